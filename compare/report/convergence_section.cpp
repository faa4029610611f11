#include "compare/report/sections.hpp"
#include "compare/study/sequences.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string item(const std::string& array, std::size_t i) {
  return array + "/" + std::to_string(i);
}

/// Table of a sequence: a row for each quantity, the levels from fine to coarse and what they say.
std::string sequence_table(const Page& page, const std::string& at) {
  const Values& v = page.values;
  const json& sequence = v.at(at);
  const bool spacing = sequence["refined"] == "spacing";
  std::vector<std::string> header{"Quantity"};
  for (std::size_t i = 0; i < sequence["levels"].size(); ++i)
    header.push_back(v.number(item(at + "/levels", i) + "/size_milli", spacing ? 2 : 3) +
                     (spacing ? " mm" : " ms"));
  for (const char* name : {"Approach", "Order", "Extrapolated", "GCI", "U"})
    header.emplace_back(name);
  header.emplace_back("Asymptotic");
  Rows rows;
  std::string doubts;
  for (const auto& [name, quantity] : sequence["quantities"].items()) {
    const std::string here = at + "/quantities/" + name;
    std::vector<std::string> row{v.text(here + "/title")};
    for (std::size_t i = 0; i < quantity["values"].size(); ++i)
      row.push_back(v.number(item(here + "/values", i), 4));
    if (quantity["result"].is_null()) {
      row.resize(header.size(), "–");
      rows.push_back(std::move(row));
      continue;
    }
    const std::string result = here + "/result";
    row.push_back(v.text(result + "/approach"));
    row.push_back(v.number(result + "/order", 2));
    for (const char* number : {"/extrapolated", "/gci21", "/uncertainty"})
      row.push_back(v.number(result + number, 4));
    const bool asymptotic = quantity["result"]["asymptotic"];
    row.emplace_back(asymptotic ? "yes" : "no");
    if (!asymptotic)
      doubts += "<li>" + v.text(here + "/title") + ": " + v.text(result + "/doubts") + "</li>";
    rows.push_back(std::move(row));
  }
  return html_table(sequence["label"].get<std::string>() + ", " +
                        sequence["refined"].get<std::string>() + " refined",
                    header, rows) +
         (doubts.empty() ? ""
                         : "<details><summary>Why not in the asymptotic range</summary><ul>" +
                               doubts + "</ul></details>\n");
}

std::string interval(const Page& page, const std::string& at) {
  const Values& v = page.values;
  if (!v.has(at)) return "–";
  return v.signed_number(at + "/E", 3) + " ± " + v.number(at + "/U", 3);
}

/// What the interval says of the difference.
std::string verdict(const Page& page, const std::string& at) {
  if (!page.values.has(at + "/beyond") || page.values.at(at + "/beyond").is_null())
    return "not known";
  return page.values.at(at + "/beyond").get<bool>() ? "differ" : "cannot be told apart";
}

std::string vof_table(const Page& page) {
  const Values& v = page.values;
  const json& all = v.at("/uncertainty/against_vof");
  if (all.empty()) return "";
  Rows rows;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string at = item("/uncertainty/against_vof", i);
    for (std::size_t k = 0; k < all[i]["rows"].size(); ++k) {
      const std::string row = item(at + "/rows", k);
      rows.push_back({v.text(at + "/label"), "T = " + v.number(row + "/T", 2),
                      v.number(row + "/S", 3), v.number(row + "/D", 3), v.number(row + "/u_num", 4),
                      v.number(row + "/u_D", 4), interval(page, row), verdict(page, row)});
    }
    rows.push_back({v.text(at + "/label"), "RMS", "–", "–", v.number(at + "/rms/u_num", 4),
                    v.number(at + "/rms/u_D", 4), interval(page, at + "/rms"),
                    verdict(page, at + "/rms")});
  }
  return html_table("Z/L of the particle methods S against the finest VOF D",
                    {"Run", "At", "S", "D", "u of S", "u of D", "E = S − D ± U", "S and D"}, rows);
}

