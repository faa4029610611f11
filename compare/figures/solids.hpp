#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/read/run.hpp"
#include "particle/case/motion.hpp"

namespace surge::compare {

/// Where a picture's lengths begin and what they are measured in: x from the wall that the column
/// stands at (of a surge towards -x: the tank's lower wall), y from the floor, both over L.
struct PictureScale {
  double x_origin = 0.0, floor = 0.0, length = 1.0;  ///< m
  double depth_origin = 0.0;                         ///< the tank's lower side along the depth, m
  std::size_t up = 1, depth = 2;                     ///< axes of the picture's y and across it
  double middle = 0.0;  ///< of the tank along the depth, m: the plane that 3D is cut at
  bool three_dimensional = false;

  explicit PictureScale(const Run& run);
  [[nodiscard]] double x(double metres) const { return (metres - x_origin) / length; }
  [[nodiscard]] double y(double metres) const { return (metres - floor) / length; }
  [[nodiscard]] double z(double metres) const { return (metres - depth_origin) / length; }
};

/// A box of the picture, over L.
struct Rectangle {
  double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
};

/// A range along the depth of a picture, over L.
struct DepthRange {
  double from = 0.0, to = 0.0;
};

/// The edge of a body in the plane of a picture: a closed line of corners, over L.
using Outline = std::vector<std::array<double, 2>>;

/// Whether a place lies inside an outline or less than `margin` from it.
[[nodiscard]] bool is_near(const Outline& outline, double x, double y, double margin);

/// gnuplot's object of it; `style` is what follows the corners.
[[nodiscard]] std::string outline_object(const Outline& outline, const std::string& style);

/// What stands still and what moves in the plane of a run's pictures.
struct Solids {
  struct MovingWall {
    Rectangle at_rest;
    double along_x = 0.0, along_y = 0.0;  ///< unit direction of its motion
    ScalarMotion law;                     ///< displacement in m
    double length = 1.0;                  ///< L, m
    DepthRange depth{};
    double along_z = 0.0;
    [[nodiscard]] Rectangle at(Seconds time) const;
    [[nodiscard]] DepthRange depth_at(Seconds time) const;
  };
  struct Block {
    Rectangle plane;
    DepthRange depth;
  };
  std::optional<Rectangle> tank;     ///< sides that are not known are not finite
  std::set<std::string> open;        ///< sides without a wall: "x-" to "z+"
  std::vector<Rectangle> obstacles;  ///< boxes
  std::vector<Outline> outlines;     ///< of obstacles with a surface; in 3D where the plane cuts it
  std::vector<Block> blocks;         ///< all boxes, those too that the plane does not cut
  /// Surfaces of obstacles in 3D: corners of triangles, x, up and depth in turn, over L.
  std::vector<std::vector<double>> surfaces;
  DepthRange tank_depth{};
  std::vector<MovingWall> walls;
  /// Moving walls whose law the run does not state in a way that is known: not drawn.
  std::size_t not_drawn = 0;
  bool tank_moves = false;  ///< the picture is in the tank's frame
  std::string up_side;      ///< "y+": that above the water
};
[[nodiscard]] Solids solids_of(const Run& run);

/// gnuplot's objects of obstacles, and of the walls that move where they are then.
[[nodiscard]] std::string solid_objects(const Solids& solids, Seconds time);

}  // namespace surge::compare
