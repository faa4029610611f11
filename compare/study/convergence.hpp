#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace surge::compare {

/// One quantity computed at one level of refinement.
struct Level {
  double h = 0.0;      ///< representative size, such as a spacing or a time step: > 0
  double value = 0.0;  ///< phi
};

/// How the values change from level to level, with eps21 = phi2 - phi1, eps32 = phi3 - phi2 and 1
/// the finest.
enum class Approach {
  constant,     ///< no change that is more than rounding: the order has no meaning
  monotone,     ///< eps32 / eps21 > 0, order > 0
  oscillating,  ///< eps32 / eps21 < 0, order > 0
  diverging     ///< the changes do not shrink with the size
};
[[nodiscard]] std::string approach_text(Approach approach);

/// What the refinement of one quantity says, by the procedure of Celik, Ghia, Roache, Freitas,
/// Coleman & Raad (2008), Procedure for estimation and reporting of uncertainty due to
/// discretization in CFD applications, J. Fluids Eng. 130, 078001.
struct GridConvergence {
  std::array<Level, 3> levels;  ///< finest first
  double r21 = 0.0, r32 = 0.0;  ///< h2/h1, h3/h2
  Approach approach = Approach::constant;
  /// Of the four below: empty where constant or diverging.
  std::optional<double> order;         ///< p, Eq. (3)
  std::optional<double> extrapolated;  ///< (r21^p phi1 - phi2) / (r21^p - 1), Eq. (4)
  std::optional<double> gci21;         ///< 1.25 |phi1 - phi2| / (r21^p - 1): Eq. (7) times |phi1|
  std::optional<double> gci32;         ///< the same of the middle level
  /// GCI32 / (r^p GCI21) with p the formal order nearest to the observed one: one where the
  /// observed order is formal. (With the observed order itself it is one for any three levels.)
  std::optional<double> index_ratio;
  /// 95 % uncertainty of phi1 in its own unit. In the asymptotic range gci21. Else the same with an
  /// order of at most one and with the largest change among the levels up to the second, since an
  /// order or a change of chance must not make it small; but never more than three times the range
  /// of the three values, which is what stands where the sequence diverges (Eca & Hoekstra 2009,
  /// Comput. Fluids 38, 1580-1591).
  double uncertainty = 0.0;
  /// Why the sequence is not in the asymptotic range, in words; empty where it seems to be.
  std::vector<std::string> doubts;

  [[nodiscard]] bool asymptotic() const { return doubts.empty(); }
};

/// Orders that are plausible: of free-surface schemes that are of first order at the surface and of
/// second inside.
inline constexpr double lowest_formal_order = 1.0;
inline constexpr double formal_order = 2.0;
/// An observed order may be this much below the lowest or above the highest: Celik et al. give no
/// number, this one is the project's choice.
inline constexpr double order_margin = 0.25;
/// Safety factor for three levels, Eq. (7).
inline constexpr double safety_factor = 1.25;
/// Celik et al. want ratios above 1.3; values of particles are noisy, so that more is asked for.
inline constexpr double smallest_ratio = 1.5;

/// Whether two sizes are one level: within 1 %.
[[nodiscard]] bool same_level(double h1, double h2);
/// The finest level, and twice the next coarser one whose size is at least `smallest_ratio` larger;
/// finest first, whatever order they come in. Empty where there are no three.
[[nodiscard]] std::optional<std::array<Level, 3>> systematic_levels(std::vector<Level> levels);

/// The procedure on three levels, finest first. `others` are levels beside these: they say how
/// much the values scatter about the curve, and nothing else. Throws surge::Error for sizes that do
/// not increase or are not positive, and for values that are not finite.
[[nodiscard]] GridConvergence grid_convergence(const std::array<Level, 3>& levels,
                                               const std::vector<Level>& others = {});

}  // namespace surge::compare
