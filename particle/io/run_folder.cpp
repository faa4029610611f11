#include "particle/io/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

namespace surge {

namespace fs = std::filesystem;

namespace {

constexpr const char* lock_name = ".lock";

bool is_run(const fs::path& manifest) {
  std::ifstream stream(manifest);
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  return json.is_object() && json.value("program", "") == "surge-particle";
}

void remove_run(const fs::path& folder) {
  for (const char* name : {"particles.pvd", "steps.csv", "case.toml", "method.json"})
    fs::remove(folder / name);
  if (!fs::is_directory(folder / "frames")) return;
  for (const auto& entry : fs::directory_iterator(folder / "frames")) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("frame_") && (name.ends_with(".vtp") || name.ends_with(".tmp"))) {
      fs::remove(entry.path());
    }
  }
}

}  // namespace

void write_file(const fs::path& file, const std::string& text) {
  const fs::path unfinished = file.string() + ".tmp";
  std::ofstream stream(unfinished, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw Error(file.string() + ": found no way to write, expected a writable place");
  rename_file(unfinished, file);
}

void rename_file(const fs::path& from, const fs::path& to) {
  std::error_code code;
  fs::rename(from, to, code);
  if (code) throw Error(to.string() + ": found " + code.message() + ", expected a writable place");
}

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

void claim_run_folder(const fs::path& folder, const std::string& manifest) {
  make_folder(folder);
  const fs::path file = folder / "manifest.json";
  if (!is_run(file)) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      // What we left when we were killed while starting here before, and what keeps others out.
      if (name == "manifest.json.tmp" || name == lock_name) continue;
      throw Error(folder.string() + ": found \"" + name +
                  "\" and no run of surge-particle, expected an empty folder or an older run");
    }
  }
  write_file(file, manifest);
  remove_run(folder);
}

}  // namespace surge
