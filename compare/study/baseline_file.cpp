#include <zlib.h>

#include <cmath>
#include <fstream>
#include <set>

#include "compare/read/readers.hpp"
#include "compare/study/baseline.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/json.hpp"
#include "particle/support/version.hpp"
#include "particle/support/write_error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A table of the file that knows which keys it may have; all of them must be there.
class BaselineTable {
 public:
  BaselineTable(const json& value, std::string place) : value_(value), place_(std::move(place)) {
    if (!value_.is_object()) fail("", json_shown(value_), "a table");
  }

  [[nodiscard]] const json& at(const std::string& key) {
    asked_.insert(key);
    if (!value_.contains(key)) fail(key, "nothing", "an entry");
    return value_[key];
  }

  [[nodiscard]] double number(const std::string& key) {
    const json& value = at(key);
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(key, json_shown(value), "a finite number");
    return value.get<double>();
  }

  [[nodiscard]] double tolerance(const std::string& key) {
    const double value = number(key);
    if (value < 0.0) fail(key, json_shown(at(key)), "a tolerance of at least 0");
    return value;
  }

  [[nodiscard]] std::string text(const std::string& key) {
    const json& value = at(key);
    if (!value.is_string()) fail(key, json_shown(value), "a text");
    return value.get<std::string>();
  }

  [[nodiscard]] std::vector<double> numbers(const std::string& key) {
    const json& value = at(key);
    std::vector<double> list;
    if (!value.is_array() || value.empty()) fail(key, json_shown(value), "a list of numbers");
    for (const json& entry : value) {
      if (!entry.is_number() || !std::isfinite(entry.get<double>()))
        fail(key, json_shown(entry), "finite numbers");
      list.push_back(entry.get<double>());
    }
    return list;
  }

  [[nodiscard]] std::vector<std::string> words(const std::string& key) {
    const json& value = at(key);
    std::vector<std::string> list;
    if (!value.is_array()) fail(key, value.dump(), "a list of texts");
    for (const json& entry : value) {
      if (!entry.is_string()) fail(key, entry.dump(), "texts");
      list.push_back(entry.get<std::string>());
    }
    return list;
  }

  [[nodiscard]] BaselineTable table(const std::string& key) {
    return {at(key), place_ + " " + key + ":"};
  }

  [[nodiscard]] bool has(const std::string& key) const { return value_.contains(key); }

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

constexpr int format = 2;  ///< 1 held the leading edge alone

BaselineCurve read_curve(BaselineTable table) {
  BaselineCurve curve;
  curve.observable = table.text("observable");
  curve.series = table.text("series");
  curve.unit = table.text("unit");
  curve.interval = table.number("interval");
  if (table.has("profile_time_s")) curve.time = table.number("profile_time_s");
  const std::string places = curve.time ? "x_m" : "time_s";
  curve.at = table.numbers(places);
  curve.values = table.numbers("value");
  if (curve.at.size() != curve.values.size())
    table.fail("value", std::to_string(curve.values.size()) + " values",
               std::to_string(curve.at.size()) + " as of " + places);
  for (std::size_t i = 1; i < curve.at.size(); ++i)
    if (curve.at[i] <= curve.at[i - 1])
      table.fail(places, number_text(curve.at[i]), "increasing places");
  BaselineTable tolerance = table.table("tolerance");
  curve.tolerance = {tolerance.tolerance("absolute"), tolerance.tolerance("relative"),
                     tolerance.tolerance("time_s")};
  tolerance.finish();
  table.finish();
  return curve;
}

json to_json(const BaselineCurve& curve) {
  json out{{"observable", curve.observable},
           {"series", curve.series},
           {"unit", curve.unit},
           {"interval", curve.interval},
           {curve.time ? "x_m" : "time_s", curve.at},
           {"value", curve.values},
           {"tolerance",
            {{"absolute", curve.tolerance.absolute},
             {"relative", curve.tolerance.relative},
             {"time_s", curve.tolerance.time}}}};
  if (curve.time) out["profile_time_s"] = *curve.time;
  return out;
}

void read_head(BaselineTable& table, Baseline& baseline) {
  BaselineTable measured = table.table("measured");
  baseline.measured = {measured.text("by"),     measured.text("date"),     measured.text("version"),
                       measured.text("commit"), measured.text("compiler"), measured.text("cpu"),
                       measured.text("reason")};
  measured.finish();
  BaselineTable source = table.table("read");
  for (const std::string& key : source.keys()) baseline.read[key] = source.words(key);
  BaselineTable definition = table.table("definition");
  baseline.front.strip_height = Metres(definition.number("strip_height_m"));
  baseline.front.linking_length = definition.number("linking_length_spacings");
  baseline.front.bed_share = definition.number("bed_share");
  definition.finish();
  BaselineTable identity = table.table("identity");
  for (const std::string& key : identity.keys()) baseline.identity[key] = identity.text(key);
  BaselineTable window = table.table("window");
  baseline.from = window.number("from_s");
  baseline.until = window.number("until_s");
  baseline.because = window.text("because");
  window.finish();
}

}  // namespace

