#include "compare/measure/measure_tool.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "compare/read/delimited.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* first_words = " ;PosX [m]:;";

bool is_table(const fs::path& file) {
  if (file.extension() != ".csv" || !fs::is_regular_file(file)) return false;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line.starts_with(first_words) || line.starts_with(first_words + 1);
}

/// The folder of the source; of a DualSPHysics run the run's.
fs::path run_folder(const Run& run) {
  fs::path folder = fs::is_directory(run.path) ? run.path : run.path.parent_path();
  const fs::path above = fs::absolute(folder).lexically_normal().parent_path();
  for (const fs::path& place : {above, above.parent_path()})
    if (fs::exists(place / "Run.out") || fs::exists(place / "Run.csv")) return place;
  return folder;
}

std::vector<fs::path> tables_of(const Run& run) {
  std::vector<fs::path> files;
  const fs::path folder = run_folder(run);
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_table(entry.path())) files.push_back(entry.path());
    if (!entry.is_directory() || entry.is_symlink()) continue;
    for (const auto& inner : fs::directory_iterator(entry.path()))
      if (is_table(inner.path())) files.push_back(inner.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Axes of the frames, as the source was read.
FileAxes axes_of(const Run& run) {
  const auto found = run.reading.find("axes");
  if (found == run.reading.end() || run.physics.vertical_axis() == 2) return {};
  const auto comma = found->second.find(", ");
  const std::array<std::string, 2> words{found->second.substr(0, comma),
                                         found->second.substr(comma + 2)};
  return FileAxes::parse(words, "axes");
}

/// One table, read line by line.
class Reader {
 public:
  explicit Reader(const fs::path& file) : file_(file), in_(file) {}

  std::vector<ProbeColumn> columns(const std::string& quantity, const FileAxes& axes) {
    std::array<std::vector<double>, 3> places;
    for (std::size_t a = 0; a < 3; ++a) {
      if (!next() || fields_.size() < 3) fail("the line of places Pos" + std::string(1, "XYZ"[a]));
      for (std::size_t k = 2; k < fields_.size(); ++k) places[a].push_back(number(k));
      if (places[a].size() != places[0].size()) fail("as many places as for PosX");
    }
    if (!next() || fields_.size() != places[0].size() + 2 || fields_[0] != "Part")
      fail("Part;Time [s]; and a name for each place");
    std::vector<ProbeColumn> found;
    std::vector<std::size_t> at;
    for (std::size_t k = 2; k < fields_.size(); ++k) {
      if (!fields_[k].starts_with(quantity + "_")) continue;
      ProbeColumn& column = found.emplace_back();
      column.file = file_;
      column.place = axes.apply({places[0][k - 2], places[1][k - 2], places[2][k - 2]});
      const auto open = fields_[k].find('['), close = fields_[k].find(']');
      if (open != std::string::npos && close != std::string::npos && close > open)
        column.unit = fields_[k].substr(open + 1, close - open - 1);
      at.push_back(k);
    }
    read_rows(found, at, places[0].size() + 2);
    return found;
  }

 private:
  void read_rows(std::vector<ProbeColumn>& found, const std::vector<std::size_t>& at,
                 std::size_t width) {
    while (next()) {
      if (fields_.size() == 1 && fields_[0].empty()) continue;
      if (fields_.size() != width) fail(std::to_string(width) + " fields");
      const double time = number(1);
      for (std::size_t k = 0; k < found.size(); ++k) {
        if (!found[k].time.empty() && !(time > found[k].time.back())) fail("a later time");
        found[k].time.push_back(time);
        found[k].values.push_back(number(at[k]));
      }
    }
    for (const ProbeColumn& column : found)
      if (column.time.empty()) fail("rows with values");
  }

  bool next() {
    if (!std::getline(in_, line_)) return false;
    ++count_;
    fields_.clear();
    std::vector<std::string_view> views;
    split_fields(line_, ';', views);
    fields_.assign(views.begin(), views.end());
    return true;
  }
  [[nodiscard]] double number(std::size_t k) const {
    const auto value = number_in(fields_[k]);
    if (!value || !std::isfinite(*value)) fail("a finite number instead of \"" + fields_[k] + '"');
    return *value;
  }
  [[noreturn]] void fail(const std::string& expected) const {
    throw Error(file_.string() + ":" + std::to_string(count_) + ": expected " + expected +
                ", as MeasureTool writes it");
  }

  fs::path file_;
  std::ifstream in_;
  std::string line_;
  std::size_t count_ = 0;
  std::vector<std::string> fields_;
};

}  // namespace

std::vector<ProbeColumn> measure_tool_columns(const Run& run, const std::string& quantity) {
  std::vector<ProbeColumn> columns;
  if (run.kind != SourceKind::particle_series) return columns;
  const FileAxes axes = axes_of(run);
  for (const fs::path& file : tables_of(run))
    for (ProbeColumn& column : Reader(file).columns(quantity, axes))
      columns.push_back(std::move(column));
  return columns;
}

std::optional<ProbeColumn> measure_tool_column(const Run& run, const std::string& quantity,
                                               const Vec3& place,
                                               const std::vector<std::size_t>& axes) {
  std::optional<ProbeColumn> found;
  for (ProbeColumn& column : measure_tool_columns(run, quantity)) {
    double square = 0.0;
    for (const std::size_t a : axes)
      square += (column.place[a] - place[a]) * (column.place[a] - place[a]);
    if (std::sqrt(square) > 0.1 * run.spacing.value()) continue;
    if (found)
      throw Error(found->file.string() + " and " + column.file.string() + ": both hold " +
                  quantity + " at that place, one expected");
    found = std::move(column);
  }
  return found;
}

}  // namespace surge::compare
