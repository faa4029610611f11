#include "particle/support/process.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "particle/support/error.hpp"

namespace surge {
namespace {

TEST(RunProcess, SaysHowItEndedAndWhatItSaid) {
  const ProcessEnd end = run_process("sh", {"-c", "echo out; echo err >&2; exit 3"}, "/", "dash");
  EXPECT_EQ(end.status, 3);
  EXPECT_EQ(end.said, "out\nerr\n");
  EXPECT_EQ(run_process("sh", {"-c", "kill -9 $$"}, "/", "dash").status, -1);
}

TEST(RunProcess, ArgumentsMeanWhatTheyAre) {
  EXPECT_EQ(run_process("printf", {"%s", "$HOME `id` \"x\""}, "/", "coreutils").said,
            "$HOME `id` \"x\"");
}

// A machine without a locale is one: a container, a job of cron.
TEST(RunProcess, LocaleIsNotTheUsers) {
  const char* before = std::getenv("LC_ALL");
  const std::string kept = before != nullptr ? before : "";
  ::setenv("LC_ALL", "C", 1);
  EXPECT_EQ(run_process("sh", {"-c", "env | grep ^LC_ALL="}, "/", "dash").said, "LC_ALL=C.UTF-8\n");
  if (before != nullptr)
    ::setenv("LC_ALL", kept.c_str(), 1);
  else
    ::unsetenv("LC_ALL");
}

TEST(RunProcess, ProgramThatIsNotThereIsNamedWithItsPackage) {
  try {
    static_cast<void>(run_process("no-such-program", {}, "/", "its-package"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "no-such-program: not found, expected the program (Debian package its-package)");
  }
}

}  // namespace
}  // namespace surge
