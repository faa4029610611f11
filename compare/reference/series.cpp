#include "compare/reference/series.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <string_view>
#include <utility>

#include "compare/read/delimited.hpp"
#include "particle/support/error.hpp"
#include "particle/support/regular_file.hpp"

namespace surge::compare {
namespace {

std::string trim(const std::string& text) {
  return std::string(trimmed(text));
}

/// One published file while it is read; knows its place for errors.
class SeriesParser {
 public:
  explicit SeriesParser(const std::filesystem::path& file)
      : file_(file), in_(open_regular(file, most_bytes, "a published series (CSV)")) {}

  PublishedSeries parse() {
    std::string line;
    bool titled = false;
    while (std::getline(in_, line)) {
      ++line_;
      line = trim(line);
      if (line.empty()) continue;
      if (line[0] == '#') {
        header(line);
      } else if (!titled) {
        if (line != "T,Z_over_L") fail("column names", "\"" + line + "\"", "T,Z_over_L");
        titled = true;
      } else {
        row(line);
      }
    }
    if (series_.front.samples.size() < 2)
      fail("rows", std::to_string(series_.front.samples.size()), "at least 2");
    return finish();
  }

 private:
  static constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20U;

  [[noreturn]] void fail(const std::string& key, const std::string& found,
                         const std::string& expected) const {
    throw Error(file_.string() + ":" + std::to_string(line_) + ": " + key + ": " + found +
                " found, " + expected + " expected");
  }

  void header(const std::string& line) {
    const auto colon = line.find(':');
    if (colon == std::string::npos) fail("header", "\"" + line + "\"", "\"# key: value\"");
    const std::string key = trim(line.substr(1, colon - 1));
    const std::string value = trim(line.substr(colon + 1));
    if (value.empty()) fail(key, "nothing", "a value");
    if (!header_.emplace(key, value).second) fail(key, "a second line", "one");
  }

  double number(const std::string& key, const std::string& text) const {
    const auto value = number_in(trimmed(text));
    if (!value || !std::isfinite(*value)) fail(key, "\"" + text + "\"", "a finite number");
    return *value;
  }

  void row(const std::string& line) {
    std::vector<std::string_view> fields;
    split_fields(line, ',', fields);
    if (fields.size() != 2) fail("row", "\"" + line + "\"", "two numbers");
    const std::string time(fields[0]);
    const DimensionlessFront::Sample sample{
        DimensionlessTime(number("T", time)),
        DimensionlessLength(number("Z_over_L", std::string(fields[1])))};
    auto& samples = series_.front.samples;
    if (!samples.empty() && sample.time <= samples.back().time) fail("T", time, "a later time");
    samples.push_back(sample);
  }

  std::string take(const std::string& key) {
    const auto entry = header_.find(key);
    if (entry == header_.end()) fail("header", "no \"# " + key + ":\"", "one");
    std::string value = std::move(entry->second);
    header_.erase(entry);
    return value;
  }

  double uncertainty(const std::string& key) {
    const std::string text = take(key);
    const double value = number(key, text);
    if (value < 0.0) fail(key, text, "0 or more");
    return value;
  }

  double positive(const std::string& key) {
    const std::string text = take(key);
    const double value = number(key, text);
    if (value <= 0.0) fail(key, text, "more than 0");
    return value;
  }

  PublishedSeries finish() {
    series_.name = file_.stem().string();
    series_.label = take("label");
    series_.citation = take("citation");
    series_.column = take("column");
    series_.of.column_height = positive("column_height");
    const std::string tank = take("tank_width");
    if (tank != "open") {
      series_.of.tank_width = number("tank_width", tank);
      if (*series_.of.tank_width <= 1.0) fail("tank_width", tank, "open, or more than 1");
    }
    series_.of.bed_depth = uncertainty("bed_depth");
    series_.of.gate = take("gate");
    series_.of.axes = take("axes");
    const std::string kind = take("kind");
    if (kind != "experiment" && kind != "computation")
      fail("kind", kind, "experiment or computation");
    series_.experiment = kind == "experiment";
    series_.time_uncertainty = DimensionlessTime(uncertainty("time_uncertainty"));
    series_.position_uncertainty = DimensionlessLength(uncertainty("position_uncertainty"));
    header_.erase("note");
    if (!header_.empty()) {
      fail(header_.begin()->first, "an unknown key",
           "label, citation, column, column_height, tank_width, bed_depth, gate, axes, kind, "
           "time_uncertainty, position_uncertainty or note");
    }
    return series_;
  }

  std::filesystem::path file_;
  std::ifstream in_;
  int line_ = 0;
  std::map<std::string, std::string> header_;
  PublishedSeries series_;
};

}  // namespace

PublishedSeries read_series(const std::filesystem::path& file) {
  return SeriesParser(file).parse();
}

}  // namespace surge::compare
