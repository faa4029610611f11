#pragma once

#include <optional>
#include <string>
#include <vector>

#include "particle/case/case.hpp"

namespace surge {

/// How many spacings a length holds, where that is a whole number to nine digits.
[[nodiscard]] std::optional<double> whole_spacings(double length, double spacing);

/// The spacings next to `spacing`, below and above, that divide all lengths; empty where none is
/// found between a thousandth of it and the smallest length.
struct NearSpacings {
  std::optional<double> below;
  std::optional<double> above;
};
[[nodiscard]] NearSpacings near_spacings(const std::vector<double>& lengths, double spacing);

/// All lengths (m) that the spacing of a case must divide: extents of tank, blocks, obstacles and
/// moving walls.
[[nodiscard]] std::vector<double> divided_lengths(const Case& c);

/// What to do about a length that the spacing does not divide, for people.
[[nodiscard]] std::string division_advice(const Case& c, double length);

}  // namespace surge
