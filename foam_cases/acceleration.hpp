#pragma once

#include <array>
#include <vector>

#include "particle/case/case.hpp"

namespace surge::foam {

/// A row of the table of OpenFOAM's tabulatedAccelerationSource. It computes with
///   g - linear - rotation^2 and Euler terms about the origin - 2 omega x v.
struct AccelerationRow {
  double time = 0.0;  ///< s
  Point linear{};     ///< m/s2
  Point omega{};      ///< rad/s
  Point alpha{};      ///< rad/s2, d omega/dt
};

/// The motion of a tank as that table, from time 0 to `end`. Rows are dense enough for a spline
/// between them. A jump of the velocity after time 0 is spread over `jump_time` s that follow it,
/// with the right impulse. Throws Error for more rows than are worth a file.
class AccelerationTable {
 public:
  AccelerationTable(const TankMotion& motion, const Point& gravity, double end,
                    double longest_step);

  [[nodiscard]] const std::vector<AccelerationRow>& rows() const { return rows_; }
  /// Over which a jump is spread (s); zero where there is none.
  [[nodiscard]] double jump_time() const { return jumps_.empty() ? 0.0 : spread_; }
  [[nodiscard]] std::size_t jumps() const { return jumps_.size(); }

 private:
  struct Jump {
    double time = 0.0;
    double velocity = 0.0;
  };
  void find_jumps(double end);
  [[nodiscard]] double interval(double longest_step) const;
  [[nodiscard]] AccelerationRow row(double time) const;

  TankMotion motion_;
  Point gravity_;
  double spread_ = 0.0;
  double step_ = 0.0;  ///< s, between rows
  std::vector<Jump> jumps_;
  std::vector<AccelerationRow> rows_;
};

}  // namespace surge::foam
