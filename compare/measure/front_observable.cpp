#include "compare/measure/front_observable.hpp"

#include <algorithm>
#include <cmath>

#include "compare/measure/front_pace.hpp"
#include "compare/measure/kinds.hpp"
#include "compare/measure/measure_all.hpp"
#include "compare/read/four_digits.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

/// What is assumed about the strip.
std::vector<std::string> assumed(const Run& run, const FrontOptions& options) {
  const double least = least_strip_spacings * run.spacing.value();
  const double bed = run.physics.bed_depth().value_or(Metres(0.0)).value();
  const FrontStrip strip = front_strip(run.physics, run.spacing, !run.is_mesh(), options);
  if (bed > 0.0) {
    const double level = std::round(1e6 * (strip.lower - run.physics.floor())) / 1e6;
    return {"front on a wet bed of " + four_digits(bed) +
            " m: where the water stands higher than " + four_digits(level) + " m"};
  }
  if (options.raw_maximum || run.is_mesh() || options.strip_height.value() >= least * (1.0 - 1e-9))
    return {};
  return {"front: a strip of " + number_text(options.strip_height.value()) +
          " m holds less than three spacings; " + four_digits(least) + " m are taken"};
}

}  // namespace

FrontObservable::FrontObservable(const Run& run, const FrontOptions& options,
                                 const std::string& name)
    : FrameObservable({{name, "m"}}), run_(run), options_(options) {
  for (std::string& notice : assumed(run, options)) tell(std::move(notice));
}

FrameObservable::Values FrontObservable::measure(FrameView& frame) {
  const Physics& physics = frame.physics();
  const auto edge = leading_edge(frame, options_);
  if (!edge && history_.empty())
    throw Error(run_.path.string() + ": no water connected to the main body within " +
                number_text(options_.strip_height.value()) +
                " m above the floor at the first frame");
  lost_ = !edge;
  if (lost_) return {std::nullopt};
  const Metres position(physics.surge_direction() * (*edge - physics.column_wall()));
  history_.push_back({frame.time(), position});
  const bool foreign = run_.kind == SourceKind::particle_series;
  if (foreign && !options_.raw_maximum) leads_.look(frame, *edge, options_);
  if (history_.size() == 1 && !options_.raw_maximum) check_front_start(run_, history_.front());
  return {position.value()};
}

std::vector<std::string> FrontObservable::course() const {
  std::vector<std::string> lines = course_notices(run_, history_);
  for (std::string& line : leads_.notices(history_.size())) lines.push_back(std::move(line));
  for (std::string& line : pace_notices(run_, history_)) lines.push_back(std::move(line));
  return lines;
}

Findings FrontObservable::findings() {
  check_front_speed(run_, history_);
  for (std::string& notice : course()) tell(std::move(notice));
  if (lost_)
    tell("no leading edge from " + number_text(run_.frames->times()[history_.size()].value()) +
         " s on (" + std::to_string(run_.frames->times().size() - history_.size()) +
         " frames left out)");
  return FrameObservable::findings();
}

void tell_of_front(Run& run, const FrontObservable& front, const FrontOptions& options) {
  for (std::string& notice : assumed(run, options)) run.notices.push_back(std::move(notice));
  for (std::string& notice : front.course()) run.notices.push_back(std::move(notice));
}

using NamedFront = std::pair<std::string, FrontOptions>;

std::vector<NamedFront> front_variants_of(const Run& run, const FrontOptions& options) {
  std::vector<NamedFront> all;
  if (run.physics.bed_depth().value_or(Metres(0.0)) > Metres(0.0)) {
    all.emplace_back("bed_share_x2", options).second.bed_share *= 2.0;
  } else {
    FrontOptions& strip = all.emplace_back("strip_x2", options).second;
    strip.strip_height = 2.0 * options.strip_height;
    if (!run.is_mesh())
      strip.strip_height = std::max(strip.strip_height, 2.0 * least_strip_spacings * run.spacing);
  }
  if (run.is_mesh()) return all;
  for (const double change : {-0.5, 0.5}) {
    const double length = options.linking_length + change;
    all.emplace_back("linking_" + number_text(length), options).second.linking_length = length;
  }
  return all;
}

FrontWithVariants measure_front_variants(Run& run, const FrontOptions& options) {
  std::vector<NamedFront> all{{"front", options}};
  if (!options.raw_maximum) {
    for (NamedFront& variant : front_variants_of(run, options)) all.push_back(std::move(variant));
  }
  std::vector<std::unique_ptr<Observable>> observables;
  for (const auto& [name, of] : all)
    observables.push_back(std::make_unique<FrontObservable>(run, of, name));
  const std::vector<Findings> found = measure_all(run, observables);
  if (found.front().failure) throw Error(*found.front().failure);
  tell_of_front(run, dynamic_cast<const FrontObservable&>(*observables.front()), options);
  FrontWithVariants result;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& history = dynamic_cast<const FrontObservable&>(*observables[k]).history();
    if (k == 0) {
      result.front = history;
    } else if (found[k].failure) {
      run.notices.push_back("front with " + all[k].first + ": " + *found[k].failure);
    } else {
      result.variants.push_back({all[k].first, history});
    }
  }
  return result;
}

FrontHistory measure_front(Run& run, const FrontOptions& options) {
  std::vector<std::unique_ptr<Observable>> one;
  one.push_back(std::make_unique<FrontObservable>(run, options, "front"));
  const std::vector<Findings> found = measure_all(run, one);
  if (found.front().failure) throw Error(*found.front().failure);
  tell_of_front(run, dynamic_cast<const FrontObservable&>(*one.front()), options);
  return dynamic_cast<const FrontObservable&>(*one.front()).history();
}

namespace {

std::unique_ptr<Observable> make_front(Parameters& parameters, const std::string& name,
                                       const ObservableContext& context) {
  FrontOptions options = context.front;
  if (const auto strip = parameters.number("strip", Bounds::above(0.0)))
    options.strip_height = Metres(*strip);
  if (const auto length = parameters.number("linking", Bounds::above(0.0)))
    options.linking_length = *length;
  if (const auto share = parameters.number("bed-share", Bounds::open(0.0, 1.0)))
    options.bed_share = *share;
  return std::make_unique<FrontObservable>(context.run, options, name);
}

}  // namespace

ObservableKind front_kind() {
  return {
      "front", "leading edge, from the wall that the column stands at, m",
      "strip (m above the floor), linking (spacings), bed-share (of the column above a wet bed)",
      make_front};
}

}  // namespace surge::compare
