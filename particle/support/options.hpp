#pragma once

#include <concepts>
#include <string>
#include <type_traits>
#include <vector>

#include "particle/support/enum_names.hpp"
#include "particle/support/toml.hpp"

namespace surge {

// A set of options is a struct with a function visit_options(params, option) in its namespace,
// which calls `option(name, member, bounds, description)` for each of them. Files, the manifest and
// `surge-particle list --options` know what it names and nothing else.

/// Reads those options that a table has; the others keep their values.
template <class Params>
void read_options(const TomlTable& table, Params& params) {
  visit_options(params, [&](const char* name, auto& member, Bounds bounds, const char*) {
    using Member = std::remove_reference_t<decltype(member)>;
    if (!table.has(name)) return;
    if constexpr (std::is_enum_v<Member>) {
      member = table.enumerator(name, enum_names<Member>);
    } else if constexpr (std::same_as<Member, bool>) {
      member = table.boolean(name);
    } else if constexpr (std::integral<Member>) {
      member = static_cast<Member>(table.integer(name, bounds));
    } else {
      member = table.number(name, bounds);
    }
  });
}

/// An option as people read it.
struct OptionText {
  std::string name;
  std::string value;
  std::string allowed;
  std::string description;
};

namespace detail {

template <class T>
std::string option_value(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return std::string(name_of(value));
  } else if constexpr (std::same_as<T, bool>) {
    return value ? "true" : "false";
  } else {
    return number_text(static_cast<double>(value));
  }
}

template <class T>
std::string allowed_values(Bounds bounds) {
  if constexpr (std::is_enum_v<T>) {
    std::string names;
    for (const auto& entry : enum_names<T>) {
      names += (names.empty() ? "" : " | ") + std::string(entry.name);
    }
    return names;
  } else if constexpr (std::same_as<T, bool>) {
    return "true | false";
  } else {
    return bounds.text().empty() ? "any" : bounds.text();
  }
}

}  // namespace detail

template <class Params>
[[nodiscard]] std::vector<OptionText> option_texts(const Params& params) {
  std::vector<OptionText> texts;
  visit_options(params, [&](const char* name, const auto& value, Bounds bounds, const char* does) {
    texts.push_back({name, detail::option_value(value),
                     detail::allowed_values<std::remove_cvref_t<decltype(value)>>(bounds), does});
  });
  return texts;
}

}  // namespace surge
