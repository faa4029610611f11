#include "compare/read/foam_field.hpp"
#include "tests/fuzz/foam_blocks.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// Fields of OpenFOAM in text and binary, in files of their own and collated.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  constexpr std::size_t cells = 8;
  const auto& root = fuzz::scratch().path();
  for (const std::size_t components : {std::size_t{1}, std::size_t{3}})
    fuzz::try_reading([&] {
      for (const compare::FoamBlock& block : fuzz::blocks_of(text, "field"))
        (void)compare::read_foam_field(block, "field", root, components, cells);
    });
  return 0;
}
