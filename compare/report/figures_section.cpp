#include "compare/figures/method.hpp"
#include "compare/report/page.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

json interaction_json(const StudyResult& study) {
  const auto found = find_interaction(study);
  if (!found) return nullptr;
  json out{{"run", found->run->study.name},
           {"time_s", found->time.value()},
           {"position_m", found->position},
           {"radii", json::array()}};
  for (std::size_t k = 0; k < found->radii_over_l0.size(); ++k) {
    out["radii"].push_back(
        {{"over_l0", found->radii_over_l0[k]}, {"neighbours", found->neighbours[k]}});
  }
  return out;
}

}  // namespace

void measure_figures(const StudyResult& study, json& metrics) {
  metrics["interaction"] = interaction_json(study);
  for (const auto& [name, what, where] : figures_elsewhere())
    metrics["figures_elsewhere"][name] = what;
}

}  // namespace surge::compare
