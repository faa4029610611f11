#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <ranges>
#include <string>
#include <type_traits>
#include <vector>

namespace surge {

/// An array or a number of a solver's State, and what it is called in a checkpoint.
struct StateField {
  std::string name;  ///< such as "p.x.0"
  std::string type;  ///< kind and bytes of a value, such as "f8"
  std::size_t count = 0;
  std::size_t value_bytes = 0;
  bool single = false;  ///< a number, not an array
  const std::byte* data = nullptr;

  [[nodiscard]] std::size_t bytes() const { return count * value_bytes; }
};

namespace detail {

template <class T>
struct ValueType {
  static std::string name() {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "a checkpoint cannot keep it");
    const char kind = std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
    return kind + std::to_string(sizeof(T));
  }
};
template <class T, std::size_t N>
struct ValueType<std::array<T, N>> {
  static std::string name() { return ValueType<T>::name() + 'x' + std::to_string(N); }
};

template <class T>
concept Composite = requires(T& value) {
  T::visit(value, [](const char*, auto&) {});
};

template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};

}  // namespace detail

/// Calls f(name, member) for the arrays and numbers that a State is made of, members of members
/// too, in one order.
template <class State, class F>
void each_state_field(State& state, F&& f, const std::string& name = "") {
  using T = std::remove_const_t<State>;
  if constexpr (detail::Composite<T>) {
    const std::string prefix = name.empty() ? "" : name + '.';
    T::visit(state,
             [&](const char* member, auto& value) { each_state_field(value, f, prefix + member); });
  } else if constexpr (detail::IsArray<T>::value) {
    for (std::size_t k = 0; k < state.size(); ++k)
      each_state_field(state[k], f, name + '.' + std::to_string(k));
  } else {
    f(name, state);
  }
}

/// Where the fields of a State lie.
template <class State>
std::vector<StateField> fields_of(const State& state) {
  std::vector<StateField> fields;
  each_state_field(state, [&](const std::string& name, const auto& member) {
    using T = std::remove_cvref_t<decltype(member)>;
    if constexpr (std::ranges::contiguous_range<T>) {
      using Value = typename T::value_type;
      static_assert(std::is_trivially_copyable_v<Value>);
      fields.push_back({name, detail::ValueType<Value>::name(), member.size(), sizeof(Value), false,
                        reinterpret_cast<const std::byte*>(member.data())});
    } else {
      fields.push_back({name, detail::ValueType<T>::name(), 1, sizeof(T), true,
                        reinterpret_cast<const std::byte*>(&member)});
    }
  });
  return fields;
}

/// The fields of a checkpoint, read one after the other.
class StateReader {
 public:
  /// `stream` stands at the first of the `fields`, whose `data` mean nothing. `file` is for errors.
  StateReader(std::istream& stream, std::vector<StateField> fields, std::filesystem::path file)
      : stream_(stream), fields_(std::move(fields)), file_(std::move(file)) {}

  /// Sets all of a State. Throws RestartError where the checkpoint holds other fields: the State is
  /// then of another version.
  template <class State>
  void read(State& state) {
    each_state_field(state, [&](const std::string& name, auto& member) {
      using T = std::remove_cvref_t<decltype(member)>;
      if constexpr (std::ranges::contiguous_range<T>) {
        using Value = typename T::value_type;
        member.resize(next(name, detail::ValueType<Value>::name(), sizeof(Value)).count);
        take(reinterpret_cast<std::byte*>(member.data()), member.size() * sizeof(Value));
      } else {
        if (next(name, detail::ValueType<T>::name(), sizeof(T)).count != 1) refuse(name, "a list");
        take(reinterpret_cast<std::byte*>(&member), sizeof(T));
      }
    });
    finish();
  }

  /// Throws RestartError: what the checkpoint holds is no state of the case.
  [[noreturn]] void refuse(const std::string& field, const std::string& found) const;

 private:
  const StateField& next(const std::string& name, const std::string& type, std::size_t value_bytes);
  void take(std::byte* data, std::size_t bytes);
  void finish() const;

  std::istream& stream_;
  std::vector<StateField> fields_;
  std::filesystem::path file_;
  std::size_t at_ = 0;
};

}  // namespace surge
