#include "compare/read/foam_dictionary.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// Dictionaries of OpenFOAM, with an include that is there.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const auto& root = fuzz::scratch();
  static const bool beside = [] {
    fuzz::scratch().put("part", "a 1;\nb { c (0 1 2); }\n");
    return true;
  }();
  (void)beside;
  fuzz::try_reading([&] {
    const auto read =
        compare::FoamDictionary::parse(std::string(text), root.path() / "dictionary", root.path());
    for (const std::string& key : read.keys()) {
      (void)read.words(key);
      fuzz::try_reading([&] { (void)read.numbers(key, 3); });
    }
  });
  return 0;
}
