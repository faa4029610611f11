#include "particle/io/method_sheet.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

#include "particle/io/run_loop.hpp"
#include "particle/kernel/mps_weight.hpp"

namespace surge {

using nlohmann::json;

namespace {

constexpr int steps_in_support = 200;

/// Samples f(r) at first, first + 1, ... steps of 1/200 of the support.
template <class F>
json sampled(const char* name, const std::string& unit, double support, int first, F&& f) {
  json out{{"name", name}, {"unit", unit}, {"support_m", support}};
  for (int k = first; k <= steps_in_support + steps_in_support / 10; ++k) {
    const double r = support * k / steps_in_support;
    out["r_m"].push_back(r);
    out["value"].push_back(f(r));
  }
  return out;
}

json stages_json(std::span<const Stage> stages) {
  json out = json::array();
  for (const Stage& stage : stages) {
    out.push_back(
        {{"function", stage.function}, {"does", stage.does}, {"equations", stage.equations}});
  }
  return out;
}

/// Names of what surrounds the step; the assertions keep them true.
template <class Solver, int D>
json loop_json() {
  static_assert(std::is_constructible_v<Solver, const Case&>);
  static_assert(std::is_member_function_pointer_v<decltype(&RunLoop<Solver, D>::run)>);
  static_assert(std::is_member_function_pointer_v<decltype(&Solver::step)>);
  return {{"start", "Solver(case)"}, {"until", "RunLoop::run"}, {"step", "Solver::step"}};
}

}  // namespace

template <int D>
json method_sheet(const mps::Solver<D>& solver, double spacing) {
  json out{{"method", "mps"}, {"dimension", D}, {"spacing_m", spacing}};
  const auto add = [&](const char* name, double re) {
    out["functions"].push_back(
        sampled(name, "1", re, 1, [&](double r) { return mps_weight(r, re); }));
  };
  add("w", solver.radius());
  add("w_laplacian", solver.laplacian_radius());
  out["loop"] = loop_json<mps::Solver<D>, D>();
  out["stages"] = stages_json(mps_stages());
  return out;
}

template <int D>
json method_sheet(const sph::Solver<D>& solver, double spacing) {
  json out{{"method", "sph"},
           {"dimension", D},
           {"spacing_m", spacing},
           {"length_m", solver.smoothing_length()}};
  std::visit(
      [&](const auto& kernel) {
        const double support = std::decay_t<decltype(kernel)>::support * solver.smoothing_length();
        out["functions"].push_back(sampled("W", "1/m" + std::to_string(D), support, 0,
                                           [&](double r) { return kernel.value(r); }));
        out["functions"].push_back(sampled("dW/dr", "1/m" + std::to_string(D + 1), support, 0,
                                           [&](double r) { return kernel.derivative(r); }));
      },
      solver.kernel());
  out["loop"] = loop_json<sph::Solver<D>, D>();
  out["stages"] = stages_json(sph_stages());
  return out;
}

template json method_sheet<2>(const mps::Solver<2>&, double);
template json method_sheet<3>(const mps::Solver<3>&, double);
template json method_sheet<2>(const sph::Solver<2>&, double);
template json method_sheet<3>(const sph::Solver<3>&, double);

}  // namespace surge
