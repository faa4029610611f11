#include "compare/read/legacy_vtk.hpp"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeTraits.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "compare/read/delimited.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

/// A value in a binary file: its bytes, the largest first.
using Decode = double (*)(const char*);
template <class T>
double decode(const char* bytes) {
  std::array<char, sizeof(T)> value{};
  std::memcpy(value.data(), bytes, sizeof(T));
  if constexpr (std::endian::native == std::endian::little)
    std::reverse(value.begin(), value.end());
  return static_cast<double>(std::bit_cast<T>(value));
}

struct LegacyType {
  std::size_t bytes;
  Decode decode;
  int vtk;  ///< type of the array that keeps it
};
template <class T>
LegacyType value_type() {
  return {sizeof(T), decode<T>, vtkTypeTraits<T>::VTKTypeID()};
}

/// VTK's own reader does not mind the case of keywords and types.
std::string cased(std::string word, int (*to)(int)) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [to](unsigned char c) { return static_cast<char>(to(c)); });
  return word;
}

const LegacyType* type_of(const std::string& name) {
  static const std::map<std::string, LegacyType> types{
      {"char", value_type<std::int8_t>()},
      {"unsigned_char", value_type<std::uint8_t>()},
      {"short", value_type<std::int16_t>()},
      {"unsigned_short", value_type<std::uint16_t>()},
      {"int", value_type<std::int32_t>()},
      {"unsigned_int", value_type<std::uint32_t>()},
      {"float", value_type<float>()},
      {"long", value_type<std::int64_t>()},
      {"unsigned_long", value_type<std::uint64_t>()},
      {"double", value_type<double>()},
      {"vtkidtype", value_type<std::int32_t>()},
      {"vtktypeint64", value_type<std::int64_t>()},
      {"vtktypeuint64", value_type<std::uint64_t>()}};
  const auto found = types.find(cased(name, std::tolower));
  return found == types.end() ? nullptr : &found->second;
}

using Words = std::vector<std::string>;
using Values = vtkSmartPointer<vtkDataArray>;

