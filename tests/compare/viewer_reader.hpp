#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace surge::compare::testing {

/// The reader of the page (page/viewer_unpack.js) in C++, written from the description of the
/// streams.

inline std::vector<std::uint8_t> bytes_of_base64(const std::string& text) {
  static const std::string letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned held = 0, bits = 0;
  for (char c : text) {
    if (c == '=') break;
    held = held << 6U | static_cast<unsigned>(letters.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::uint8_t>(held >> bits & 0xffU));
  }
  return bytes;
}

/// One stream of a track, read from its beginning.
class StreamReader {
 public:
  explicit StreamReader(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}
  std::uint8_t byte() { return bytes_.at(at_++); }
  std::uint32_t number() {
    std::uint32_t value = 0;
    for (unsigned shift = 0;; shift += 7U) {
      const std::uint8_t next = byte();
      value |= std::uint32_t(next & 0x7fU) << shift;
      if (next < 0x80U) return value;
    }
  }
  std::int32_t signed_number() {
    const std::uint32_t value = number();
    return static_cast<std::int32_t>(value >> 1U) ^ -static_cast<std::int32_t>(value & 1U);
  }
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

inline std::vector<StreamReader> streams_of(const nlohmann::json& track) {
  const auto packed = bytes_of_base64(track.at("data"));
  std::size_t size = 0;
  for (std::size_t one : track.at("sizes")) size += one;
  std::vector<std::uint8_t> bytes(size + 1);
  uLongf found = bytes.size();
  if (uncompress(bytes.data(), &found, packed.data(), packed.size()) != Z_OK || found != size)
    return {};
  std::vector<StreamReader> streams;
  auto at = bytes.begin();
  for (std::size_t one : track.at("sizes")) {
    streams.emplace_back(std::vector<std::uint8_t>(at, at + static_cast<std::ptrdiff_t>(one)));
    at += static_cast<std::ptrdiff_t>(one);
  }
  return streams;
}

/// Of each particle at each time {x, y, z, pressure, speed}.
inline std::vector<std::vector<std::array<double, 5>>> unpacked_particles(
    const nlohmann::json& track) {
  struct Held {
    std::array<int, 3> at{}, moved{};
    std::array<std::uint8_t, 2> values{};
  };
  auto streams = streams_of(track);
  const std::size_t axes = track.at("dimension");
  std::vector<std::vector<std::array<double, 5>>> frames;
  std::vector<Held> held;
  for (const std::size_t count : track.at("counts")) {
    std::size_t gone = streams.at(0).number(), at = 0;
    std::vector<Held> now;
    std::vector<std::size_t> lost;
    for (; gone > 0; --gone) lost.push_back(at += streams.at(0).number());
    for (std::size_t i = 0; i < held.size(); ++i)
      if (std::find(lost.begin(), lost.end(), i) == lost.end()) now.push_back(held[i]);
    const std::size_t old = now.size();
    now.resize(count);
    frames.emplace_back(count);
    for (std::size_t i = 0; i < count; ++i) {
      Held& one = now[i];
      for (std::size_t a = 0; a < axes; ++a) {
        const int expected = i < old ? one.at[a] + one.moved[a] : i > 0 ? now[i - 1].at[a] : 0;
        const int place = expected + streams.at(1 + a).signed_number();
        one.moved[a] = i < old ? place - one.at[a] : 0;
        one.at[a] = place;
        frames.back()[i][a] = place * track.at("step").get<double>();
      }
      for (std::size_t v = 0; v < 2; ++v) {
        one.values[v] = static_cast<std::uint8_t>(one.values[v] + streams.at(1 + axes + v).byte());
        frames.back()[i][3 + v] = one.values[v] / 255.0;
      }
    }
    held = now;
  }
  return frames;
}

/// Of each square that holds water at each time {x, y, z, fraction, pressure, speed}.
inline std::vector<std::vector<std::array<double, 6>>> unpacked_squares(
    const nlohmann::json& track) {
  auto streams = streams_of(track);
  const auto size = track.at("size").get<std::array<std::size_t, 3>>();
  const auto first = track.at("first").get<std::array<long, 3>>();
  const double edge = 2.0 * track.at("half").get<double>();
  std::vector<std::array<std::uint8_t, 3>> grid(size[0] * size[1] * size[2]);
  std::vector<std::vector<std::array<double, 6>>> frames(track.at("times").get<std::size_t>());
  for (auto& frame : frames) {
    for (std::size_t v = 0; v < 3; ++v)
      for (auto& square : grid)
        square[v] = static_cast<std::uint8_t>(square[v] + streams.at(v).byte());
    for (std::size_t n = 0; n < grid.size(); ++n) {
      if (grid[n][0] == 0) continue;
      const std::array<std::size_t, 3> k{n % size[0], n / size[0] % size[1],
                                         n / (size[0] * size[1])};
      std::array<double, 6> square{};
      for (std::size_t a = 0; a < 3; ++a)
        square[a] = (double(first[a]) + double(k[a]) + 0.5) * edge;
      for (std::size_t v = 0; v < 3; ++v) square[3 + v] = grid[n][v] / 255.0;
      frame.push_back(square);
    }
  }
  return frames;
}

/// The pieces {x0, y0, x1, y1} of the lines at each time.
inline std::vector<std::vector<std::array<double, 4>>> unpacked_lines(const nlohmann::json& track) {
  auto streams = streams_of(track);
  const double step = track.at("step");
  std::vector<std::vector<std::array<double, 4>>> frames(track.at("times").get<std::size_t>());
  int x = 0, y = 0;
  for (auto& frame : frames)
    for (std::uint32_t lines = streams.at(0).number(); lines > 0; --lines) {
      const std::uint32_t points = streams.at(0).number();
      for (std::uint32_t i = 0; i < points; ++i) {
        const int x0 = x, y0 = y;
        x += streams.at(1).signed_number();
        y += streams.at(2).signed_number();
        if (i > 0) frame.push_back({x0 * step, y0 * step, x * step, y * step});
      }
    }
  return frames;
}

}  // namespace surge::compare::testing
