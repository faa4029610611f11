#pragma once

#include <stdexcept>
#include <string>

namespace surge {

/// Every error that a user can cause. `what()` is the one line that is printed:
/// `file:line: key: what was found, what is expected`.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace surge
