#include "compare/read/method_sheet.hpp"
#include "compare/read/readers.hpp"
#include "compare/read/recorded.hpp"
#include "compare/study/baseline.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// JSON: the manifest of a run, the sheet of its method, a baseline, a list of files.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const auto& folder = fuzz::scratch_with({"a.vtp", "sub/b.vtp"});
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
  // With the checksum that belongs to it, or nothing behind that were tried.
  nlohmann::json baseline = nlohmann::json::parse(text, nullptr, false);
  if (baseline.is_object()) {
    baseline["checksum"] = compare::baseline_checksum(baseline);
    folder.put("baseline.json", baseline.dump());
    fuzz::try_reading([&] { (void)compare::read_baseline(folder.path() / "baseline.json"); });
  }
  fuzz::try_reading([&] { (void)compare::list_series(folder.path() / "list.vtp.series"); });
  return 0;
}