std::string experiment_table(const Page& page) {
  const Values& v = page.values;
  const json& all = v.at("/uncertainty/experiments");
  if (all.empty()) return "";
  Rows rows;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string at = item("/uncertainty/experiments", i);
    const auto add = [&](const std::string& when, const std::string& raw,
                         const std::string& shifted) {
      rows.push_back({v.text(at + "/label"), when, interval(page, raw), verdict(page, raw),
                      v.signed_number(at + "/shift_T", 3), interval(page, shifted),
                      verdict(page, shifted)});
    };
    for (std::size_t k = 0; k < all[i]["rows"].size(); ++k) {
      const std::string row = item(at + "/rows", k);
      add("T = " + v.number(row + "/T", 2), row + "/raw", row + "/shifted");
    }
    add("RMS", at + "/rms/raw", at + "/rms/shifted");
  }
  return html_table(
      "Z/L of the finest VOF S against the experiments D, as published and shifted",
      {"Experiment", "At", "E ± U, raw", "S and D", "Shift in T", "E ± U, shifted", "S and D"},
      rows);
}

/// "MPS improved is within 0.03 ± 0.01 of ..."
std::string answer(const Page& page) {
  const Values& v = page.values;
  std::string text;
  const json& methods = v.at("/uncertainty/against_vof");
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const std::string at = item("/uncertainty/against_vof", i);
    if (methods[i]["rms"]["U"].is_null()) continue;
    text += (text.empty() ? "" : "; ") + v.text(at + "/label") + " within " +
            v.number(at + "/rms/E", 3) + " ± " + v.number(at + "/rms/U", 3);
  }
  if (text.empty()) return "";
  std::string experiments;
  const json& series = v.at("/uncertainty/experiments");
  for (std::size_t i = 0; i < series.size(); ++i) {
    const std::string at = item("/uncertainty/experiments", i);
    if (series[i]["rms"]["raw"]["U"].is_null()) continue;
    experiments += (experiments.empty() ? "" : "; ") + v.number(at + "/rms/raw/E", 2) + " ± " +
                   v.number(at + "/rms/raw/U", 2) + " of " + v.text(at + "/label") +
                   " as published, " + v.number(at + "/rms/shifted/E", 2) + " ± " +
                   v.number(at + "/rms/shifted/U", 2) + " with it shifted by " +
                   v.signed_number(at + "/shift_T", 2) + " in T";
  }
  return "<div class=\"answer\"><p>RMS of Z/L against " + v.text("/convergence/finest_label") +
         ": " + text + "." + (experiments.empty() ? "" : " VOF within " + experiments + ".") +
         "</p></div>\n";
}

std::string cost_tables(const Page& page) {
  const Values& v = page.values;
  const json& points = v.at("/pareto/points");
  if (points.empty()) return "";
  Rows cheapest, unbeaten;
  for (std::size_t i = 0; i < v.at("/pareto/cheapest").size(); ++i) {
    const std::string at = item("/pareto/cheapest", i);
    const bool there = v.has(at + "/point/run");
    cheapest.push_back({v.number(at + "/rms", 2), there ? v.text(at + "/point/label") : "none",
                        there ? v.number(at + "/point/rms", 4) : "–",
                        there ? v.magnitude(at + "/point/wall_s") : "–"});
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string at = item("/pareto/points", i);
    unbeaten.push_back({v.text(at + "/label"), v.integer(at + "/threads"),
                        v.magnitude(at + "/wall_s"), v.number(at + "/rms", 4),
                        points[i]["front"].get<bool>() ? "yes" : "no"});
  }
  return html_table("The cheapest run on one thread by the RMS of Z/L that it must reach",
                    {"RMS at most", "Run", "Its RMS", "Solving time, s"}, cheapest) +
         html_table("All levels; unbeaten: none on as many threads is both cheaper and nearer",
                    {"Run", "Threads", "Solving time, s", "RMS of Z/L", "Unbeaten"}, unbeaten);
}

