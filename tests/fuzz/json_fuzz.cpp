#include "compare/read/method_sheet.hpp"
#include "compare/read/readers.hpp"
#include "compare/read/recorded.hpp"
#include "compare/study/baseline.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// JSON: the manifest of a run, the sheet of its method, a baseline, a list of files.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const auto& folder = fuzz::scratch();
  folder.put("method.json", text);
  folder.put("list.vtp.series", text);
  const auto file = folder.put("manifest.json", text);
  fuzz::try_reading([&] {
    compare::Run run;
    compare::apply_manifest(run, file);
  });
  fuzz::try_reading([&] {
    compare::Run run;
    run.path = folder.path();
    if (const auto sheet = compare::read_method_sheet(run)) (void)sheet->stages_with({});
  });
  fuzz::try_reading([&] { (void)compare::read_baseline(file); });
  fuzz::try_reading([&] { (void)compare::list_series(folder.path() / "list.vtp.series"); });
  return 0;
}
