#include <pwd.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <memory>

#include "compare/study/baseline.hpp"
#include "particle/support/error.hpp"
#include "particle/support/version.hpp"

namespace surge::compare {
namespace {

std::string first_line_of(const char* command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command, "r"), pclose);
  std::array<char, 256> buffer{};
  if (!pipe || !std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe.get())) return {};
  const std::string line(buffer.data());
  return line.substr(0, line.find('\n'));
}

std::string user_name() {
  std::string git = first_line_of("git config user.name 2>/dev/null");
  if (!git.empty()) return git;
  const char* user = std::getenv("USER");
  if (user && *user) return user;
  const passwd* entry = getpwuid(getuid());
  if (entry) return entry->pw_name;
  throw Error("--bless: nobody found (git config user.name or USER expected)");
}

std::string cpu_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

Provenance provenance_now(const std::string& reason) {
  if (reason.find_first_not_of(" \t\n") == std::string::npos)
    throw Error("--bless: no reason found, --reason \"...\" expected");
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  const BuildInfo build = build_info();
  return {user_name(),    date.data(), build.version, build.commit,
          build.compiler, cpu_name(),  reason};
}

}  // namespace surge::compare
