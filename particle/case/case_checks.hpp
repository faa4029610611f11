#pragma once

#include <string_view>

#include "particle/case/case.hpp"
#include "particle/support/toml.hpp"

namespace surge {

/// What of a case a program can compute. Nothing that a case says is left out in silence.
struct Supports {
  bool tank_motion = false;
  bool moving_walls = false;
};

/// What the checks must know of the method that computes a case.
struct MethodFacts {
  std::string_view name;
  double interaction_radius = 0.0;  ///< over which two of its particles act on each other, in l0
  bool needs_reference_speed = false;
  Supports supports;
};

/// Checks what single entries cannot show: that the bodies fit into the tank and not into each
/// other, that the spacing divides them and so on. `root` is the file that the case was read from,
/// for the places of errors. Throws Error.
void check_case(const Case& c, const TomlTable& root);

/// Checks what depends on the method: that periods hold two interaction radii, that walls are
/// thicker than one, that the method computes all that the case says. Throws Error.
void check_case_for(const MethodFacts& method, const Case& c, const TomlTable& root);

/// Checks names and places of probes, gauges and force surfaces. Part of check_case().
void check_instruments(const Case& c, const TomlTable& root);

}  // namespace surge
