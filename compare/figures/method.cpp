#include "compare/figures/method.hpp"

#include "compare/study/run_fault.hpp"

namespace surge::compare {

std::optional<SheetRun> sheet_run(const StudyResult& study, const std::string& method) {
  std::optional<SheetRun> found;
  for (const RunResult* run : study.measured()) {
    const Run& r = run->measured->run;
    if (r.method != method || (found && r.preset != "paper")) continue;
    if (auto sheet = guarded(run->study.name, r.path, [&] { return read_method_sheet(r); }))
      found = SheetRun{run, std::move(*sheet)};
    if (found && r.preset == "paper") break;
  }
  return found;
}

Figure empty_figure(const std::string& name, const std::string& title, const std::string& why) {
  Figure figure;
  figure.name = name;
  figure.title = title;
  figure.caption = why;
  figure.missing = why;
  return figure;
}

}  // namespace surge::compare
