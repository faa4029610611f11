#pragma once

#include "particle/support/error.hpp"

namespace surge {

/// A run that cannot go on from what is in its folder; the folder is as it was.
class RestartError : public Error {
 public:
  using Error::Error;
};

}  // namespace surge
