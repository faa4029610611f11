#include "compare/read/xml_vtk.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "compare/read/delimited.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view blanks = " \t\r\n";

/// A tag with its attributes, as far as they are asked for.
class Tag {
 public:
  explicit Tag(std::string_view text) : text_(text) {}

  [[nodiscard]] std::string_view name() const {
    return text_.substr(0, std::min(text_.find_first_of(blanks), text_.size()));
  }
  [[nodiscard]] std::optional<std::string_view> attribute(std::string_view key) const {
    for (auto at = text_.find(key); at != std::string_view::npos; at = text_.find(key, at + 1)) {
      const bool starts = at > 0 && blanks.find(text_[at - 1]) != std::string_view::npos;
      const auto sign = text_.find_first_not_of(blanks, at + key.size());
      if (!starts || sign == std::string_view::npos || text_[sign] != '=') continue;
      const auto quote = text_.find_first_not_of(blanks, sign + 1);
      if (quote == std::string_view::npos || (text_[quote] != '"' && text_[quote] != '\''))
        return std::nullopt;
      const auto end = text_.find(text_[quote], quote + 1);
      if (end == std::string_view::npos) return std::nullopt;
      return trimmed(text_.substr(quote + 1, end - quote - 1));
    }
    return std::nullopt;
  }
  [[nodiscard]] bool closed() const { return text_.ends_with('/'); }

 private:
  std::string_view text_;
};

std::size_t words_in(std::string_view text) {
  std::size_t count = 0;
  for (auto at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
    ++count;
    const auto end = text.find_first_of(blanks, at);
    at = end == std::string_view::npos ? end : text.find_first_not_of(blanks, end);
  }
  return count;
}

class Checker {
 public:
  explicit Checker(const fs::path& file)
      : file_(file),
        text_(bytes_between(file, 0, 0)),
        // Compressed values take a thousandth of their size at least.
        most_(1000.0 * static_cast<double>(text_.size())) {
    text_.resize(std::min(text_.find("<AppendedData"), text_.size()));
  }

  void check() {
    for (auto at = text_.find('<'); at != std::string::npos; at = text_.find('<', at)) {
      const auto end = text_.find('>', at);
      if (end == std::string::npos) return;
      const Tag tag(std::string_view(text_).substr(at + 1, end - at - 1));
      at = end + 1;
      check_counts(tag);
      const std::string_view name = tag.name();
      if (name == "DataArray" || name == "Array") check_type(tag);
      if (name == "Piece") points_ = number(tag, "NumberOfPoints");
      if (name == "Points" || name == "PointData") of_points_ = true;
      if (name == "/Points" || name == "/PointData") of_points_ = false;
      if (name == "DataArray" && !tag.closed()) check_ascii(tag, at);
    }
  }

 private:
  std::optional<double> number(const Tag& tag, std::string_view key) const {
    const auto word = tag.attribute(key);
    return word ? number_in(*word) : std::nullopt;
  }

  void check_counts(const Tag& tag) const {
    for (const std::string key :
         {"NumberOfPoints", "NumberOfCells", "NumberOfVerts", "NumberOfLines", "NumberOfStrips",
          "NumberOfPolys", "NumberOfTuples", "NumberOfComponents"}) {
      const auto word = tag.attribute(key);
      if (!word) continue;
      const auto count = number_in(*word);
      if (!count || !(*count >= 0.0) || *count > (key == "NumberOfComponents" ? 100.0 : most_))
        throw Error(file_.string() + ": " + key + ": found \"" + std::string(word->substr(0, 40)) +
                    "\", expected a count that the file can hold");
    }
  }

  /// An array of a type that it does not know is none, and VTK's reader ends the program on it.
  void check_type(const Tag& tag) const {
    static const std::set<std::string_view> known{
        "Int8",   "UInt8",   "Int16",   "UInt16", "Int32", "UInt32", "Int64",
        "UInt64", "Float32", "Float64", "String", "Bit",   "IdType", "vtkIdType"};
    const auto type = tag.attribute("type");
    if (type && known.contains(*type)) return;
    throw Error(file_.string() + ": DataArray: type: found \"" +
                std::string(type.value_or("").substr(0, 40)) + "\", expected one such as Float32");
  }

  void check_ascii(const Tag& tag, std::size_t at) const {
    const auto format = tag.attribute("format");
    if (!of_points_ || !points_ || !format || *format != "ascii") return;
    const double components = number(tag, "NumberOfComponents").value_or(1.0);
    const std::size_t end = std::min(text_.find('<', at), text_.size());
    const std::size_t found = words_in(std::string_view(text_).substr(at, end - at));
    if (static_cast<double>(found) == components * *points_) return;
    throw Error(file_.string() + ": DataArray " + std::string(tag.attribute("Name").value_or("")) +
                ": " + std::to_string(found) + " values found, " +
                std::to_string(static_cast<long long>(components * *points_)) + " expected");
  }

  fs::path file_;
  std::string text_;
  double most_;
  std::optional<double> points_;  ///< of the present piece
  bool of_points_ = false;
};

}  // namespace

void check_xml_vtk(const fs::path& file) {
  Checker(file).check();
}

}  // namespace surge::compare
