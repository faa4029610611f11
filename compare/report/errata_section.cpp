#include <array>

#include "compare/report/errata.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr std::array<Erratum, 5> list{{
    {"Eq. (8)", "lambda = re²/12", "lambda = re²/6 in two dimensions",
     "numerator 2π∫(re/r − 1) r³ dr = 2π (re⁴/3 − re⁴/4) = π re⁴/6; denominator "
     "2π∫(re/r − 1) r dr = 2π (re² − re²/2) = π re²; their quotient is re²/6. The printed "
     "value halves the pressure: it acts as an under-relaxation of the source term",
     "tests/kernel/kernel_test.cpp", "PaperErrata.LambdaByIntegration"},
    {"after Eq. (18)", "120/h in one dimension", "1/(120 h)",
     "∫W dx = 2h α ∫₀³ [(3−R)⁵ − 6(2−R)⁵ + 15(1−R)⁵] dR = "
     "2h α (3⁶ − 6·2⁶ + 15)/6 = 120 h α, which must be one",
     "tests/kernel/kernel_test.cpp", "PaperErrata.NormalisationOfTheQuinticSpline"},
    {"after Eq. (18)", "3/(359 π h³) in three dimensions", "1/(120 π h³)",
     "4π h³ α ∫₀³ R² [...] dR = 120 π h³ α must be one; 359/3 = 119.67 makes the kernel "
     "0.28 % too large",
     "tests/kernel/kernel_test.cpp", "PaperErrata.NormalisationOfTheQuinticSpline"},
    {"Eq. (13)", "P of the particle itself in the gradient",
     "the minimum of the neighbourhood, Eq. (6)",
     "as the text after Eq. (5) says: with P_j − min P ≥ 0 every pair repels, with P_j − P_i "
     "some attract",
     "tests/mps/operators_test.cpp", "Gradient.MinimumMakesEveryPairRepel"},
    {"Eq. (23)", "no gravity", "+ g on the right side",
     "Eq. (2) has it and the text before Eq. (23) adds it directly; without it no column collapses",
     "tests/verification/hydrostatic_test.cpp", "Hydrostatic.TankKeepsItsPressure"},
}};

}  // namespace

std::span<const Erratum> errata() {
  return list;
}

void measure_errata(const StudyResult&, json& metrics) {
  metrics["errata"] = json::array();
  for (const Erratum& e : errata()) {
    metrics["errata"].push_back({{"place", e.place},
                                 {"printed", e.printed},
                                 {"correct", e.correct},
                                 {"derivation", e.derivation},
                                 {"test_file", e.test_file},
                                 {"test", e.test}});
  }
}

}  // namespace surge::compare
