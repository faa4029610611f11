#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "compare/read/delimited.hpp"
#include "compare/read/particle_table.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// A text dump of LAMMPS (doc/dump.html): sections `ITEM: NAME`, several times in a file.
class Dump {
 public:
  Dump(const fs::path& file, const FilePart& part)
      : file_(file),
        lines_(file, part.begin, part.end),
        line_(part.line == 0 ? 0 : part.line - 1) {}

  /// Reads up to the rows of the next time; false at the end of the file.
  bool head() {
    part_ = {};
    bool started = false;
    while (true) {
      const std::uintmax_t begin = lines_.at();
      if (!next()) {
        if (started) fail("the file ends before the atoms of its last time: cut short");
        return false;
      }
      if (!started) {
        if (trimmed(text_).empty()) continue;
        part_.begin = begin;
        part_.line = line_;
        started = true;
      }
      if (!text_.starts_with("ITEM:")) fail("\"ITEM:\" expected");
      std::vector<std::string_view> words;
      const std::string header(text_);
      split_fields(std::string_view(header).substr(5), ' ', words);
      if (words.empty()) fail("\"ITEM: NAME\" expected");
      if (words[0] == "ATOMS") {
        columns_.assign(words.begin() + 1, words.end());
        if (columns_.empty()) fail("names of columns expected");
        return true;
      }
      section(words);
    }
  }

  /// Steps over a row and keeps its numbers.
  const std::vector<std::string_view>& row() {
    if (!next()) fail("the file ends before the last of " + std::to_string(part_.count) + " atoms");
    split_fields(text_, ' ', fields_);
    if (fields_.size() != columns_.size())
      fail(std::to_string(fields_.size()) + " fields found, " + std::to_string(columns_.size()) +
           " expected");
    return fields_;
  }

  double number(std::string_view word) const {
    const auto value = number_in(word);
    if (!value) fail("found \"" + std::string(word) + "\", expected a number");
    return *value;
  }

  [[nodiscard]] FilePart part() const {
    FilePart part = part_;
    part.end = lines_.at();
    return part;
  }
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  /// Of the axis, lower and upper.
  [[nodiscard]] const std::array<double, 2>& bounds(std::size_t axis) const { return box_[axis]; }
  [[nodiscard]] bool has_box() const { return has_box_; }
  [[nodiscard]] bool tilted() const { return tilted_; }
  [[nodiscard]] bool periodic() const { return periodic_; }
  [[nodiscard]] bool open_end() const { return lines_.open_end(); }
  [[nodiscard]] const std::string& units() const { return units_; }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(file_.string() + ":" + std::to_string(line_) + ": " + what);
  }

 private:
  bool next() {
    if (!lines_.next(text_)) return false;
    ++line_;
    return true;
  }
  std::string_view value() {
    if (!next()) fail("the file ends in its head: cut short");
    return trimmed(text_);
  }

  void section(const std::vector<std::string_view>& words) {
    if (words[0] == "TIMESTEP") {
      part_.step = static_cast<long long>(whole(value()));
    } else if (words[0] == "TIME") {
      part_.time = number(value());
    } else if (words[0] == "UNITS") {
      units_ = std::string(value());
    } else if (words[0] == "NUMBER") {
      part_.count = static_cast<std::size_t>(whole(value()));
    } else if (words[0] == "BOX") {
      box(words);
    } else {
      fail("\"ITEM: " + std::string(words[0]) + "\" found, an atom dump in text expected");
    }
  }

  /// `BOX BOUNDS ff ff pp`, or `BOX BOUNDS xy xz yz ff ff pp` with a tilt behind each axis' ends.
  void box(const std::vector<std::string_view>& words) {
    const bool may_tilt = std::find(words.begin(), words.end(), "xy") != words.end();
    tilted_ = false;
    for (std::array<double, 2>& axis : box_) {
      std::vector<std::string_view> ends;
      split_fields(value(), ' ', ends);
      if (ends.size() != (may_tilt ? 3U : 2U))
        fail(may_tilt ? "two ends of the box and a tilt expected" : "two ends of the box expected");
      axis = {number(ends[0]), number(ends[1])};
      if (may_tilt && number(ends[2]) != 0.0) tilted_ = true;
    }
    has_box_ = true;
    const std::size_t first = may_tilt ? 5 : 2;
    periodic_ = words.size() > first && words[first] == "pp";
  }

  double whole(std::string_view word) const {
    const double found = number(word);
    if (!(found >= 0.0) || found != std::round(found) || found > 1e15)
      fail("found \"" + std::string(word) + "\", expected a whole number");
    return found;
  }

  fs::path file_;
  FileLines lines_;
  std::string_view text_;
  std::size_t line_ = 0;
  FilePart part_;
  std::string units_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> fields_;
  std::array<std::array<double, 2>, 3> box_{};
  bool has_box_ = false;
  bool tilted_ = false;
  bool periodic_ = false;  ///< along x
};

