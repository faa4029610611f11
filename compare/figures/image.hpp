#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "compare/figures/style.hpp"

namespace surge::compare {

/// A picture of a rectangle of the plane, pixel rows from the top, transparent at first.
class Image {
 public:
  /// The rectangle [x0, x1] x [y0, y1] at `pixels` per unit of length.
  Image(double x0, double x1, double y0, double y1, double pixels);

  /// Covers a disc; its rim is smoothed.
  void disc(double x, double y, double radius, Colour colour);
  /// Lays a colour over a rectangle; pixels count where their centre is inside, so that adjoining
  /// rectangles neither overlap nor leave a gap.
  /// Corners (x, y) of a closed line, filled, row by row of pixels.
  void polygon(const std::vector<std::array<double, 2>>& corners, Colour colour);
  void rectangle(double x0, double x1, double y0, double y1, Colour colour, double opacity);

  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] double pixel_size() const { return 1.0 / pixels_; }
  /// Red, green, blue and opacity, 0..255, of the pixel that holds the point; the point must lie
  /// inside.
  [[nodiscard]] std::array<std::uint8_t, 4> at(double x, double y) const;

  /// Throws Error where the file cannot be written.
  void write_png(const std::filesystem::path& file) const;

 private:
  struct Range {
    std::size_t begin, end;
  };
  [[nodiscard]] Range covered(double from, double to, std::size_t limit) const;
  void blend(std::size_t column, std::size_t row, Colour colour, double opacity);

  double x0_, y1_, pixels_;
  std::size_t columns_, rows_;
  std::vector<float> rgba_;  ///< premultiplied, 0..1
};

struct NamedImage {
  std::string name;  ///< file stem; the file is NAME.png
  Image image;
};

}  // namespace surge::compare
