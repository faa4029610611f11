#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/run.hpp"

namespace surge::compare {

/// A run of a film, with the words over it.
struct MoviePanel {
  const Run* run = nullptr;
  std::string label;
};

struct MovieOptions {
  std::filesystem::path out;    ///< .mp4 or .gif
  std::string title;            ///< over all panels
  bool speed_of_water = false;  ///< colours: |u|/sqrt(2gH) instead of p/(rho g H)
  std::optional<double>
      pace;  ///< simulated seconds per second; empty: the film takes eight seconds
  std::optional<Seconds> end{};  ///< of the flow; empty: as long as the longest run
  int pictures = 25;             ///< per second
  int width = 1280;              ///< pixels
};

/// Writes a film of the runs side by side, drawn as in the page's viewer: the water, obstacles,
/// walls that move and the free surface of the first panel's run over all of them. No window and no
/// browser take part; ffmpeg, which gets the pictures through a pipe, encodes. At each moment a run
/// shows its nearest frame, or none after its end. Throws Error where the file's name ends
/// otherwise, ffmpeg is not there or fails, or a run cannot be read; then no file is left. Returns
/// how many pictures there are.
std::size_t write_movie(const std::vector<MoviePanel>& panels, const MovieOptions& options);

}  // namespace surge::compare
