#include "compare/read/foam_reader.hpp"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "compare/read/foam_field.hpp"
#include "compare/read/foam_file.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

constexpr double told_volume_change = 5e-4;  ///< relative; solvers keep it to rounding errors
constexpr double told_alpha_excess = 0.01;
constexpr double most_alpha_excess = 0.5;

std::optional<double> time_in(const std::string& name) {
  double value = 0.0;
  const auto [end, failed] = std::from_chars(name.data(), name.data() + name.size(), value);
  const bool all = failed == std::errc{} && end == name.data() + name.size();
  return all ? std::optional(value) : std::nullopt;
}

bool same_time(double a, double b) {
  return std::abs(a - b) <= 1e-12 + 1e-9 * std::abs(b);
}

vtkSmartPointer<vtkDoubleArray> cell_array(const std::string& name, int components,
                                           const std::vector<double>& values) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

}  // namespace

FoamReader::FoamReader(fs::path root, FoamParts parts, std::string region, std::string alpha)
    : root_(std::move(root)),
      parts_(std::move(parts)),
      region_(std::move(region)),
      alpha_(std::move(alpha)) {
  FoamTimes found = foam_times(parts_.folders, (fs::path(region_) / alpha_).string());
  times_ = std::move(found.times);
  names_ = std::move(found.names);
  notices_ = std::move(found.notices);
  for (const Seconds time : times_) folder_times_.push_back(time.value());
  for (const auto& [time, name] : foam_time_folders(parts_.folders.front())) {
    const fs::path mesh = parts_.folders.front() / name / region_ / "polyMesh";
    if (has_foam_file(mesh / "points") || has_foam_file(mesh / "faces"))
      mesh_times_.emplace(time, name);
  }
}

fs::path FoamReader::first_time_folder() const {
  return parts_.folders.front() / names_.front() / region_;
}

void FoamReader::set_axes(const FoamAxes& axes) {
  if (axes == axes_) return;
  axes_ = axes;
  mesh_ = {};
}

void FoamReader::count_from_start() {
  const Seconds start = times_.front();
  for (Seconds& time : times_) time = time - start;
}

void FoamReader::each_part(const fs::path& relative, const auto& action) const {
  std::size_t part = 0;
  for (const fs::path& folder : parts_.folders) {
    const fs::path file = folder / relative;
    const std::string text = read_foam_file(file, root_);
    if (!parts_.collated) {
      action(part++, FoamBlock{text, {}}, file.string());
      continue;
    }
    const std::vector<FoamBlock> blocks = foam_blocks(text, file.string());
    for (std::size_t k = 0; k < blocks.size(); ++k)
      action(part++, blocks[k], file.string() + ", block " + std::to_string(k));
  }
}

std::string FoamReader::mesh_folder(double time, const std::string& file, double earliest) const {
  for (auto it = mesh_times_.rbegin(); it != mesh_times_.rend(); ++it) {
    if (it->first > time && !same_time(it->first, time)) continue;
    if (it->first < earliest) break;
    if (has_foam_file(parts_.folders.front() / it->second / region_ / "polyMesh" / file))
      return it->second;
  }
  return "constant";
}

void FoamReader::load_mesh(std::size_t index) {
  const double time = folder_times_[index];
  const std::string faces = mesh_folder(time, "faces", -std::numeric_limits<double>::infinity());
  const std::string points = mesh_folder(
      time, "points", time_in(faces).value_or(-std::numeric_limits<double>::infinity()));
  // Points that are older than the faces would belong to another mesh.
  const std::string of_points = points == "constant" ? faces : points;
  if (mesh_.grid && mesh_.faces_folder == faces && mesh_.points_folder == of_points) return;
  mesh_ = {};
  // One file of all parts is read at a time, and the parts' texts are kept until the meshes are
  // made of them.
  std::map<std::string, std::vector<std::string>> texts;
  std::map<std::string, std::vector<FoamHeader>> headers;
  for (const char* name : {"points", "faces", "owner", "neighbour", "boundary"}) {
    const std::string& from = std::string(name) == "points" ? of_points : faces;
    each_part(fs::path(from) / region_ / "polyMesh" / name,
              [&](std::size_t, const FoamBlock& block, const std::string&) {
                texts[name].emplace_back(block.text);
                headers[name].push_back(block.header);
              });
    if (texts[name].size() != parts_.processors)
      throw Error(root_.string() + ": " + name + " of " + std::to_string(texts[name].size()) +
                  " processors found, " + std::to_string(parts_.processors) + " expected");
  }
  std::vector<FoamMesh> meshes;
  for (std::size_t k = 0; k < texts["points"].size(); ++k) {
    const fs::path folder = parts_.folders[std::min(k, parts_.folders.size() - 1)];
    const std::string place = (folder / faces / region_ / "polyMesh").string() +
                              (parts_.collated ? " (block " + std::to_string(k) + ")" : "");
    meshes.push_back(read_foam_mesh(
        [&](const std::string& name) {
          return FoamBlock{texts.at(name)[k], headers.at(name)[k]};
        },
        place));
  }
  const bool decomposed = parts_.collated || parts_.folders.front() != root_;
  if (decomposed) check_processor_patches(meshes);
  describe(meshes);
  mesh_.faces_folder = faces;
  mesh_.points_folder = of_points;
}

