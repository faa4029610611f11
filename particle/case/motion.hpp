#pragma once

#include <array>
#include <string>
#include <vector>

namespace surge {

/// Coordinates as a case file gives them; in 2D the third entry is zero.
using Point = std::array<double, 3>;

/// A scalar that changes with time, q(t): a displacement along a line (m) or an angle (rad).
///   harmonic:  q = A sin(2 pi (t - start) / T + phase), times a ramp from 0 to 1 over `ramp` s
///   constant:  q = speed (t - start) between start and stop, at rest before and after
///   table:     q, or its second derivative, linear between (time, value) samples; at rest after
///              the last sample of a displacement
struct ScalarMotion {
  enum class Kind { none, harmonic, constant, table };
  enum class Quantity { displacement, acceleration };
  Kind kind = Kind::none;
  double amplitude = 0.0;  ///< A, m or rad
  double period = 1.0;     ///< T, s
  double phase = 0.0;      ///< rad
  double ramp = 0.0;       ///< s; 0: none
  double speed = 0.0;      ///< m/s or rad/s
  double start = 0.0;      ///< s
  double stop = 0.0;       ///< s; constant only
  Quantity quantity = Quantity::displacement;
  std::vector<std::array<double, 2>> samples;  ///< table: s, and m | rad or m/s2 | rad/s2
};

/// q, dq/dt and d2q/dt2 at one time.
struct MotionState {
  double displacement = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};
[[nodiscard]] MotionState motion_at(const ScalarMotion& motion, double time);

/// How the tank moves. The flow is computed in the tank's frame: its motion acts as a body force,
///   translation: a = -q'' e
///   rotation by the angle q about the axis e through `centre`:
///                a = R^T g - q'' e x r - q'^2 e x (e x r) - 2 q' e x v,  r = x - centre.
struct TankMotion {
  enum class Kind { none, translation, rotation };
  Kind kind = Kind::none;
  Point direction{};  ///< e, a unit vector; of a rotation in 2D: (0, 0, 1)
  Point centre{};     ///< m, of a rotation
  ScalarMotion law;
};

}  // namespace surge
