#include "compare/read/particle_table.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// Legacy VTK files, in text and binary.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const auto file = fuzz::scratch().put("particles.vtk", text);
  fuzz::try_reading([&] {
    for (const compare::FilePart& part : compare::parts_of(file, {}))
      (void)compare::read_table(file, part, std::nullopt, {});
  });
  return 0;
}
