#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "compare/read/physics.hpp"

namespace surge::compare::testing {

/// A mesh as OpenFOAM stores it.
struct FoamTestMesh {
  struct Patch {
    std::string name, type;
    std::size_t start = 0, count = 0;
  };
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  std::vector<int> owner, neighbour;
  std::vector<Patch> patches;
  std::vector<std::size_t> cells;  ///< their numbers in the whole mesh
};

/// Cells of a tank on a lattice of half cells: whole ones, two half cells wide, and refined ones.
class FoamTestTank {
 public:
  using Box = std::array<std::array<int, 3>, 2>;  ///< lower and upper corner, half cells
  using Refined = std::function<bool(std::array<int, 3>)>;

  /// `n` cells of size `h`; `empty`: the axis that a 2D case does not have, 3 for none. It is one
  /// cell thick and not refined.
  FoamTestTank(std::array<int, 3> n, double h, std::size_t empty, const Refined& refined = {})
      : h_(h), empty_(empty) {
    std::array<int, 3> c{};
    for (c[2] = 0; c[2] < n[2]; ++c[2])
      for (c[1] = 0; c[1] < n[1]; ++c[1])
        for (c[0] = 0; c[0] < n[0]; ++c[0]) add_cell(c, refined && refined(c));
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      each_corner(cells_[i], [&](const std::array<int, 3>& p) { used_.emplace(p, 0); });
      each_unit(cells_[i], [&](const std::array<int, 3>& p) { holder_[p] = i; });
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) add_faces(i);
  }

  [[nodiscard]] std::size_t cells() const { return cells_.size(); }
  [[nodiscard]] Vec3 lower(std::size_t cell) const { return at(cells_[cell][0]); }
  [[nodiscard]] Vec3 upper(std::size_t cell) const { return at(cells_[cell][1]); }

  /// The cells that belong to `part`, with `place` where each point goes to.
  [[nodiscard]] FoamTestMesh mesh(const std::vector<int>& part_of, int part,
                                  const std::function<Vec3(Vec3)>& place) const;

 private:
  struct Face {
    std::vector<std::array<int, 3>> loop;  ///< its normal points out of `owner`
    std::size_t owner = 0;
    long neighbour = -1;
    bool empty = false;
  };

  [[nodiscard]] Vec3 at(const std::array<int, 3>& p) const {
    return {0.5 * h_ * p[0], 0.5 * h_ * p[1], 0.5 * h_ * p[2]};
  }

  void add_cell(const std::array<int, 3>& c, bool refined) {
    const std::array<int, 3> low{2 * c[0], 2 * c[1], 2 * c[2]};
    if (!refined) {
      cells_.push_back({low, {low[0] + 2, low[1] + 2, low[2] + 2}});
      return;
    }
    for (int i = 0; i < 8; ++i) {
      const std::array<int, 3> half{i % 2, i / 2 % 2, i / 4};
      Box box{low, low};
      bool skip = false;
      for (std::size_t a = 0; a < 3; ++a) {
        skip = skip || (a == empty_ && half[a] == 1);
        box[0][a] += a == empty_ ? 0 : half[a];
        box[1][a] = box[0][a] + (a == empty_ ? 2 : 1);
      }
      if (!skip) cells_.push_back(box);
    }
  }

  static void each_corner(const Box& box, const auto& action) {
    for (std::size_t i = 0; i < 8; ++i)
      action(std::array<int, 3>{box[i % 2][0], box[i / 2 % 2][1], box[i / 4][2]});
  }
  static void each_unit(const Box& box, const auto& action) {
    std::array<int, 3> p{};
    for (p[2] = box[0][2]; p[2] < box[1][2]; ++p[2])
      for (p[1] = box[0][1]; p[1] < box[1][1]; ++p[1])
        for (p[0] = box[0][0]; p[0] < box[1][0]; ++p[0]) action(p);
  }

