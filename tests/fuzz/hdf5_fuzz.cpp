#include "compare/read/particle_table.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// HDF5 files: their groups, attributes and data sets.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const auto file = fuzz::scratch().put("particles.h5", text);
  compare::SourceOptions options;
  options.format = "hdf5";
  for (const char* group : {"", "Step#*"}) {
    options.groups.assign(*group != 0 ? 1 : 0, group);
    fuzz::try_reading([&] {
      for (const compare::FilePart& part : compare::parts_of(file, options))
        (void)compare::read_table(file, part, std::nullopt, options);
    });
  }
  return 0;
}
