#include <algorithm>
#include <cmath>

#include "compare/read/foam_mesh.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3 operator*(double s, const Vec3& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

constexpr double most_warp = 0.1;   ///< distance of a corner from the plane, of the face's size
constexpr double most_open = 1e-6;  ///< |sum of areas| / sum of |areas| of a cell

/// Centre and area of a face: triangles from the mean of its corners.
void face_geometry(FoamMesh& mesh, std::size_t face) {
  const std::uint32_t* corner = mesh.corners.data() + mesh.face_start[face];
  const std::size_t n = mesh.face_start[face + 1] - mesh.face_start[face];
  const auto point = [&](std::size_t k) -> const Vec3& { return mesh.points[corner[k % n]]; };
  Vec3 mean{};
  for (std::size_t k = 0; k < n; ++k) mean = mean + (1.0 / static_cast<double>(n)) * point(k);
  Vec3 area{};
  for (std::size_t k = 0; k < n; ++k)
    area = area + 0.5 * cross(point(k) - mean, point(k + 1) - mean);
  const double size = length(area);
  if (!std::isfinite(size))
    throw Error(mesh.place + "/points: face " + std::to_string(face) + " has no finite area");
  mesh.face_area[face] = area;
  mesh.face_centre[face] = mean;
  if (size == 0.0) return;  // collapsed, as at the axis of a wedge
  const Vec3 normal = (1.0 / size) * area;
  Vec3 sum{};
  double weight = 0.0, off = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double part = dot(0.5 * cross(point(k) - mean, point(k + 1) - mean), normal);
    sum = sum + (part / 3.0) * (mean + point(k) + point(k + 1));
    weight += part;
    off = std::max(off, std::abs(dot(point(k) - mean, normal)));
  }
  mesh.face_centre[face] = (1.0 / weight) * sum;
  if (off > most_warp * std::sqrt(size)) ++mesh.warped_faces;
}

}  // namespace

void compute_geometry(FoamMesh& mesh) {
  const std::size_t faces = mesh.faces();
  mesh.face_area.resize(faces);
  mesh.face_centre.resize(faces);
  for (std::size_t f = 0; f < faces; ++f) face_geometry(mesh, f);

  // Each inner face counts for the cells on both of its sides.
  const auto each_side = [&](const auto& action) {
    for (std::size_t f = 0; f < faces; ++f) {
      action(f, mesh.owner[f], 1.0);
      if (f < mesh.neighbour.size()) action(f, mesh.neighbour[f], -1.0);
    }
  };
  std::vector<Vec3> inside(mesh.cells), sum(mesh.cells);
  std::vector<double> count(mesh.cells), all(mesh.cells);
  each_side([&](std::size_t f, std::size_t cell, double sign) {
    inside[cell] = inside[cell] + mesh.face_centre[f];
    sum[cell] = sum[cell] + sign * mesh.face_area[f];
    all[cell] += length(mesh.face_area[f]);
    count[cell] += 1.0;
  });
  const auto refuse = [&](std::size_t cell, const std::string& why) {
    throw Error(mesh.place + ": cell " + std::to_string(cell) + " " + why +
                " (a damaged mesh; checkMesh says more)");
  };
  for (std::size_t c = 0; c < mesh.cells; ++c) {
    if (count[c] < 4.0) refuse(c, "has fewer than 4 faces");
    if (length(sum[c]) > most_open * all[c]) refuse(c, "is not closed");
    inside[c] = (1.0 / count[c]) * inside[c];
  }
  mesh.volume.assign(mesh.cells, 0.0);
  mesh.centre.assign(mesh.cells, Vec3{});
  each_side([&](std::size_t f, std::size_t cell, double sign) {
    const Vec3 out = mesh.face_centre[f] - inside[cell];
    const double pyramid = sign * dot(mesh.face_area[f], out) / 3.0;
    mesh.volume[cell] += pyramid;
    mesh.centre[cell] =
        mesh.centre[cell] + pyramid * (0.75 * mesh.face_centre[f] + 0.25 * inside[cell]);
    // A face that looks inwards, by more than in a cell that is somewhat concave.
    const double size = length(mesh.face_area[f]) * length(out);
    if (sign * dot(mesh.face_area[f], out) < -0.1 * size)
      refuse(cell, "is inside out at face " + std::to_string(f));
  });
  for (std::size_t c = 0; c < mesh.cells; ++c) {
    if (!(mesh.volume[c] > 0.0)) refuse(c, "has no volume");
    mesh.centre[c] = (1.0 / mesh.volume[c]) * mesh.centre[c];
  }
}

}  // namespace surge::compare