  void add_faces(std::size_t cell) {
    const Box& box = cells_[cell];
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t side = 0; side < 2; ++side) {
        // The cells on the other side, each with what it shares with this one.
        std::map<long, Box> beyond;
        Box layer = box;
        layer[0][a] = side == 0 ? box[0][a] - 1 : box[1][a];
        layer[1][a] = layer[0][a] + 1;
        each_unit(layer, [&](const std::array<int, 3>& p) {
          const auto found = holder_.find(p);
          const long other = found == holder_.end() ? -1 : static_cast<long>(found->second);
          const auto [it, is_new] = beyond.try_emplace(other, Box{p, p});
          for (std::size_t d = 0; d < 3; ++d) {
            it->second[0][d] = std::min(it->second[0][d], p[d]);
            it->second[1][d] = std::max(is_new ? p[d] + 1 : it->second[1][d], p[d] + 1);
          }
        });
        for (auto& [other, shared] : beyond) {
          if (other >= 0 && other < static_cast<long>(cell)) continue;
          shared[0][a] = shared[1][a] = box[side][a];
          faces_.push_back({loop(shared, a, side == 1), cell, other, a == empty_});
        }
      }
    }
  }

  /// Round a rectangle normal to axis `a`, with the points on its edges that other cells have.
  [[nodiscard]] std::vector<std::array<int, 3>> loop(const Box& r, std::size_t a,
                                                     bool upwards) const {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    std::vector<std::array<int, 3>> points;
    std::array<int, 3> p = r[0];
    const auto walk = [&](std::size_t axis, int to) {
      while (p[axis] != to) {
        if (used_.contains(p)) points.push_back(p);
        p[axis] += p[axis] < to ? 1 : -1;
      }
    };
    walk(b, r[1][b]);
    walk(c, r[1][c]);
    walk(b, r[0][b]);
    walk(c, r[0][c]);
    if (!upwards) std::reverse(points.begin(), points.end());
    return points;
  }

  double h_;
  std::size_t empty_;
  std::vector<Box> cells_;
  std::map<std::array<int, 3>, int> used_;
  std::map<std::array<int, 3>, std::size_t> holder_;
  std::vector<Face> faces_;
};

inline FoamTestMesh FoamTestTank::mesh(const std::vector<int>& part_of, int part,
                                       const std::function<Vec3(Vec3)>& place) const {
  FoamTestMesh mesh;
  std::map<std::size_t, int> number;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (part_of[i] != part) continue;
    number[i] = static_cast<int>(mesh.cells.size());
    mesh.cells.push_back(i);
  }
  std::map<std::array<int, 3>, int> points;
  const auto add = [&](const Face& face, bool turned) {
    std::vector<int> loop;
    for (const auto& p : face.loop) {
      const auto [it, is_new] = points.try_emplace(p, static_cast<int>(mesh.points.size()));
      if (is_new) mesh.points.push_back(place(at(p)));
      loop.push_back(it->second);
    }
    if (turned) std::reverse(loop.begin(), loop.end());
    mesh.faces.push_back(loop);
  };
  for (const Face& face : faces_) {
    if (face.neighbour < 0) continue;
    const auto other = static_cast<std::size_t>(face.neighbour);
    if (!number.contains(face.owner) || !number.contains(other)) continue;
    add(face, false);
    mesh.owner.push_back(number.at(face.owner));
    mesh.neighbour.push_back(number.at(other));
  }
  const auto patch = [&](const std::string& name, const std::string& type, const auto& is_part) {
    const std::size_t start = mesh.faces.size();
    for (const Face& face : faces_) {
      const int owner = part_of[face.owner];
      const int other = face.neighbour < 0 ? -1 : part_of[static_cast<std::size_t>(face.neighbour)];
      if (!is_part(face, owner, other)) continue;
      const bool turned = owner != part;
      add(face, turned);
      mesh.owner.push_back(
          number.at(turned ? static_cast<std::size_t>(face.neighbour) : face.owner));
    }
    const std::size_t count = mesh.faces.size() - start;
    if (count > 0 || type == "wall") mesh.patches.push_back({name, type, start, count});
  };
  patch("walls", "wall", [&](const Face& f, int owner, int) {
    return f.neighbour < 0 && owner == part && !f.empty;
  });
  patch("sides", "empty",
        [&](const Face& f, int owner, int) { return f.neighbour < 0 && owner == part && f.empty; });
  const int parts = 1 + *std::max_element(part_of.begin(), part_of.end());
  for (int k = 0; k < parts; ++k) {
    if (k == part) continue;
    std::string name = "procBoundary";
    name.append(std::to_string(part)).append("to").append(std::to_string(k));
    patch(name, "processor", [&](const Face& f, int owner, int other) {
      return f.neighbour >= 0 && ((owner == part && other == k) || (owner == k && other == part));
    });
  }
  return mesh;
}

}  // namespace surge::compare::testing
