#include "compare/reference/reference_series.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "compare/read/delimited.hpp"
#include "compare/read/readers.hpp"
#include "particle/case/case_checks.hpp"
#include "particle/case/case_file.hpp"
#include "particle/case/case_json.hpp"
#include "particle/support/error.hpp"
#include "particle/support/spelling.hpp"
#include "particle/support/text.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kinds{"experiment", "computation", "theory"};
constexpr std::size_t most_lines = 1'000'000;

/// One file while it is read; knows its line for errors.
class ReferenceParser {
 public:
  ReferenceParser(const fs::path& file, const std::vector<std::string>& known)
      : file_(file), in_(file), known_(known) {
    if (!in_) throw Error(file.string() + ": cannot be opened, a reference series (CSV) expected");
    series_.name = file.stem().string();
    series_.place = file.string();
  }

  ReferenceSeries parse() {
    std::string line;
    while (std::getline(in_, line)) {
      if (++line_ > most_lines) fail("rows", "more than a million lines", "fewer");
      const std::string text(trimmed(line));
      if (text.empty()) continue;
      if (text[0] == '#') {
        header(text);
      } else if (columns_.empty()) {
        columns(text);
      } else {
        row(text);
      }
    }
    if (series_.points.size() < 2)
      fail("rows", std::to_string(series_.points.size()), "at least 2");
    finish();
    return std::move(series_);
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& found,
                         const std::string& expected) const {
    throw Error(file_.string() + ":" + std::to_string(line_) + ": " + key + ": " + found +
                " found, " + expected + " expected");
  }
  [[nodiscard]] std::string where(const std::string& key) const {
    return file_.string() + ": " + key;
  }

  void header(const std::string& line) {
    if (!columns_.empty()) fail("header", "\"" + line + "\" below the columns", "it above them");
    const auto colon = line.find(':');
    if (colon == std::string::npos) fail("header", "\"" + line + "\"", "\"# key: value\"");
    const std::string key(trimmed(std::string_view(line).substr(1, colon - 1)));
    const std::string value(trimmed(std::string_view(line).substr(colon + 1)));
    if (value.empty()) fail(key, "nothing", "a value");
    if (!header_.emplace(key, value).second) fail(key, "a second line", "one");
  }

  void columns(const std::string& line) {
    std::vector<std::string_view> fields;
    split_fields(line, ',', fields);
    for (const std::string_view field : fields) columns_.emplace_back(trimmed(field));
    const std::string first = header_.contains("at_time") ? "x" : "t";
    const bool good = columns_.size() >= 2 && columns_.size() <= 3 && columns_[0] == first &&
                      columns_[1] == "value" && (columns_.size() == 2 || columns_[2] == "u");
    if (!good) fail("column names", "\"" + line + "\"", first + ",value or " + first + ",value,u");
  }

  double number(const std::string& key, std::string_view text) const {
    const auto value = number_in(trimmed(text));
    if (!value || !std::isfinite(*value))
      fail(key, "\"" + std::string(text) + "\"", "a finite number");
    return *value;
  }

  void row(const std::string& line) {
    std::vector<std::string_view> fields;
    split_fields(line, ',', fields);
    if (fields.size() != columns_.size())
      fail("row", "\"" + line + "\"", std::to_string(columns_.size()) + " numbers");
    ReferenceSeries::Point point{number(columns_[0], fields[0]), number("value", fields[1]), 0.0};
    if (fields.size() == 3) point.limit = number("u", fields[2]);
    if (point.limit < 0.0) fail("u", std::string(fields[2]), "0 or more");
    if (!series_.points.empty() && point.first <= series_.points.back().first)
      fail(columns_[0], std::string(fields[0]), "a larger one than before");
    series_.points.push_back(point);
  }

  std::optional<std::string> maybe(const std::string& key) {
    const auto entry = header_.find(key);
    asked_.push_back(key);
    if (entry == header_.end()) return std::nullopt;
    std::string value = std::move(entry->second);
    header_.erase(entry);
    return value;
  }
  std::string take(const std::string& key) {
    auto value = maybe(key);
    if (!value) fail("header", "no \"# " + key + ":\"", "one");
    return *value;
  }
  double uncertainty(const std::string& key) {
    const std::string text = take(key);
    const double value = number(key, text);
    if (value < 0.0) fail(key, text, "0 or more");
    return value;
  }

  /// "x 1.61*m, y 0.003*m"
  void read_place(const std::string& text) {
    std::vector<std::string_view> parts;
    split_fields(text, ',', parts);
    for (const std::string_view part : parts) {
      const std::string word(trimmed(part));
      const std::size_t axis = word.empty() ? 3 : std::string("xyz").find(word[0]);
      if (word.size() < 3 || word[1] != ' ' || axis > 2 || series_.at[axis])
        fail("place", "\"" + text + "\"", "such as \"x 0.3*m, y 0.01*m\", each axis once");
      series_.at[axis] = std::string(trimmed(std::string_view(word).substr(1)));
    }
  }

  void read_case() {
    const std::string& name = series_.case_name;
    const bool word = name.find_first_of("/\\") == std::string::npos && name[0] != '.';
    if (!word)
      fail("case", "\"" + name + "\"", "the name of a case file, without folder and .toml");
    const fs::path beside = file_.parent_path();
    for (const fs::path& folder :
         {beside, beside / "../../particle/cases", fs::path("particle/cases")}) {
      const fs::path file = (folder / (name + ".toml")).lexically_normal();
      if (!fs::is_regular_file(file)) continue;
      const TomlTable root = TomlTable::read(file);
      const Case flow = surge::read_case(root);
      check_case(flow, root);
      nlohmann::json stated = to_json(flow);
      stated["method"] = {{"name", ""}, {"preset", ""}};
      Run described;
      apply_case(described, stated, file.string());
      series_.of = described.physics;
      place_of_name(stated);
      return;
    }
    fail("case", "\"" + name + "\"",
         "a case file, " + name + ".toml beside the series or in particle/cases");
  }

