#include "compare/measure/kinds.hpp"
#include "particle/support/error.hpp"

/// Sums over all water of a frame, drops included. A parcel i is a particle, V_i = l0^D, or a cell,
/// V_i = alpha_i times its volume; in 2D volumes are per metre of width (m2).
///   volume            V = sum_i V_i                     m3 | m2
///   centre of mass    X = sum_i V_i x_i / V             m, the frame's own coordinates
///   kinetic energy    K = 1/2 rho sum_i V_i |v_i|^2     J | J/m; in 2D v in the plane
///   potential energy  P = rho g sum_i V_i (z_i - floor) J | J/m; zero at the tank's floor
/// with x_i the particle's place or the cell's centre. Of a plane surface through cells the centre
/// is known to half a cell of that layer alone.
namespace surge::compare {
namespace {

const char* volume_unit(const Run& run) {
  return run.physics.dimension == 3 ? "m3" : "m2";
}
const char* energy_unit(const Run& run) {
  return run.physics.dimension == 3 ? "J" : "J/m";
}

double density_of(const Run& run, const std::string& name) {
  if (run.physics.density) return *run.physics.density;
  throw Error(name + ": found no density of the water in " + run.path.string() +
              ", expected --density");
}

/// What one parcel adds to a sum, per volume.
using Density = double (*)(const FrameView& frame, std::size_t i);

double one(const FrameView&, std::size_t) {
  return 1.0;
}

double half_speed_squared(const FrameView& frame, std::size_t i) {
  const Vec3 v = frame.velocity(i);
  double sum = 0.0;
  for (const std::size_t a : frame.axes()) sum += v[a] * v[a];
  return 0.5 * sum;
}

double height(const FrameView& frame, std::size_t i) {
  return frame.centre(i)[frame.up()] - frame.physics().floor();
}

class Sum : public FrameObservable {
 public:
  Sum(const std::string& name, const std::string& unit, Density density, double factor,
      Fields needs = {})
      : FrameObservable({{name, unit}}), density_(density), factor_(factor), needs_(needs) {}
  [[nodiscard]] Fields fields() const override { return needs_; }

 protected:
  [[nodiscard]] Values measure(FrameView& frame) override {
    if (needs_.velocity && !frame.has_velocity()) return {std::nullopt};
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const double volume = frame.volume(i);
      if (volume != 0.0) sum += volume * density_(frame, i);
    }
    return {factor_ * sum};
  }

 private:
  Density density_;
  double factor_;
  Fields needs_;
};

class CentreOfMass : public FrameObservable {
 public:
  explicit CentreOfMass(std::vector<Column> columns) : FrameObservable(std::move(columns)) {}

 protected:
  [[nodiscard]] Values measure(FrameView& frame) override {
    Vec3 moment{};
    double volume = 0.0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const double part = frame.volume(i);
      volume += part;
      for (const std::size_t a : frame.axes()) moment[a] += part * frame.centre(i)[a];
    }
    Values centre;
    for (const std::size_t a : frame.axes())
      centre.push_back(volume > 0.0 ? std::optional(moment[a] / volume) : std::nullopt);
    return centre;
  }
};

std::unique_ptr<Observable> make_volume(Parameters&, const std::string& name,
                                        const ObservableContext& context) {
  return std::make_unique<Sum>(name, volume_unit(context.run), one, 1.0);
}

std::unique_ptr<Observable> make_centre(Parameters&, const std::string& name,
                                        const ObservableContext& context) {
  std::vector<FrameObservable::Column> columns;
  const FrameView frame(context.run.physics, context.run.spacing);
  for (const std::size_t a : frame.axes()) columns.push_back({name + '.' + "xyz"[a], "m"});
  return std::make_unique<CentreOfMass>(std::move(columns));
}

std::unique_ptr<Observable> make_kinetic(Parameters&, const std::string& name,
                                         const ObservableContext& context) {
  return std::make_unique<Sum>(name, energy_unit(context.run), half_speed_squared,
                               density_of(context.run, name), Fields{.velocity = true});
}

std::unique_ptr<Observable> make_potential(Parameters&, const std::string& name,
                                           const ObservableContext& context) {
  return std::make_unique<Sum>(
      name, energy_unit(context.run), height,
      density_of(context.run, name) * context.run.physics.gravity_magnitude());
}

}  // namespace

ObservableKind volume_kind() {
  return {"volume", "all water, m3; in 2D m2", "", make_volume};
}
ObservableKind centre_of_mass_kind() {
  return {"centre-of-mass", "centre of all water, m, a column per axis", "", make_centre};
}
ObservableKind kinetic_energy_kind() {
  return {"kinetic-energy", "of all water, J; in 2D J per metre of width", "", make_kinetic};
}
ObservableKind potential_energy_kind() {
  return {"potential-energy", "of all water above the tank's floor, J; in 2D J/m", "",
          make_potential};
}

}  // namespace surge::compare
