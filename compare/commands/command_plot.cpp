#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>

#include "compare/commands/command_options.hpp"
#include "compare/commands/commands.hpp"
#include "compare/figures/gnuplot.hpp"
#include "compare/figures/solids.hpp"
#include "compare/figures/water.hpp"
#include "particle/support/error.hpp"
#include "particle/support/printable.hpp"
#include "particle/support/process.hpp"
#include "particle/support/write_error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

struct PlotInput {
  std::string source;
  std::string out;
  std::optional<double> time;
  SourceArguments files;
};

constexpr double picture_pixels = 1000.0;  ///< across
constexpr double shown_part = 0.995;  ///< of the water; single drops may fly out of the picture
constexpr double margin = 0.05;       ///< L

/// A folder that goes with what is in it.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "surgefront-plot-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw write_error(name);
    path_ = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// What of the plane is shown, over L.
struct View {
  double x0 = 0.0, x1 = 1.0, y1 = 1.0;
};

View view_of(const WaterPicture& water) {
  View view;
  for (const WaterPatch& patch : water.patches) {
    view.x0 = std::min(view.x0, patch.x - patch.half_x);
    view.x1 = std::max(view.x1, patch.x + patch.half_x);
  }
  view.y1 = std::max(0.2 * (view.x1 - view.x0), water.height_of(shown_part) + margin);
  return view;
}

std::size_t frame_index(const Run& run, const std::optional<double>& time) {
  const std::vector<Seconds>& times = run.frames->times();
  if (!time) return times.size() - 1;
  if (const auto found = frame_near(times, Seconds(*time))) return *found;
  throw Error("--time: found " + number_text(*time) + " s, expected a time of " + run.name +
              "'s frames, " + number_text(times.front().value()) + " to " +
              number_text(times.back().value()) + " s");
}

std::string script(const View& view, const WaterPicture& water, const std::string& solids,
                   const std::string& title, double pixel) {
  const double across = 1200.0;
  const double down = 200.0 + across * 0.8 * std::clamp(view.y1 / (view.x1 - view.x0), 0.1, 3.0);
  std::string text =
      "set terminal pngcairo enhanced size " + fixed_text(across, 0) + "," + fixed_text(down, 0) +
      " font \"Sans,15\"\nset output \"out.png\"\n" +
      "set encoding utf8\nset size ratio -1\nset datafile separator comma\n" +
      "set tics nomirror out\nset border 3\n" + viridis_palette() +
      "\nset cbrange [0:1]\nset cblabel \"{/:Italic p}/(ρ{/:Italic gH})\"\n" + "set xrange [" +
      plot_number(view.x0) + ":" + plot_number(view.x1) +
      "]\nset yrange [0:" + plot_number(view.y1) + "]\n" +
      "set xlabel \"{/:Italic x}/{/:Italic L}\"\n" + "set ylabel \"{/:Italic y}/{/:Italic L}\"\n" +
      "set title " + plot_label(title) + "\n" + solids +
      "plot \"water.png\" binary filetype=png origin=(" + plot_number(view.x0 + 0.5 * pixel) + "," +
      plot_number(0.5 * pixel) + ") dx=" + plot_number(pixel) + " dy=" + plot_number(pixel) +
      " with rgbalpha notitle";
  if (!water.surface.empty())
    text +=
        ", \"surface.csv\" using 1:2:($3-$1):($4-$2) with vectors nohead lw 1.5 lc rgb "
        "\"#d55e00\" notitle";
  // The bar of colours appears with something that uses the palette.
  return text + ", \"+\" using (-1e9):(-1e9):(0.5) with points palette notitle\n";
}

void write_surface(const fs::path& file, const WaterPicture& water) {
  std::vector<std::vector<double>> rows;
  for (const Segment& s : water.surface) rows.push_back({s.x0, s.y0, s.x1, s.y1});
  write_csv(file, {"x0", "y0", "x1", "y1"}, rows);
}

void run_plot(const PlotInput& arguments) {
  Run run =
      open_run(arguments.source, arguments.files.get(std::filesystem::path(arguments.source)));
  const std::size_t index = frame_index(run, arguments.time);
  const double time = run.frames->times()[index].value();
  const WaterPicture water = water_picture(run.frames->read(index, {.pressure = true}), run);
  if (water.patches.empty())
    throw Error(run.name + ": found no water at " + number_text(time) + " s, expected some");
  const View view = view_of(water);
  const ScratchFolder scratch;
  Image image(view.x0, view.x1, 0.0, view.y1, picture_pixels / (view.x1 - view.x0));
  water.paint(image);
  image.write_png(scratch.path() / "water.png");
  write_surface(scratch.path() / "surface.csv", water);
  const fs::path gp = scratch.path() / "plot.gp";
  std::ofstream out(gp);
  out << script(view, water, solid_objects(solids_of(run), Seconds(time)),
                run.name + ", t = " + fixed_text(time, 3) + " s", image.pixel_size());
  out.close();
  if (!out) throw write_error(gp);
  const auto [status, said] = run_process("gnuplot", {"plot.gp"}, scratch.path(), "gnuplot-nox");
  if (status != 0) throw Error("plot: gnuplot failed: " + said);
  const fs::path target = arguments.out.empty() ? run.name + ".png" : arguments.out;
  std::error_code error;
  fs::copy_file(scratch.path() / "out.png", target, fs::copy_options::overwrite_existing, error);
  if (error) throw Error(target.string() + ": cannot be written: " + error.message());
  print_notices(run);
  std::printf("%s: t = %g s, %zu of %zu frames: %s\n", run.name.c_str(), time, index + 1,
              run.frames->times().size(), printable(target.string()).c_str());
}

}  // namespace

void add_plot_command(CLI::App& app) {
  auto arguments = std::make_shared<PlotInput>();
  CLI::App* command = app.add_subcommand(
      "plot", "Picture (PNG) of one frame of a source, coloured by pressure; in 3D its middle");
  command
      ->add_option("SOURCE", arguments->source,
                   "run folder, OpenFOAM case, .pvd, folder or \"pattern_*.vtk\" of particle files")
      ->required();
  command->add_option("--out", arguments->out, "file to write (default: NAME.png)");
  command->add_option("--time", arguments->time, "s; the last frame by default");
  arguments->files.add_to(*command);
  command->footer("Example:\n  surge-compare plot runs/mine --time 0.3 --out mine.png");
  command->callback([arguments] { run_plot(*arguments); });
}

}  // namespace surge::compare
