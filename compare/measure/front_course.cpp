#include "compare/measure/front_course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle/support/bounds.hpp"

namespace surge::compare {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string short_text(double value) {
  return number_text(std::round(value * 1e6) / 1e6);
}

/// By how far (m) the particle at the leading edge is ahead of the next one that could make it.
double lead_of(FrameView& view, double edge, const FrontOptions& options) {
  const double direction = view.physics().surge_direction();
  const double half = 0.5 * view.spacing();
  const FrontStrip strip = front_strip(view.physics(), Metres(view.spacing()), true, options);
  const double above = strip.lower - half + 1e-9 * half;
  const double foremost = direction * edge - half;
  double next = -infinity;
  std::size_t there = 0;
  for (const Vec3& x : view.particles()->position) {
    const double along = direction * x[0];
    if (x[view.up()] <= above || x[view.up()] > strip.upper) continue;
    if (along > foremost + 2e-9 * half) continue;
    if (along >= foremost - 2e-9 * half && ++there == 1) continue;
    next = std::max(next, along);
  }
  return foremost - next;
}

}  // namespace

void Leads::look(FrameView& view, double edge, const FrontOptions& options) {
  const double lead = lead_of(view, edge, options);
  if (!(lead > 0.2 * view.spacing())) return;
  ++count_;
  most_ = std::max(most_, lead);
}

std::vector<std::string> Leads::notices(std::size_t frames) const {
  if (count_ == 0) return {};
  return {"in " + std::to_string(count_) + " of " + std::to_string(frames) +
          " frames one particle makes the leading edge, up to " + short_text(most_) +
          " m ahead of the next"};
}

std::vector<std::string> course_notices(const Run& run, const FrontHistory& history) {
  if (!run.manifest.is_null() || run.is_mesh() || history.empty()) return {};
  const double l0 = run.spacing.value();
  const double wall =
      run.physics.far_wall() ? run.physics.far_wall()->value() - 4.0 * l0 : infinity;
  const auto step = [&](std::size_t i) {
    return i == 0 || i >= history.size() ? 0.0
                                         : (history[i].position - history[i - 1].position).value();
  };
  std::size_t back = 0, jumps = 0;
  std::string first_back, first_jump;
  double farthest = history.front().position.value();
  for (std::size_t i = 1; i < history.size() && farthest < wall; ++i) {
    const std::string place = " m at " + short_text(history[i].time.value()) + " s";
    const double here = history[i].position.value();
    if (here < farthest - 0.2 * l0 && back++ == 0)
      first_back = short_text(farthest) + " m to " + short_text(here) + place;
    if (step(i) > 2.0 * l0 && step(i) > 2.5 * std::max(step(i - 1), step(i + 1)) && jumps++ == 0)
      first_jump = short_text(step(i)) + place;
    farthest = std::max(farthest, here);
  }
  const std::string reason = " (water that leaves or joins the main body, or files out of order)";
  std::vector<std::string> notices;
  if (back > 0)
    notices.push_back("the leading edge goes back in " + std::to_string(back) +
                      " frames, first from " + first_back + reason);
  if (jumps > 0 && history.size() > 2)
    notices.push_back("the leading edge jumps in " + std::to_string(jumps) + " frames, first by " +
                      first_jump + reason);
  return notices;
}

}  // namespace surge::compare
