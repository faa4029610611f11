#include "particle/support/count.hpp"

#include <cmath>
#include <string>

#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge {

long whole_number(double value, std::string_view what, double most) {
  const double rounded = std::round(value);
  if (rounded >= 0.0 && rounded <= most) return static_cast<long>(rounded);
  throw Error(std::string(what) + ": found " + number_text(value) +
              ", expected a count of at most " + number_text(most));
}

}  // namespace surge
