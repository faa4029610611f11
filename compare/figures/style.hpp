#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace surge::compare {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  [[nodiscard]] std::string hex() const;  ///< #rrggbb
};

/// Look of one curve: colour and dash differ together, so that print and colour-blind readers can
/// tell curves apart as well. Colours: Okabe & Ito (2008), "Color universal design".
struct LineStyle {
  Colour colour;
  std::string dash;  ///< gnuplot's dashtype
  int point = 6;     ///< gnuplot's pointtype, used for measured points
};

/// The reference (VOF) is black and solid; computed runs are numbered from 0 in the study's order.
[[nodiscard]] LineStyle reference_style();
[[nodiscard]] LineStyle run_style(std::size_t index);
/// Published series, numbered from 0: colours and markers that no run has.
[[nodiscard]] LineStyle published_style(std::size_t index);

/// Contrast of a colour on white by WCAG 2.1: (L1 + 0.05)/(L2 + 0.05) of the relative luminances.
[[nodiscard]] double contrast_on_white(const Colour& colour);
/// The colour, or the darker one of its kind that text can have: a contrast of 4.5 on white.
[[nodiscard]] Colour readable(Colour colour);

/// `lw W lc rgb "..." dt ...` for a plot command.
[[nodiscard]] std::string line_spec(const LineStyle& style, double width);
/// `pt P ps S lc rgb "..." lw 0.8` for a plot command.
[[nodiscard]] std::string point_spec(const LineStyle& style, double size);

/// Viridis (van der Walt & Smith, CC0), interpolated from nine of its colours; s is clamped to
/// 0..1.
[[nodiscard]] Colour viridis(double s);
/// The same map as a `set palette` command.
[[nodiscard]] std::string viridis_palette();

}  // namespace surge::compare
