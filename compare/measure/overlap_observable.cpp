#include "compare/measure/flow_pattern.hpp"
#include "compare/measure/kinds.hpp"
#include "particle/support/error.hpp"

/// Overlap of the water with that of a reference run: FractionGrid and overlap(), on cells no finer
/// than either run. No value at times of which the reference has no frame.
namespace surge::compare {
namespace {

class Overlap : public FrameObservable {
 public:
  Overlap(const Run& reference, Metres cell, const std::string& name)
      : FrameObservable({{name, "1"}}),
        reference_(reference),
        cell_(cell),
        other_(reference.physics, reference.spacing) {}

 protected:
  [[nodiscard]] Values measure(FrameView& frame) override {
    const auto index = frame_at(reference_.frames->times(), frame.time());
    if (!index) return {std::nullopt};
    other_.show(reference_.frames->read(*index, {}));
    FractionGrid mine(reference_.physics, cell_), theirs(reference_.physics, cell_);
    mine.add(frame);
    theirs.add(other_);
    return {overlap(mine, theirs)};
  }

 private:
  const Run& reference_;
  Metres cell_;
  FrameView other_;
};

std::unique_ptr<Observable> make_overlap(Parameters& parameters, const std::string& name,
                                         const ObservableContext& context) {
  if (context.reference == nullptr)
    throw Error(name + ": found no run to compare with, expected --reference");
  const Run& reference = *context.reference;
  if (context.run.physics.dimension != reference.physics.dimension)
    throw Error(name + ": found " + std::to_string(context.run.physics.dimension) + "D and " +
                std::to_string(reference.physics.dimension) +
                "D, expected two runs of one dimension");
  Metres cell = overlap_cell(context.run, reference);
  if (const auto given = parameters.number("cell", Bounds::above(0.0))) cell = Metres(*given);
  return std::make_unique<Overlap>(reference, cell, name);
}

}  // namespace

ObservableKind overlap_kind() {
  return {"overlap", "water in both runs over water in either one, 1",
          "cell (m) [no finer than either run]; needs --reference", make_overlap};
}

}  // namespace surge::compare
