#include "particle/io/method_sheet.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

#include "particle/io/run_loop.hpp"

namespace surge {

using nlohmann::json;

namespace {

constexpr int steps_in_support = 200;

/// Samples the function at every 1/200 of its support.
json sampled(const RadialFunction& function) {
  json out{{"name", function.name}, {"unit", function.unit}, {"support_m", function.support}};
  for (int k = function.finite_at_zero ? 0 : 1; k <= steps_in_support + steps_in_support / 10;
       ++k) {
    const double r = function.support * k / steps_in_support;
    out["r_m"].push_back(r);
    out["value"].push_back(function.value(r));
  }
  return out;
}

json stages_json(std::span<const Stage> stages) {
  json out = json::array();
  for (const Stage& stage : stages) {
    out.push_back({{"function", stage.function},
                   {"does", stage.does},
                   {"equations", stage.equations},
                   {"if", stage.options}});
  }
  return out;
}

/// Names of what surrounds the step; the assertions keep them true.
template <int D>
json loop_json() {
  static_assert(std::is_member_function_pointer_v<decltype(&RunLoop<AnySolver<D>, D>::run)>);
  static_assert(std::is_member_function_pointer_v<decltype(&AnySolver<D>::step)>);
  return {{"start", "Solver(case)"}, {"until", "RunLoop::run"}, {"step", "Solver::step"}};
}

}  // namespace

template <int D>
json method_sheet(std::string_view method, const AnySolver<D>& solver, double spacing) {
  json out{{"method", method}, {"dimension", D}, {"spacing_m", spacing}};
  if (const auto h = solver.smoothing_length()) out["length_m"] = *h;
  for (const RadialFunction& function : solver.functions())
    out["functions"].push_back(sampled(function));
  out["loop"] = loop_json<D>();
  out["stages"] = stages_json(stages_of(method));
  return out;
}

template json method_sheet<2>(std::string_view, const AnySolver<2>&, double);
template json method_sheet<3>(std::string_view, const AnySolver<3>&, double);

}  // namespace surge
