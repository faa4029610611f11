#include "particle/io/computation.hpp"
#include "particle/support/error.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// A case file: what is taken must read back as the same from its own text.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::try_reading([&] {
    const Computation computation = parse_computation(text, "case.toml");
    const std::string written = to_toml(computation);
    if (to_toml(parse_computation(written, "written.toml")) != written) std::abort();
  });
  return 0;
}
