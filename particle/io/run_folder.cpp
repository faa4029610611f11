#include "particle/io/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "particle/io/atomic_file.hpp"
#include "particle/io/restart_error.hpp"
#include "particle/io/step_table.hpp"
#include "particle/support/json.hpp"

namespace surge {

namespace fs = std::filesystem;

namespace {

constexpr const char* lock_name = ".lock";
constexpr const char* manifest_name = "manifest.json";
constexpr const char* collection_name = "particles.pvd";
constexpr const char* steps_name = "steps.csv";
constexpr const char* frames_folder = "frames";
constexpr std::array results{checkpoint_name, collection_name, steps_name, "case.toml",
                             "method.json"};

/// The manifest of a run of ours, or nothing.
nlohmann::json manifest_of(const fs::path& folder) {
  nlohmann::json json;
  try {
    json = read_json(folder / manifest_name);
  } catch (const Error&) {  // whatever that is, it is no run of ours
    return {};
  }
  const bool ours =
      json.is_object() && json.contains("program") && json["program"] == "surge-particle";
  return ours ? json : nlohmann::json();
}

bool is_frame(const std::string& name) {
  return name.starts_with("frame_") && (name.ends_with(".vtp") || name.ends_with(".tmp"));
}

/// Removes the frames for whose names `unwanted` holds.
template <class Unwanted>
void remove_frames(const fs::path& folder, Unwanted&& unwanted) {
  if (!fs::is_directory(folder / frames_folder)) return;
  for (const auto& entry : fs::directory_iterator(folder / frames_folder)) {
    const std::string name = entry.path().filename().string();
    if (is_frame(name) && unwanted(name)) fs::remove(entry.path());
  }
}

void remove_run(const fs::path& folder) {
  for (const char* name : results) fs::remove(folder / name);
  remove_frames(folder, [](const std::string&) { return true; });
}

/// Through a link we would write to or remove what is not the run's.
void refuse_links(const fs::path& folder) {
  const auto check = [&](const char* name) {
    if (fs::is_symlink(fs::symlink_status(folder / name)))
      throw Error((folder / name).string() + ": found a link, expected a file of the run's own");
  };
  for (const char* name : results) check(name);
  check(manifest_name);
  check(frames_folder);
}

/// What is lost where the run is replaced, and what else could be done.
void refuse_older_run(const fs::path& folder, const nlohmann::json& manifest) {
  const bool finished = manifest.contains("finished") && manifest["finished"] == true;
  std::string options = "; --force replaces it";
  if (!finished && fs::exists(folder / checkpoint_name))
    options = "; --restart goes on with it from its checkpoint, --force replaces it";
  throw Error(folder.string() + ": found " + (finished ? "a finished" : "an unfinished") +
              " run, expected an empty folder" + options);
}

void refuse_foreign_files(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    // What we left when we were killed while starting here before, and what keeps others out.
    if (name == "manifest.json.tmp" || name == lock_name) continue;
    throw Error(folder.string() + ": found \"" + name +
                "\" and no run of surge-particle, expected an empty folder or an older run");
  }
}

}  // namespace

void make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code || !fs::is_directory(folder)) {
    const std::string found = code ? code.message() : "a file";
    throw Error(folder.string() + ": found " + found +
                ", expected a folder or a place to make one");
  }
}

FolderLock::FolderLock(const fs::path& folder) {
  make_folder(folder);
  const fs::path file = folder / lock_name;
  descriptor_ = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (descriptor_ < 0) {
    throw Error(file.string() + ": found " + std::strerror(errno) +
                ", expected a place to write to");
  }
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  close(descriptor_);
  throw Error(folder.string() +
              ": found another run that is being written here, expected a folder of its own");
}

FolderLock::~FolderLock() {
  close(descriptor_);
}

void claim_run_folder(const fs::path& folder, const std::string& manifest, bool force) {
  make_folder(folder);
  refuse_links(folder);
  const nlohmann::json older = manifest_of(folder);
  if (older.is_null()) {
    refuse_foreign_files(folder);
  } else if (!force && fs::exists(folder / collection_name)) {
    refuse_older_run(folder, older);
  }
  // A checkpoint would be taken for that of the new run.
  fs::remove(folder / checkpoint_name);
  write_file(folder / manifest_name, manifest);
  remove_run(folder);
}

std::string frame_name(long index) {
  std::array<char, 48> name{};
  std::snprintf(name.data(), name.size(), "frames/frame_%05ld.vtp", index);
  return name.data();
}

void check_results(const fs::path& folder, long frames, long rows, double time) {
  refuse_links(folder);
  for (long k = 0; k < frames; ++k) {
    if (fs::is_regular_file(fs::symlink_status(folder / frame_name(k)))) continue;
    throw RestartError((folder / frame_name(k)).string() + ": found no such frame, expected the " +
                       std::to_string(frames) +
                       " frames that the checkpoint follows; --force "
                       "starts anew");
  }
  check_rows(folder / steps_name, rows, time);
}

void cut_back(const fs::path& folder, long frames, long rows) {
  std::set<std::string> wanted;
  for (long k = 0; k < frames; ++k) wanted.insert(fs::path(frame_name(k)).filename().string());
  remove_frames(folder, [&](const std::string& name) { return !wanted.contains(name); });
  cut_rows(folder / steps_name, rows);
}

}  // namespace surge
