#include "compare/measure/mesh_topology.hpp"

#include <vtkCell.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "compare/read/union_find.hpp"

namespace surge::compare {
namespace {

Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3 operator*(double f, const Vec3& a) {
  return {f * a[0], f * a[1], f * a[2]};
}
double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec3 point_of(vtkPoints& points, vtkIdType i) {
  Vec3 x;
  points.GetPoint(i, x.data());
  return x;
}

/// Numbers the points anew so that coinciding ones (of neighbouring processors) are one.
std::vector<MeshIndex> merge_points(const std::vector<Vec3>& all, std::vector<Vec3>& merged) {
  std::vector<MeshIndex> order(all.size());
  std::iota(order.begin(), order.end(), MeshIndex{0});
  std::sort(order.begin(), order.end(), [&](MeshIndex a, MeshIndex b) { return all[a] < all[b]; });
  std::vector<MeshIndex> number(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k == 0 || all[order[k]] != all[order[k - 1]]) merged.push_back(all[order[k]]);
    number[order[k]] = static_cast<MeshIndex>(merged.size() - 1);
  }
  return number;
}

/// Each face once, as a loop of corners. Two faces are the same where their three smallest corners
/// are: different faces of a mesh never share three.
MeshLists unique_faces(const MeshLists& faces) {
  std::vector<std::pair<std::array<MeshIndex, 3>, std::size_t>> keys(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    std::array<MeshIndex, 3> smallest{};
    std::partial_sort_copy(faces.begin(f), faces.begin(f) + faces.length(f), smallest.begin(),
                           smallest.end());
    keys[f] = {smallest, f};
  }
  std::sort(keys.begin(), keys.end());
  MeshLists unique;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (k > 0 && keys[k].first == keys[k - 1].first) continue;
    const std::size_t f = keys[k].second;
    unique.entries.insert(unique.entries.end(), faces.begin(f), faces.begin(f) + faces.length(f));
    unique.close();
  }
  return unique;
}

/// Each edge of the faces once.
std::vector<MeshEdge> unique_edges(const MeshLists& faces) {
  std::vector<MeshEdge> edges;
  edges.reserve(faces.entries.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::size_t n = faces.length(f);
    for (std::size_t k = 0; k < n; ++k) {
      const auto [a, b] = std::minmax(faces.begin(f)[k], faces.begin(f)[(k + 1) % n]);
      edges.push_back({a, b});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  edges.shrink_to_fit();
  return edges;
}

Vec3 middle_of(const MeshLists& lists, std::size_t i, const std::vector<Vec3>& points) {
  Vec3 sum{};
  for (std::size_t k = 0; k < lists.length(i); ++k) sum = sum + points[lists.begin(i)[k]];
  return (1.0 / static_cast<double>(lists.length(i))) * sum;
}

Extent box_of(const MeshLists& cells, std::size_t i, const std::vector<Vec3>& points) {
  Extent box{points[*cells.begin(i)], points[*cells.begin(i)]};
  for (std::size_t k = 0; k < cells.length(i); ++k) {
    for (std::size_t a = 0; a < 3; ++a) {
      box.lower[a] = std::min(box.lower[a], points[cells.begin(i)[k]][a]);
      box.upper[a] = std::max(box.upper[a], points[cells.begin(i)[k]][a]);
    }
  }
  return box;
}

struct Solid {
  double volume = 0.0;
  Vec3 centre{};
};

/// Tetrahedra from `middle` over the triangles between each face's middle and its edges.
Solid solid_of(const MeshLists& faces, std::size_t first, std::size_t end, const Vec3& middle,
               const std::vector<Vec3>& points) {
  Solid solid;
  Vec3 moment{};
  for (std::size_t f = first; f < end; ++f) {
    const Vec3 top = middle_of(faces, f, points);
    const std::size_t n = faces.length(f);
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3& a = points[faces.begin(f)[k]];
      const Vec3& b = points[faces.begin(f)[(k + 1) % n]];
      const double v = std::abs(dot(top - middle, cross(a - middle, b - middle))) / 6.0;
      solid.volume += v;
      moment = moment + 0.25 * v * (middle + top + a + b);
    }
  }
  solid.centre = solid.volume > 0.0 ? (1.0 / solid.volume) * moment : middle;
  return solid;
}

}  // namespace

