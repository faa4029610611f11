#include "compare/measure/measure_all.hpp"

#include <algorithm>

#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

std::string absence_of(const TimeSeries& series) {
  const auto first = std::find(series.values.begin(), series.values.end(), std::nullopt);
  const auto at = static_cast<std::size_t>(first - series.values.begin());
  return series.name + ": no value at " + std::to_string(series.absent()) + " of " +
         std::to_string(series.values.size()) + " times, first at " +
         number_text(series.times[at].value()) + " s";
}

/// An observable until it fails.
class Follower {
 public:
  explicit Follower(Observable& observable) : observable_(observable) {}

  [[nodiscard]] bool looks_at(std::size_t index) const {
    return !failure_ && observable_.looks_at(index);
  }
  [[nodiscard]] Fields fields() const { return observable_.fields(); }
  void look(FrameView& view) {
    attempt([&] { observable_.look(view); });
  }
  [[nodiscard]] Findings findings() {
    Findings found;
    if (!failure_) attempt([&] { found = observable_.findings(); });
    if (failure_) return {{}, {}, {}, failure_};
    if (lacks_fields(found))
      return {{},
              {},
              {},
              found.series.front().name + ": the frames hold no " +
                  (fields().pressure ? "pressure" : "velocity") + ", one expected"};
    for (const TimeSeries& series : found.series)
      if (series.absent() > 0) found.notices.push_back(absence_of(series));
    return found;
  }

 private:
  /// A foreign program's files may have neither pressure nor velocity.
  [[nodiscard]] bool lacks_fields(const Findings& found) const {
    if (!fields().pressure && !fields().velocity) return false;
    return !found.series.empty() &&
           std::all_of(found.series.begin(), found.series.end(), [](const TimeSeries& series) {
             return !series.values.empty() && series.absent() == series.values.size();
           });
  }
  void attempt(const auto& action) {
    try {
      action();
    } catch (const Error& error) {
      failure_ = error.what();
    }
  }

  Observable& observable_;
  std::optional<std::string> failure_;
};

}  // namespace

std::vector<Findings> measure_all(Run& run,
                                  const std::vector<std::unique_ptr<Observable>>& observables) {
  std::vector<Follower> followers;
  followers.reserve(observables.size());
  for (const auto& observable : observables) followers.emplace_back(*observable);
  FrameView view(run.physics, run.spacing);
  for (std::size_t i = 0; i < run.frames->times().size(); ++i) {
    Fields fields;
    std::vector<Follower*> looking;
    for (Follower& follower : followers) {
      if (!follower.looks_at(i)) continue;
      looking.push_back(&follower);
      fields.pressure = fields.pressure || follower.fields().pressure;
      fields.velocity = fields.velocity || follower.fields().velocity;
    }
    if (looking.empty()) continue;
    view.show(run.frames->read(i, fields));
    for (Follower* follower : looking) follower->look(view);
  }
  std::vector<Findings> all;
  all.reserve(followers.size());
  for (Follower& follower : followers) all.push_back(follower.findings());
  for (const std::string& notice : run.frames->notices()) {
    if (std::find(run.notices.begin(), run.notices.end(), notice) == run.notices.end())
      run.notices.push_back(notice);
  }
  return all;
}

}  // namespace surge::compare
