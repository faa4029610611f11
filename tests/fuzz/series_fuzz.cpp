#include "compare/read/particle_reader.hpp"
#include "compare/reference/series.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// Tables of two columns: a published series, and times by number.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const auto file = fuzz::scratch().put("series.csv", text);
  fuzz::try_reading([&] { (void)compare::read_series(file); });
  fuzz::try_reading([&] { (void)compare::read_time_file(file); });
  return 0;
}
