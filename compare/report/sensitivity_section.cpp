#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// The row of a run; `at` points to it.
std::vector<std::string> row(const Page& page, const std::string& at, std::string choice,
                             std::string value) {
  const Values& values = page.values;
  const std::string status = values.at(at + "/status");
  if (status != "complete") value += " (" + values.text(at + "/status") + ")";
  return {std::move(choice),
          std::move(value),
          values.number(at + "/rms", 4),
          values.number(at + "/max", 4),
          values.signed_number(at + "/bias", 4),
          values.number(at + "/impact_time_s", 4),
          values.number(at + "/rms_vs_base", 4),
          values.signed_number(at + "/bias_vs_base", 4),
          values.integer(at + "/steps"),
          values.number(at + "/cost_ratio", 2)};
}

std::string table(const Page& page, const std::string& method) {
  const std::string at = key({"sensitivity", method});
  std::vector<std::vector<std::string>> rows{row(page, at + "/base", "base", "")};
  const json& runs = page.values.at(at + "/runs");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string run = at + "/runs/" + std::to_string(i);
    std::string choice = page.values.text(run + "/choice");
    if (!runs[i]["base_value"].is_null())
      choice += ", base " + page.values.text(run + "/base_value");
    rows.push_back(row(page, run, choice, page.values.text(run + "/value")));
  }
  return html_table(upper(method) +
                        ": the leading edge Z/L against the reference and against the "
                        "base, and the cost",
                    {"Choice", "Value", "RMS", "Max", "Bias", "Impact, s", "RMS to base",
                     "Bias to base", "Steps", "Cost over base"},
                    rows);
}

/// Runs that are not there or broke, with what is known about it.
std::string notes(const Page& page, const std::string& method) {
  const std::string at = key({"sensitivity", method, "runs"});
  std::string html;
  for (std::size_t i = 0; i < page.values.at(at).size(); ++i) {
    const std::string run = at + "/" + std::to_string(i);
    if (page.values.at(run + "/note").get<std::string>().empty()) continue;
    html += "<li>" + page.values.text(run + "/choice") + " " + page.values.text(run + "/value") +
            ": " + page.values.text(run + "/note") + "</li>";
  }
  return html.empty() ? "" : "<ul>" + html + "</ul>\n";
}

}  // namespace

std::string write_sensitivity(const Page& page) {
  const json& methods = page.values.at("/sensitivity");
  if (methods.empty()) return "";
  std::string html =
      "<p>What the paper leaves open, and what its presets chose, changed one choice at a time. "
      "Differences are those of the leading edge before it comes near the far wall, in units of L; "
      "the reference is " +
      page.values.text("/definition/reference") +
      ". The cost is in CPU seconds per simulated second, because these runs share the "
      "machine.</p>\n";
  for (const auto& [method, entry] : methods.items()) {
    html += "<h3>" + upper(method) + "</h3>\n" + figure_html(page, "sensitivity_" + method) +
            table(page, method) + notes(page, method);
  }
  return html;
}

}  // namespace surge::compare
