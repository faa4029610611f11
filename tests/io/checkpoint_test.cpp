#include "particle/io/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "particle/io/run_folder.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/io/restart_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A checkpoint of the small case after a few steps, and what becomes of changed ones.
class CheckpointFile : public testing::Test {
 protected:
  CheckpointFile() {
    const auto solver = computation_.make_solver<2>();
    for (int k = 0; k < 5; ++k) record_.add(solver->step(1e-3), solver->time());
    record_.started = "2010-05-03T12:00:00Z";
    record_.frames = 2;
    record_.simulated = solver->time();
    record_.ppe_worst_residual = 0.1;
    record_.wall = {0.1, 1.0 / 3.0, 0.3, 0.4, 0.5};
    record_.restarts.push_back({"2010-05-03T13:00:00Z", 3, 0.1, 2, "a processor"});
    state_ = test::fingerprint(solver->state());
    write_checkpoint(folder_.path(), computation_, record_, solver->state());
    text_ = test::read_text(file_);
  }

  [[nodiscard]] std::uint64_t restored_state() const {
    Checkpoint checkpoint(folder_.path(), computation_);
    return test::fingerprint(computation_.restore_solver<2>(checkpoint.state())->state());
  }
  /// What it is refused with, in one line; empty where it is taken.
  [[nodiscard]] std::string refusal(const Computation& computation) const {
    try {
      Checkpoint checkpoint(folder_.path(), computation);
      const auto solver = computation.restore_solver<2>(checkpoint.state());
      return "";
    } catch (const RestartError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      EXPECT_THAT(error.what(), HasSubstr("checkpoint.bin: "));
      return error.what();
    }
  }
  [[nodiscard]] std::string refusal() const { return refusal(computation_); }
  void write(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }
  /// The header, and where the state begins.
  [[nodiscard]] std::pair<json, std::size_t> header() const {
    const std::size_t first = text_.find('\n') + 1;
    const std::size_t second = text_.find('\n', first) + 1;
    const std::size_t length = std::stoul(text_.substr(first, second - first));
    return {json::parse(text_.substr(second, length)), second + length};
  }
  /// Writes a checkpoint with this header and state and the checksum that belongs to them.
  void forge(const std::string& header, const std::string& state) const {
    std::string text = text_.substr(0, text_.find('\n') + 1);
    text += std::to_string(header.size()) + '\n' + header + state;
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
    std::array<char, 32> line{};
    std::snprintf(line.data(), line.size(), "crc32 %08lx\n", sum);
    write(text + line.data());
  }
  [[nodiscard]] std::string state_bytes() const {
    const std::size_t begin = header().second;
    return text_.substr(begin, text_.size() - 15 - begin);
  }
  /// The refusal of a checkpoint whose header was changed.
  [[nodiscard]] std::string refusal_with(const std::function<void(json&)>& change) const {
    json changed = header().first;
    change(changed);
    forge(changed.dump() + '\n', state_bytes());
    return refusal();
  }

  tests::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / checkpoint_name;
  Computation computation_ = test::make_computation();
  RunRecord record_;
  std::uint64_t state_ = 0;
  std::string text_;
};

TEST_F(CheckpointFile, GivesBackStateAndRecord) {
  EXPECT_EQ(restored_state(), state_);
  const Checkpoint checkpoint(folder_.path(), computation_);
  EXPECT_EQ(to_json(checkpoint.record()), to_json(record_));
  EXPECT_EQ(checkpoint.record().wall[1], 1.0 / 3.0);
  EXPECT_EQ(checkpoint.record().restarts.at(0).cpu, "a processor");
  EXPECT_FALSE(std::filesystem::exists(file_.string() + ".tmp"));
}

TEST_F(CheckpointFile, IsRefusedWhereItIsCut) {
  for (std::size_t size = 0; size < text_.size(); size += size < 3000 ? 1 : 97) {
    write(text_.substr(0, size));
    ASSERT_NE(refusal(), "") << size;
  }
  write(text_ + "x");
  EXPECT_NE(refusal(), "");
  write(text_);
  EXPECT_EQ(refusal(), "");
}

TEST_F(CheckpointFile, IsRefusedWhereABitHasChanged) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> bit(0, 7);
  for (std::size_t at = 0; at < text_.size(); at += at < 2000 ? 7 : 131) {
    std::string damaged = text_;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit(random)));
    write(damaged);
    ASSERT_NE(refusal(), "") << at;
  }
}

TEST_F(CheckpointFile, OfAnotherCaseIsRefusedByTheKey) {
  const auto other = [&](const char* set) { return refusal(test::make_computation({set})); };
  EXPECT_THAT(other("fluid.density=998"),
              HasSubstr("another case: fluid.density = 1000.0, expected 998.0"));
  EXPECT_THAT(other("sph.gamma=5"), HasSubstr("sph.gamma = 7.0, expected 5.0"));
  EXPECT_THAT(other("method.name=mps"), HasSubstr("method.name = \"sph\", expected \"mps\""));
  EXPECT_THAT(other("resolution.spacing=0.005"), HasSubstr("resolution.spacing = 0.01"));
  EXPECT_EQ(other("output.checkpoint=1"), "");
}

