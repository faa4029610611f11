#include <vtkCell.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "compare/measure/front.hpp"
#include "compare/read/union_find.hpp"

namespace surge::compare {
namespace {

using Index = std::uint32_t;
constexpr double interface_level = 0.5;

/// Lists of different lengths, one behind the other.
struct Lists {
  std::vector<std::size_t> start{0};
  std::vector<Index> entries;

  void close() { start.push_back(entries.size()); }
  [[nodiscard]] std::size_t size() const { return start.size() - 1; }
  [[nodiscard]] const Index* begin(std::size_t i) const { return entries.data() + start[i]; }
  [[nodiscard]] std::size_t length(std::size_t i) const { return start[i + 1] - start[i]; }
};

Vec3 point_of(vtkPoints& points, vtkIdType i) {
  Vec3 x;
  points.GetPoint(i, x.data());
  return x;
}

/// Numbers the points anew so that coinciding ones (of neighbouring processors) are one.
std::vector<Index> merge_points(vtkPoints& points, std::vector<Vec3>& merged) {
  const auto count = static_cast<std::size_t>(points.GetNumberOfPoints());
  std::vector<Vec3> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = point_of(points, static_cast<vtkIdType>(i));
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return all[a] < all[b]; });
  std::vector<Index> number(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (k == 0 || all[order[k]] != all[order[k - 1]]) merged.push_back(all[order[k]]);
    number[order[k]] = static_cast<Index>(merged.size() - 1);
  }
  return number;
}

/// Each face once, as a loop of corners. Two faces are the same where their three smallest corners
/// are: different faces of a mesh never share three.
Lists unique_faces(const Lists& faces) {
  std::vector<std::pair<std::array<Index, 3>, std::size_t>> keys(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    std::array<Index, 3> smallest{};
    std::partial_sort_copy(faces.begin(f), faces.begin(f) + faces.length(f), smallest.begin(),
                           smallest.end());
    keys[f] = {smallest, f};
  }
  std::sort(keys.begin(), keys.end());
  Lists unique;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (k > 0 && keys[k].first == keys[k - 1].first) continue;
    const std::size_t f = keys[k].second;
    unique.entries.insert(unique.entries.end(), faces.begin(f), faces.begin(f) + faces.length(f));
    unique.close();
  }
  return unique;
}

using Edge = std::array<Index, 2>;

/// Each edge of the faces once.
std::vector<Edge> unique_edges(const Lists& faces) {
  std::vector<Edge> edges;
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

/// Volume of the box around the corners: exact for axis-aligned cells, enough to rank the pieces
/// of water on any other mesh.
double box_volume(const std::vector<Vec3>& points, const Lists& cells, std::size_t cell) {
  double volume = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double lower = points[*cells.begin(cell)][axis];
    double upper = lower;
    for (std::size_t k = 0; k < cells.length(cell); ++k) {
      lower = std::min(lower, points[cells.begin(cell)[k]][axis]);
      upper = std::max(upper, points[cells.begin(cell)[k]][axis]);
    }
    volume *= upper - lower;
  }
  return volume;
}

}  // namespace

struct MeshFront::Topology {
  explicit Topology(vtkUnstructuredGrid& grid);
  [[nodiscard]] bool describes(vtkUnstructuredGrid& grid) const;
  /// Mean of alpha over the cells around each corner, and the volume of water that the corner
  /// stands for.
  void spread(const std::vector<double>& alpha, std::vector<double>& corner_alpha,
              std::vector<double>& water) const;

  /// The faces that reach below `top`: the others cannot touch the strip. Found once for a strip.
  const std::vector<std::size_t>& faces_below(double top, std::size_t up);

  std::vector<Vec3> raw_points;  ///< as the grid has them
  std::vector<Vec3> points;      ///< merged
  Lists cells;                   ///< corners per cell
  Lists faces;                   ///< corners per face, each face once
  std::vector<Edge> edges;
  std::vector<double> volume;  ///< per cell

 private:
  std::vector<std::size_t> low_faces_;
  double low_faces_top_ = std::numeric_limits<double>::quiet_NaN();
  std::size_t low_faces_up_ = 0;
};

