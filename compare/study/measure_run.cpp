#include "compare/study/measure_run.hpp"

#include "compare/measure/front_observable.hpp"
#include "compare/measure/measure_all.hpp"
#include "compare/measure/registry.hpp"
#include "compare/measure/stated.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

/// The observables of one pass; where each of the study's stands among them.
struct Pass {
  std::vector<std::unique_ptr<Observable>> observables;
  const FrontObservable* front = nullptr;
  const PatternObservable* pattern = nullptr;
  std::vector<std::optional<std::size_t>> place;  ///< empty where one could not be made
  /// The front by other choices: the name of each and its place among the observables.
  std::vector<std::pair<std::string, std::size_t>> variants{};
};

template <class T>
const T* add(Pass& pass, std::unique_ptr<T> observable) {
  const T* found = observable.get();
  pass.observables.push_back(std::move(observable));
  return found;
}

void add_asked(Pass& pass, MeasuredRun& measured, const MeasureRequest& request) {
  if (request.observables == nullptr) return;
  const ObservableContext context{measured.run, request.front.value_or(FrontOptions{}),
                                  request.reference ? &request.reference->run() : nullptr};
  for (const StudyObservable& asked : *request.observables) {
    measured.observed.emplace_back();
    pass.place.emplace_back();
    try {
      auto made = make_observable(asked.name, asked.kind, asked.parameters, context);
      pass.place.back() = pass.observables.size();
      pass.observables.push_back(std::move(made));
    } catch (const Error& error) {
      measured.observed.back().failure = error.what();
    }
  }
}

void add_variants(Pass& pass, const Run& run, const FrontOptions& front) {
  for (const auto& [name, options] : front_variants_of(run, front)) {
    pass.variants.emplace_back(name, pass.observables.size());
    pass.observables.push_back(std::make_unique<FrontObservable>(run, options, name));
  }
}

}  // namespace

MeasuredRun measure_for_study(Run run, const MeasureRequest& request) {
  MeasuredRun measured{std::move(run), {}, {}};
  Pass pass;
  if (request.front)
    pass.front =
        add(pass, std::make_unique<FrontObservable>(measured.run, *request.front, "front"));
  if (request.pattern)
    pass.pattern = add(pass, std::make_unique<PatternObservable>(measured.run, request.reference));
  add_asked(pass, measured, request);
  // Of the runs that are compared; of levels and single choices nobody asks how sure their front
  // is.
  if (request.front && request.pattern && !request.front->raw_maximum)
    add_variants(pass, measured.run, *request.front);
  std::vector<Findings> found = measure_all(measured.run, pass.observables);
  const std::size_t own = (pass.front != nullptr ? 1 : 0) + (pass.pattern != nullptr ? 1 : 0);
  for (std::size_t k = 0; k < own; ++k)
    if (found[k].failure) throw Error(*found[k].failure);
  if (pass.front != nullptr) {
    tell_of_front(measured.run, *pass.front, *request.front);
    measured.history = pass.front->history();
    measured.front = dimensionless(measured.history, measured.run.physics.scales());
  }
  for (const auto& [name, place] : pass.variants) {
    const auto& variant = dynamic_cast<const FrontObservable&>(*pass.observables[place]);
    if (found[place].failure)
      measured.run.notices.push_back("front with " + name + ": " + *found[place].failure);
    else
      measured.variants.push_back({name, variant.history()});
  }
  if (pass.pattern != nullptr) measured.pattern = pass.pattern->history();
  for (std::size_t k = 0; k < pass.place.size(); ++k)
    if (pass.place[k]) measured.observed[k] = std::move(found[*pass.place[k]]);
  return measured;
}

namespace {

StudyObservable of_case(const std::string& name, const std::string& kind, const std::string& title,
                        std::map<std::string, std::string> parameters = {}) {
  StudyObservable one;
  one.name = name;
  one.kind = kind;
  one.title = title;
  one.parameters = std::move(parameters);
  return one;
}

/// By its place and not by its name, which files of other programs do not know.
std::map<std::string, std::string> place_of(const Vec3& at, const std::vector<std::size_t>& axes) {
  std::map<std::string, std::string> out;
  for (const std::size_t a : axes) out[std::string(1, "xyz"[a])] = number_text(at[a]);
  return out;
}

}  // namespace

std::vector<StudyObservable> study_observables(const Study& study, const Run& reference) {
  if (!study.observables.empty()) return study.observables;
  std::vector<StudyObservable> all;
  const FrameView view(reference.physics, reference.spacing);
  for (const StatedPlace& gauge : stated_places(reference, "gauges")) {
    std::vector<std::size_t> axes{0};
    if (reference.physics.dimension == 3) axes.push_back(view.across());
    all.push_back(of_case("gauge-" + gauge.name, "gauge", "Height of the water at " + gauge.name,
                          place_of(gauge.place, axes)));
  }
  for (const StatedPlace& probe : stated_places(reference, "probes"))
    all.push_back(of_case("pressure-" + probe.name, "pressure", "Pressure at " + probe.name,
                          place_of(probe.place, view.axes())));
  const nlohmann::json::json_pointer forces("/case/forces");
  if (reference.manifest.is_object() && reference.manifest.contains(forces)) {
    for (const nlohmann::json& force : reference.manifest.at(forces)) {
      const std::string name = force.value("name", "");
      all.push_back(of_case("force-" + name, "force", "Force on " + name, {{"name", name}}));
    }
  }
  all.push_back(of_case("centre-of-mass", "centre-of-mass", "Centre of mass"));
  all.push_back(of_case("potential-energy", "potential-energy", "Potential energy"));
  all.push_back(of_case("kinetic-energy", "kinetic-energy", "Kinetic energy"));
  all.push_back(of_case("volume", "volume", "Volume of the water"));
  return all;
}

}  // namespace surge::compare
