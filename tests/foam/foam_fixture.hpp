#pragma once

#include <string>
#include <vector>

#include "foam_cases/foam_case.hpp"
#include "particle/support/error.hpp"

namespace surge::foam::test {

/// Water 0.1 m wide and 0.2 m high in an open tank 0.4 x 0.4 m with a step at its right wall.
inline constexpr const char* small_case = R"(title = "Small"
dimension = 2
[fluid]
density = 1000.0
gravity = [0.0, -9.81]
[tank]
lower = [0.0, 0.0]
upper = [0.4, 0.4]
open = ["y+"]
[[block]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.1, 0.2]
[[obstacle]]
lower = [0.3, 0.0]
upper = [0.4, 0.1]
[[probe]]
name = "wall_pressure"
position = [0.4, 0.2]
[resolution]
spacing = 0.01
[time]
end = 0.02
[output]
interval = 0.01
[method]
name = "a method that this program does not know"
[its_own_table]
option = 1
)";

inline FoamCase made(const std::vector<std::string>& settings = {},
                     const std::vector<std::string>& overrides = {},
                     const std::string& text = small_case) {
  return parse_foam_case(text, "small.toml", overrides, settings);
}

/// Why a case is not made; "made" where it is.
inline std::string refusal(const std::vector<std::string>& settings,
                           const std::vector<std::string>& overrides = {},
                           const std::string& text = small_case) {
  try {
    static_cast<void>(made(settings, overrides, text));
  } catch (const Error& error) {
    return error.what();
  }
  return "made";
}

}  // namespace surge::foam::test
