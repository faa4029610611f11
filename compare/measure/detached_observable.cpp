#include "compare/measure/flow_pattern.hpp"
#include "compare/measure/kinds.hpp"

/// Water that left the main body: detached() over time.
namespace surge::compare {
namespace {

class DetachedWater : public FrameObservable {
 public:
  DetachedWater(const Cohesion& cohesion, const std::string& name)
      : FrameObservable({{name + ".pieces", "1"}, {name + ".part", "1"}, {name + ".blurred", "1"}}),
        cohesion_(cohesion) {}

 protected:
  [[nodiscard]] Values measure(FrameView& frame) override {
    const Detached found = detached(frame, cohesion_);
    return {static_cast<double>(found.pieces), found.part, found.blurred};
  }

 private:
  Cohesion cohesion_;
};

std::unique_ptr<Observable> make(Parameters& parameters, const std::string& name,
                                 const ObservableContext& context) {
  Cohesion cohesion;
  cohesion.linking_length = context.front.linking_length;
  if (const auto length = parameters.number("linking", Bounds::above(0.0)))
    cohesion.linking_length = *length;
  if (const auto level = parameters.number("level", Bounds::open(0.0, 1.0)))
    cohesion.corner_level = *level;
  return std::make_unique<DetachedWater>(cohesion, name);
}

}  // namespace

ObservableKind detached_kind() {
  return {
      "detached",
      "water that left the main body: number of pieces, part of all water in them, part in cells "
      "too empty for any piece",
      "linking (spacings, particles) [2], level (volume fraction at corners, meshes) [0.5]", make};
}

}  // namespace surge::compare
