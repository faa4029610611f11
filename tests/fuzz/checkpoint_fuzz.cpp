#include "tests/fuzz/checkpoint_input.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// Checkpoints of every preset: what is taken is a state that steps.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::CheckpointInput input = fuzz::checkpoint_around(fuzz::text_of(data, size));
  fuzz::scratch().put("checkpoint.bin", input.bytes);
  fuzz::try_reading([&] {
    Checkpoint checkpoint(fuzz::scratch().path(), *input.computation);
    const auto solver = input.computation->restore_solver<2>(checkpoint.state());
    for (int k = 0; k < 2; ++k) (void)solver->step(1e-3);
  });
  return 0;
}
