#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "particle/support/bounds.hpp"

namespace surge {

/// The names of an enumeration's values in files, std::array of Named<E>; given next to the
/// enumeration, or to the options that use it.
template <class E>
inline constexpr std::nullptr_t enum_names = nullptr;

/// The name of an enumerator.
template <class E>
[[nodiscard]] constexpr std::string_view name_of(E value) {
  for (const auto& entry : enum_names<E>) {
    if (entry.value == value) return entry.name;
  }
  return "?";
}

}  // namespace surge
