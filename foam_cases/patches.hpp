#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "foam_cases/mesh.hpp"

namespace surge::foam {

/// A boundary of the mesh: a side of the tank, or the surface of an obstacle.
struct Patch {
  enum class Kind { wall, piston, open, periodic, empty };
  std::string name;
  Kind kind = Kind::wall;
  std::string neighbour;           ///< periodic: the patch on the other side
  std::vector<std::string> faces;  ///< each of four numbers of vertices, outwards
};

/// The name of a side (x-, x+, y-, y+, z-, z+) in the mesh: floor, leftWall, atmosphere ...
[[nodiscard]] std::string side_name(const Case& c, const Mesh& mesh, std::size_t side);
[[nodiscard]] std::string obstacle_name(std::size_t index);

/// Corners of the pieces of a mesh, numbered in the order of a blockMeshDict: those that a block of
/// cells has.
class Vertices {
 public:
  explicit Vertices(const Mesh& mesh);
  [[nodiscard]] std::size_t number(const Place& corner) const { return numbers_[index(corner)]; }
  [[nodiscard]] bool used(const Place& corner) const { return numbers_[index(corner)] != none; }
  [[nodiscard]] std::size_t count(std::size_t axis) const { return count_[axis]; }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  [[nodiscard]] std::size_t index(const Place& corner) const {
    return corner[0] + count_[0] * (corner[1] + count_[1] * corner[2]);
  }
  Place count_;
  std::vector<std::size_t> numbers_;
};

/// All boundaries with their faces; in 2D the last one is frontAndBack, without a list of faces.
[[nodiscard]] std::vector<Patch> patches(const Case& c, const Mesh& mesh, const Vertices& vertices);

/// Throws Error where obstacles cut the space into parts that the pressure of another does not
/// reach, and one of them has no open side.
void check_connected(const Case& c, const Mesh& mesh);

}  // namespace surge::foam