/// Scaled coordinates (xs, xsu) of the box as metres.
void unscale(ParticleTable& table, const Dump& dump) {
  for (ParticleArray& array : table.arrays) {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::string axis(1, "xyz"[a]);
      if (array.name != axis + "s" && array.name != axis + "su") continue;
      if (!dump.has_box()) dump.fail("scaled coordinates " + array.name + " without BOX BOUNDS");
      if (dump.tilted()) dump.fail("scaled coordinates " + array.name + " of a tilted box");
      const auto [lower, upper] = dump.bounds(a);
      for (double& x : array.values) x = lower + x * (upper - lower);
    }
  }
}

}  // namespace

std::vector<FilePart> lammps_parts(const fs::path& file) {
  std::vector<FilePart> parts;
  Dump dump(file, {});
  while (dump.head()) {
    for (std::size_t i = 0; i < dump.part().count; ++i) (void)dump.row();
    if (!dump.part().step) dump.fail("no TIMESTEP found before the atoms");
    if (!parts.empty() && *dump.part().step <= *parts.back().step)
      dump.fail("time step " + std::to_string(*dump.part().step) + " after " +
                std::to_string(*parts.back().step) +
                ": increasing ones expected (are two runs in one file?)");
    parts.push_back(dump.part());
  }
  if (parts.empty()) throw Error(file.string() + ": no time found, a LAMMPS dump expected");
  return parts;
}

ParticleTable read_lammps(const fs::path& file, const FilePart& part, const ArrayNames& wanted) {
  Dump dump(file, part);
  if (!dump.head()) throw Error(file.string() + ": no time found, a LAMMPS dump expected");
  ParticleTable table;
  table.count = dump.part().count;
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < dump.columns().size(); ++i) {
    const std::string& name = dump.columns()[i];
    if (wanted && std::find(wanted->begin(), wanted->end(), name) == wanted->end()) continue;
    columns.push_back(i);
    table.arrays.push_back({name, 1, "number", {}});
  }
  for (std::size_t i = 0; i < table.count; ++i) {
    const std::vector<std::string_view>& fields = dump.row();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      ParticleArray& array = table.arrays[k];
      const std::string_view field = fields[columns[k]];
      // A column of names (element).
      const bool word =
          !number_in(field) && std::isalpha(static_cast<unsigned char>(field[0])) != 0;
      if (i == 0 ? word : array.is_text()) {
        array.add_word(std::string(field));
      } else {
        array.values.push_back(dump.number(field));
      }
    }
  }
  unscale(table, dump);
  if (!dump.units().empty() && dump.units() != "si")
    table.notes.push_back("units \"" + dump.units() +
                          "\" are stated in the dump: lengths are taken "
                          "as the options say (--length-unit, --time-unit)");
  const auto has = [&](const char* name) {
    return std::find(dump.columns().begin(), dump.columns().end(), name) != dump.columns().end();
  };
  if (dump.periodic() && !has("xu") && !has("xsu"))
    table.notes.emplace_back(
        "the box is periodic along x: particles that leave it are back at its other end (dump xu)");
  if (dump.open_end()) table.notes.push_back("the last line has no end: is the file cut short?");
  return table;
}

}  // namespace surge::compare
