#pragma once

#include <string>

namespace surge::compare {

/// Whether compare_physics() tells differences under this key, and all of the keys.
[[nodiscard]] bool is_physics_key(const std::string& key);
[[nodiscard]] std::string physics_keys();

}  // namespace surge::compare