MeshFront::Topology::Topology(vtkUnstructuredGrid& grid) {
  vtkPoints& grid_points = *grid.GetPoints();
  for (vtkIdType i = 0; i < grid_points.GetNumberOfPoints(); ++i)
    raw_points.push_back(point_of(grid_points, i));
  const std::vector<Index> number = merge_points(grid_points, points);
  const auto append = [&](Lists& lists, vtkIdList& ids) {
    for (vtkIdType k = 0; k < ids.GetNumberOfIds(); ++k) {
      lists.entries.push_back(number[static_cast<std::size_t>(ids.GetId(k))]);
    }
    lists.close();
  };
  Lists all_faces;
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    grid.GetCell(c, cell);
    append(cells, *cell->GetPointIds());
    for (int f = 0; f < cell->GetNumberOfFaces(); ++f)
      append(all_faces, *cell->GetFace(f)->GetPointIds());
    volume.push_back(box_volume(points, cells, static_cast<std::size_t>(c)));
  }
  faces = unique_faces(all_faces);
  edges = unique_edges(faces);
}

const std::vector<std::size_t>& MeshFront::Topology::faces_below(double top, std::size_t up) {
  if (low_faces_top_ == top && low_faces_up_ == up) return low_faces_;
  low_faces_top_ = top;
  low_faces_up_ = up;
  low_faces_.clear();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Index* corner = faces.begin(f);
    const auto is_low = [&](Index p) { return points[p][up] <= top; };
    if (std::any_of(corner, corner + faces.length(f), is_low)) low_faces_.push_back(f);
  }
  return low_faces_;
}

bool MeshFront::Topology::describes(vtkUnstructuredGrid& grid) const {
  vtkPoints& grid_points = *grid.GetPoints();
  if (static_cast<std::size_t>(grid.GetNumberOfCells()) != cells.size() ||
      static_cast<std::size_t>(grid_points.GetNumberOfPoints()) != raw_points.size()) {
    return false;
  }
  for (std::size_t i = 0; i < raw_points.size(); ++i) {
    if (point_of(grid_points, static_cast<vtkIdType>(i)) != raw_points[i]) return false;
  }
  return true;
}

void MeshFront::Topology::spread(const std::vector<double>& alpha,
                                 std::vector<double>& corner_alpha,
                                 std::vector<double>& water) const {
  std::vector<Index> around(points.size(), 0);
  corner_alpha.assign(points.size(), 0.0);
  water.assign(points.size(), 0.0);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const double share = alpha[c] * volume[c] / static_cast<double>(cells.length(c));
    for (std::size_t k = 0; k < cells.length(c); ++k) {
      const Index p = cells.begin(c)[k];
      corner_alpha[p] += alpha[c];
      water[p] += share;
      ++around[p];
    }
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (around[p] > 0) corner_alpha[p] /= around[p];
  }
}

namespace {

/// Unites the corners of at least `level` that share the edge of a face.
UnionFind bodies_of(const std::vector<Edge>& edges, const std::vector<double>& alpha,
                    double level) {
  UnionFind sets(alpha.size());
  for (const auto& [a, b] : edges) {
    if (alpha[a] >= level && alpha[b] >= level) sets.unite(a, b);
  }
  return sets;
}

/// Water of each body, at the corner that stands for it.
std::vector<double> body_volumes(UnionFind& sets, const std::vector<double>& alpha,
                                 const std::vector<double>& water, double level) {
  std::vector<double> volume(alpha.size(), 0.0);
  for (std::size_t p = 0; p < alpha.size(); ++p) {
    if (alpha[p] >= level) volume[sets.find(p)] += water[p];
  }
  return volume;
}

/// The corners of the largest connected body of water (of all water if `everything`).
std::vector<char> main_body(const std::vector<Edge>& edges, const std::vector<double>& alpha,
                            const std::vector<double>& water, bool everything) {
  std::vector<char> body(alpha.size(), 0);
  if (everything) {
    for (std::size_t p = 0; p < alpha.size(); ++p) body[p] = alpha[p] >= interface_level;
    return body;
  }
  UnionFind sets = bodies_of(edges, alpha, interface_level);
  const std::vector<double> volume = body_volumes(sets, alpha, water, interface_level);
  const auto largest =
      static_cast<std::size_t>(std::max_element(volume.begin(), volume.end()) - volume.begin());
  for (std::size_t p = 0; p < alpha.size(); ++p) {
    body[p] = alpha[p] >= interface_level && sets.find(p) == largest;
  }
  return body;
}

/// Gathers the farthest x of points below `top`.
class Reach {
 public:
  Reach(std::size_t up, double top) : up_(up), top_(top) {}

