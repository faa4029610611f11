#include "compare/read/legacy_vtk.hpp"

#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

/// Bytes of a value in a binary file; empty for a type that the format does not have.
std::optional<std::size_t> size_of(const std::string& type) {
  static const std::map<std::string, std::size_t> sizes{
      {"char", 1},          {"unsigned_char", 1}, {"short", 2},     {"unsigned_short", 2},
      {"int", 4},           {"unsigned_int", 4},  {"float", 4},     {"long", 8},
      {"unsigned_long", 8}, {"double", 8},        {"vtkidtype", 4}, {"vtktypeint64", 8},
      {"vtktypeuint64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? std::nullopt : std::optional(found->second);
}

using Words = std::vector<std::string>;

/// Goes through a file from header to header.
class Scanner {
 public:
  explicit Scanner(const std::filesystem::path& file) : file_(file) {
    std::ifstream in(file, std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(in), {});
    if (!in.good() && !in.eof()) throw Error(file.string() + ": cannot be read");
  }

  void check() {
    if (!text_.starts_with("# vtk DataFile Version"))
      throw Error(file_.string() + ": not a legacy VTK file, \"# vtk DataFile Version\" expected");
    (void)line();
    (void)line();
    const Words format = words(line());
    if (format.empty() || (format[0] != "BINARY" && format[0] != "ASCII"))
      throw Error(file_.string() + ": neither BINARY nor ASCII found in its third line");
    binary_ = format[0] == "BINARY";
    while (at_ < text_.size() && section(words(line()))) {
    }
  }

 private:
  std::string line() {
    const std::size_t end = text_.find('\n', at_);
    std::string found = text_.substr(at_, end == std::string::npos ? end : end - at_);
    at_ = end == std::string::npos ? text_.size() : end + 1;
    return found;
  }

  static Words words(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
  }

  std::size_t count(const Words& header, std::size_t i) const {
    std::size_t value = 0;
    const std::string word = i < header.size() ? header[i] : "";
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failed != std::errc() || end != word.data() + word.size() || value > most)
      throw Error(file_.string() + ": " + header[0] + ": found \"" + word + "\", expected a count");
    return value;
  }

  /// Steps over values; an end of the file among them is the fault that is looked for.
  void skip(const std::string& section, std::size_t values, std::size_t bytes) {
    bool whole = true;
    if (binary_) {
      whole = text_.size() - at_ >= values * bytes;
      if (whole) at_ += values * bytes;
    } else {
      for (std::size_t k = 0; whole && k < values; ++k) whole = skip_word();
    }
    if (!whole)
      throw Error(file_.string() + ": cut short: " + section + " announces " +
                  std::to_string(values) + " values, the file ends before the last of them");
  }

  bool skip_word() {
    const std::size_t begin = text_.find_first_not_of(" \t\r\n", at_);
    if (begin == std::string::npos) return false;
    const std::size_t end = text_.find_first_of(" \t\r\n", begin);
    at_ = end == std::string::npos ? text_.size() : end;
    return true;
  }

  /// False where the rest is not understood.
  bool section(const Words& header) {
    if (header.empty()) return true;
    const std::string& name = header[0];
    if (name == "DATASET") return true;
    if (name == "METADATA") return metadata();
    if (name == "POINT_DATA" || name == "CELL_DATA") {
      tuples_ = count(header, 1);
      return true;
    }
    if (name == "FIELD") {
      fields_left_ = count(header, 2);
      return fields();
    }
    if (name == "CELL_TYPES") return values(name, count(header, 1), "int");
    if (name == "OFFSETS" || name == "CONNECTIVITY")
      return header.size() > 1 && values(name, cells_[name == "OFFSETS" ? 0 : 1], header[1]);
    for (const char* cells : {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS", "CELLS"})
      if (name == cells) return cell_section(header);
    if (header.size() < 3) return name == "LOOKUP_TABLE";
    if (name == "POINTS") return values(name, 3 * count(header, 1), header[2]);
    if (name == "SCALARS") return scalars(header, header.size() > 3 ? count(header, 3) : 1);
    for (const char* vector : {"VECTORS", "NORMALS"})
      if (name == vector) return values(name + " " + header[1], 3 * tuples_, header[2]);
    if (name == "LOOKUP_TABLE") return values(name, 4 * count(header, 2), "unsigned_char");
    return false;
  }

  bool values(const std::string& section, std::size_t number, const std::string& type) {
    const auto bytes = size_of(type);
    if (!bytes) return false;
    skip(section, number, *bytes);
    return true;
  }

  bool scalars(const Words& header, std::size_t components) {
    const std::size_t before = at_;
    const Words table = words(line());
    if (table.empty() || table[0] != "LOOKUP_TABLE") at_ = before;
    return values("SCALARS " + header[1], components * tuples_, header[2]);
  }

  bool cell_section(const Words& header) {
    // From version 5 on the two counts are those of OFFSETS and CONNECTIVITY, which follow.
    const std::size_t before = at_;
    const Words next = words(line());
    at_ = before;
    if (!next.empty() && next[0] == "OFFSETS") {
      cells_ = {count(header, 1), count(header, 2)};
      return true;
    }
    return values(header[0], count(header, 2), "int");
  }

  bool fields() {
    while (fields_left_ > 0) {
      if (at_ >= text_.size())
        throw Error(file_.string() + ": cut short: " + std::to_string(fields_left_) +
                    " arrays of a FIELD are missing");
      const Words header = words(line());
      if (header.empty()) continue;
      if (header[0] == "METADATA") {
        if (!metadata()) return false;
        continue;
      }
      if (header.size() < 4) return false;
      if (!values("array " + header[0], count(header, 1) * count(header, 2), header[3]))
        return false;
      --fields_left_;
    }
    return true;
  }

  /// Up to the next blank line.
  bool metadata() {
    while (at_ < text_.size())
      if (words(line()).empty()) return true;
    return true;
  }

  static constexpr std::size_t most = 1UL << 40;  ///< values; more are no count

  std::filesystem::path file_;
  std::string text_;
  std::size_t at_ = 0;
  bool binary_ = false;
  std::size_t tuples_ = 0;
  std::size_t fields_left_ = 0;
  std::array<std::size_t, 2> cells_{};
};

}  // namespace

void check_legacy_vtk(const std::filesystem::path& file) {
  Scanner(file).check();
}

}  // namespace surge::compare
