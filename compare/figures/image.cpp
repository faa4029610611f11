#include "compare/figures/image.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <algorithm>
#include <cmath>

#include "particle/support/error.hpp"

namespace surge::compare {

Image::Image(double x0, double x1, double y0, double y1, double pixels)
    : x0_(x0),
      y1_(y1),
      pixels_(pixels),
      columns_(static_cast<std::size_t>(std::lround((x1 - x0) * pixels))),
      rows_(static_cast<std::size_t>(std::lround((y1 - y0) * pixels))),
      rgba_(4 * columns_ * rows_, 0.0F) {}

void Image::blend(std::size_t column, std::size_t row, Colour colour, double opacity) {
  float* pixel = &rgba_[4 * (row * columns_ + column)];
  const auto a = static_cast<float>(opacity);
  const std::array<float, 4> over{static_cast<float>(colour.red) / 255.0F,
                                  static_cast<float>(colour.green) / 255.0F,
                                  static_cast<float>(colour.blue) / 255.0F, 1.0F};
  for (std::size_t i = 0; i < 4; ++i) pixel[i] = a * over[i] + (1.0F - a) * pixel[i];
}

/// Pixels whose centres lie in [from, to), both in pixels.
Image::Range Image::covered(double from, double to, std::size_t limit) const {
  const auto clipped = [limit](double x) {
    return static_cast<std::size_t>(std::clamp(std::ceil(x - 0.5), 0.0, double(limit)));
  };
  return {clipped(from), clipped(to)};
}

void Image::disc(double x, double y, double radius, Colour colour) {
  const double cx = (x - x0_) * pixels_;
  const double cy = (y1_ - y) * pixels_;
  const double r = radius * pixels_;
  const Range across = covered(cx - r - 1.0, cx + r + 1.0, columns_);
  const Range down = covered(cy - r - 1.0, cy + r + 1.0, rows_);
  for (std::size_t row = down.begin; row < down.end; ++row) {
    for (std::size_t column = across.begin; column < across.end; ++column) {
      const double distance = std::hypot(double(column) + 0.5 - cx, double(row) + 0.5 - cy);
      const double coverage = std::clamp(r + 0.5 - distance, 0.0, 1.0);
      if (coverage > 0.0) blend(column, row, colour, coverage);
    }
  }
}

void Image::rectangle(double x0, double x1, double y0, double y1, Colour colour, double opacity) {
  const Range across = covered((x0 - x0_) * pixels_, (x1 - x0_) * pixels_, columns_);
  const Range down = covered((y1_ - y1) * pixels_, (y1_ - y0) * pixels_, rows_);
  for (std::size_t row = down.begin; row < down.end; ++row) {
    for (std::size_t column = across.begin; column < across.end; ++column) {
      blend(column, row, colour, opacity);
    }
  }
}

void Image::polygon(const std::vector<std::array<double, 2>>& corners, Colour colour) {
  std::vector<double> crossings;
  for (std::size_t row = 0; row < rows_; ++row) {
    const double y = y1_ - (double(row) + 0.5) / pixels_;
    crossings.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto& [ax, ay] = corners[i];
      const auto& [bx, by] = corners[(i + 1) % corners.size()];
      if ((ay > y) != (by > y)) crossings.push_back(ax + (y - ay) / (by - ay) * (bx - ax));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
      rectangle(crossings[i], crossings[i + 1], y - 0.5 / pixels_, y + 0.5 / pixels_, colour, 1.0);
  }
}

std::array<std::uint8_t, 4> Image::at(double x, double y) const {
  const auto column = std::min(static_cast<std::size_t>((x - x0_) * pixels_), columns_ - 1);
  const auto row = std::min(static_cast<std::size_t>((y1_ - y) * pixels_), rows_ - 1);
  const float* pixel = &rgba_[4 * (row * columns_ + column)];
  const float a = pixel[3];
  const auto byte = [](float s) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(s, 0.0F, 1.0F)));
  };
  if (a <= 0.0F) return {0, 0, 0, 0};
  return {byte(pixel[0] / a), byte(pixel[1] / a), byte(pixel[2] / a), byte(a)};
}

void Image::write_png(const std::filesystem::path& file) const {
  vtkNew<vtkImageData> data;
  data->SetDimensions(static_cast<int>(columns_), static_cast<int>(rows_), 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t column = 0; column < columns_; ++column) {
      const auto colour =
          at(x0_ + (double(column) + 0.5) / pixels_, y1_ - (double(row) + 0.5) / pixels_);
      // VTK's rows start at the bottom.
      auto* pixel = static_cast<std::uint8_t*>(
          data->GetScalarPointer(static_cast<int>(column), static_cast<int>(rows_ - 1 - row), 0));
      std::copy(colour.begin(), colour.end(), pixel);
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetCompressionLevel(9);
  writer->SetInputData(data);
  writer->Write();
  if (writer->GetErrorCode() != 0) throw Error(file.string() + ": cannot be written");
}

}  // namespace surge::compare
