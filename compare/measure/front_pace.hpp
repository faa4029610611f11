#pragma once

#include <string>
#include <vector>

#include "compare/measure/front.hpp"

namespace surge::compare {

/// How long a column of width L and height H takes until it is s L wide if it stays a box, in units
/// of L / sqrt(g H). The flow u = (s'/s) x, v = -(s'/s) y keeps the volume; its energy
///   s'^2 (L^2 + H^2/s^4)/6 + g H/(2 s) = g H/2
/// gives t = int_1^s ds / s'. A collapse is faster than this box, by a factor of about 0.65 for
/// H = 2L until s = 1.5 (interFoam, 20 cells per L), but of its order.
[[nodiscard]] double box_time(double height_over_width, double s);

/// Whether the front of a foreign particle source is as fast as its column, gravity and times make
/// one expect: times or units that are typed wrong, walls or air counted as water, and water that
/// flows the other way show here. Silent where the first frame is not the column at rest on a dry
/// floor, and where the front has moved by less than a fifth of L.
[[nodiscard]] std::vector<std::string> pace_notices(const Run& run, const FrontHistory& history);

}  // namespace surge::compare
