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

Colour darker(const Colour& colour, double part) {
  const auto scaled = [part](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::lround(part * value));
  };
  return {scaled(colour.red), scaled(colour.green), scaled(colour.blue)};
}

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
                                                {{0x56, 0xb4, 0xe9}, "'_'", 6}}};
  // From the seventh on: the same colours darker, each with the next dash and marker.
  const std::size_t round = index / styles.size(), place = index % styles.size();
  LineStyle style = styles[place];
  const LineStyle& next = styles[(place + round) % styles.size()];
  style.dash = next.dash;
  style.point = next.point;
  for (std::size_t i = 0; i < round; ++i) style.colour = darker(style.colour, 0.6);
  return style;
}

LineStyle published_style(std::size_t index) {
  // None of the colours and markers of a run.
  static const std::array<LineStyle, 4> styles{{{{0x30, 0x30, 0x30}, "solid", 7},
                                                {{0x80, 0x80, 0x80}, "solid", 5},
                                                {{0x8c, 0x56, 0x4b}, "solid", 3},
                                                {{0x6a, 0x3d, 0x9a}, "solid", 2}}};
  LineStyle style = styles[index % styles.size()];
  for (std::size_t i = 0; i < index / styles.size(); ++i) {
    style.colour = darker(style.colour, 0.6);
    style.point = 1;
  }
  return style;
}

double contrast_on_white(const Colour& colour) {
  const auto linear = [](std::uint8_t part) {
    const double s = part / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  const double luminance =
      0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
  return 1.05 / (luminance + 0.05);
}

Colour readable(Colour colour) {
  while (contrast_on_white(colour) < 4.5) colour = darker(colour, 0.95);
  return colour;
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
