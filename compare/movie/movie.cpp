#include "compare/movie/movie.hpp"

#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkVersionMacros.h>
#if VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION < 2
#include <vtkUnicodeString.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/figures/surface.hpp"
#include "compare/movie/video_pipe.hpp"
#include "particle/support/error.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {

namespace {

constexpr double usual_length = 8.0;                                         ///< of a film, s
constexpr int margin = 16, title_height = 52, label_height = 24, foot = 36;  ///< pixels
constexpr double shown_part = 0.98;     ///< of the water that the panels must show
constexpr std::size_t most_looks = 40;  ///< at frames, to find how high the water gets
constexpr Colour ink{0x1c, 0x1c, 0x1c}, solid{0x8a, 0x8a, 0x8a}, moving{0xe6, 0x9f, 0x00};

/// Debian's fonts-dejavu-core: the letters that VTK brings itself lack Greek.
constexpr const char* font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr const char* bold_font = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";
bool has_font() {
  static const bool found = std::filesystem::exists(font) && std::filesystem::exists(bold_font);
  return found;
}

/// Text (UTF-8) as a picture.
bool render(vtkTextProperty& look, const std::string& words, vtkImageData& drawn) {
  std::array<int, 2> extent{};
  vtkFreeTypeTools* tools = vtkFreeTypeTools::GetInstance();
  tools->ScaleToPowerTwoOff();
#if VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION < 2
  // Of a std::string VTK 9.1 draws the ASCII letters and nothing for the others.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  if (vtkUnicodeString::is_utf8(words))
    return tools->RenderString(&look, vtkUnicodeString::from_utf8(words), 72, &drawn,
                               extent.data());
#pragma GCC diagnostic pop
#endif
  return tools->RenderString(&look, words, 72, &drawn, extent.data());
}

/// A picture of red, green and blue, rows from the top.
class Canvas {
 public:
  Canvas(std::size_t width, std::size_t height)
      : width_(width), height_(height), bytes_(3 * width * height, 255) {}

  void clear() { std::fill(bytes_.begin(), bytes_.end(), std::uint8_t{255}); }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }

  void blend(long column, long row, const Colour& colour, double opacity) {
    if (column < 0 || row < 0 || column >= long(width_) || row >= long(height_)) return;
    const std::size_t at = 3 * (std::size_t(row) * width_ + std::size_t(column));
    const std::array<std::uint8_t, 3> over{colour.red, colour.green, colour.blue};
    for (std::size_t i = 0; i < 3; ++i)
      bytes_[at + i] = static_cast<std::uint8_t>(
          std::lround(opacity * over[i] + (1.0 - opacity) * bytes_[at + i]));
  }

  /// The text's upper left corner.
  void text(const std::string& words, long left, long top, int size, bool bold = false) {
    if (words.empty()) return;
    vtkNew<vtkTextProperty> look;
    if (has_font()) {
      look->SetFontFamily(VTK_FONT_FILE);
      look->SetFontFile(bold ? bold_font : font);
    } else {
      look->SetFontFamilyToArial();
    }
    look->SetFontSize(size);
    look->SetBold(bold && !has_font() ? 1 : 0);
    look->SetColor(ink.red / 255.0, ink.green / 255.0, ink.blue / 255.0);
    vtkNew<vtkImageData> drawn;
    if (!render(*look, words, *drawn))
      throw Error("the film: the text \"" + words + "\" cannot be drawn");
    const std::array<int, 6> range{drawn->GetExtent()[0],
                                   drawn->GetExtent()[1],
                                   drawn->GetExtent()[2],
                                   drawn->GetExtent()[3],
                                   0,
                                   0};
    for (int y = range[2]; y <= range[3]; ++y)
      for (int x = range[0]; x <= range[1]; ++x) {
        const double opacity = drawn->GetScalarComponentAsDouble(x, y, 0, 3) / 255.0;
        if (opacity > 0.0) blend(left + x - range[0], top + range[3] - y, ink, opacity);
      }
  }

