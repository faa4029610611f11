#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

/// SurgeFront's comparator for a solver that hands its frames over from memory: no files, no
/// conversion. This header needs the standard library alone (C++20). All numbers are in SI units.
///
/// @code
///   surgefront::Frames frames({.name = "mine", .spacing = 0.01, .gravity = 9.81});
///   frames.add(0.00, positions);          // x, y, z of every fluid particle, one after the other
///   frames.add(0.01, positions);
///   for (const surgefront::Series& series : frames.measure({"front", "gauge:x=0.3"})) ...
///   const surgefront::Difference d = frames.difference("runs/vof-20");
/// @endcode
///
/// Frames go through the checks that files go through: neighbours about a spacing apart, one body
/// of water that fills its column at the start, a front no faster than falling water.
namespace surgefront {

/// What is wrong and what is expected, in one line.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a solver knows of its flow and its frames do not say.
struct Flow {
  std::string name = "solver";  ///< in messages and results
  double spacing = 0.0;         ///< particle spacing l0, m
  double gravity = 0.0;         ///< magnitude, m/s2
  /// Axes of the positions along the surge and up, "-" turns one round: "x" and "z", for instance.
  std::array<std::string, 2> axes{"x", "y"};
  int dimension = 0;  ///< 2 or 3; 0: by the first frame
  /// m; needed where the first frame is not the column at rest
  std::optional<double> column_width{};
  std::optional<double> column_height{};  ///< m; likewise
  std::optional<double> tank_width{};     ///< m, far wall from the column's wall
  std::optional<double> tank_height{};    ///< m, from the floor
  std::optional<double> bed_depth{};      ///< m, of water that lies in the tank at time 0
  std::optional<double> density{};        ///< kg/m3, for energies and forces
  double strip_height = 0.015;            ///< m, in which the leading edge is looked for
};

/// A measured quantity over time; a value that is not there at a time is empty.
struct Series {
  std::string name;          ///< of the observable, and of its part where it has several
  std::string unit;          ///< SI; "1" without dimension
  std::vector<double> time;  ///< s
  std::vector<std::optional<double>> value;  ///< one for each time
};

/// Leading edges Z/L over T = t sqrt(2 g / L), frames less reference, over the time that both know
/// before the far wall.
struct Difference {
  double rms = 0.0;      ///< root of the mean square
  double maximum = 0.0;  ///< of the magnitude
  double bias = 0.0;     ///< mean; positive where the frames are ahead
  double from = 0.0;     ///< T at which the comparison begins
  double until = 0.0;    ///< T at which it ends
};

/// A quantity of a baseline; of a curve its worst point.
struct Finding {
  std::string quantity;  ///< as the baseline names it
  bool passed = false;   ///< within the tolerance of the baseline
  std::string worst;     ///< "0.12 s" of a curve, empty for a single value
  std::string found;     ///< value there; "missing" where there is none
  std::string expected;  ///< value of the baseline there
  std::string unit;      ///< of both; empty where there is none
  std::string why;       ///< of a failure that the numbers do not tell
};

/// Frames of fluid particles in the order of time, kept in memory.
class Frames {
 public:
  /// Throws Error for numbers and axes that cannot be.
  explicit Frames(const Flow& flow);
  ~Frames();
  Frames(Frames&&) noexcept;             ///< what is moved from can only be destroyed
  Frames& operator=(Frames&&) noexcept;  ///< what is moved from can only be destroyed

  /// Adds a frame. `position`, `velocity`: three numbers for each fluid particle (z = 0 in 2D), m
  /// and m/s; `pressure`: one, Pa. Velocities and pressures may be left out; what needs them then
  /// fails. Throws Error for sizes that do not agree and a time that is not after the last one.
  void add(double time, std::span<const double> position, std::span<const double> velocity = {},
           std::span<const double> pressure = {});
  /// Number of frames.
  [[nodiscard]] std::size_t size() const;

  /// The observables of `surge-compare measure --list`, KIND or KIND:key=value,key=value. Throws
  /// Error where one cannot be measured.
  [[nodiscard]] std::vector<Series> measure(const std::vector<std::string>& observables);

  /// Against a run folder, an OpenFOAM case or particle files that say all about themselves. Throws
  /// Error where the two are different flows.
  [[nodiscard]] Difference difference(const std::string& reference);

  /// Against a baseline that bless() wrote. Throws Error where nothing can be compared.
  [[nodiscard]] std::vector<Finding> check(const std::string& baseline_file);
  /// Writes a baseline of the frames. `reason`: why they are right.
  void bless(const std::string& baseline_file, const std::string& reason,
             const std::vector<std::string>& observables = {"front"});

  /// What was left out or looks odd, of all that was done so far.
  [[nodiscard]] const std::vector<std::string>& notices() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace surgefront
