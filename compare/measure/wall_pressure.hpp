#pragma once

#include <optional>
#include <vector>

#include "compare/read/run.hpp"
#include "compare/read/units.hpp"

namespace surge::compare {

/// Name of the probe on the far wall in a particle case and in the manifest of the foam case.
inline constexpr const char* wall_probe_name = "wall_pressure";

/// Time between two values of a real sensor: Lobovsky et al., J. Fluids Struct. 48 (2014) 407-434,
/// record at 20 kHz.
inline constexpr Seconds sensor_interval{5e-5};
/// What is faster than this is noise here: 5 ms, a hundred values of the sensor. The load of a
/// collapsing column 0.3 m high rises and falls over tens of milliseconds.
inline constexpr Seconds noise_interval{5e-3};
/// By convention here, a signal can be read where its noise is below this part of the largest load.
inline constexpr double readable_noise = 0.1;
/// The impact: so long, from the run's own impact on.
inline constexpr DimensionlessTime impact_duration{2.0};

/// A pressure over time at one place, linear between its values.
class PressureSignal {
 public:
  /// Times in s, increasing; pressures in Pa; at least two. Throws surge::Error otherwise.
  PressureSignal(std::vector<double> time, std::vector<double> pressure);

  [[nodiscard]] const std::vector<double>& time() const { return time_; }
  [[nodiscard]] const std::vector<double>& pressure() const { return pressure_; }
  [[nodiscard]] bool covers(double begin, double end) const {
    return begin >= time_.front() && end <= time_.back();
  }
  /// Integral of p dt from begin to end, Pa s; exact for the linear pieces. Both within the times.
  [[nodiscard]] double integral(double begin, double end) const;
  /// Mean over an interval (s) around t, Pa: 1/d int_{t-d/2}^{t+d/2} p dt.
  [[nodiscard]] double mean(double t, double interval) const;
  /// Median distance in time of the values from begin to end, s; empty where there are fewer than
  /// two.
  [[nodiscard]] std::optional<double> median_step(double begin, double end) const;

 private:
  /// Integral from the first time.
  [[nodiscard]] double until(double t) const;

  std::vector<double> time_, pressure_;
  std::vector<double> sum_;  ///< integral up to each time
};

/// Where the run's probe on the far wall is, m; empty where its case has none of that name.
[[nodiscard]] std::optional<Vec3> wall_probe(const Run& run);

/// What that probe has recorded at every step: the last columns of steps.csv, or the function
/// object wallPressure of the foam case. Throws surge::Error where the file or the column is
/// missing or broken.
[[nodiscard]] PressureSignal read_wall_pressure(const Run& run);

/// Pressure at the wall under the impact, made dimensionless by rho g H (H: height of the column).
/// The signal is that of a sensor, p_k = 1/d int_{t_k-d/2}^{t_k+d/2} p dt with d = sensor_interval
/// and t_k = t_0 + k d; nothing else is filtered. The window is t_0 <= t_k <= t_0 + duration.
struct ImpactPressure {
  double peak = 0.0;               ///< max p_k / (rho g H)
  DimensionlessTime time_of_peak;  ///< after t_0
  double impulse = 0.0;            ///< int p / (rho g H) dT over the window, T = t sqrt(2g/L)
  /// sqrt(mean of (p_k - m_k)^2) / (rho g H), m_k the mean over noise_interval around t_k
  double noise = 0.0;
  /// First t_k, after t_0, from which on sqrt(mean of (p_j - m_j)^2 over |t_j - t_k| <= half a
  /// noise interval, inside the window) <= readable_noise max m_j; empty where the noise lasts to
  /// the end.
  std::optional<DimensionlessTime> readable_from;
};

/// Empty where the signal does not cover the window and half a noise interval before and after it.
[[nodiscard]] std::optional<ImpactPressure> impact_pressure(const PressureSignal& signal,
                                                            const Physics& physics, Seconds impact);

/// rho g H in Pa; empty where density or height of the column are not known.
[[nodiscard]] std::optional<double> pressure_scale(const Physics& physics);

}  // namespace surge::compare
