#pragma once

#include <string_view>

#include "particle/case/motion.hpp"
#include "particle/support/toml.hpp"

namespace surge {

/// A unit vector of the case's dimension from a list of any length but zero.
[[nodiscard]] Point read_direction(const TomlTable& table, std::string_view key, int dimension);

/// The law by which something moves, out of the table that says what moves:
///   law = "harmonic"   amplitude, period; phase, ramp, start (0 where they are missing)
///   law = "constant"   speed, stop; start (0)
///   law = "table"      quantity = "displacement" | "acceleration", and either
///                      table = "FILE.csv", relative to the case file: a line of column names where
///                      the first is not a number, then lines `time,value`; or
///                      samples = [[time, value], ...]
/// Times are in s and increase. Throws Error.
[[nodiscard]] ScalarMotion read_law(const TomlTable& table);

/// [motion]: kind = "translation" with a direction, or "rotation" with a centre and in 3D a
/// direction; and a law.
[[nodiscard]] TankMotion read_tank_motion(const TomlTable& table, int dimension);

}  // namespace surge
