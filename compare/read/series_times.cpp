#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/read/delimited.hpp"
#include "compare/read/particle_reader.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

std::string rounded(double value) {
  return number_text(std::round(value * 1e9) / 1e9);
}

/// Numbers that are missing: what neighbours differ by at least is the rule.
void find_gaps(const std::vector<SeriesEntry>& entries, std::vector<std::string>& lines,
               std::vector<bool>& explained) {
  long long stride = std::numeric_limits<long long>::max();
  for (std::size_t i = 1; i < entries.size(); ++i)
    if (entries[i].number && entries[i - 1].number)
      stride = std::min(stride, *entries[i].number - *entries[i - 1].number);
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const auto before = entries[i - 1].number, here = entries[i].number;
    if (!before || !here || *here - *before == stride) continue;
    explained[i] = true;
    // Where numbers are times in millionths or steps of changing length, they are no count.
    if (stride > 1 && (*here - *before) % stride != 0) continue;
    lines.push_back("no file between " + entries[i - 1].files[0].filename().string() + " and " +
                    entries[i].files[0].filename().string() + ": a gap in the series");
  }
}

}  // namespace

std::vector<std::string> irregularities(const std::vector<SeriesEntry>& entries,
                                        const std::vector<Seconds>& times) {
  std::vector<std::string> lines;
  std::vector<bool> explained(entries.size(), false);
  find_gaps(entries, lines, explained);
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times.size(); ++i)
    intervals.push_back((times[i] - times[i - 1]).value());
  if (intervals.size() < 3) return lines;
  std::vector<double> sorted = intervals;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  const auto is_usual = [&](double interval) { return std::abs(interval - usual) <= 0.05 * usual; };
  const auto even = std::count_if(intervals.begin(), intervals.end(), is_usual);
  // Frames that are written at any time have no rule.
  if (2 * static_cast<std::size_t>(even) < intervals.size()) return lines;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (is_usual(intervals[i - 1])) continue;
    const bool told = explained[i] && std::any_of(lines.begin(), lines.end(), [&](const auto& l) {
                        return l.find(entries[i].files[0].filename().string()) != std::string::npos;
                      });
    if (told) continue;
    lines.push_back("from " + rounded(times[i - 1].value()) + " s to " + rounded(times[i].value()) +
                    " s are " + rounded(intervals[i - 1]) + " s, between most frames " +
                    rounded(usual) + " s");
  }
  return lines;
}

std::map<long long, double> read_time_file(const fs::path& file) {
  require_regular(file);
  const TextTable table = describe_table(file);
  const auto column = [&](std::initializer_list<const char*> names, std::size_t otherwise) {
    for (const char* name : names)
      for (std::size_t i = 0; i < table.columns.size(); ++i)
        if (plain_name(table.columns[i]) == name) return i;
    return otherwise;
  };
  const std::size_t number = column({"part", "number", "frame", "step", "file", "index", "n"}, 0);
  const std::size_t time = column({"time", "timestep", "time_s", "t"}, 1);
  std::map<long long, double> times;
  FileLines lines(file, table.begin, 0);
  std::string_view text;
  std::vector<std::string_view> fields;
  for (std::size_t line = table.line; lines.next(text); ++line) {
    if (trimmed(text).empty() || trimmed(text).front() == '#') continue;
    split_fields(text, table.delimiter, fields);
    const std::string place = file.string() + ":" + std::to_string(line) + ": ";
    if (fields.size() <= std::max(number, time))
      throw Error(place + std::to_string(fields.size()) +
                  " fields found, number and time expected");
    const auto n = number_in(fields[number], table.decimal);
    const auto t = number_in(fields[time], table.decimal);
    if (!n || !t || !std::isfinite(*t) || *n != std::round(*n) || std::abs(*n) > 1e15)
      throw Error(place + "found \"" + std::string(fields[number]) + "\" and \"" +
                  std::string(fields[time]) + "\", expected a whole number and a time");
    if (!times.emplace(static_cast<long long>(*n), *t).second)
      throw Error(place + "number " + std::string(fields[number]) + " a second time");
  }
  return times;
}

std::vector<SeriesEntry> with_parts(std::vector<SeriesEntry> entries,
                                    const SourceOptions& options) {
  std::vector<SeriesEntry> found;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    SeriesEntry& entry = entries[i];
    // What is numbered and timed by the options need not be read for its time, but for the last.
    const bool timed = options.time_step && entry.number && i + 1 < entries.size() &&
                       format_of(entry.files[0], options) == Format::vtk;
    if (entry.time || entry.parted || timed) {
      found.push_back(std::move(entry));
      continue;
    }
    std::vector<FilePart> parts = parts_of(entry.files[0], options);
    if (parts.size() > 1 && entry.files.size() > 1)
      throw Error(entry.files[0].string() + ": " + std::to_string(parts.size()) +
                  " times found in one of several files of a time, one expected");
    for (FilePart& part : parts) {
      SeriesEntry one = entry;
      if (!part.time) part.time = entry.part.time;  // of the name
      if (part.step) one.number = part.step;
      if (parts.size() > 1 && !part.step) one.number.reset();
      one.part = std::move(part);
      one.parted = true;
      found.push_back(std::move(one));
    }
  }
  return found;
}

}  // namespace surge::compare
