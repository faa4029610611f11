#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/foam_grid.hpp"
#include "compare/read/foam_times.hpp"
#include "compare/read/run.hpp"

namespace surge::compare {

/// Frames of an OpenFOAM case from its own files: ascii, binary and compressed; serial, decomposed
/// and collated; fixed, moving and refined meshes. Nothing is believed that is not checked: sizes
/// of fields, the mesh (foam_mesh.hpp), that a field was written for its time and processor.
class FoamReader : public FrameReader {
 public:
  /// `region`: name of the region, empty where the case has none.
  FoamReader(std::filesystem::path root, FoamParts parts, std::string region, std::string alpha);

  [[nodiscard]] const std::vector<Seconds>& times() const override { return times_; }
  [[nodiscard]] Frame read(std::size_t index, Fields fields) override;
  [[nodiscard]] std::vector<std::string> notices() const override;

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }
  [[nodiscard]] const std::string& region() const { return region_; }
  [[nodiscard]] const std::string& alpha() const { return alpha_; }
  /// Folder of the first time in the first part.
  [[nodiscard]] std::filesystem::path first_time_folder() const;
  void tell(std::string notice) { notices_.push_back(std::move(notice)); }

  /// From now on frames come in these axes.
  void set_axes(const FoamAxes& axes);
  [[nodiscard]] const FoamAxes& axes() const { return axes_; }
  /// Times count from the first one.
  void count_from_start();
  /// What the case counts at the frames' time 0, s.
  [[nodiscard]] double start() const { return folder_times_.front() - times_.front().value(); }
  /// Volume of the cells of the frame that was read last, m3, in its order.
  [[nodiscard]] const std::vector<double>& volumes() const { return mesh_.volume; }
  /// Axis of the case normal to its `empty` patches; none in 3D. Throws surge::Error for a wedge.
  [[nodiscard]] std::optional<std::size_t> empty_axis() const;

  /// Leaves the last time out, with a notice, where it is cut short.
  void leave_out_unfinished();

 private:
  /// One mesh of all parts, as far as later frames need it.
  struct Mesh {
    std::string faces_folder, points_folder;  ///< relative to the part
    std::vector<std::size_t> cells;           ///< per part
    std::vector<std::vector<FoamPatch>> patches;
    std::vector<double> volume;
    Vec3 empty_area{};  ///< sum of |components| of the areas of `empty` faces
    bool wedge = false;
    vtkSmartPointer<vtkUnstructuredGrid> grid;
  };
  void load_mesh(std::size_t index);
  void describe(const std::vector<FoamMesh>& meshes);
  [[nodiscard]] std::string mesh_folder(double time, const std::string& file,
                                        double earliest) const;
  /// Calls action(part number, block, place) for a file of every part.
  void each_part(const std::filesystem::path& relative, const auto& action) const;
  std::vector<double> values(std::size_t index, const std::string& field, std::size_t components);
  [[nodiscard]] bool has_field(std::size_t index, const std::string& field) const;
  void check_location(const std::string& location, std::size_t index, const std::string& place);
  void check_alpha(const std::vector<double>& alpha, std::size_t index, const std::string& place);

  std::filesystem::path root_;
  FoamParts parts_;
  std::string region_;
  std::string alpha_;
  std::vector<Seconds> times_;
  std::vector<double> folder_times_;  ///< as the case counts
  std::vector<std::string> names_;
  std::map<double, std::string> mesh_times_;  ///< time folders with a mesh or points of their own
  std::vector<std::string> notices_;
  FoamAxes axes_;
  Mesh mesh_;

  std::optional<double> first_volume_;  ///< of the water, m3
  double worst_change_ = 0.0;           ///< relative
  double worst_change_time_ = 0.0;
  double lowest_alpha_ = 0.0, highest_alpha_ = 1.0;
  std::map<std::string, std::string> elsewhere_;  ///< files that were written for other times
};

}  // namespace surge::compare
