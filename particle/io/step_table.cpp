#include "particle/io/step_table.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string_view>

#include "particle/case/enum_names.hpp"
#include "particle/io/restart_error.hpp"
#include "particle/support/regular_file.hpp"

namespace surge {

namespace {

constexpr std::size_t most_waiting = 65536;  ///< bytes

std::string time_text(double time) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", time);
  return text.data();
}

/// Reads the header and so many rows; fewer where there are no more. Gives the last line.
struct Rows {
  long count = -1;  ///< -1: not even a header
  std::string last;
  std::streamoff bytes = 0;  ///< up to the end of the last line
};
Rows read_rows(const std::filesystem::path& file, long rows) {
  Rows found;
  if (!std::filesystem::exists(file)) return found;
  std::ifstream stream = open_regular(file, most_table_bytes, "a table of steps");
  for (std::string line; found.count < rows && std::getline(stream, line) && !stream.eof();) {
    ++found.count;
    found.bytes += static_cast<std::streamoff>(line.size()) + 1;
    found.last = std::move(line);
  }
  return found;
}

}  // namespace

std::vector<std::string> recorded_columns(const Case& c) {
  std::vector<std::string> names;
  for (const Probe& probe : c.probes) names.push_back(probe.name);
  for (const ForceSurface& force : c.forces)
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a)
      names.push_back("force_" + force.name + '_' + std::string(axis_names[a]));
  return names;
}

StepTable::StepTable(std::filesystem::path file, const std::vector<std::string>& recorded)
    : file_(std::move(file)) {
  open(O_CREAT | O_TRUNC);
  waiting_ =
      "time,dt,courant,v_max,ppe_iterations,ppe_residual,ppe_setup_s,ppe_solve_s,"
      "particle_collisions,wall_collisions,clipped,lost";
  for (const std::string& name : recorded) waiting_ += ',' + name;
  waiting_ += '\n';
  flush();
}

StepTable::StepTable(std::filesystem::path file, long rows, double time)
    : file_(std::move(file)), rows_(rows), time_(time), written_(rows), written_until_(time) {
  open(0);
  written_bytes_ = lseek(descriptor_, 0, SEEK_END);
}

StepTable::~StepTable() {
  try {
    flush();
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch)
    // Who wants to know calls flush() first.
  }
  close(descriptor_);
}

void StepTable::open(int flags) {
  descriptor_ = ::open(file_.c_str(), flags | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor_ < 0) fail(errno);
}

void StepTable::add(double time, const StepReport& r, const std::vector<double>& recorded) {
  std::array<char, 256> row{};
  std::snprintf(row.data(), row.size(), ",%.6g,%.6g,%.6g,%d,%.4g,%.3g,%.3g,%ld,%ld,%ld,%ld", r.dt,
                r.courant, r.v_max, r.ppe_iterations, r.ppe_residual, r.ppe_setup_s, r.ppe_solve_s,
                r.particle_collisions, r.wall_collisions, r.clipped, r.lost);
  waiting_ += time_text(time) + row.data();
  for (const double value : recorded) {
    std::snprintf(row.data(), row.size(), ",%.7g", value);
    waiting_ += row.data();
  }
  waiting_ += '\n';
  ++rows_;
  time_ = time;
  if (waiting_.size() > most_waiting) flush();
}

void StepTable::flush() {
  std::string_view left = waiting_;
  while (!left.empty()) {
    const ssize_t count = write(descriptor_, left.data(), left.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int cause = errno;
      // Not half a row: what was written of these is taken back.
      if (ftruncate(descriptor_, written_bytes_) == 0) lseek(descriptor_, 0, SEEK_END);
      fail(cause);
    }
    left.remove_prefix(static_cast<std::size_t>(count));
  }
  written_ = rows_;
  written_until_ = time_;
  written_bytes_ += static_cast<long>(waiting_.size());
  waiting_.clear();
}

void StepTable::fail(int cause) const {
  throw Error(file_.string() + ": found " + std::strerror(cause) +
              ", expected a place to write to");
}

void check_rows(const std::filesystem::path& file, long rows, double time) {
  const Rows found = read_rows(file, rows);
  if (found.count < rows) {
    throw RestartError(file.string() + ": found " + std::to_string(std::max(found.count, 0L)) +
                       " rows, expected the " + std::to_string(rows) +
                       " that the checkpoint follows; --force starts anew");
  }
  if (!found.last.starts_with(time_text(time) + ','))
    throw RestartError(file.string() + ": found row " + std::to_string(rows) + " at " +
                       found.last.substr(0, std::min<std::size_t>(found.last.find(','), 40)) +
                       " s, expected " + time_text(time) +
                       " s as in the checkpoint; --force starts anew");
}

void cut_rows(const std::filesystem::path& file, long rows) {
  std::filesystem::resize_file(file, static_cast<std::uintmax_t>(read_rows(file, rows).bytes));
}

}  // namespace surge
