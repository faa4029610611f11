#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "particle/io/computation.hpp"

namespace surge::test {

/// A small complete case: 4 x 8 particles in a tank of 12 x 12, with line numbers that tests name.
inline constexpr const char* small_case = R"(title = "Small"
dimension = 2
[fluid]
density = 1000.0
kinematic_viscosity = 0.0
gravity = [0.0, -9.81]
[tank]
lower = [0.0, 0.0]
upper = [0.12, 0.12]
open = ["y+"]
periodic = []
wall = "slip"
[[block]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.04, 0.08]
velocity = [0.0, 0.0]
[[obstacle]]
lower = [0.1, 0.0]
upper = [0.12, 0.02]
[[probe]]
name = "corner"
position = [0.005, 0.005]
[resolution]
spacing = 0.01
[time]
end = 0.02
initial_step = 1e-4
maximum_step = 1e-3
courant = 0.2
[output]
interval = 0.005
[search]
neighbours = "cell_grid"
[method]
name = "sph"
preset = "paper"
)";

/// The small case without its tank: the block and the obstacle in free space.
inline std::string case_without_tank() {
  std::string text = small_case;
  const auto begin = text.find("[tank]");
  return text.erase(begin, text.find("[[block]]") - begin);
}

inline Computation make_computation(const std::vector<std::string>& overrides = {}) {
  return parse_computation(small_case, "small.toml", overrides);
}
inline Case make_case(const std::vector<std::string>& overrides = {}) {
  return make_computation(overrides).flow;
}

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace surge::test