MeshTopology::MeshTopology(vtkUnstructuredGrid& grid) {
  vtkPoints& grid_points = *grid.GetPoints();
  for (vtkIdType i = 0; i < grid_points.GetNumberOfPoints(); ++i)
    raw_points_.push_back(point_of(grid_points, i));
  const std::vector<MeshIndex> number = merge_points(raw_points_, points);
  const auto append = [&](MeshLists& lists, vtkIdList& ids) {
    for (vtkIdType k = 0; k < ids.GetNumberOfIds(); ++k)
      lists.entries.push_back(number[static_cast<std::size_t>(ids.GetId(k))]);
    lists.close();
  };
  MeshLists all_faces;
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    grid.GetCell(c, cell);
    const auto i = static_cast<std::size_t>(c);
    append(cells, *cell->GetPointIds());
    const std::size_t first = all_faces.size();
    for (int f = 0; f < cell->GetNumberOfFaces(); ++f)
      append(all_faces, *cell->GetFace(f)->GetPointIds());
    const Solid solid =
        solid_of(all_faces, first, all_faces.size(), middle_of(cells, i, points), points);
    volume.push_back(solid.volume);
    centre.push_back(solid.centre);
    box.push_back(box_of(cells, i, points));
  }
  faces = unique_faces(all_faces);
  edges = unique_edges(faces);
  bounds.lower.fill(std::numeric_limits<double>::infinity());
  bounds.upper.fill(-std::numeric_limits<double>::infinity());
  for (const Vec3& x : points) {
    for (std::size_t a = 0; a < 3; ++a) {
      bounds.lower[a] = std::min(bounds.lower[a], x[a]);
      bounds.upper[a] = std::max(bounds.upper[a], x[a]);
    }
  }
}

bool MeshTopology::describes(vtkUnstructuredGrid& grid) const {
  if (static_cast<std::size_t>(grid.GetNumberOfCells()) != size()) return false;
  vtkPoints& other = *grid.GetPoints();
  if (static_cast<std::size_t>(other.GetNumberOfPoints()) != raw_points_.size()) return false;
  for (std::size_t i = 0; i < raw_points_.size(); ++i)
    if (point_of(other, static_cast<vtkIdType>(i)) != raw_points_[i]) return false;
  return true;
}

const std::vector<std::size_t>& MeshTopology::faces_between(double lower, double upper,
                                                            std::size_t up) {
  if (strip_lower_ == lower && strip_upper_ == upper && strip_up_ == up) return strip_faces_;
  strip_lower_ = lower;
  strip_upper_ = upper;
  strip_up_ = up;
  strip_faces_.clear();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (std::size_t k = 0; k < faces.length(f); ++k) {
      const double height = points[faces.begin(f)[k]][up];
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
    if (highest >= lower && lowest <= upper) strip_faces_.push_back(f);
  }
  return strip_faces_;
}

CornerWater::CornerWater(const MeshTopology& mesh, const std::vector<double>& cell_alpha)
    : alpha(mesh.points.size(), 0.0), volume(mesh.points.size(), 0.0) {
  std::vector<MeshIndex> around(mesh.points.size(), 0);
  for (std::size_t c = 0; c < mesh.size(); ++c) {
    const double share = cell_alpha[c] * mesh.volume[c] / static_cast<double>(mesh.cells.length(c));
    for (std::size_t k = 0; k < mesh.cells.length(c); ++k) {
      const MeshIndex p = mesh.cells.begin(c)[k];
      alpha[p] += cell_alpha[c];
      volume[p] += share;
      ++around[p];
    }
  }
  for (std::size_t p = 0; p < alpha.size(); ++p)
    if (around[p] > 0) alpha[p] /= around[p];
}

MeshBodies::MeshBodies(const MeshTopology& mesh, const CornerWater& water, double level)
    : body_of(water.alpha.size(), none) {
  UnionFind sets(water.alpha.size());
  const auto wet = [&](std::size_t p) { return water.alpha[p] >= level; };
  for (const auto& [a, b] : mesh.edges)
    if (wet(a) && wet(b)) sets.unite(a, b);
  std::vector<double> volume(water.alpha.size(), 0.0);
  for (std::size_t p = 0; p < volume.size(); ++p)
    if (wet(p)) volume[sets.find(p)] += water.volume[p];
  std::vector<std::size_t> roots;
  for (std::size_t p = 0; p < volume.size(); ++p)
    if (wet(p) && sets.find(p) == p && volume[p] > 0.0) roots.push_back(p);
  std::stable_sort(roots.begin(), roots.end(),
                   [&](std::size_t a, std::size_t b) { return volume[a] > volume[b]; });
  std::vector<std::size_t> number(volume.size(), none);
  for (std::size_t k = 0; k < roots.size(); ++k) {
    number[roots[k]] = k;
    volumes.push_back(volume[roots[k]]);
  }
  for (std::size_t p = 0; p < body_of.size(); ++p)
    if (wet(p)) body_of[p] = number[sets.find(p)];
}

}  // namespace surge::compare
