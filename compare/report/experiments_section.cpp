#include "compare/report/sections.hpp"

namespace surge::compare {

namespace {

std::vector<std::string> comparison_row(const Page& page, const RunResult& run,
                                        const PublishedSeries& series) {
  const Values& values = page.values;
  const std::string pointer = key({"front", run.study.name, "published", series.name});
  std::vector<std::string> row{"<code>" + values.text(key({"runs", run.study.name, "name"})) +
                               "</code>"};
  if (values.at(pointer + "/status") != "passed") {
    row.push_back(values.text(pointer + "/reason"));
    row.resize(7, "–");
    return row;
  }
  row.push_back(values.integer(pointer + "/raw/points"));
  row.push_back(values.number(pointer + "/raw/rms", 3));
  row.push_back(values.signed_number(pointer + "/raw/bias", 3));
  row.push_back(values.signed_number(pointer + "/shift_T", 3));
  row.push_back(values.integer(pointer + "/shifted/points"));
  row.push_back(values.number(pointer + "/shifted/rms", 3));
  return row;
}

std::string series_text(const Page& page, const PublishedSeries& series) {
  const Values& values = page.values;
  const std::string pointer = key({"published", series.name});
  std::string html = "<p><cite>" + values.text(pointer + "/citation") + "</cite>. ";
  if (series.experiment) {
    html += "Experiment, uncertainty ±" + values.number(pointer + "/uncertainty_T", 2) +
            " in T and ±" + values.number(pointer + "/uncertainty_Z_over_L", 2) + " in Z/L.";
  } else {
    html += "A computation, which states no uncertainty.";
  }
  return html + "</p>\n";
}

}  // namespace

std::string write_experiments(const Page& page) {
  if (page.study.published.empty()) return "<p>The study names no published series.</p>\n";
  std::string html =
      "<p>Differences run minus series at the published points inside the run’s window. "
      "<em>Raw</em>: as printed. <em>Shifted</em>: the series moved by the one constant time that "
      "makes the RMS smallest for that run; a negative shift means that the series is late, as it "
      "is where a gate takes time to leave.</p>\n";
  for (const auto& series : page.study.published) {
    std::vector<std::vector<std::string>> rows;
    for (const RunResult* run : page.study.measured()) {
      rows.push_back(comparison_row(page, *run, series));
    }
    html += "<h3>" + page.values.text(key({"published", series.name, "label"})) + "</h3>\n" +
            series_text(page, series) +
            html_table("Z/L against this series",
                       {"Run", "Points, raw", "RMS, raw", "Bias, raw", "Shift in T",
                        "Points, shifted", "RMS, shifted"},
                       rows);
  }
  return html;
}

}  // namespace surge::compare
