#include "compare/read/source_options.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// A map file, which says what the arrays of a foreign program are.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const auto file = fuzz::scratch().put("map.toml", text);
  fuzz::try_reading([&] { (void)compare::read_source_map(file); });
  return 0;
}
