#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "particle/io/computation.hpp"
#include "particle/io/presets.hpp"
#include "particle/io/state_fields.hpp"

namespace surge::test {

/// A column that collapses onto an obstacle in a short tank, with the water near the far wall soon.
inline std::string collapse(int dimension, const std::string& method, const std::string& preset) {
  const bool space = dimension == 3;
  const auto point = [&](const std::string& x, const std::string& y, const std::string& z) {
    return " = [" + x + ", " + y + (space ? ", " + z : "") + "]\n";
  };
  return "title = \"Collapse\"\ndimension = " + std::to_string(dimension) +
         "\n[fluid]\ndensity = 1000.0\nkinematic_viscosity = 1e-5\ngravity" +
         point("0.0", "-9.81", "0.0") + "[tank]\nlower" + point("0.0", "0.0", "0.0") + "upper" +
         point("0.2", "0.2", "0.06") + "open = [\"y+\"]\nwall = \"no-slip\"\n" +
         "[[block]]\nshape = \"box\"\nlower" + point("0.0", "0.0", "0.0") + "upper" +
         point("0.06", "0.12", "0.06") + "velocity" + point("0.8", "0.0", "0.0") +
         "[[obstacle]]\nlower" + point("0.12", "0.0", "0.0") + "upper" +
         point("0.2", "0.04", "0.06") + "[[probe]]\nname = \"foot\"\nposition" +
         point("0.12", "0.01", "0.02") + "[resolution]\nspacing = " + (space ? "0.02" : "0.01") +
         "\n[time]\nend = 0.1\n[output]\ninterval = 0.01\n[method]\nname = \"" + method +
         "\"\npreset = \"" + preset + "\"\n";
}

/// Every preset of every method, as "sph-paper".
inline std::vector<std::string> all_presets() {
  std::vector<std::string> names;
  for (const Method& method : methods())
    for (const std::string& preset : preset_names(method.name))
      names.push_back(std::string(method.name) + '-' + preset);
  return names;
}

inline Computation collapse_of(const std::string& method_and_preset, int dimension) {
  const std::size_t dash = method_and_preset.find('-');
  return parse_computation(
      collapse(dimension, method_and_preset.substr(0, dash), method_and_preset.substr(dash + 1)),
      "collapse.toml");
}

/// FNV-1a over the bits of all that a state holds.
inline std::uint64_t fingerprint(const std::vector<StateField>& state) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const StateField& field : state)
    for (std::size_t k = 0; k < field.bytes(); ++k)
      hash = (hash ^ static_cast<std::uint64_t>(field.data[k])) * 1099511628211ULL;
  return hash;
}

}  // namespace surge::test
