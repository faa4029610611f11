#include "compare/figures/style.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "particle/support/table.hpp"

namespace surge::compare {

namespace {

constexpr std::array<Colour, 9> viridis_anchors{{{0x44, 0x01, 0x54},
                                                 {0x47, 0x2c, 0x7a},
                                                 {0x3b, 0x51, 0x8b},
                                                 {0x2c, 0x71, 0x8e},
                                                 {0x21, 0x90, 0x8d},
                                                 {0x27, 0xad, 0x81},
                                                 {0x5c, 0xc8, 0x63},
                                                 {0xaa, 0xdc, 0x32},
                                                 {0xfd, 0xe7, 0x25}}};

}  // namespace

std::string Colour::hex() const {
  constexpr const char* digits = "0123456789abcdef";
  std::string text = "#";
  for (std::uint8_t part : {red, green, blue}) {
    text += digits[part >> 4U];
    text += digits[part & 15U];
  }
  return text;
}

LineStyle reference_style() {
  return {{0x00, 0x00, 0x00}, "solid", 6};
}

LineStyle run_style(std::size_t index) {
  static const std::array<LineStyle, 6> styles{{{{0x00, 0x72, 0xb2}, "solid", 4},
                                                {{0xd5, 0x5e, 0x00}, "'-'", 8},
                                                {{0x00, 0x9e, 0x73}, "'-.'", 12},
                                                {{0xcc, 0x79, 0xa7}, "'.'", 10},
                                                {{0xe6, 0x9f, 0x00}, "'-..'", 14},
                                                {{0x56, 0xb4, 0xe9}, "'_'", 5}}};
  return styles[index % styles.size()];
}

LineStyle published_style(std::size_t index) {
  static const std::array<LineStyle, 4> styles{{{{0x30, 0x30, 0x30}, "solid", 6},
                                                {{0x80, 0x80, 0x80}, "solid", 4},
                                                {{0xe6, 0x9f, 0x00}, "solid", 8},
                                                {{0xcc, 0x79, 0xa7}, "solid", 2}}};
  return styles[index % styles.size()];
}

std::string line_spec(const LineStyle& style, double width) {
  return "lw " + fixed_text(width, 1) + " lc rgb \"" + style.colour.hex() + "\" dt " + style.dash;
}

std::string point_spec(const LineStyle& style, double size) {
  return "pt " + std::to_string(style.point) + " ps " + fixed_text(size, 2) + " lw 0.7 lc rgb \"" +
         style.colour.hex() + "\"";
}

Colour viridis(double s) {
  const double x = std::clamp(s, 0.0, 1.0) * static_cast<double>(viridis_anchors.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(x), viridis_anchors.size() - 2);
  const double part = x - static_cast<double>(low);
  const auto mix = [part](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround((1.0 - part) * a + part * b));
  };
  const Colour& a = viridis_anchors[low];
  const Colour& b = viridis_anchors[low + 1];
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

std::string viridis_palette() {
  std::string text = "set palette defined (";
  for (std::size_t i = 0; i < viridis_anchors.size(); ++i) {
    text += (i ? ", " : "") + std::to_string(i) + " \"" + viridis_anchors[i].hex() + '"';
  }
  return text + ")\n";
}

}  // namespace surge::compare
