#pragma once

#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "particle/support/error.hpp"

namespace surge::compare {

/// Values one after the other as bytes, of one process and its child.
class Packer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void put(const std::string& text) {
    put(text.size());
    bytes_ += text;
  }
  void put(const std::vector<double>& values) {
    put(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    if constexpr (std::is_same_v<T, std::string>) {
      const auto size = get<std::size_t>();
      return std::string(step(size), size);
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      T values(get<std::size_t>());
      if (values.empty()) return values;
      std::memcpy(values.data(), step(values.size() * sizeof(double)),
                  values.size() * sizeof(double));
      return values;
    } else {
      T value{};
      std::memcpy(&value, step(sizeof(T)), sizeof(T));
      return value;
    }
  }

 private:
  const char* step(std::size_t size) {
    if (size > bytes_.size() - at_) throw Error("a child process sent too little");
    const char* place = bytes_.data() + at_;
    at_ += size;
    return place;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

template <class T>
void put_optional(Packer& out, const std::optional<T>& value) {
  out.put(value.has_value());
  out.put(value.value_or(T{}));
}
template <class T>
std::optional<T> get_optional(Unpacker& in) {
  const bool there = in.get<bool>();
  const T value = in.get<T>();
  return there ? std::optional(value) : std::nullopt;
}

}  // namespace surge::compare
