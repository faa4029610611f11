#include "compare/study/limits.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;

constexpr double no_limit = std::numeric_limits<double>::quiet_NaN();

/// A number with the place where it is.
struct Measured {
  std::optional<double> value;
  std::string at;
};

std::optional<double> number(const json& front, const std::string& key) {
  const auto found = front.find(key);
  if (found == front.end() || !found->is_number()) return std::nullopt;
  const double value = found->get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Measured largest_arrival(const json& front) {
  Measured worst;
  // Of its own, as a loop keeps what items() belongs to no longer than its first line.
  const json differences = front.value("arrival_T_difference", json::object());
  for (const auto& [level, value] : differences.items()) {
    if (!value.is_number()) continue;
    const double late = value.get<double>();
    if (worst.value && std::abs(*worst.value) >= std::abs(late)) continue;
    worst = {late, "Z/L = " + level};
  }
  return worst;
}

std::optional<double> limit_of(const std::map<std::string, double>& limits,
                               const std::string& run) {
  const auto own = limits.find(run);
  const auto all = limits.find("");
  if (own != limits.end()) return own->second;
  return all == limits.end() ? std::nullopt : std::optional(all->second);
}

Finding judge(const std::string& quantity, const Measured& measured, double limit) {
  Finding finding{quantity, Status::failed, measured.at, "missing", "at most " + number_text(limit),
                  "1",      no_limit,       limit,       ""};
  if (!measured.value) return finding;
  finding.found = number_text(*measured.value);
  finding.deviation = *measured.value;
  if (std::abs(*measured.value) <= limit) finding.status = Status::passed;
  return finding;
}

void check_names(const json& metrics, const Limits& limits, const std::string& reference) {
  for (const auto* group : {&limits.rms, &limits.maximum, &limits.bias, &limits.arrival})
    for (const auto& [name, value] : *group)
      if (!name.empty() && (name == reference || !metrics["front"].contains(name)))
        throw Error("limit of \"" + name + "\": found no such run beside the reference, expected " +
                    "the name of one");
}

}  // namespace

bool Limits::any() const {
  return !rms.empty() || !maximum.empty() || !bias.empty() || !arrival.empty();
}

std::vector<CheckReport> check_limits(const json& metrics, const Limits& limits) {
  const std::string reference = metrics["definition"]["reference"].get<std::string>();
  check_names(metrics, limits, reference);
  std::vector<CheckReport> reports;
  for (const auto& [name, front] : metrics["front"].items()) {
    if (name == reference) continue;
    CheckReport report{name, reference, "", {}, {}, ""};
    const std::string against = front.contains("rms_vs_vof") ? "vof" : "reference";
    if (const auto limit = limit_of(limits.rms, name))
      report.findings.push_back(
          judge("RMS of Z/L", {number(front, "rms_vs_" + against), ""}, *limit));
    if (const auto limit = limit_of(limits.maximum, name)) {
      const auto at = number(front, "max_at_T");
      report.findings.push_back(judge(
          "difference of Z/L",
          {number(front, "max_vs_" + against), at ? "T = " + number_text(*at) : std::string()},
          *limit));
    }
    if (const auto limit = limit_of(limits.bias, name))
      report.findings.push_back(
          judge("bias of Z/L", {number(front, "bias_vs_" + against), ""}, *limit));
    if (const auto limit = limit_of(limits.arrival, name))
      report.findings.push_back(judge("arrival in T", largest_arrival(front), *limit));
    if (!report.findings.empty()) reports.push_back(std::move(report));
  }
  if (reports.empty())
    throw Error("nothing was compared: found no run beside the reference " + reference +
                " that a limit holds for");
  return reports;
}

}  // namespace surge::compare
