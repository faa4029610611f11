#include "particle/case/divisions.hpp"

#include <algorithm>
#include <cmath>

#include "particle/support/bounds.hpp"

namespace surge {

namespace {

constexpr double relative_tolerance = 1e-9;
constexpr double most_tries = 100000;  // of spacings, which takes milliseconds

bool divides_all(const std::vector<double>& lengths, double spacing) {
  return std::all_of(lengths.begin(), lengths.end(),
                     [&](double length) { return whole_spacings(length, spacing).has_value(); });
}

/// Ten digits are more than anybody writes into a file, and divide as well as all of them.
std::string short_text(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 9.0);
  return number_text(std::round(value / unit) / std::round(1.0 / unit));
}

std::string either(const std::vector<std::string>& choices) {
  std::string text;
  for (const std::string& choice : choices) text += (text.empty() ? "" : " or ") + choice;
  return text;
}

}  // namespace

std::optional<double> whole_spacings(double length, double spacing) {
  const double count = length / spacing;
  const double whole = std::round(count);
  if (!(whole >= 1.0) || !(std::abs(count - whole) <= relative_tolerance * whole))
    return std::nullopt;
  return whole;
}

NearSpacings near_spacings(const std::vector<double>& lengths, double spacing) {
  NearSpacings near;
  if (lengths.empty()) return near;
  // Every common divisor of all lengths is the smallest one over a whole number.
  const double smallest = *std::min_element(lengths.begin(), lengths.end());
  const double from = std::floor(smallest / spacing);
  if (!(from < 1e15)) return near;  // one more or less is then no other number
  for (double parts = from; parts >= std::max(1.0, from - most_tries); --parts) {
    if (smallest / parts <= spacing || !divides_all(lengths, smallest / parts)) continue;
    near.above = smallest / parts;
    break;
  }
  const double finest = std::min(1000.0 * (from + 1.0), from + most_tries);
  for (double parts = from + 1.0; parts <= finest; ++parts) {
    if (smallest / parts >= spacing || !divides_all(lengths, smallest / parts)) continue;
    near.below = smallest / parts;
    break;
  }
  return near;
}

std::vector<double> divided_lengths(const Case& c) {
  std::vector<double> lengths;
  const auto add = [&](const Box& box) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a)
      if (box.upper[a] > box.lower[a]) lengths.push_back(box.upper[a] - box.lower[a]);
  };
  if (c.has_tank) add(c.tank.box);
  for (const FluidBlock& block : c.blocks) add(block.box);
  for (const Obstacle& obstacle : c.obstacles)
    if (!obstacle.surface) add(obstacle);
  for (const MovingWall& wall : c.moving_walls) add(wall.box);
  return lengths;
}

/// Along an axis: beyond it a double does not tell a whole number of them from another.
constexpr double most_spacings = 1e12;

std::string division_advice(const Case& c, double length) {
  const double below = std::floor(length / c.spacing);
  if (!(below < most_spacings))
    return "at most " + number_text(most_spacings) + " spacings of " + number_text(c.spacing) +
           " m: a larger spacing";
  std::vector<std::string> sizes, spacings;
  if (below >= 1.0) sizes.push_back(short_text(below * c.spacing));
  sizes.push_back(short_text((below + 1.0) * c.spacing));
  const NearSpacings near = near_spacings(divided_lengths(c), c.spacing);
  if (near.below) spacings.push_back(short_text(*near.below));
  if (near.above) spacings.push_back(short_text(*near.above));
  std::string text = "a whole number of spacings of " + number_text(c.spacing) + " m: a size of " +
                     either(sizes) + " m";
  if (!spacings.empty())
    text += ", or a spacing of " + either(spacings) + " m, which divides all sizes of the case";
  return text;
}

}  // namespace surge