  /// Where the case's probe or gauge of the series' name is.
  void place_of_name(const nlohmann::json& stated) {
    if (series_.stated.empty()) return;
    for (const char* list : {"probes", "gauges", "forces"}) {
      for (const nlohmann::json& entry : stated.at(list)) {
        if (entry.at("name") != series_.stated) continue;
        if (!entry.contains("position")) return;
        const Vec3 at = entry.at("position").get<Vec3>();
        for (std::size_t a = 0; a < 3; ++a)
          if (a < 2 || series_.of.dimension == 3) series_.at[a] = number_text(at[a]) + "*m";
        return;
      }
    }
    fail("name", "\"" + series_.stated + "\"", "a probe, gauge or force surface of its case");
  }

  void read_shift() {
    const std::string text = maybe("time_shift").value_or("none");
    if (text == "none") return;
    const std::string start = "fitted within ";
    if (!text.starts_with(start) || series_.is_profile())
      fail("time_shift", "\"" + text + "\"",
           series_.is_profile() ? "none for a profile" : "none or \"fitted within EXPRESSION\"");
    series_.shift_within = text.substr(start.size());
    series_.clock = maybe("clock").value_or("");
  }

  void read_axes() {
    series_.at_time = maybe("at_time");
    const std::string first = series_.is_profile() ? "position" : "time";
    series_.first_unit = take(first + "_unit");
    series_.value_unit = take("value_unit");
    series_.first_zero = maybe(first + "_zero").value_or("0");
    series_.value_zero = maybe("value_zero").value_or("0");
    series_.first_uncertainty = uncertainty(first + "_uncertainty");
    if (columns_.size() == 2) {
      const double limit = uncertainty("value_uncertainty");
      for (ReferenceSeries::Point& point : series_.points) point.limit = limit;
    }
  }

  /// What it says must be understood before a run is there.
  void check_expressions() const {
    const Symbols symbols = case_symbols(series_.of);
    const std::string length = "m", time = "s";
    const std::string& first = series_.is_profile() ? length : time;
    const SiValue unit = evaluate(series_.first_unit, symbols, where("unit"));
    if (!unit.same_dimension(unit_symbols().at(first)) || !(unit.value > 0.0))
      throw Error(where(series_.is_profile() ? "position_unit" : "time_unit") + ": found \"" +
                  series_.first_unit + "\", expected a positive one in " + first);
    static_cast<void>(evaluate(series_.value_unit, symbols, where("value_unit")));
    static_cast<void>(evaluate_in(series_.first_zero, first, symbols, where("zero")));
    if (series_.at_time)
      static_cast<void>(evaluate_in(*series_.at_time, time, symbols, where("at_time")));
    if (series_.shift_within)
      static_cast<void>(evaluate_in(*series_.shift_within, time, symbols, where("time_shift")));
    for (const auto& at : series_.at)
      if (at) static_cast<void>(evaluate_in(*at, length, symbols, where("place")));
  }

  void finish() {
    series_.label = take("label");
    series_.citation = take("citation");
    series_.case_name = take("case");
    series_.observable = take("observable");
    if (std::find(known_.begin(), known_.end(), series_.observable) == known_.end())
      fail("observable", "\"" + series_.observable + "\"", "one of " + comma_list(known_));
    series_.component = maybe("component").value_or("");
    if (series_.component.size() > 1 || std::string("xyz").find(series_.component) > 2)
      fail("component", "\"" + series_.component + "\"", "x, y or z");
    series_.stated = maybe("name").value_or("");
    if (const auto place = maybe("place")) {
      if (!series_.stated.empty()) fail("place", "it beside a name", "one of them");
      read_place(*place);
    }
    series_.axes = take("axes");
    const std::string kind = take("kind");
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    if (found == kinds.end()) fail("kind", kind, "experiment, computation or theory");
    series_.kind = static_cast<ReferenceKind>(found - kinds.begin());
    read_axes();
    read_shift();
    series_.gate = maybe("gate").value_or("none");
    series_.note = maybe("note").value_or("");
    if (!header_.empty()) {
      const std::string near = nearest(header_.begin()->first, asked_);
      fail(header_.begin()->first, "an unknown key",
           near.empty() ? "one that docs/studies.md names" : near);
    }
    read_case();
    check_expressions();
  }

  fs::path file_;
  std::ifstream in_;
  const std::vector<std::string>& known_;
  std::size_t line_ = 0;
  std::map<std::string, std::string> header_;
  std::vector<std::string> columns_, asked_;
  ReferenceSeries series_;
};

}  // namespace

std::string_view kind_text(ReferenceKind kind) {
  return kinds[static_cast<std::size_t>(kind)];
}

bool ReferenceSeries::of_one_size() const {
  for (const std::string* text : {&first_unit, &value_unit})
    for (const char* scale : {"L", "H", "d"})
      if (uses(*text, scale)) return false;
  return true;
}

ReferenceSeries read_reference(const fs::path& file, const std::vector<std::string>& known) {
  return ReferenceParser(file, known).parse();
}

}  // namespace surge::compare
