#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace surge::compare {

/// The whole number of steps nearest to a value; what lies beyond 2^29 steps becomes the end, what
/// is not a number 0. value - step*steps_of(value, step) is at most half a step.
[[nodiscard]] std::int32_t steps_of(double value, double step);
/// A part of one in 2^8 steps; what lies outside of 0..1 becomes an end, what is not a number 0.
[[nodiscard]] std::uint8_t quantise_unit(double value);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

/// Numbers of one kind behind each other; small ones take one byte.
class ByteStream {
 public:
  void byte(std::uint8_t value) { bytes_.push_back(value); }
  /// Seven bits a byte, the lowest first; the highest bit says that another byte follows.
  void number(std::uint32_t value);
  /// 0, -1, 1, -2, ... as 0, 1, 2, 3, ...
  void signed_number(std::int32_t value);
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// {"sizes": bytes of each stream, "data": base64 of all of them behind each other in the format of
/// zlib, RFC 1950, which browsers call "deflate"}.
[[nodiscard]] nlohmann::json packed(const std::vector<const ByteStream*>& streams);

}  // namespace surge::compare
