#include "compare/read/pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include "compare/read/union_find.hpp"

namespace surge::compare {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct PieceEntry {
  Cell cell;
  std::size_t particle;
};

/// Cells of the linking distance; a particle that flew very far shares the outermost one.
Cell cell_of(const Vec3& position, double size) {
  constexpr double farthest = 1e15;
  Cell cell;
  for (std::size_t a = 0; a < 3; ++a) {
    cell[a] =
        static_cast<std::int64_t>(std::clamp(std::floor(position[a] / size), -farthest, farthest));
  }
  return cell;
}

using Entries = std::span<const PieceEntry>;

/// The entries of the three cells (column x, column y, z-1..z+1), which lie next to each other in
/// the sorted list.
Entries cells_around(const std::vector<PieceEntry>& entries, Cell column, std::int64_t z) {
  const auto less = [](const PieceEntry& e, const Cell& c) { return e.cell < c; };
  column[2] = z - 1;
  const auto first = std::lower_bound(entries.begin(), entries.end(), column, less);
  column[2] = z + 2;
  auto last = first;
  while (last != entries.end() && last->cell < column) ++last;
  return {first, last};
}

void link(Entries cell, Entries around, const std::vector<Vec3>& position, double distance_squared,
          UnionFind& sets) {
  for (const PieceEntry& entry : cell) {
    const Vec3& x = position[entry.particle];
    for (const PieceEntry& other : around) {
      const Vec3& y = position[other.particle];
      const Vec3 d{x[0] - y[0], x[1] - y[1], x[2] - y[2]};
      if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= distance_squared)
        sets.unite(entry.particle, other.particle);
    }
  }
}

Pieces number_by_size(UnionFind& sets, std::size_t count) {
  std::vector<std::size_t> members(count, 0);
  for (std::size_t i = 0; i < count; ++i) ++members[sets.find(i)];
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < count; ++i) {
    if (members[i] > 0) roots.push_back(i);
  }
  std::stable_sort(roots.begin(), roots.end(),
                   [&](std::size_t a, std::size_t b) { return members[a] > members[b]; });
  Pieces pieces;
  std::vector<std::size_t> number(count, 0);
  for (std::size_t k = 0; k < roots.size(); ++k) {
    number[roots[k]] = k;
    pieces.sizes.push_back(members[roots[k]]);
  }
  pieces.piece_of.resize(count);
  for (std::size_t i = 0; i < count; ++i) pieces.piece_of[i] = number[sets.find(i)];
  return pieces;
}

}  // namespace

Pieces connected_pieces(const std::vector<Vec3>& position, double linking_distance) {
  std::vector<PieceEntry> entries(position.size());
  for (std::size_t i = 0; i < position.size(); ++i)
    entries[i] = {cell_of(position[i], linking_distance), i};
  std::sort(entries.begin(), entries.end(),
            [](const PieceEntry& a, const PieceEntry& b) { return a.cell < b.cell; });
  UnionFind sets(position.size());
  // Particles exactly a linking distance apart (a lattice) must not depend on rounding.
  const double distance_squared = std::pow(linking_distance * (1.0 + 1e-9), 2);
  for (auto begin = entries.begin(); begin != entries.end();) {
    const Cell cell = begin->cell;
    const auto end =
        std::find_if(begin, entries.end(), [&](const PieceEntry& e) { return e.cell != cell; });
    // Half of the neighbours is enough: the other half finds this one.
    for (const auto& [dx, dy] : {std::pair{0, 0}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}) {
      const Entries around = cells_around(entries, {cell[0] + dx, cell[1] + dy, 0}, cell[2]);
      link({begin, end}, around, position, distance_squared, sets);
    }
    begin = end;
  }
  return number_by_size(sets, position.size());
}

}  // namespace surge::compare
