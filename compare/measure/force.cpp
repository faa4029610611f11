#include "compare/measure/kinds.hpp"
#include "compare/measure/recorded.hpp"
#include "particle/support/error.hpp"

/// Force of the water on a wall, an obstacle or a moving wall over time, as the program recorded
/// it: forces.csv of surge-particle (NAME_x, NAME_y, NAME_z), or postProcessing/NAME/*/force.dat of
/// OpenFOAM's function object `forces` (pressure and viscous stress on its patches). N; in 2D N per
/// metre of width, the force on the mesh over the thickness of its one layer of cells.
namespace surge::compare {
namespace {

class Force : public Observable {
 public:
  Force(const Run& run, Recorded table, std::string name)
      : table_(std::move(table)),
        name_(std::move(name)),
        flat_(run.physics.dimension == 2),
        of_mesh_(run.is_mesh()),
        axes_(FrameView(run.physics, run.spacing).axes()) {}

  /// The thickness of a 2D mesh is in its frames.
  [[nodiscard]] bool looks_at(std::size_t index) const override {
    return index == 0 && flat_ && of_mesh_;
  }
  void look(FrameView& frame) override { thickness_ = frame.thickness(); }

  [[nodiscard]] Findings findings() override {
    Findings found;
    for (const std::size_t a : axes_) {
      TimeSeries series{name_ + '.' + "xyz"[a], flat_ ? "N/m" : "N", {}, {}};
      for (const double time : table_.time) series.times.emplace_back(time);
      for (const double value : table_.values[a]) series.values.emplace_back(value / thickness_);
      found.series.push_back(std::move(series));
    }
    return found;
  }

 private:
  Recorded table_;
  std::string name_;
  bool flat_, of_mesh_;
  std::vector<std::size_t> axes_;
  double thickness_ = 1.0;
};

std::unique_ptr<Observable> make(Parameters& parameters, const std::string& name,
                                 const ObservableContext& context) {
  const auto surface = parameters.text("name");
  if (!surface) parameters.fail("name", "nothing", "that of the surface");
  const Run& run = context.run;
  Recorded table = run.is_mesh()
                       ? read_foam_force(run, *surface)
                       : read_recorded_csv(run.path / "forces.csv",
                                           {*surface + "_x", *surface + "_y", *surface + "_z"});
  return std::make_unique<Force>(run, std::move(table), name);
}

}  // namespace

ObservableKind force_kind() {
  return {"force", "force of the water on a surface, N; in 2D N/m; a column per axis",
          "name of the surface ([[force]] of the case, function object of OpenFOAM)", make};
}

}  // namespace surge::compare