std::string baseline_checksum(json root) {
  root.erase("checksum");
  const std::string text = root.dump();
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
  return std::to_string(sum);
}

Baseline read_baseline(const fs::path& file) {
  const json root = read_json(file);
  BaselineTable table(root, file.string() + ":");
  if (!table.has("format") || table.number("format") != format)
    table.fail("format", table.has("format") ? root["format"].dump() : "nothing",
               std::to_string(format) + " (one of another version: remove it and --bless again)");
  if (table.text("checksum") != baseline_checksum(root))
    table.fail("checksum", root["checksum"].dump() + " of other contents",
               "a file as --bless wrote it (--bless --reason is the way to change one)");
  Baseline baseline;
  read_head(table, baseline);
  const json& curves = table.at("curves");
  if (!curves.is_array() || curves.empty())
    table.fail("curves", curves.dump(), "a list of curves, one at least");
  for (std::size_t k = 0; k < curves.size(); ++k)
    baseline.curves.push_back(read_curve(
        BaselineTable(curves[k], file.string() + ": curves[" + std::to_string(k) + "]:")));
  BaselineTable values = table.table("values");
  for (const std::string& key : values.keys()) {
    BaselineTable value = values.table(key);
    baseline.values[key] = {value.number("value"), value.tolerance("tolerance")};
    value.finish();
  }
  table.finish();
  return baseline;
}

void write_baseline(const fs::path& file, const Baseline& baseline) {
  json curves = json::array();
  for (const BaselineCurve& curve : baseline.curves) curves.push_back(to_json(curve));
  json values = json::object();
  for (const auto& [name, value] : baseline.values)
    values[name] = {{"value", value.value}, {"tolerance", value.tolerance}};
  const Provenance& m = baseline.measured;
  json root{
      {"format", format},
      {"measured",
       {{"by", m.by},
        {"date", m.date},
        {"version", m.version},
        {"commit", m.commit},
        {"compiler", m.compiler},
        {"cpu", m.cpu},
        {"reason", m.reason}}},
      {"read", baseline.read},
      {"definition",
       {{"strip_height_m", baseline.front.strip_height.value()},
        {"linking_length_spacings", baseline.front.linking_length},
        {"bed_share", baseline.front.bed_share}}},
      {"identity", baseline.identity},
      {"window",
       {{"from_s", baseline.from}, {"until_s", baseline.until}, {"because", baseline.because}}},
      {"curves", curves},
      {"values", values}};
  // What is stored is what is read back, so that the sum is that of the file's numbers.
  root["checksum"] = baseline_checksum(json::parse(root.dump()));
  errno = 0;
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  const fs::path part = file.string() + ".part";
  std::ofstream out(part);
  out << root.dump(1) << '\n';
  out.close();
  if (!out) throw write_error(part);
  fs::rename(part, file);
}

}  // namespace surge::compare