/// Goes through a file from header to header.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file)
      : file_(file),
        text_(bytes_between(file, 0, 0)),
        points_(vtkSmartPointer<vtkPolyData>::New()) {}

  vtkSmartPointer<vtkPolyData> read() {
    if (!text_.starts_with("# vtk DataFile Version"))
      fail("not a legacy VTK file, \"# vtk DataFile Version\" expected");
    (void)line();
    (void)line();
    const Words format = words();
    const std::string kind = format.empty() ? "" : cased(format[0], std::toupper);
    if (kind != "BINARY" && kind != "ASCII")
      fail("neither BINARY nor ASCII found in its third line");
    binary_ = kind == "BINARY";
    while (at_ < text_.size()) section(header_line());
    if (count_ == 0) fail("no points found, particles expected");
    return points_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(file_.string() + ": " + what);
  }

  std::string_view line() {
    const std::size_t end = text_.find('\n', at_);
    const std::string_view found = std::string_view(text_).substr(
        at_, end == std::string::npos ? std::string::npos : end - at_);
    at_ = end == std::string::npos ? text_.size() : end + 1;
    return found;
  }

  Words words() {
    std::vector<std::string_view> fields;
    split_fields(line(), ' ', fields);
    return {fields.begin(), fields.end()};
  }

  /// The line that a section begins with.
  Words header_line() {
    Words found = words();
    if (!found.empty()) found[0] = cased(found[0], std::toupper);
    return found;
  }

  std::size_t count(const Words& header, std::size_t i) const {
    std::size_t value = 0;
    const std::string word = i < header.size() ? header[i] : "";
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failed != std::errc() || end != word.data() + word.size() || value > most)
      fail(header[0] + ": found \"" + word + "\", expected a count");
    return value;
  }

  /// The values that a section announces; an end of the file among them is the fault that is
  /// looked for.
  Values values(const std::string& section, std::size_t tuples, std::size_t components,
                const std::string& type) {
    const LegacyType* kind = type_of(type);
    if (kind == nullptr) fail(section + ": values of type \"" + type + "\" are not known");
    const std::size_t number = tuples * components;
    const std::size_t least = binary_ ? kind->bytes : 2;
    if (components == 0 || components > most / std::max<std::size_t>(tuples, 1) ||
        (text_.size() - at_ + 1) / least < number)
      cut_short(section, number);
    auto array = Values::Take(vtkDataArray::CreateDataArray(kind->vtk));
    array->SetNumberOfComponents(static_cast<int>(components));
    array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
    for (std::size_t k = 0; k < number; ++k) {
      double value = 0.0;
      if (binary_) {
        value = kind->decode(text_.data() + at_);
        at_ += kind->bytes;
      } else {
        value = next_number(section, number);
      }
      array->SetComponent(static_cast<vtkIdType>(k / components), static_cast<int>(k % components),
                          value);
    }
    return array;
  }

  [[noreturn]] void cut_short(const std::string& section, std::size_t number) const {
    fail("cut short: " + section + " announces " + std::to_string(number) +
         " values, the file ends before the last of them");
  }

  double next_number(const std::string& section, std::size_t number) {
    const std::size_t begin = text_.find_first_not_of(" \t\r\n", at_);
    if (begin == std::string::npos) cut_short(section, number);
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n", begin), text_.size());
    at_ = end;
    const std::string_view word = std::string_view(text_).substr(begin, end - begin);
    const auto value = number_in(word);
    if (!value) fail(section + ": found \"" + std::string(word) + "\", expected a number");
    return *value;
  }

  void section(const Words& header) {
    if (header.empty()) return;
    const std::string& name = header[0];
    if (name == "DATASET") {
      const std::string kind = header.size() < 2 ? "" : cased(header[1], std::toupper);
      if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID")
        fail("a file of particles (DATASET POLYDATA or UNSTRUCTURED_GRID) expected");
    } else if (name == "METADATA") {
      skip_metadata();
    } else if (name == "POINT_DATA") {
      data_ = points_->GetPointData();
      tuples_ = count(header, 1);
      if (tuples_ != count_)
        fail("POINT_DATA: " + std::to_string(tuples_) + " found, " + std::to_string(count_) +
             " points expected");
    } else if (name == "CELL_DATA") {
      data_ = nullptr;
      tuples_ = count(header, 1);
    } else if (name == "FIELD") {
      fields(count(header, 2));
    } else if (header.size() > 2 && name == "POINTS") {
      if (count_ > 0) fail("POINTS a second time");
      count_ = count(header, 1);
      vtkNew<vtkPoints> points;
      points->SetData(values(name, count_, 3, header[2]));
      points_->SetPoints(points);
    } else if (!cells(header) && !attribute(header)) {
      fail("\"" + printable(name) + "\" found, a section of the legacy VTK format expected");
    }
  }

  /// Up to a blank line.
  void skip_metadata() {
    while (at_ < text_.size() && !words().empty()) {
    }
  }

  static std::string printable(const std::string& word) {
    std::string text = word.substr(0, 30);
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
    return text;
  }

  /// Cells of particles say nothing; those of a mesh are refused.
  bool cells(const Words& header) {
    const std::string& name = header[0];
    if (name == "CELL_TYPES") {
      const Values types = values(name, count(header, 1), 1, "int");
      for (vtkIdType i = 0; i < types->GetNumberOfTuples(); ++i)
        if (types->GetComponent(i, 0) > 2.0) mesh(types->GetNumberOfTuples());
      return true;
    }
    if (name == "OFFSETS" || name == "CONNECTIVITY") {
      if (header.size() < 2) return false;
      (void)values(name, sizes_[name == "OFFSETS" ? 0 : 1], 1, header[1]);
      return true;
    }
    const bool surface = name == "POLYGONS" || name == "TRIANGLE_STRIPS";
    if (!surface && name != "VERTICES" && name != "LINES" && name != "CELLS") return false;
    const std::size_t number = count(header, 1);
    if (surface && number > 0) mesh(static_cast<long long>(number));
    // From version 5 on the two counts are those of OFFSETS and CONNECTIVITY, which follow.
    const std::size_t before = at_;
    const Words next = header_line();
    at_ = before;
    if (!next.empty() && next[0] == "OFFSETS") {
      sizes_ = {number, count(header, 2)};
    } else {
      (void)values(name, count(header, 2), 1, "int");
    }
    return true;
  }

  [[noreturn]] void mesh(long long number) const {
    fail(std::to_string(number) +
         " cells with an extent found, a file of particles (points, vertices) expected");
  }

  bool attribute(const Words& header) {
    const std::string& name = header[0];
    if (name == "LOOKUP_TABLE" && header.size() > 2) {
      (void)values(name, count(header, 2), 4, binary_ ? "unsigned_char" : "float");
      return true;
    }
    if (header.size() < 3) return false;
    std::size_t components = 0;
    std::string type = header[2];
    if (name == "VECTORS" || name == "NORMALS") components = 3;
    if (name == "TENSORS") components = 9;
    if (name == "TENSORS6") components = 6;
    if (name == "TEXTURE_COORDINATES" && header.size() > 3) {
      components = count(header, 2);
      type = header[3];
    }
    if (name == "COLOR_SCALARS") {
      components = count(header, 2);
      type = binary_ ? "unsigned_char" : "float";
    }
    if (name == "SCALARS") {
      components = header.size() > 3 ? count(header, 3) : 1;
      const std::size_t before = at_;
      const Words table = header_line();
      if (table.empty() || table[0] != "LOOKUP_TABLE") at_ = before;
    }
    if (components == 0) return false;
    add(header[1], values(name + " " + header[1], tuples_, components, type));
    return true;
  }

  void fields(std::size_t number) {
    while (number > 0) {
      if (at_ >= text_.size())
        fail("cut short: " + std::to_string(number) + " arrays of a FIELD are missing");
      const Words header = words();
      if (header.empty()) continue;
      if (cased(header[0], std::toupper) == "METADATA") {
        skip_metadata();
        continue;
      }
      if (header.size() < 4) fail("an array of a FIELD (name, components, values, type) expected");
      const std::size_t tuples = count(header, 2);
      if (data_ == points_->GetPointData() && tuples != count_)
        fail("array " + header[0] + ": " + std::to_string(tuples) + " values found, " +
             std::to_string(count_) + " expected");
      add(header[0], values("array " + header[0], tuples, count(header, 1), header[3]));
      --number;
    }
  }

  /// "Particle%20Type", as VTK writes a name with a blank.
  void add(const std::string& written, const Values& array) {
    const std::string name = without_percent(written);
    array->SetName(name.c_str());
    if (data_ == nullptr) return;
    if (data_->HasArray(name.c_str()) != 0) fail("array " + name + ": a second one of this name");
    data_->AddArray(array);
  }

  static constexpr std::size_t most = 1UL << 40;  ///< values; more are no count

  std::filesystem::path file_;
  std::string text_;
  vtkSmartPointer<vtkPolyData> points_;
  vtkFieldData* data_ = points_->GetFieldData();  ///< what arrays belong to; none for cells
  std::size_t at_ = 0;
  bool binary_ = false;
  std::size_t count_ = 0;   ///< points
  std::size_t tuples_ = 0;  ///< of what arrays belong to
  std::array<std::size_t, 2> sizes_{};
};

}  // namespace

vtkSmartPointer<vtkPolyData> read_legacy_vtk(const std::filesystem::path& file) {
  return Reader(file).read();
}

void check_legacy_vtk(const std::filesystem::path& file) {
  (void)Reader(file).read();
}

}  // namespace surge::compare