  /// What is not transparent of an image.
  void put(const Image& image, double x0, double y1, long left, long top) {
    const double pixel = image.pixel_size();
    for (std::size_t row = 0; row < image.rows(); ++row)
      for (std::size_t column = 0; column < image.columns(); ++column) {
        const auto [r, g, b, a] =
            image.at(x0 + (double(column) + 0.5) * pixel, y1 - (double(row) + 0.5) * pixel);
        if (a > 0) blend(left + long(column), top + long(row), {r, g, b}, a / 255.0);
      }
  }

 private:
  std::size_t width_, height_;
  std::vector<std::uint8_t> bytes_;
};

/// A run at a moment; what was read last is kept.
struct Shown {
  const MoviePanel* panel = nullptr;
  Solids solids;
  std::optional<std::size_t> index;
  WaterPicture water;
  std::vector<Segment> surface;

  void look_at(Seconds time) {
    FrameReader& frames = *panel->run->frames;
    const auto next = frame_near(frames.times(), time);
    if (next == index) return;
    index = next;
    water = index ? water_picture(frames.read(*index, {.pressure = true, .velocity = true}),
                                  *panel->run)
                  : WaterPicture{};
    surface = free_surface(water, solids, time);
  }
};

/// What all panels show, over L.
Rectangle view_of(std::vector<Shown>& all) {
  Rectangle view{0.0, 0.0, 1.0, 0.5};
  Shown& first = all.front();
  const auto& tank = first.solids.tank;
  const auto& times = first.panel->run->frames->times();
  const std::size_t stride = std::max<std::size_t>(1, times.size() / most_looks);
  for (std::size_t i = 0; i < times.size(); i += stride) {
    first.look_at(times[i]);
    view.y1 = std::max(view.y1, first.water.height_of(shown_part) + 0.05);
    for (const WaterPatch& p : first.water.patches) {
      view.x0 = std::min(view.x0, p.x - p.half_x);
      view.x1 = std::max(view.x1, p.x + p.half_x);
    }
  }
  if (tank && std::isfinite(tank->x0)) view.x0 = tank->x0;
  if (tank && std::isfinite(tank->x1)) view.x1 = tank->x1;
  view.y1 = std::ceil(2.0 * view.y1) / 2.0;
  return view;
}

void paint_line(Image& image, const Segment& s, double width, const Colour& colour) {
  const double step = 0.5 * image.pixel_size();
  const auto count = static_cast<int>(std::ceil(std::hypot(s.x1 - s.x0, s.y1 - s.y0) / step)) + 1;
  for (int k = 0; k <= count; ++k) {
    const double part = double(k) / count;
    image.disc(s.x0 + part * (s.x1 - s.x0), s.y0 + part * (s.y1 - s.y0),
               0.5 * width * image.pixel_size(), colour);
  }
}

Image painted(const Shown& shown, const Shown& first, Seconds time, const Rectangle& view,
              double pixels, bool speed) {
  Image image(view.x0, view.x1, view.y0, view.y1, pixels);
  WaterPicture water = shown.water;
  if (speed)
    for (WaterPatch& patch : water.patches) patch.pressure = patch.speed;
  water.paint(image);
  const auto box = [&](const Rectangle& r, const Colour& colour) {
    image.rectangle(r.x0, r.x1, r.y0, r.y1, colour, 1.0);
  };
  for (const Rectangle& one : shown.solids.obstacles) box(one, solid);
  for (const Outline& outline : shown.solids.outlines) image.polygon(outline, solid);
  for (const Solids::MovingWall& wall : shown.solids.walls) box(wall.at(time), moving);
  for (const Segment& s : first.surface) paint_line(image, s, 3.4, {255, 255, 255});
  for (const Segment& s : first.surface) paint_line(image, s, 1.8, {0, 0, 0});
  const double edge = image.pixel_size();
  for (const Segment& s : {Segment{view.x0 + edge, view.y0, view.x0 + edge, view.y1},
                           Segment{view.x1 - edge, view.y0, view.x1 - edge, view.y1},
                           Segment{view.x0, view.y0 + edge, view.x1, view.y0 + edge}})
    paint_line(image, s, 2.0, ink);
  return image;
}

