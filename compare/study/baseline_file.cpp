#include <pwd.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <set>

#include "compare/read/readers.hpp"
#include "compare/study/baseline.hpp"
#include "particle/support/error.hpp"
#include "particle/support/version.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A table of the file that knows which keys it may have; all of them must be there.
class Table {
 public:
  Table(const json& value, std::string place) : value_(value), place_(std::move(place)) {
    if (!value_.is_object()) fail("", value_.dump(), "a table");
  }

  [[nodiscard]] const json& at(const std::string& key) {
    asked_.insert(key);
    if (!value_.contains(key)) fail(key, "nothing", "an entry");
    return value_[key];
  }

  [[nodiscard]] double number(const std::string& key) {
    const json& value = at(key);
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(key, value.dump(), "a finite number");
    return value.get<double>();
  }

  [[nodiscard]] double tolerance(const std::string& key) {
    const double value = number(key);
    if (value < 0.0) fail(key, at(key).dump(), "a tolerance of at least 0");
    return value;
  }

  [[nodiscard]] std::string text(const std::string& key) {
    const json& value = at(key);
    if (!value.is_string()) fail(key, value.dump(), "a text");
    return value.get<std::string>();
  }

  [[nodiscard]] std::vector<double> numbers(const std::string& key) {
    const json& value = at(key);
    std::vector<double> list;
    if (!value.is_array() || value.empty()) fail(key, value.dump(), "a list of numbers");
    for (const json& entry : value) {
      if (!entry.is_number() || !std::isfinite(entry.get<double>()))
        fail(key, entry.dump(), "finite numbers");
      list.push_back(entry.get<double>());
    }
    return list;
  }

  [[nodiscard]] Table table(const std::string& key) { return {at(key), place_ + " " + key + ":"}; }

  [[nodiscard]] std::vector<std::string> keys() const {
    std::vector<std::string> names;
    for (const auto& [key, value] : value_.items()) names.push_back(key);
    return names;
  }

  void finish() const {
    for (const std::string& key : keys()) {
      if (!asked_.contains(key)) fail(key, "an unknown key", "none");
    }
  }

  [[noreturn]] void fail(const std::string& key, const std::string& found,
                         const std::string& expected) const {
    throw Error(place_ + " " + key + (key.empty() ? "" : ": ") + found + " found, " + expected +
                " expected");
  }

 private:
  const json& value_;
  std::string place_;
  std::set<std::string> asked_;
};

DimensionlessFront read_front(Table& table) {
  const std::vector<double> times = table.numbers("T");
  const std::vector<double> positions = table.numbers("Z_over_L");
  if (times.size() != positions.size()) {
    table.fail("Z_over_L", std::to_string(positions.size()) + " values",
               std::to_string(times.size()) + " as of T");
  }
  DimensionlessFront front;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0 && times[i] <= times[i - 1])
      table.fail("T", std::to_string(times[i]), "increasing times");
    front.samples.push_back({DimensionlessTime(times[i]), DimensionlessLength(positions[i])});
  }
  return front;
}

void read_arrivals(Table table, Baseline& baseline) {
  baseline.arrival_tolerance = DimensionlessTime(table.tolerance("tolerance_T"));
  Table times = table.table("T");
  for (const std::string& level : times.keys()) {
    char* end = nullptr;
    const double value = std::strtod(level.c_str(), &end);
    if (end == level.c_str() || *end != '\0' || !std::isfinite(value))
      times.fail(level, "this key", "a level of Z/L");
    baseline.arrival[level] = DimensionlessTime(times.number(level));
  }
  table.finish();
}

std::string first_line_of(const char* command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command, "r"), pclose);
  std::array<char, 256> buffer{};
  if (!pipe || !std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe.get())) return {};
  const std::string line(buffer.data());
  return line.substr(0, line.find('\n'));
}

std::string user_name() {
  std::string git = first_line_of("git config user.name 2>/dev/null");
  if (!git.empty()) return git;
  const char* user = std::getenv("USER");
  if (user && *user) return user;
  const passwd* entry = getpwuid(getuid());
  if (entry) return entry->pw_name;
  throw Error("--bless: nobody found (git config user.name or USER expected)");
}

std::string cpu_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

Baseline read_baseline(const fs::path& file) {
  const json root = read_json(file);
  Table table(root, file.string() + ":");
  Baseline baseline;
  Table measured = table.table("measured");
  baseline.measured = {measured.text("by"),     measured.text("date"),     measured.text("version"),
                       measured.text("commit"), measured.text("compiler"), measured.text("cpu"),
                       measured.text("reason")};
  measured.finish();
  Table definition = table.table("definition");
  baseline.strip_height = Metres(definition.number("strip_height_m"));
  baseline.linking_length = definition.number("linking_length_spacings");
  definition.finish();
  Table identity = table.table("identity");
  for (const std::string& key : identity.keys()) baseline.identity[key] = identity.text(key);
  Table front = table.table("front");
  baseline.front_tolerance = DimensionlessLength(front.tolerance("tolerance_Z_over_L"));
  baseline.front = read_front(front);
  front.finish();
  read_arrivals(table.table("arrival"), baseline);
  Table scalars = table.table("scalars");
  for (const std::string& key : scalars.keys()) {
    Table scalar = scalars.table(key);
    baseline.scalars[key] = {scalar.number("value"), scalar.tolerance("tolerance")};
    scalar.finish();
  }
  table.finish();
  return baseline;
}

void write_baseline(const fs::path& file, const Baseline& baseline) {
  json times = json::array();
  json positions = json::array();
  // Four digits are finer than any tolerance of use, and keep the file readable.
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  for (const auto& sample : baseline.front.samples) {
    times.push_back(rounded(sample.time.value()));
    positions.push_back(rounded(sample.position.value()));
  }
  json arrivals = json::object();
  for (const auto& [level, time] : baseline.arrival) arrivals[level] = rounded(time.value());
  json scalars = json::object();
  for (const auto& [name, value] : baseline.scalars) {
    scalars[name] = {{"value", value.value}, {"tolerance", value.tolerance}};
  }
  const Provenance& m = baseline.measured;
  const json root{
      {"measured",
       {{"by", m.by},
        {"date", m.date},
        {"version", m.version},
        {"commit", m.commit},
        {"compiler", m.compiler},
        {"cpu", m.cpu},
        {"reason", m.reason}}},
      {"definition",
       {{"strip_height_m", baseline.strip_height.value()},
        {"linking_length_spacings", baseline.linking_length}}},
      {"identity", baseline.identity},
      {"front",
       {{"tolerance_Z_over_L", baseline.front_tolerance.value()},
        {"T", times},
        {"Z_over_L", positions}}},
      {"arrival", {{"tolerance_T", baseline.arrival_tolerance.value()}, {"T", arrivals}}},
      {"scalars", scalars}};
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  std::ofstream out(file);
  out << root.dump(1) << '\n';
  out.flush();
  if (!out) throw Error(file.string() + ": cannot be written");
}

Provenance provenance_now(const std::string& reason) {
  if (reason.find_first_not_of(" \t\n") == std::string::npos)
    throw Error("--bless: no reason found, --reason \"...\" expected");
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  const BuildInfo build = build_info();
  return {user_name(),    date.data(), build.version, build.commit,
          build.compiler, cpu_name(),  reason};
}

}  // namespace surge::compare
