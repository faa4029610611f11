#include <algorithm>
#include <cmath>
#include <map>

#include "compare/measure/height.hpp"
#include "compare/measure/kinds.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

/// Free surface at given times: water_height() at equal steps of x from wall to wall, in the middle
/// of each step. A time is that of the nearest frame, which must be within half a frame interval.
namespace surge::compare {
namespace {

struct Grid {
  double begin = 0.0, end = 0.0, step = 0.0;  ///< m
};

class ProfileObservable : public Observable {
 public:
  ProfileObservable(const Run& run, const std::vector<double>& asked, const Grid& grid,
                    std::optional<double> across, const std::string& name)
      : grid_(grid), across_(across), name_(name) {
    for (const double time : asked) {
      const auto index = frame_near(run.frames->times(), Seconds(time));
      if (!index)
        throw Error(name + ": times: found no frame of " + run.path.string() +
                    " within half an interval of " + number_text(time) + " s, expected one");
      asked_.emplace(*index, Seconds(time));
    }
    for (const auto& [index, time] : asked_) order_.push_back(index);
    order_.erase(std::unique(order_.begin(), order_.end()), order_.end());
  }

  [[nodiscard]] bool looks_at(std::size_t index) const override { return asked_.contains(index); }

  void look(FrameView& frame) override {
    const std::size_t index = order_.at(looked_++);
    Profile profile{name_, "m", "m", {}, frame.time(), {}, {}};
    const auto count =
        static_cast<std::size_t>(std::max(1.0, std::round((grid_.end - grid_.begin) / grid_.step)));
    const double step = (grid_.end - grid_.begin) / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double x = grid_.begin + (static_cast<double>(k) + 0.5) * step;
      profile.positions.push_back(x);
      profile.values.emplace_back(water_height(frame, {x, across_}));
    }
    const auto [begin, end] = asked_.equal_range(index);
    for (auto it = begin; it != end; ++it) {
      profile.asked = it->second;
      found_.profiles.push_back(profile);
    }
  }

  [[nodiscard]] Findings findings() override { return std::move(found_); }

 private:
  Grid grid_;
  std::optional<double> across_;
  std::string name_;
  std::multimap<std::size_t, Seconds> asked_;  ///< by frame
  std::vector<std::size_t> order_;             ///< frames, in the order of time
  std::size_t looked_ = 0;
  Findings found_;
};

std::unique_ptr<Observable> make_profile(Parameters& parameters, const std::string& name,
                                         const ObservableContext& context) {
  const Physics& physics = context.run.physics;
  const std::vector<double> times = parameters.numbers("times");
  if (times.empty())
    parameters.fail("times", "nothing", "one time or more (s), as in times=0.1;0.2");
  Grid grid;
  const auto side = [&](const char* key, double known) {
    if (const auto given = parameters.number(key)) return *given;
    if (!std::isfinite(known))
      parameters.fail(key, "nothing", "a place (m), as the tank is not known");
    return known;
  };
  const bool tank = physics.tank.has_value();
  grid.begin = side("from", tank ? physics.tank->lower[0] : std::nan(""));
  grid.end = side("to", tank ? physics.tank->upper[0] : std::nan(""));
  if (!(grid.end > grid.begin)) parameters.fail("to", number_text(grid.end), "a place beyond from");
  grid.step = parameters.number("step", Bounds::above(0.0)).value_or(context.run.spacing.value());
  std::optional<double> across;
  if (physics.dimension == 3) across = parameters.number(physics.vertical_axis() == 1 ? "z" : "y");
  if (context.planned) return nullptr;
  return std::make_unique<ProfileObservable>(context.run, times, grid, across, name);
}

}  // namespace

ObservableKind profile_kind() {
  return {
      "profile", "height of the water over x at given times, m",
      "times (s, separated by ;), step (m) [spacing], from, to (m) [the tank]; in 3D z or y (m): "
      "without it over the whole width",
      make_profile};
}

}  // namespace surge::compare
