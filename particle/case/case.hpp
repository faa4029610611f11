#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "particle/case/box.hpp"
#include "particle/case/closed_surface.hpp"
#include "particle/case/motion.hpp"

namespace surge {

/// A body of fluid at time zero, filled with particles on a square (cubic) lattice.
struct FluidBlock {
  enum class Shape { box, ball };
  Shape shape = Shape::box;
  Box box;           ///< the box itself, or the one that encloses the ball
  Point velocity{};  ///< m/s, at the centre of the block
  /// dv_a/dx_b in 1/s: the initial velocity is velocity + gradient (x - centre).
  std::array<Point, 3> velocity_gradient{};
  /// m; > 0: besides, the velocities of a standing wave of this amplitude on the box's flat surface
  double wave_amplitude = 0.0;
};

enum class WallCondition { slip, no_slip };

/// The box that holds the fluid. A side is a wall unless it is open or its axis is periodic.
struct Tank {
  Box box;
  std::array<bool, 6> open{};      ///< x-, x+, y-, y+, z-, z+
  std::array<bool, 3> periodic{};  ///< x, y, z
  WallCondition wall = WallCondition::slip;
};

/// A fixed solid body: a box, or what a closed surface holds; the box is then the one around it.
struct Obstacle : Box {
  std::shared_ptr<const ClosedSurface> surface;  ///< null: the box itself

  Obstacle() = default;
  Obstacle(const Box& box) : Box(box) {}  // NOLINT: a box is an obstacle
  Obstacle(const Point& from, const Point& to) : Box{from, to} {}
  explicit Obstacle(ClosedSurface made)
      : Box(made.bounds()), surface(std::make_shared<const ClosedSurface>(std::move(made))) {}
};

/// Where the pressure is recorded at every step, as a flush sensor of this diameter would read it.
struct Probe {
  std::string name;
  Point position{};
  double diameter = 0.0;  ///< m; 0: one spacing
};

/// A wall that moves through the tank: a piston, or a gate that is lifted.
struct MovingWall {
  std::string name;
  Box box;            ///< at displacement zero
  Point direction{};  ///< unit vector
  ScalarMotion law;
};

/// A vertical line on which the height of the water is recorded: a wave gauge.
struct Gauge {
  std::string name;
  Point position{};  ///< m; its component along gravity does not matter
};

/// Solid surface on which the force of the water is recorded.
struct ForceSurface {
  enum class Of { side, obstacle, moving_wall };
  std::string name;
  Of of = Of::obstacle;
  std::size_t index = 0;  ///< side: x-, x+, y-, y+, z-, z+; else of the obstacle or moving wall
};

/// Eq. (25) and what the paper says next to it.
struct TimeControl {
  double end = 1.0;            ///< s
  double initial_step = 1e-4;  ///< s
  double maximum_step = 1e-3;  ///< s
  double courant = 0.2;        ///< v_max dt / l0
};

/// One physical case, checked and complete. It knows no method.
struct Case {
  std::string title;
  int dimension = 2;
  double density = 1000.0;           ///< kg/m3
  double kinematic_viscosity = 0.0;  ///< m2/s
  double reference_speed = 0.0;      ///< m/s, the flow's; 0: reference_speed() finds one
  Point gravity{0.0, -9.81, 0.0};    ///< m/s2
  bool has_tank = false;
  Tank tank;
  std::vector<FluidBlock> blocks;
  std::vector<Obstacle> obstacles;
  TankMotion motion;
  std::vector<MovingWall> moving_walls;
  std::vector<Probe> probes;
  std::vector<Gauge> gauges;
  std::vector<ForceSurface> forces;
  double spacing = 0.005;  ///< l0, m
  TimeControl time;
  double output_interval = 0.01;  ///< s between frames
  /// s of wall-clock time between checkpoints, 0: none but at a stop. Ten minutes are what a kill
  /// costs at most. A checkpoint takes 100 bytes per particle and less time than a step (measured:
  /// 0.1 s for 210 000 particles), so that ten minutes apart they cost nothing.
  double checkpoint_interval = 600.0;
};

}  // namespace surge