  void point(const Vec3& p) {
    if (p[up_] <= top_) edge_ = std::max(edge_.value_or(p[0]), p[0]);
  }

  /// A piece of the contour; only its part below the top of the strip counts.
  void segment(const Vec3& a, const Vec3& b) {
    point(a);
    point(b);
    if ((a[up_] <= top_) == (b[up_] <= top_)) return;
    const double w = (top_ - a[up_]) / (b[up_] - a[up_]);
    const double x = a[0] + w * (b[0] - a[0]);
    edge_ = std::max(edge_.value_or(x), x);
  }

  [[nodiscard]] std::optional<double> edge() const { return edge_; }

 private:
  std::size_t up_;
  double top_;
  std::optional<double> edge_;
};

Vec3 contour_point(const Vec3& a, const Vec3& b, double alpha_a, double alpha_b) {
  const double w = (interface_level - alpha_a) / (alpha_b - alpha_a);
  return {a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1]), a[2] + w * (b[2] - a[2])};
}

}  // namespace

MeshFront::MeshFront() = default;
MeshFront::~MeshFront() = default;
MeshFront::MeshFront(MeshFront&&) noexcept = default;
MeshFront& MeshFront::operator=(MeshFront&&) noexcept = default;

std::optional<double> MeshFront::leading_edge(const MeshFrame& frame, const Physics& physics,
                                              const FrontOptions& options) {
  if (!topology_ || !topology_->describes(*frame.grid))
    topology_ = std::make_unique<Topology>(*frame.grid);
  Topology& mesh = *topology_;
  std::vector<double> alpha;
  std::vector<double> water;
  mesh.spread(frame.alpha, alpha, water);
  const std::vector<char> body = main_body(mesh.edges, alpha, water, options.raw_maximum);
  const double top = options.raw_maximum
                         ? std::numeric_limits<double>::infinity()
                         : physics.floor() + options.strip_height.value() * (1.0 + 1e-6);
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  Reach reach(up, top);
  const double direction = physics.surge_direction();
  const auto along = [&](Vec3 x) {
    x[0] *= direction;
    return x;
  };
  for (std::size_t p = 0; p < body.size(); ++p) {
    if (body[p]) reach.point(along(mesh.points[p]));
  }
  // Going round a face, the contour runs from where the water begins to where it ends next.
  for (const std::size_t f : mesh.faces_below(top, up)) {
    const Index* corner = mesh.faces.begin(f);
    const std::size_t n = mesh.faces.length(f);
    const auto crossing = [&](std::size_t k) {
      const Index a = corner[k % n];
      const Index b = corner[(k + 1) % n];
      return contour_point(mesh.points[a], mesh.points[b], alpha[a], alpha[b]);
    };
    const auto wet = [&](std::size_t k) { return alpha[corner[k % n]] >= interface_level; };
    for (std::size_t k = 0; k < n; ++k) {
      if (wet(k) || !wet(k + 1) || !body[corner[(k + 1) % n]]) continue;
      std::size_t end = k + 1;
      while (wet(end + 1)) ++end;
      reach.segment(along(crossing(k)), along(crossing(end)));
    }
  }
  const std::optional<double> edge = reach.edge();
  return edge ? std::optional(direction * *edge) : edge;
}

MeshFront::Bodies MeshFront::pieces(const MeshFrame& frame, double level) {
  if (!topology_ || !topology_->describes(*frame.grid))
    topology_ = std::make_unique<Topology>(*frame.grid);
  std::vector<double> alpha;
  std::vector<double> water;
  topology_->spread(frame.alpha, alpha, water);
  UnionFind sets = bodies_of(topology_->edges, alpha, level);
  Bodies bodies;
  bodies.volumes = body_volumes(sets, alpha, water, level);
  std::erase_if(bodies.volumes, [](double volume) { return volume <= 0.0; });
  std::sort(bodies.volumes.begin(), bodies.volumes.end(), std::greater<>());
  bodies.all = std::accumulate(water.begin(), water.end(), 0.0);
  return bodies;
}

}  // namespace surge::compare
