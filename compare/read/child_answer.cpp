#include "compare/read/child_answer.hpp"

#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// What stands before the bytes of an answer.
enum class Sent : char { result = 'r', error = 'e', other = 'o' };

rlim_t seconds_used() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<rlim_t>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec);
}

}  // namespace

void limit_child(std::uintmax_t bytes) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU})
    std::signal(signal, SIG_DFL);
  const auto set = [](auto what, rlim_t most) {
    rlimit limit{};
    getrlimit(what, &limit);
    limit.rlim_cur = std::min(most, limit.rlim_max);
    setrlimit(what, &limit);
  };
  set(RLIMIT_CORE, 0);
  set(RLIMIT_CPU, seconds_used() + 30 + bytes / 1'000'000);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__clang__)  // whose shadow takes terabytes
  // Values take a thousand times their compressed size at most.
  set(RLIMIT_DATA, (std::uintmax_t{8} << 30U) + 1000 * bytes);
#endif
}

std::string answer_of(const std::function<std::string()>& work) {
  std::string answer;
  Sent kind = Sent::result;
  try {
    answer = work();
  } catch (const Error& error) {
    kind = Sent::error;
    answer = error.what();
  } catch (const std::exception& error) {
    kind = Sent::other;
    answer = error.what();
  }
  answer.insert(answer.begin(), static_cast<char>(kind));
  return answer;
}

std::string result_of(std::string answer, const fs::path& file) {
  const auto kind = static_cast<Sent>(answer.at(0));
  answer.erase(0, 1);
  if (kind == Sent::error) throw Error(answer);
  if (kind == Sent::other) throw Error(file.string() + ": cannot be read: " + answer);
  return answer;
}

Error broken_down(const fs::path& file, int status) {
  const std::string how = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                              : "status " + std::to_string(WEXITSTATUS(status));
  return Error(file.string() + ": the library that reads it broke down (" + how +
               "), an undamaged file expected");
}

}  // namespace surge::compare