std::string counts_sentence(const Page& page) {
  const Values& v = page.values;
  const std::string at = "/convergence/counts/";
  return "<p>Of " + v.integer(at + "all") + " quantities with three levels " +
         v.integer(at + "monotone") + " converge monotonically, " + v.integer(at + "oscillating") +
         " oscillate, " + v.integer(at + "diverging") + " diverge; " +
         v.integer(at + "asymptotic") + " seem to be in the asymptotic range.</p>\n";
}

/// What the recommended presets are to reach, and whether they do.
std::string bar_table(const Page& page) {
  const Values& v = page.values;
  Rows rows;
  for (std::size_t i = 0; i < v.at("/convergence/bars").size(); ++i) {
    const std::string at = item("/convergence/bars", i);
    rows.push_back({v.text(at + "/label"), v.number(at + "/rms", 4), v.number(at + "/bar", 2),
                    v.at(at + "/reached").get<bool>() ? "reached" : "missed"});
  }
  if (rows.empty()) return "";
  return html_table("RMS of Z/L to the finest VOF that the recommended presets are to reach",
                    {"Run", "RMS", "Bar", ""}, rows);
}

std::string missing_runs(const Page& page) {
  std::string html;
  for (const RunResult* run : page.study.runs_of(Role::convergence)) {
    if (run->status == RunStatus::complete) continue;
    html +=
        "<li><code>" + escape(run->study.name) + "</code>: " + status_text(run->status) + "</li>";
  }
  return html.empty() ? "" : "<p>Runs that are not shown:</p><ul>" + html + "</ul>\n";
}

}  // namespace

std::string write_convergence(const Page& page) {
  const Values& v = page.values;
  if (v.at("/convergence").empty())
    return page.study.runs_of(Role::convergence).empty() ? "" : missing_runs(page);
  std::string html = answer(page);
  html +=
      "<h3>Levels of refinement</h3>\n<p>By the procedure of <cite>Celik and others, Journal of "
      "Fluids Engineering</cite>: the finest level and the next coarser ones at a ratio of at "
      "least " +
      v.number("/convergence/smallest_ratio", 1) + ", safety factor " +
      v.number("/convergence/safety_factor", 2) +
      ". <em>GCI</em> is the index of the finest level in the unit of the quantity. Levels are "
      "not in the asymptotic range where the order is below " +
      v.number("/convergence/order_least", 2) + " or above " +
      v.number("/convergence/order_most", 2) +
      ", where the changes alternate in sign or do not shrink, or where a level in between is "
      "off the curve by more than the index; extrapolated values are guesses there. <em>U</em> "
      "is what is used below: the index in the asymptotic range; else that of first-order "
      "schemes with the largest change among the levels up to the second, or three times the "
      "range of the levels where they diverge or where that is less. The step shrinks with the "
      "spacing, so that the levels over the spacing contain the error of the step; the levels "
      "over the step show how much that is.</p>\n" +
      counts_sentence(page) + figure_html(page, "convergence");
  for (std::size_t i = 0; i < v.at("/convergence/sequences").size(); ++i)
    html += sequence_table(page, item("/convergence/sequences", i));
  html += missing_runs(page);
  if (!v.at("/uncertainty/against_vof").empty() || !v.at("/uncertainty/experiments").empty()) {
    html +=
        "<h3>Differences with their uncertainty</h3>\n<p>As in ASME V&amp;V, standard for "
        "fluid dynamics: E = S − D, with the standard uncertainty √(u<sub>num</sub>² + "
        "u<sub>input</sub>² + u<sub>D</sub>²) and U = " +
        v.integer("/uncertainty/coverage") +
        " of these. The numerical one is U of the tables above over " +
        v.number("/uncertainty/numerical_coverage", 2) +
        ", of both sides where both are computed; the experiments’ is half of what their "
        "series state for Z/L and, times the speed of the front, for T. The inputs are the "
        "same in all computations, and of the experiments they are not stated: zero.</p>\n" +
        vof_table(page) + bar_table(page) + experiment_table(page);
  }
  const std::string cost = cost_tables(page);
  if (!cost.empty())
    html += "<h3>Error over cost</h3>\n" + figure_html(page, "convergence_cost") + cost;
  return html;
}

}  // namespace surge::compare
