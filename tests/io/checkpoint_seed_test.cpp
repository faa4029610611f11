// The corpus of the fuzz target `checkpoint`: a state of each preset in the present layout. Another
// layout would be refused at its first field, and nothing behind that were tried.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/fuzz/checkpoint_input.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

namespace fs = std::filesystem;

constexpr const char* remedy =
    "SURGE_WRITE_SEEDS=1 build/release/bin/test_io --gtest_filter='CheckpointSeeds*' makes it anew";

fs::path seed_file(const std::string& preset) {
  return fs::path(tests::sources()) / "tests/fuzz/corpus/checkpoint" / preset;
}

TEST(CheckpointSeeds, AreTakenWholeByTheReader) {
  for (const std::string& preset : fuzz::presets_with_checkpoints()) {
    SCOPED_TRACE(preset + ": " + remedy);
    if (std::getenv("SURGE_WRITE_SEEDS") != nullptr)
      std::ofstream(seed_file(preset), std::ios::binary) << fuzz::checkpoint_seed(preset);
    std::ifstream in(seed_file(preset), std::ios::binary);
    const std::string seed{std::istreambuf_iterator<char>(in), {}};
    ASSERT_LT(seed.size(), std::size_t{1} << 15U) << "longer than the inputs that are tried";
    const tests::TemporaryFolder folder;
    const fuzz::CheckpointInput input = fuzz::checkpoint_around(seed);
    ASSERT_EQ(input.computation, &fuzz::computation_of(preset));
    std::ofstream(folder.path() / "checkpoint.bin", std::ios::binary) << input.bytes;
    ASSERT_NO_THROW({
      Checkpoint checkpoint(folder.path(), *input.computation);
      const auto solver = input.computation->restore_solver<2>(checkpoint.state());
      for (int k = 0; k < 2; ++k) (void)solver->step(1e-3);
    });
  }
}

}  // namespace
}  // namespace surge
