#include "compare/study/observables.hpp"

#include <algorithm>

#include "compare/measure/registry.hpp"
#include "particle/support/text.hpp"

namespace surge::compare {
namespace {

constexpr std::array<std::string_view, 8> words{"rms",     "arrival", "peak",      "peak-time",
                                                "impulse", "final",   "amplitude", "phase"};

std::string read_name(const TomlTable& table) {
  const std::string name = table.text("name");
  const auto good = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '-';
  };
  if (name.empty() || name.size() > 100 || name.front() == '.' || name.front() == '-' ||
      !std::all_of(name.begin(), name.end(), good))
    throw table.error("name", name, "a name of letters, digits, '.', '_' and '-'");
  return name;
}

std::string read_kind(const TomlTable& table) {
  std::vector<std::string_view> kinds;
  for (const ObservableKind& kind : observable_kinds()) kinds.push_back(kind.name);
  return std::string(kinds[table.choice("kind", kinds)]);
}

std::map<std::string, std::string> read_parameters(const TomlTable& table) {
  std::map<std::string, std::string> parameters;
  const auto given = table.optional_table("parameters");
  if (!given) return parameters;
  for (const std::string& key : given->keys()) {
    std::string list;
    for (const std::string& word : given->words(key)) list += (list.empty() ? "" : ";") + word;
    parameters[key] = list;
  }
  return parameters;
}

CurveMeasure measure_of(const TomlTable& table, const std::string& key, const std::string& word) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<CurveMeasure>(found - words.begin());
  throw table.error(key, word, "one of " + comma_list(words));
}

void read_compare(const TomlTable& table, StudyObservable& out) {
  if (table.has("compare")) {
    out.compare.clear();
    for (const std::string& word : table.texts("compare")) {
      const CurveMeasure measure = measure_of(table, "compare", word);
      if (std::count(out.compare.begin(), out.compare.end(), measure) > 0)
        throw table.error("compare", word + " twice", "it once");
      out.compare.push_back(measure);
    }
  }
  if (table.has("threshold")) out.threshold = table.scalar("threshold");
  if (table.has("period")) out.period = table.scalar("period");
  const auto asks = [&](CurveMeasure measure) {
    return std::count(out.compare.begin(), out.compare.end(), measure) > 0;
  };
  if (asks(CurveMeasure::arrival) && !out.threshold)
    throw table.error("threshold", "nothing", "the value whose arrival is compared");
  if ((asks(CurveMeasure::amplitude) || asks(CurveMeasure::phase)) && !out.period)
    throw table.error("period", "nothing", "that of the oscillation, s");
  if (table.has("window")) {
    const std::vector<std::string> ends = table.scalars("window");
    if (ends.size() != 2)
      throw table.error("window", std::to_string(ends.size()) + " entries", "two times, s");
    out.window = {ends[0], ends[1]};
  }
  if (const auto tolerance = table.optional_table("tolerance"))
    for (const std::string& word : tolerance->keys())
      out.tolerance[measure_of(*tolerance, word, word)] = tolerance->scalar(word);
}

StudyObservable read_one(const TomlTable& table) {
  StudyObservable out;
  out.place = table.place("");
  out.name = read_name(table);
  out.kind = read_kind(table);
  out.parameters = read_parameters(table);
  out.title = table.text_or("title", "");
  if (table.has("component")) {
    constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
    out.component = axes[table.choice("component", axes)];
  }
  if (table.has("references")) out.references = table.texts("references");
  read_compare(table, out);
  if (out.title.empty()) out.title = out.request();
  return out;
}

}  // namespace

std::string_view measure_text(CurveMeasure measure) {
  return words[static_cast<std::size_t>(measure)];
}

std::string StudyObservable::request() const {
  std::string text = kind;
  for (const auto& [key, value] : parameters)
    text.append(text == kind ? ":" : ",").append(key).append("=").append(value);
  return text;
}

std::vector<StudyObservable> read_observables(const TomlTable& root) {
  std::vector<StudyObservable> all;
  for (const TomlTable& table : root.tables("observable")) {
    StudyObservable one = read_one(table);
    if (std::any_of(all.begin(), all.end(), [&](const auto& x) { return x.name == one.name; }))
      throw table.error("name", one.name + " a second time", "different names");
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace surge::compare