void FoamReader::describe(const std::vector<FoamMesh>& meshes) {
  std::size_t warped = 0, cells = 0;
  for (const FoamMesh& mesh : meshes) {
    mesh_.cells.push_back(mesh.cells);
    mesh_.patches.push_back(mesh.patches);
    mesh_.volume.insert(mesh_.volume.end(), mesh.volume.begin(), mesh.volume.end());
    warped += mesh.warped_faces;
    cells += mesh.cells;
    for (const FoamPatch& patch : mesh.patches) {
      mesh_.wedge = mesh_.wedge || (patch.type == "wedge" && patch.count > 0);
      if (patch.type != "empty") continue;
      for (std::size_t f = patch.start; f < patch.start + patch.count; ++f)
        for (std::size_t a = 0; a < 3; ++a) mesh_.empty_area[a] += std::abs(mesh.face_area[f][a]);
    }
  }
  if (cells == 0) throw Error(root_.string() + ": a mesh without cells");
  if (warped > 0) {
    const std::string notice = std::to_string(warped) +
                               " faces of the mesh are not flat (corners off by more than a tenth "
                               "of the face; checkMesh says more)";
    if (std::find(notices_.begin(), notices_.end(), notice) == notices_.end()) tell(notice);
  }
  mesh_.grid = foam_grid(meshes, axes_);
}

std::optional<std::size_t> FoamReader::empty_axis() const {
  if (mesh_.wedge)
    throw Error(root_.string() +
                ": wedge patches found (a flow round an axis), a 2D or 3D case expected");
  const Vec3& area = mesh_.empty_area;
  const double all = area[0] + area[1] + area[2];
  if (all == 0.0) return std::nullopt;
  const auto axis =
      static_cast<std::size_t>(std::max_element(area.begin(), area.end()) - area.begin());
  if (area[axis] < 0.999 * all)
    throw Error(root_.string() +
                ": empty patches that are oblique or normal to two axes found, "
                "normal to x, y or z expected");
  return axis;
}

bool FoamReader::has_field(std::size_t index, const std::string& field) const {
  return has_foam_file(parts_.folders.front() / names_[index] / region_ / field);
}

std::vector<double> FoamReader::values(std::size_t index, const std::string& field,
                                       std::size_t components) {
  std::vector<double> all;
  std::size_t parts = 0;
  each_part(fs::path(names_[index]) / region_ / field, [&](std::size_t part, const FoamBlock& block,
                                                           const std::string& place) {
    ++parts;
    if (part >= mesh_.cells.size()) return;
    const FoamField found = read_foam_field(block, place, root_, components, mesh_.cells[part]);
    check_location(found.location, index, place);
    const std::vector<FoamPatch>& patches = mesh_.patches[part];
    for (const std::string& name : found.patches) {
      const bool there = std::any_of(patches.begin(), patches.end(),
                                     [&](const FoamPatch& p) { return p.name == name; });
      if (name.starts_with("procBoundary") && !there)
        throw Error(place + ": patch " + name +
                    " found, which its processor's mesh does not have (files of two "
                    "processors exchanged?)");
    }
    all.insert(all.end(), found.values.begin(), found.values.end());
  });
  if (parts != mesh_.cells.size())
    throw Error(root_.string() + ", time " + names_[index] + ": " + field + " of " +
                std::to_string(parts) + " processors found, " + std::to_string(mesh_.cells.size()) +
                " expected");
  return all;
}

