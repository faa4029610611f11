#include "foam_cases/patches.hpp"

#include <algorithm>
#include <array>

#include "particle/support/error.hpp"

namespace surge::foam {

namespace {

/// The four corners of a face of a piece, as seen from outside against the clock.
std::array<Place, 4> corners(const Place& p, std::size_t axis, bool plus) {
  const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;  // b x c points along the axis
  Place first = p;
  if (plus) ++first[axis];
  std::array<Place, 4> face{first, first, first, first};
  ++face[1][plus ? b : c];
  ++face[2][b];
  ++face[2][c];
  ++face[3][plus ? c : b];
  return face;
}

std::string face_text(const std::array<Place, 4>& face, const Vertices& vertices) {
  std::string text = "(";
  for (std::size_t i = 0; i < 4; ++i)
    text.append(i > 0 ? " " : "").append(std::to_string(vertices.number(face[i])));
  return text + ")";
}

Patch::Kind kind_of(const Case& c, std::size_t side) {
  if (c.tank.periodic[side / 2]) return Patch::Kind::periodic;
  return c.tank.open[side] ? Patch::Kind::open : Patch::Kind::wall;
}

/// The obstacle that fills a solid piece.
std::size_t obstacle_at(const Case& c, const Point& x) {
  for (std::size_t i = 0; i < c.obstacles.size(); ++i) {
    const Obstacle& box = c.obstacles[i];
    bool inside = !box.surface;
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a)
      inside = inside && x[a] > box.lower[a] && x[a] < box.upper[a];
    if (inside) return i;
  }
  throw Error("mesh: found a solid piece without an obstacle");
}

}  // namespace

std::string obstacle_name(std::size_t index) {
  return "obstacle" + std::to_string(index);
}

std::string side_name(const Case& c, const Mesh& mesh, std::size_t side) {
  const std::size_t axis = side / 2;
  const bool plus = side % 2 == 1;
  const Patch::Kind kind = kind_of(c, side);
  if (axis == mesh.up && kind != Patch::Kind::periodic) {
    if (plus != mesh.up_is_plus) return kind == Patch::Kind::wall ? "floor" : "floorOpening";
    return kind == Patch::Kind::wall ? "ceiling" : "atmosphere";
  }
  // The two axes across, in their order: from the left to the right, from the back to the front.
  const bool first = axis == (mesh.up == 0 ? 1 : 0);
  const std::string name = axis == mesh.up ? (plus ? "upper" : "lower")
                           : first         ? (plus ? "right" : "left")
                                           : (plus ? "front" : "back");
  if (kind == Patch::Kind::wall) return name + "Wall";
  return name + (kind == Patch::Kind::open ? "Opening" : "Period");
}

Vertices::Vertices(const Mesh& mesh)
    : count_{mesh.count(0) + 1, mesh.count(1) + 1, mesh.count(2) + 1},
      numbers_(count_[0] * count_[1] * count_[2], none) {
  std::vector<bool> used(numbers_.size(), false);
  mesh.for_each_place([&](const Place& p) {
    if (mesh.is_solid(p)) return;
    for (std::size_t corner = 0; corner < 8; ++corner)
      used[index({p[0] + (corner & 1), p[1] + (corner >> 1 & 1), p[2] + (corner >> 2)})] = true;
  });
  std::size_t next = 0;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) numbers_[i] = next++;
}

std::vector<Patch> patches(const Case& c, const Mesh& mesh, const Vertices& vertices) {
  const std::size_t axes = c.dimension == 2 ? 2 : 3;
  std::vector<Patch> all;
  for (std::size_t side = 0; side < 2 * axes; ++side) {
    Patch patch{side_name(c, mesh, side), kind_of(c, side), {}, {}};
    if (patch.kind == Patch::Kind::periodic) patch.neighbour = side_name(c, mesh, side ^ 1U);
    all.push_back(patch);
  }
  for (std::size_t i = 0; i < c.obstacles.size(); ++i)
    all.push_back({obstacle_name(i), Patch::Kind::wall, {}, {}});
  mesh.for_each_place([&](const Place& p) {
    if (mesh.is_solid(p)) return;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      for (const bool plus : {false, true}) {
        const auto next = mesh.next(p, axis, plus);
        if (next && !mesh.is_solid(*next)) continue;
        const std::size_t at =
            next ? 2 * axes + obstacle_at(c, mesh.middle(*next)) : 2 * axis + (plus ? 1 : 0);
        all[at].faces.push_back(face_text(corners(p, axis, plus), vertices));
      }
    }
  });
  // What stands against a wall along its whole length, or between others, has no face. Cutting
  // gives those with a surface theirs.
  const auto gets_faces = [&](const Patch& patch) {
    for (std::size_t i = 0; i < c.obstacles.size(); ++i)
      if (c.obstacles[i].surface && patch.name == obstacle_name(i)) return true;
    return false;
  };
  std::erase_if(all, [&](const Patch& patch) { return patch.faces.empty() && !gets_faces(patch); });
  if (c.dimension == 2) all.push_back({"frontAndBack", Patch::Kind::empty, {}, {}});
  return all;
}

void check_connected(const Case& c, const Mesh& mesh) {
  std::vector<bool> seen(mesh.solid.size(), false);
  std::size_t parts = 0, closed = 0;
  mesh.for_each_place([&](const Place& start) {
    if (mesh.is_solid(start) || seen[mesh.index(start)]) return;
    ++parts;
    bool open = false;
    std::vector<Place> todo{start};
    seen[mesh.index(start)] = true;
    while (!todo.empty()) {
      const Place p = todo.back();
      todo.pop_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const bool plus : {false, true}) {
          auto next = mesh.next(p, axis, plus);
          if (!next && axis < static_cast<std::size_t>(c.dimension)) {
            open = open || c.tank.open[2 * axis + (plus ? 1 : 0)];
            if (!c.tank.periodic[axis]) continue;
            next = p;
            (*next)[axis] = plus ? 0 : mesh.count(axis) - 1;
          }
          if (!next || mesh.is_solid(*next) || seen[mesh.index(*next)]) continue;
          seen[mesh.index(*next)] = true;
          todo.push_back(*next);
        }
      }
    }
    if (!open) ++closed;
  });
  if (parts > 1 && closed > 0) {
    throw Error("obstacle: found a tank cut into " + std::to_string(parts) + " parts, " +
                std::to_string(closed) +
                " of them closed, expected one space, or parts that are open: the pressure of a "
                "closed part has no reference");
  }
}

}  // namespace surge::foam
