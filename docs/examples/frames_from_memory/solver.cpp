// A "solver" that hands its frames to SurgeFront from memory: no files in between. What it computes
// is a column of particles that is sheared along the floor; put your own time loop in its place.
//
// Usage: solver BASELINE.json [bless]
#include <cstdio>
#include <exception>
#include <string>
#include <surgefront/surgefront.hpp>
#include <vector>

namespace {

constexpr double spacing = 0.01;   // m
constexpr double interval = 0.02;  // s

/// x, y, z of each particle: the tops of the columns flow to the front, two by two.
std::vector<double> positions(int frame) {
  std::vector<double> x;
  for (int row = 0; row < 20; ++row)
    for (int k = 0; k < 10; ++k) {
      const int from_top = 199 - (10 * row + k);
      const bool moved = from_top < 2 * frame;
      x.push_back(moved ? 0.1 + spacing * (from_top / 2 + 0.5) : spacing * (k + 0.5));
      x.push_back(spacing * ((moved ? from_top % 2 : row) + 0.5));
      x.push_back(0.0);
    }
  return x;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 1;
  try {
    surgefront::Frames frames({.name = "my solver",
                               .spacing = spacing,
                               .gravity = 9.81,
                               .tank_width = 0.4,
                               .strip_height = 0.03});
    for (int frame = 0; frame < 6; ++frame) frames.add(interval * frame, positions(frame));
    for (const surgefront::Series& series : frames.measure({"front", "gauge:x=0.05"}))
      std::printf("%s at %g s: %g %s\n", series.name.c_str(), series.time.back(),
                  series.value.back().value_or(0.0), series.unit.c_str());
    if (argc > 2 && std::string(argv[2]) == "bless") {
      frames.bless(argv[1], "the example of the documentation", {"front", "gauge:x=0.05"});
      return 0;
    }
    int failed = 0;
    for (const surgefront::Finding& f : frames.check(argv[1])) {
      if (f.passed) continue;
      ++failed;
      std::printf("%s: found %s, expected %s %s at %s\n", f.quantity.c_str(), f.found.c_str(),
                  f.expected.c_str(), f.unit.c_str(), f.worst.c_str());
    }
    for (const std::string& notice : frames.notices()) std::printf("notice: %s\n", notice.c_str());
    return failed == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "solver: %s\n", error.what());
    return 1;
  }
}