void FoamReader::check_location(const std::string& location, std::size_t index,
                                const std::string& place) {
  std::optional<double> stated;
  for (const fs::path& part : fs::path(location))
    if (const auto time = time_in(part.string())) stated = time;
  if (!stated || same_time(*stated, folder_times_[index])) return;
  const bool other_frame = std::any_of(folder_times_.begin(), folder_times_.end(),
                                       [&](double time) { return same_time(time, *stated); });
  if (other_frame && index > 0)
    throw Error(place + ": its header says that it was written for time " + number_text(*stated) +
                ", " + names_[index] + " expected (time folders exchanged or copied?)");
  elsewhere_.emplace(place, number_text(*stated));
}

void FoamReader::check_alpha(const std::vector<double>& alpha, std::size_t index,
                             const std::string& place) {
  double volume = 0.0;
  for (std::size_t c = 0; c < alpha.size(); ++c) {
    if (alpha[c] < -most_alpha_excess || alpha[c] > 1.0 + most_alpha_excess)
      throw Error(place + ": " + alpha_ + ": " + number_text(alpha[c]) + " in cell " +
                  std::to_string(c) + ", a volume fraction between 0 and 1 expected");
    lowest_alpha_ = std::min(lowest_alpha_, alpha[c]);
    highest_alpha_ = std::max(highest_alpha_, alpha[c]);
    volume += alpha[c] * mesh_.volume[c];
  }
  if (index == 0) first_volume_ = volume;
  if (!first_volume_ || !(*first_volume_ > 0.0)) return;
  const double change = volume / *first_volume_ - 1.0;
  if (std::abs(change) > std::abs(worst_change_)) {
    worst_change_ = change;
    worst_change_time_ = folder_times_[index];
  }
}

Frame FoamReader::read(std::size_t index, Fields fields) {
  MeshFrame frame;
  frame.time = times_.at(index);
  frame.alpha_name = alpha_;
  load_mesh(index);
  frame.alpha = values(index, alpha_, 1);
  check_alpha(frame.alpha, index, root_.string() + ", time " + names_[index]);
  frame.grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  frame.grid->ShallowCopy(mesh_.grid);
  frame.grid->GetCellData()->AddArray(cell_array(alpha_, 1, frame.alpha));
  if (fields.pressure && has_field(index, "p"))
    frame.grid->GetCellData()->AddArray(cell_array("p", 1, values(index, "p", 1)));
  if (fields.velocity && has_field(index, "U")) {
    std::vector<double> velocity = values(index, "U", 3);
    for (std::size_t i = 0; i + 2 < velocity.size(); i += 3) {
      const Vec3 u = axes_.read({velocity[i], velocity[i + 1], velocity[i + 2]});
      std::copy(u.begin(), u.end(), velocity.begin() + static_cast<std::ptrdiff_t>(i));
    }
    frame.grid->GetCellData()->AddArray(cell_array("U", 3, velocity));
  }
  return frame;
}

void FoamReader::leave_out_unfinished() {
  if (times_.size() < 2) return;
  try {
    (void)read(times_.size() - 1, Fields{.pressure = true, .velocity = true});
  } catch (const FoamCutShort& error) {
    tell("time " + names_.back() + " is unfinished (" + error.what() + "): left out");
    times_.pop_back();
    folder_times_.pop_back();
    names_.pop_back();
  }
}

std::vector<std::string> FoamReader::notices() const {
  std::vector<std::string> all = notices_;
  if (!elsewhere_.empty())
    all.push_back(std::to_string(elsewhere_.size()) +
                  " files say in their headers that they were "
                  "written for other times, " +
                  elsewhere_.begin()->first + " for " + elsewhere_.begin()->second +
                  ": read as the time of their folder");
  if (std::abs(worst_change_) > told_volume_change)
    all.push_back("the volume of water changes by up to " +
                  number_text(std::round(1e5 * worst_change_) / 1e3) +
                  " % from the first time (at " + number_text(worst_change_time_) + " s)");
  if (lowest_alpha_ < -told_alpha_excess || highest_alpha_ > 1.0 + told_alpha_excess)
    all.push_back(alpha_ + " lies between " + number_text(lowest_alpha_) + " and " +
                  number_text(highest_alpha_) + ", outside 0 and 1");
  return all;
}

}  // namespace surge::compare
