#pragma once

#include "particle/case/motion.hpp"

namespace surge {

struct Box {
  Point lower{};  ///< m
  Point upper{};  ///< m
};

}  // namespace surge
