#include "particle/case/stl_file.hpp"

#include <charconv>
#include <cstring>
#include <map>
#include <sstream>

#include "particle/case/vectors.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/regular_file.hpp"

namespace surge {

namespace {

constexpr std::size_t head = 80;  ///< bytes of a binary file before the number of triangles
constexpr std::size_t bytes_a_facet = 50;  ///< 12 numbers of 4 bytes, 2 bytes of attributes
/// An ascii file takes some 300 bytes a triangle.
constexpr std::uintmax_t most_bytes = ClosedSurface::most_triangles * std::uintmax_t{1000};

struct StlFacet {
  Point normal{};
  std::array<Point, 3> corner{};
};

[[noreturn]] void refuse_stl(const std::string& place, const std::string& found,
                             const std::string& expected) {
  throw Error(place + ": found " + found + ", expected " + expected);
}

/// The number that a float's shortest text says, as an ascii file would have it.
double read_float(const char* bytes) {
  float value = 0.0F;
  std::memcpy(&value, bytes, sizeof value);
  if (!std::isfinite(value)) return static_cast<double>(value);
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double number = 0.0;
  std::from_chars(text.data(), end, number);
  return number;
}

std::vector<StlFacet> read_binary(const std::string& bytes, std::size_t count) {
  std::vector<StlFacet> facets(count);
  for (std::size_t f = 0; f < count; ++f) {
    const char* at = bytes.data() + head + 4 + f * bytes_a_facet;
    const auto next = [&] {
      Point x{};
      for (double& entry : x) {
        entry = read_float(at);
        at += 4;
      }
      return x;
    };
    facets[f].normal = next();
    for (Point& corner : facets[f].corner) corner = next();
  }
  return facets;
}

/// Words of an ascii file with the lines that they are on.
class StlWords {
 public:
  StlWords(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {}

  [[nodiscard]] std::string place() const { return file_ + ":" + std::to_string(line_); }
  /// Goes past the rest of a line.
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  /// The next word in small letters; empty at the end.
  std::string word() {
    while (at_ < text_.size() && is_space(text_[at_]))
      if (text_[at_++] == '\n') ++line_;
    std::string found;
    while (at_ < text_.size() && !is_space(text_[at_])) found += lower(text_[at_++]);
    return found;
  }
  void expect(const char* wanted) {
    if (const std::string found = word(); found != wanted)
      refuse_stl(place(), shown(found), '"' + std::string(wanted) + '"');
  }
  Point point() {
    Point x{};
    for (double& entry : x) {
      const std::string found = word();
      const char* begin = found.data() + (found.starts_with('+') ? 1 : 0);
      const char* end = found.data() + found.size();
      const auto result = std::from_chars(begin, end, entry);
      if (result.ec != std::errc{} || result.ptr != end)
        refuse_stl(place(), shown(found), "a number");
    }
    return x;
  }
  static std::string shown(const std::string& word) {
    if (word.empty()) return "the end of the file";
    std::string text = word.substr(0, 40);
    for (char& c : text)
      if (c < 32 || c == 127) c = '?';
    return '"' + text + '"';
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  static char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
  const std::string& text_;
  std::string file_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

std::vector<StlFacet> read_ascii(const std::string& text, const std::string& file) {
  StlWords words(text, file);
  std::vector<StlFacet> facets;
  words.expect("solid");
  words.skip_line();
  while (true) {
    const std::string word = words.word();
    if (word == "endsolid") {
      words.skip_line();
      const std::string next = words.word();
      if (next.empty()) return facets;
      if (next != "solid") refuse_stl(words.place(), StlWords::shown(next), "\"solid\" or the end");
      words.skip_line();  // of another part of the same body
      continue;
    }
    if (word != "facet")
      refuse_stl(words.place(), StlWords::shown(word), "\"facet\" or \"endsolid\"");
    if (facets.size() == ClosedSurface::most_triangles)
      refuse_stl(words.place(), "more triangles",
                 "at most " + std::to_string(ClosedSurface::most_triangles));
    StlFacet facet;
    words.expect("normal");
    facet.normal = words.point();
    words.expect("outer");
    words.expect("loop");
    for (Point& corner : facet.corner) {
      words.expect("vertex");
      corner = words.point();
    }
    words.expect("endloop");
    words.expect("endfacet");
    facets.push_back(facet);
  }
}

/// A binary file is as long as its number of triangles says; its first word may be "solid", too.
std::vector<StlFacet> read_facets(const std::string& bytes, const std::string& file) {
  if (bytes.size() >= head + 4) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + head, sizeof count);
    if (bytes.size() == head + 4 + std::uint64_t{count} * bytes_a_facet)
      return read_binary(bytes, count);
  }
  if (!bytes.starts_with("solid"))
    refuse_stl(file, "neither \"solid\" nor the length of a binary file",
               "an STL file, ascii or binary");
  return read_ascii(bytes, file);
}

bool is_finite_point(const Point& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

void check_stl_facet(const StlFacet& facet, const std::string& place) {
  for (const Point& corner : facet.corner)
    if (!is_finite_point(corner))
      refuse_stl(place, "a number that is not finite", "finite numbers");
  const Point made =
      unit(cross(minus(facet.corner[1], facet.corner[0]), minus(facet.corner[2], facet.corner[0])));
  // Zero and what is not finite say nothing about a normal, as some programs write them.
  if (is_finite_point(facet.normal) && dot(unit(facet.normal), made) < -0.5)
    refuse_stl(place, "a normal against the order of the corners",
               "corners that run against the clock as seen from outside");
}

}  // namespace

ClosedSurface read_stl(const std::filesystem::path& file, double scale) {
  const std::string name = file.string();
  const std::string bytes = read_regular(file, most_bytes, "an STL file");
  const std::vector<StlFacet> found = read_facets(bytes, name);
  std::map<Point, std::uint32_t> numbers;
  std::vector<Point> vertices;
  std::vector<ClosedSurface::Facet> facets;
  for (std::size_t f = 0; f < found.size(); ++f) {
    check_stl_facet(found[f], name + ": triangle " + std::to_string(f + 1));
    ClosedSurface::Facet facet{};
    for (std::size_t k = 0; k < 3; ++k) {
      Point x = found[f].corner[k];
      for (double& entry : x) entry = entry * scale + 0.0;  // one zero, without a sign
      const auto [at, is_new] = numbers.try_emplace(x, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.push_back(x);
      facet[k] = at->second;
    }
    // With two corners in one place a triangle is a line, and its neighbours meet there.
    if (facet[0] != facet[1] && facet[1] != facet[2] && facet[2] != facet[0])
      facets.push_back(facet);
  }
  try {
    return ClosedSurface::triangles(std::move(vertices), std::move(facets));
  } catch (const Error& error) {
    throw Error(name + ": " + error.what());
  }
}

}  // namespace surge
