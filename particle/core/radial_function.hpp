#pragma once

#include <functional>
#include <string>

namespace surge {

/// A function of the distance with which a method weighs neighbours.
struct RadialFunction {
  std::string name;
  std::string unit;
  double support = 0.0;                 ///< m
  bool finite_at_zero = true;           ///< whether it has a value at r = 0
  std::function<double(double)> value;  ///< of r (m)
};

}  // namespace surge
