#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

std::string fit_cell(const Page& page, const std::string& at) {
  if (!page.values.has(at)) return "–";
  return page.values.number(at + "/exponent", 2) + " ± " +
         page.values.number(at + "/half_width", 2);
}

std::string fit_table(const Page& page) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, curve] : page.values.at("/scaling").items()) {
    const std::string at = key({"scaling", name});
    rows.push_back({page.values.text(at + "/label"), fit_cell(page, at + "/fit_per_step"),
                    fit_cell(page, at + "/fit_per_step_over_fluid"),
                    fit_cell(page, at + "/fit_total"),
                    fit_cell(page, at + "/fit_total_over_fluid")});
  }
  return html_table("Exponent of the growth with the number of particles, with its 95 % interval",
                    {"Method", "Time per step, all particles", "fluid particles only",
                     "Total time, all particles", "fluid particles only"},
                    rows);
}

/// Pointers and curves of all points in their order.
template <class Row>
std::vector<std::vector<std::string>> point_rows(const Page& page, Row&& row) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, curve] : page.values.at("/scaling").items()) {
    for (std::size_t i = 0; i < curve["points"].size(); ++i) {
      const std::string at = key({"scaling", name, "points", std::to_string(i)});
      std::vector<std::string> cells{page.values.text(key({"scaling", name, "label"})),
                                     page.values.integer(at + "/fluid_particles")};
      for (std::string& cell : row(at, curve["points"][i])) cells.push_back(std::move(cell));
      rows.push_back(std::move(cells));
    }
  }
  return rows;
}

std::string step_table(const Page& page) {
  const auto share = [&](const std::string& at, const char* phase) {
    const std::string pointer = at + "/shares/" + phase;
    return page.values.has(pointer) ? page.values.number(pointer, 3) : std::string("–");
  };
  const auto rows = point_rows(page, [&](const std::string& at, const json& point) {
    const std::string sample = at + (point["window"].is_null() ? "/whole" : "/window");
    return std::vector<std::string>{page.values.integer(at + "/all_particles"),
                                    page.values.magnitude(at + "/ms_per_step"),
                                    page.values.magnitude(sample + "/ms_per_step_least"),
                                    page.values.magnitude(sample + "/ms_per_step_most"),
                                    page.values.integer(sample + "/repeats"),
                                    page.values.integer(sample + "/steps"),
                                    share(at, "neighbours"),
                                    share(at, "pressure"),
                                    share(at, "forces")};
  });
  return html_table(
      "Solving time per step in the first steps of the collapse, median of the repeats; shares of "
      "the whole run where there is one",
      {"Method", "Fluid particles", "All particles", "ms per step", "Least", "Most", "Repeats",
       "Steps", "Neighbours", "Pressure", "Forces"},
      rows);
}

std::string total_table(const Page& page) {
  const auto rows = point_rows(page, [&](const std::string& at, const json& point) {
    const bool whole = !point["whole"].is_null();
    const auto of_whole = [&](const char* name) {
      return whole ? page.values.magnitude(at + "/whole/" + name) : std::string("–");
    };
    return std::vector<std::string>{page.values.magnitude(at + "/total_s"),
                                    whole ? "measured" : "extrapolated",
                                    whole ? page.values.integer(at + "/whole/repeats") : "–",
                                    whole ? page.values.integer(at + "/whole/steps") : "–",
                                    of_whole("setup_s"),
                                    of_whole("output_s"),
                                    page.values.has(at + "/whole_over_window")
                                        ? page.values.number(at + "/whole_over_window", 2)
                                        : "–"};
  });
  return html_table("Solving time of the whole run",
                    {"Method", "Fluid particles", "Total, s", "Made", "Repeats", "Steps",
                     "Setup, s", "Output, s", "Whole over first steps, per step"},
                    rows);
}

}  // namespace

std::string write_scaling(const Page& page) {
  const json& curves = page.values.at("/scaling");
  if (curves.empty()) return "";
  const std::string first = key({"scaling", curves.begin().key()});
  return "<p>Measured on " + page.values.text(first + "/cpu") +
         ", threads per run: " + page.values.integer(first + "/threads") +
         ". Setup and output are left out of all times but where they are named.</p>\n" +
         fit_table(page) +
         "<p>Each particle meets every other with the search of all pairs, so that its cost goes "
         "with all particles, the walls among them. With the cell grid, walls that no water is "
         "near cost next to nothing, and the number of fluid particles counts.</p>\n" +
         total_table(page) +
         "<p>Extrapolated: the time per step in the first steps, times the ratio of the last "
         "column at the largest size of the curve that has one, times the number of steps of the "
         "method’s largest whole run, carried to the spacing by the power that fits the whole "
         "runs.</p>\n" +
         step_table(page);
}

}  // namespace surge::compare
