#include "compare/measure/frame_view.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace surge::compare {
namespace {

vtkDataArray* cell_array(const MeshFrame& frame, const char* name) {
  return frame.grid->GetCellData()->GetArray(name);
}

}  // namespace

FrameView::FrameView(const Physics& physics, Metres spacing)
    : physics_(physics),
      spacing_(spacing.value()),
      up_(static_cast<std::size_t>(physics.vertical_axis())) {
  for (std::size_t a = 0; a < 3; ++a)
    if (physics.dimension == 3 || a != across()) axes_.push_back(a);
}

void FrameView::show(Frame frame) {
  frame_ = std::move(frame);
  corners_.reset();
  bodies_.clear();
  pieces_.clear();
  settled_.clear();
  thickness_ = 1.0;
  const MeshFrame* now = mesh();
  if (now == nullptr) return;
  if (!topology_ || !topology_->describes(*now->grid))
    topology_ = std::make_unique<MeshTopology>(*now->grid);
  if (physics_.dimension == 2)
    thickness_ = topology_->bounds.upper[across()] - topology_->bounds.lower[across()];
}

std::size_t FrameView::size() const {
  return mesh() != nullptr ? mesh()->alpha.size() : particles()->position.size();
}

double FrameView::volume(std::size_t i) const {
  if (const MeshFrame* now = mesh()) return now->alpha[i] * topology_->volume[i] / thickness_;
  return std::pow(spacing_, physics_.dimension);
}

double FrameView::fraction(std::size_t i) const {
  return mesh() != nullptr ? mesh()->alpha[i] * cell_part(i) : 1.0;
}

double FrameView::cell_part(std::size_t i) const {
  double boxed = 1.0;
  for (const std::size_t a : axes_)
    boxed *= topology_->box[i].upper[a] - topology_->box[i].lower[a];
  return boxed > 0.0 ? topology_->volume[i] / thickness_ / boxed : 0.0;
}

const Vec3& FrameView::centre(std::size_t i) const {
  return mesh() != nullptr ? topology_->centre[i] : particles()->position[i];
}

Extent FrameView::box(std::size_t i) const {
  if (mesh() != nullptr) return topology_->box[i];
  Extent box{particles()->position[i], particles()->position[i]};
  for (const std::size_t a : axes_) {
    box.lower[a] -= 0.5 * spacing_;
    box.upper[a] += 0.5 * spacing_;
  }
  return box;
}

bool FrameView::has_velocity() const {
  if (const MeshFrame* now = mesh()) return cell_array(*now, "U") != nullptr;
  return particles()->velocity.size() == size();
}

bool FrameView::has_pressure() const {
  if (const MeshFrame* now = mesh()) return cell_array(*now, "p") != nullptr;
  return particles()->pressure.size() == size();
}

Vec3 FrameView::velocity(std::size_t i) const {
  if (mesh() == nullptr) return particles()->velocity[i];
  Vec3 u;
  cell_array(*mesh(), "U")->GetTuple(static_cast<vtkIdType>(i), u.data());
  return u;
}

double FrameView::pressure(std::size_t i) const {
  if (mesh() == nullptr) return particles()->pressure[i];
  return cell_array(*mesh(), "p")->GetComponent(static_cast<vtkIdType>(i), 0);
}

const std::vector<std::pair<Extent, double>>& FrameView::surface_boxes() {
  if (has_surface_boxes_) return surface_boxes_;
  has_surface_boxes_ = true;
  for (const SolidBody& body : physics_.obstacles.value_or(std::vector<SolidBody>{})) {
    if (!body.surface) continue;
    Extent at;
    const std::function<void(std::size_t)> along = [&](std::size_t k) {
      if (k == axes_.size()) {
        const double share = body.surface->share_of({at.lower, at.upper}, 2);
        if (share > 0.0) surface_boxes_.emplace_back(at, share);
        return;
      }
      const std::size_t a = axes_[k];
      const double count = std::max(1.0, std::ceil((body.upper[a] - body.lower[a]) / spacing_));
      const double size = (body.upper[a] - body.lower[a]) / count;
      for (double i = 0.0; i < count; ++i) {
        at.lower[a] = body.lower[a] + i * size;
        at.upper[a] = at.lower[a] + size;
        along(k + 1);
      }
    };
    along(0);
  }
  return surface_boxes_;
}

double FrameView::all_water() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) sum += volume(i);
  return sum;
}

bool FrameView::stands(const Vec3& x, double reach) const {
  if (x[up_] <= physics_.floor() + reach) return true;
  if (!physics_.obstacles) return false;
  return std::any_of(
      physics_.obstacles->begin(), physics_.obstacles->end(), [&](const SolidBody& o) {
        if (o.surface) {
          Point place = x;
          if (physics_.dimension == 2) place[2] = 0.0;
          const NearestPlace near = o.surface->nearest(place);
          return std::abs(near.distance) <= reach && near.normal[up_] > 0.0;
        }
        for (const std::size_t a : axes_)
          if (a != up_ && (x[a] < o.lower[a] || x[a] > o.upper[a])) return false;
        return x[up_] >= o.upper[up_] - 0.5 * spacing_ && x[up_] <= o.upper[up_] + reach;
      });
}

const std::vector<std::uint8_t>& FrameView::settled() {
  if (!settled_.empty() || size() == 0) return settled_;
  settled_.assign(size(), 0);
  if (mesh() == nullptr) {
    const Pieces& found = pieces(usual_linking_length);
    std::vector<std::uint8_t> counts(found.sizes.size(), 0);
    counts[0] = 1;
    for (std::size_t i = 0; i < size(); ++i)
      if (stands(centre(i), spacing_)) counts[found.piece_of[i]] = 1;
    for (std::size_t i = 0; i < size(); ++i) settled_[i] = counts[found.piece_of[i]];
    return settled_;
  }
  const MeshBodies& found = bodies(interface_level);
  if (found.volumes.empty()) return settled_;
  std::vector<std::uint8_t> counts(found.volumes.size(), 0);
  counts[0] = 1;
  const MeshTopology& mesh_of = *topology_;
  for (std::size_t p = 0; p < mesh_of.points.size(); ++p)
    if (found.body_of[p] != MeshBodies::none && stands(mesh_of.points[p], 0.5 * spacing_))
      counts[found.body_of[p]] = 1;
  for (std::size_t c = 0; c < size(); ++c) {
    const MeshIndex* corner = mesh_of.cells.begin(c);
    settled_[c] = std::any_of(corner, corner + mesh_of.cells.length(c), [&](MeshIndex p) {
      return found.body_of[p] != MeshBodies::none && counts[found.body_of[p]] == 1;
    });
  }
  return settled_;
}

const Pieces& FrameView::pieces(double linking_length) {
  const auto known = pieces_.find(linking_length);
  if (known != pieces_.end()) return known->second;
  return pieces_[linking_length] =
             connected_pieces(particles()->position, linking_length * spacing_);
}

MeshTopology& FrameView::topology() {
  return *topology_;
}

const CornerWater& FrameView::corners() {
  if (!corners_) corners_.emplace(*topology_, mesh()->alpha);
  return *corners_;
}

const MeshBodies& FrameView::bodies(double level) {
  const auto known = bodies_.find(level);
  if (known != bodies_.end()) return known->second;
  return bodies_.emplace(level, MeshBodies(*topology_, corners(), level)).first->second;
}

}  // namespace surge::compare
