#include "compare/read/reading_process.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_vtp;

/// File k has k + 1 particles at x = k.
struct ReadingProcesses : ::testing::Test {
  TemporaryFolder folder;
  ReadingProcess process;

  [[nodiscard]] fs::path file(std::size_t k) const {
    const fs::path path = folder / ("f_" + std::to_string(k) + ".vtp");
    if (!fs::exists(path)) write_vtp(path, std::vector<Vec3>(k + 1, Vec3{double(k), 0, 0}), {});
    return path;
  }
  std::size_t count_in(std::size_t k) {
    process.ask(file(k), std::nullopt);
    return process.answer().count;
  }
};

/// The one child of this process.
pid_t the_child() {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream in(entry.path() / "stat");
    std::string stat;
    if (!std::getline(in, stat)) continue;
    char state = ' ';
    pid_t parent = 0;
    std::istringstream rest(stat.substr(stat.rfind(')') + 1));  // a name may hold anything
    if (rest >> state >> parent && parent == getpid())
      found.push_back(static_cast<pid_t>(std::stol(entry.path().filename())));
  }
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? -1 : found.front();
}

/// Sends the signal and waits until it has acted; what ended stays to be waited for.
void signal_and_wait(pid_t child, int signal) {
  ASSERT_EQ(::kill(child, signal), 0);
  siginfo_t info{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WSTOPPED | WNOWAIT), 0);
}

TEST_F(ReadingProcesses, TablesAreThoseOfReadVtk) {
  const ArrayNames pressure{std::vector<std::string>{"pressure"}};
  for (const ArrayNames& wanted : {ArrayNames{}, pressure}) {
    process.ask(file(3), wanted);
    const ParticleTable found = process.answer(), expected = read_vtk(file(3), wanted);
    EXPECT_EQ(found.count, 4U);
    EXPECT_EQ(found.points, expected.points);
    ASSERT_EQ(found.arrays.size(), expected.arrays.size());
    for (std::size_t i = 0; i < found.arrays.size(); ++i) {
      EXPECT_EQ(found.arrays[i].name, expected.arrays[i].name);
      EXPECT_EQ(found.arrays[i].values, expected.arrays[i].values);
    }
  }
}

TEST_F(ReadingProcesses, OneChildReadsAllFilesAndHoldsNothingElseOpen) {
  EXPECT_EQ(count_in(0), 1U);
  const pid_t child = the_child();
  EXPECT_EQ(count_in(5), 6U);
  EXPECT_EQ(the_child(), child);
  const fs::path open = fs::path("/proc") / std::to_string(child) / "fd";
  EXPECT_EQ(std::distance(fs::directory_iterator(open), {}), 4);  // three standard ones, its own
}

TEST_F(ReadingProcesses, AFaultIsThatOfItsFile) {
  fs::resize_file(file(2), fs::file_size(file(2)) / 2);
  EXPECT_THAT(error_of([&] { (void)count_in(2); }), HasSubstr("f_2.vtp"));
  EXPECT_EQ(count_in(1), 2U);
  EXPECT_THAT(error_of([&] {
                process.ask(folder / "none.vtp", std::nullopt);
                (void)process.answer();
              }),
              HasSubstr("none.vtp"));
}

TEST_F(ReadingProcesses, AnAnswerThatWasNotFetchedIsDropped) {
  process.ask(file(1), std::nullopt);
  EXPECT_EQ(count_in(4), 5U);
}

TEST_F(ReadingProcesses, AChildThatEndedWhileNothingWasAskedIsReplaced) {
  EXPECT_EQ(count_in(0), 1U);
  signal_and_wait(the_child(), SIGKILL);
  EXPECT_EQ(count_in(1), 2U);
}

struct KilledReadingProcesses : ReadingProcesses {
  /// The child ended while file 1 was asked for and not answered.
  void SetUp() override {
    EXPECT_EQ(count_in(0), 1U);
    const pid_t child = the_child();
    signal_and_wait(child, SIGSTOP);
    process.ask(file(1), std::nullopt);
    signal_and_wait(child, SIGKILL);
  }
};

TEST_F(KilledReadingProcesses, EndIsAnErrorOfTheFileAskedFor) {
  EXPECT_THAT(error_of([&] { (void)process.answer(); }),
              HasSubstr("f_1.vtp: the library that reads it broke down (signal 9)"));
  EXPECT_EQ(count_in(2), 3U);
}

TEST_F(KilledReadingProcesses, EndIsNoErrorOfAnotherFile) {
  EXPECT_EQ(count_in(2), 3U);
}

}  // namespace
}  // namespace surge::compare