void draw_scale(Canvas& canvas, long left, long top, bool speed) {
  constexpr long length = 180;
  for (long i = 0; i < length; ++i)
    for (long j = 0; j < 12; ++j)
      canvas.blend(left + 14 + i, top + j, viridis(double(i) / double(length - 1)), 1.0);
  canvas.text("0", left, top, 13);
  const std::string quantity = has_font() ? (speed ? "|u|/√(2gH)" : "p/(ρgH)")
                               : speed    ? "|u|/sqrt(2 g H)"
                                          : "p/(rho g H)";
  canvas.text("1  " + quantity, left + length + 20, top, 13);
}

/// In rows of at most so many that a panel is not too narrow.
struct Grid {
  std::size_t columns, rows;
};
Grid grid_of(std::size_t panels) {
  const std::size_t columns = std::min<std::size_t>(panels, 3);
  return {columns, (panels + columns - 1) / columns};
}

}  // namespace

std::size_t write_movie(const std::vector<MoviePanel>& panels, const MovieOptions& options) {
  if (panels.empty()) throw Error("the film: found no run, expected one");
  std::vector<Shown> all;
  Seconds begin = panels.front().run->frames->times().front(), last = begin;
  for (const MoviePanel& panel : panels) {
    all.push_back({&panel, solids_of(*panel.run), {}, {}, {}});
    begin = std::min(begin, panel.run->frames->times().front());
    last = std::max(last, panel.run->frames->times().back());
  }
  if (options.end) last = std::min(last, *options.end);
  const double span = (last - begin).value();
  if (!(span > 0.0))
    throw Error(panels.front().run->path.string() + ": found " +
                (options.end ? "nothing before the end that was asked for" : "one frame") +
                ", expected a film's worth");
  const double pace = options.pace.value_or(span / usual_length);
  const auto count = static_cast<std::size_t>(std::ceil(span / pace * options.pictures)) + 1;
  const Rectangle view = view_of(all);
  const Grid grid = grid_of(panels.size());
  const double panel_width = double(options.width - margin) / double(grid.columns) - margin;
  const double pixels = panel_width / (view.x1 - view.x0);
  const auto panel_height = static_cast<long>(std::lround((view.y1 - view.y0) * pixels));
  const auto even = [](long value) { return static_cast<std::size_t>(value + value % 2); };
  const std::size_t width = even(options.width);
  const std::size_t height =
      even(title_height + long(grid.rows) * (panel_height + label_height + margin) + foot);
  const Scales scales = panels.front().run->physics.scales();
  Canvas canvas(width, height);
  VideoPipe film(options.out, width, height, options.pictures);
  for (std::size_t k = 0; k < count; ++k) {
    const Seconds time = std::min(begin + Seconds(double(k) * pace / options.pictures), last);
    canvas.clear();
    canvas.text(options.title, margin, 8, 17, true);
    canvas.text("t = " + fixed_text(time.value(), 3) +
                    " s,  T = " + fixed_text(scales.dimensionless(time).value(), 2) + ",  " +
                    fixed_text(pace, 3) + " of real time",
                margin, 32, 14);
    for (Shown& shown : all) shown.look_at(time);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const long left = margin + long(double(i % grid.columns) * (panel_width + margin));
      const long top =
          title_height + long(i / grid.columns) * (panel_height + label_height + margin);
      canvas.text(all[i].panel->label, left, top + 2, 14);
      canvas.put(painted(all[i], all.front(), time, view, pixels, options.speed_of_water), view.x0,
                 view.y1, left, top + label_height);
      if (!all[i].index)
        canvas.text("no frame at this time", left + 12, top + label_height + 12, 14);
    }
    draw_scale(canvas, margin, long(height) - foot + 8, options.speed_of_water);
    film.add(canvas.bytes());
  }
  film.finish();
  return count;
}

}  // namespace surge::compare
