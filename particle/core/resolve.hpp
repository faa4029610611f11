#pragma once

#include <type_traits>

namespace surge {

/// Calls f with std::true_type or std::false_type: an option becomes part of the type before a loop
/// instead of a question in it.
template <class F>
decltype(auto) resolve(bool option, F&& f) {
  return option ? f(std::true_type{}) : f(std::false_type{});
}

}  // namespace surge
