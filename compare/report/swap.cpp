#include "compare/report/swap.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// What a report's folder may hold besides the stamps of the workflow, which begin with a dot.
constexpr std::array parts{"index.html", "metrics.json", "figures", "summary.txt"};

std::string name_of(const fs::path& folder) {
  std::string name = ".";
  return name.append(folder.filename().string()).append(".new-");
}

void check_place(const fs::path& folder) {
  if (fs::is_symlink(folder)) {
    throw Error(folder.string() + ": found a link to " + fs::read_symlink(folder).string() +
                ", expected a folder of its own (remove the link, or name another folder)");
  }
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw Error(folder.string() + ": found a file, expected a folder");
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool ours =
        name.starts_with('.') || std::find(parts.begin(), parts.end(), name) != parts.end();
    if (!ours)
      throw Error(folder.string() + ": found " + name +
                  ", which is no part of a report; expected an empty folder, or an older report, "
                  "which is replaced as a whole");
  }
}

/// Folders of processes that are gone.
void remove_leftovers(const fs::path& folder) {
  const std::string begin = name_of(folder);
  for (const auto& entry : fs::directory_iterator(folder.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin)) continue;
    const std::string number = name.substr(begin.size());
    pid_t process = 0;
    const auto [end, failed] =
        std::from_chars(number.data(), number.data() + number.size(), process);
    const bool is_number = failed == std::errc() && end == number.data() + number.size();
    if (is_number && process > 0 && (kill(process, 0) == 0 || errno != ESRCH)) continue;
    std::error_code ignored;
    if (is_number) fs::remove_all(entry.path(), ignored);
  }
}

/// Gives `unfinished` the place of `folder`; what was there is then at `unfinished`.
void exchange(const fs::path& unfinished, const fs::path& folder) {
  if (!fs::exists(folder)) {
    fs::rename(unfinished, folder);
    return;
  }
  if (renameat2(AT_FDCWD, unfinished.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0)
    return;
  if (errno != EINVAL && errno != ENOSYS)
    throw Error(folder.string() + ": cannot be replaced: " + std::strerror(errno));
  // A file system that cannot exchange: two steps, between which neither is there.
  const fs::path old = unfinished.string() + "-old";
  fs::rename(folder, old);
  fs::rename(unfinished, folder);
  fs::rename(old, unfinished);
}

class Unfinished {
 public:
  explicit Unfinished(fs::path path) : path_(std::move(path)) { fs::create_directory(path_); }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  ~Unfinished() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

 private:
  fs::path path_;
};

}  // namespace

void make_in_place(const fs::path& named, const std::function<void(const fs::path&)>& make) {
  fs::path folder = fs::absolute(named).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  try {
    check_place(folder);
    fs::create_directories(folder.parent_path());
    remove_leftovers(folder);
    const fs::path path = folder.parent_path() / (name_of(folder) + std::to_string(::getpid()));
    fs::remove_all(path);
    const Unfinished unfinished(path);
    make(path);
    exchange(path, folder);
  } catch (const fs::filesystem_error& error) {
    throw Error(error.path1().string() + ": cannot be written: " + error.code().message());
  }
}

}  // namespace surge::compare