TEST_F(CheckpointFile, OfAnotherBuildIsRefused) {
  EXPECT_THAT(refusal_with([](json& j) { j["build"] = "0123"; }), HasSubstr("another build"));
  EXPECT_THAT(refusal_with([](json& j) { j["compiler"] = "Clang 19"; }),
              HasSubstr("another build, by Clang 19, expected "));
  EXPECT_THAT(refusal_with([](json& j) { j["flags"] = "-O0"; }), HasSubstr("with -O0"));
}

TEST_F(CheckpointFile, OfAnotherStateIsRefused) {
  EXPECT_THAT(refusal_with([](json& j) { j["fields"][0][0] = "p.y.0"; }),
              HasSubstr("found field p.y.0 (f8), expected p.x.0 (f8)"));
  EXPECT_THAT(refusal_with([](json& j) { j["fields"][0][1] = "f4"; }), HasSubstr("(f4)"));
  EXPECT_THAT(refusal_with([](json& j) {
                j["fields"].push_back({"more", "f8", 0, 8});
              }),
              HasSubstr("found field more"));
  // Values without bytes, of which any number fits into any file.
  EXPECT_NE(refusal_with([](json& j) {
              j["fields"].push_back({"more", "f8", 1ULL << 60U, 0});
            }),
            "");
  EXPECT_NE(refusal_with([](json& j) {
              j["fields"].insert(j["fields"].begin(), {"p.x.0", "f8", 1ULL << 60U, 0});
            }),
            "");
  EXPECT_THAT(refusal_with([](json& j) {
                const auto n = j["fields"][0][2].get<std::size_t>();
                j["fields"][0][2] = n - 1;
                j["fields"][1][2] = n + 1;
              }),
              HasSubstr("a value per particle"));
}

TEST_F(CheckpointFile, WithHeadersThatAreNoneIsRefused) {
  for (const char* text :
       {"", "{}", "[]", "null", "{\"build\": 1}", "{\"fields\": [[]]}", "\xff"}) {
    forge(text, state_bytes());
    EXPECT_THAT(refusal(), HasSubstr("found a header that is none")) << text;
  }
  forge(std::string(100000, '['), state_bytes());
  EXPECT_NE(refusal(), "");
  for (const json& count : {json(-1), json(1e300), json("5"), json(nullptr), json(1ULL << 63U)})
    EXPECT_NE(refusal_with([&](json& j) { j["fields"][0][2] = count; }), "") << count;
  for (const json& run : {json(), json(5), json::object(), json({{"steps", "many"}})})
    EXPECT_NE(refusal_with([&](json& j) { j["run"] = run; }), "") << run;
}

TEST_F(CheckpointFile, WithOtherParticlesIsRefused) {
  const auto [head, unused] = header();
  std::size_t ids = 0;  // where they begin
  for (const json& field : head["fields"]) {
    if (field[0] == "p.id") break;
    ids += field[2].get<std::size_t>() * field[3].get<std::size_t>();
  }
  for (const std::int32_t id : {-1, 1 << 30, 0}) {
    std::string state = state_bytes();
    for (std::size_t k = 0; k < 2; ++k)  // two of them
      std::memcpy(state.data() + ids + 4 * k, &id, 4);
    forge(head.dump() + '\n', state);
    EXPECT_THAT(refusal(), HasSubstr("found other particles")) << id;
  }
}

TEST_F(CheckpointFile, ThatIsNoFileIsRefused) {
  std::filesystem::rename(file_, folder_.path() / "else");
  EXPECT_THAT(refusal(), HasSubstr("found no file of its own"));
  EXPECT_THROW(require_checkpoint(folder_.path()), RestartError);
  std::filesystem::create_symlink(folder_.path() / "else", file_);
  EXPECT_THAT(refusal(), HasSubstr("found no file of its own"));
  std::filesystem::remove(file_);
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT(refusal(), HasSubstr("found no file of its own"));
  std::filesystem::remove(file_);
  std::filesystem::rename(folder_.path() / "else", file_);
  std::filesystem::resize_file(file_, 1ULL << 40U);  // a hole of a terabyte
  EXPECT_THAT(refusal(), HasSubstr("expected at most"));
}

TEST_F(CheckpointFile, TheOlderOneStaysWhereTheNewOneFails) {
  const auto solver = computation_.make_solver<2>();
  std::filesystem::create_directory(file_.string() + ".tmp");  // in the way
  EXPECT_THROW(write_checkpoint(folder_.path(), computation_, record_, solver->state()), Error);
  EXPECT_EQ(restored_state(), state_);
}

}  // namespace
}  // namespace surge
