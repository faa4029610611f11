#include "compare/measure/kinds.hpp"
#include "compare/measure/recorded.hpp"
#include "compare/measure/stated.hpp"
#include "particle/support/error.hpp"

/// Force of the water on a wall, an obstacle or a moving wall over time, as the program recorded
/// it: columns force_NAME_x, force_NAME_y and, in 3D, force_NAME_z of surge-particle's steps.csv,
/// or postProcessing/OBJECT/*/force.dat of OpenFOAM's function object `forces` (pressure and
/// viscous stress on its patches), OBJECT that which the manifest states for NAME, else NAME. N; in
/// 2D N per metre of width, the force on the mesh over the thickness of its one layer of cells.
namespace surge::compare {
namespace {

/// The columns along the axes of a run, in their order.
Recorded read_force(const Run& run, const std::string& surface,
                    const std::vector<std::size_t>& axes) {
  if (run.is_mesh()) {
    Recorded all = read_foam_force(run, recording_object(run, "forces", surface));
    Recorded table{std::move(all.time), {}};
    for (const std::size_t a : axes) table.values.push_back(std::move(all.values[a]));
    return table;
  }
  std::vector<std::string> columns;
  columns.reserve(axes.size());
  for (const std::size_t a : axes) columns.push_back("force_" + surface + '_' + "xyz"[a]);
  return read_recorded_csv(run.path / "steps.csv", columns);
}

class Force : public Observable {
 public:
  Force(const Run& run, const std::string& surface, std::string name)
      : name_(std::move(name)),
        flat_(run.physics.dimension == 2),
        of_mesh_(run.is_mesh()),
        axes_(FrameView(run.physics, run.spacing).axes()),
        table_(read_force(run, surface, axes_)) {}

  /// The thickness of a 2D mesh is in its frames.
  [[nodiscard]] bool looks_at(std::size_t index) const override {
    return index == 0 && flat_ && of_mesh_;
  }
  void look(FrameView& frame) override { thickness_ = frame.thickness(); }

  [[nodiscard]] Findings findings() override {
    Findings found;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      TimeSeries series{name_ + '.' + "xyz"[axes_[k]], flat_ ? "N/m" : "N", {}, {}};
      for (const double time : table_.time) series.times.emplace_back(time);
      for (const double value : table_.values[k]) series.values.emplace_back(value / thickness_);
      found.series.push_back(std::move(series));
    }
    return found;
  }

 private:
  std::string name_;
  bool flat_, of_mesh_;
  std::vector<std::size_t> axes_;
  Recorded table_;  ///< a column per axis
  double thickness_ = 1.0;
};

std::unique_ptr<Observable> make_force(Parameters& parameters, const std::string& name,
                                       const ObservableContext& context) {
  const auto surface = parameters.text("name");
  if (!surface) parameters.fail("name", "nothing", "that of the surface");
  if (context.planned) {
    require_stated(context.run, "forces", *surface, name);
    return nullptr;
  }
  return std::make_unique<Force>(context.run, *surface, name);
}

}  // namespace

ObservableKind force_kind() {
  return {"force", "force of the water on a surface, N; in 2D N/m; a column per axis",
          "name of the surface ([[force]] of the case, function object of OpenFOAM)", make_force};
}

}  // namespace surge::compare
