#include "compare/study/study.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// A study file, with another one beside it that it can include.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  static const bool beside = [] {
    fuzz::scratch().put(
        "part.toml",
        "title = \"p\"\nreference = \"a\"\nstrip_height = 0.01\n"
        "snapshot_times = []\npublished = []\n[[run]]\nname = \"a\"\nprogram = \"surge-particle\"\n"
        "case = \"a.toml\"\n");
    return true;
  }();
  (void)beside;
  const auto file = fuzz::scratch().put("study.toml", text);
  fuzz::try_reading([&] { (void)compare::read_study(file); });
  return 0;
}
