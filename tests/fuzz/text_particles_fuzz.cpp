#include "compare/read/particle_table.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// Particles in text: tables with any delimiter, and dumps of LAMMPS.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const auto file = fuzz::scratch().put("particles.dat", text);
  compare::SourceOptions options;
  const bool dump = text.starts_with("ITEM:");
  options.format = dump ? "lammps" : "csv";
  for (const char* time : {"", "t"}) {
    options.time_array = time;
    fuzz::try_reading([&] {
      for (const compare::FilePart& part : compare::parts_of(file, options)) {
        (void)compare::read_table(file, part, std::nullopt, options);
        (void)compare::read_table(file, part, std::vector<std::string>{"x", "y"}, options);
      }
    });
  }
  return 0;
}
