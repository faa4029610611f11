#include "compare/measure/measured_text.hpp"

#include <algorithm>
#include <cstdio>
#include <ostream>

#include "compare/read/foam_case.hpp"
#include "particle/support/bounds.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;

std::string at_time(const std::optional<double>& value, Seconds time) {
  return (value ? six_digits(*value) : "none") + " at " + six_digits(time.value()) + " s";
}

void write_line(std::ostream& out, const TimeSeries& series) {
  out << "  " << series.name << " [" << series.unit << "]: " << series.values.size() << " times";
  if (series.absent() > 0) out << ", " << series.absent() << " of them without a value";
  if (series.values.empty()) {
    out << '\n';
    return;
  }
  out << "; first " << at_time(series.values.front(), series.times.front()) << ", last "
      << at_time(series.values.back(), series.times.back());
  std::optional<std::size_t> least, most;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    if (!series.values[i]) continue;
    if (!least || *series.values[i] < *series.values[*least]) least = i;
    if (!most || *series.values[i] > *series.values[*most]) most = i;
  }
  if (least) {
    out << ", least " << at_time(series.values[*least], series.times[*least]) << ", largest "
        << at_time(series.values[*most], series.times[*most]);
  }
  out << '\n';
}

/// A field of a line of CSV.
std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

json values_of(const std::vector<std::optional<double>>& values) {
  json out = json::array();
  for (const auto& value : values) out.push_back(value ? json(*value) : json(nullptr));
  return out;
}

}  // namespace

void write_table(std::ostream& out, const MeasuredSource& source) {
  out << source.name << '\n';
  for (std::size_t k = 0; k < source.findings.size(); ++k) {
    const Findings& found = source.findings[k];
    for (const TimeSeries& series : found.series) write_line(out, series);
    for (const Profile& profile : found.profiles) {
      out << "  " << profile.name << " [" << profile.unit << "]: " << profile.values.size()
          << " places at " << six_digits(profile.time.value()) << " s\n";
    }
    if (found.failure) out << "  " << source.requests[k] << ": failed: " << *found.failure << '\n';
  }
}

void write_csv(std::ostream& out, const std::vector<MeasuredSource>& sources) {
  out << "source,series,unit,time_s,x_m,value\n";
  const auto line = [&](const MeasuredSource& source, const std::string& name,
                        const std::string& unit, Seconds time, const std::string& place,
                        const std::optional<double>& value) {
    out << csv_quoted(source.name) << ',' << csv_quoted(name) << ',' << unit << ','
        << number_text(time.value()) << ',' << place << ',' << (value ? number_text(*value) : "")
        << '\n';
  };
  for (const MeasuredSource& source : sources) {
    for (const Findings& found : source.findings) {
      for (const TimeSeries& s : found.series)
        for (std::size_t i = 0; i < s.values.size(); ++i)
          line(source, s.name, s.unit, s.times[i], "", s.values[i]);
      for (const Profile& p : found.profiles)
        for (std::size_t i = 0; i < p.values.size(); ++i)
          line(source, p.name, p.unit, p.time, number_text(p.positions[i]), p.values[i]);
    }
  }
}

json to_json(const std::vector<MeasuredSource>& sources) {
  json out = json::array();
  for (const MeasuredSource& source : sources) {
    json entry{{"name", source.name},       {"path", source.path},
               {"series", json::array()},   {"profiles", json::array()},
               {"notices", source.notices}, {"failures", json::object()}};
    for (std::size_t k = 0; k < source.findings.size(); ++k) {
      const Findings& found = source.findings[k];
      for (const TimeSeries& s : found.series) {
        json times = json::array();
        for (const Seconds time : s.times) times.push_back(time.value());
        entry["series"].push_back({{"name", s.name},
                                   {"unit", s.unit},
                                   {"time_s", std::move(times)},
                                   {"value", values_of(s.values)},
                                   {"absent", s.absent()}});
      }
      for (const Profile& p : found.profiles) {
        entry["profiles"].push_back({{"name", p.name},
                                     {"unit", p.unit},
                                     {"asked_s", p.asked.value()},
                                     {"time_s", p.time.value()},
                                     {"x_m", p.positions},
                                     {"value", values_of(p.values)}});
      }
      for (const std::string& notice : found.notices) entry["notices"].push_back(notice);
      if (found.failure) entry["failures"][source.requests[k]] = *found.failure;
    }
    out.push_back(std::move(entry));
  }
  return out;
}

}  // namespace surge::compare
