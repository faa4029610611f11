#include "compare/commands/command_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "particle/support/error.hpp"
#include "particle/support/printable.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

template <class Kind>
std::optional<Kind> positive(const char* option, std::optional<double> value) {
  if (!value) return std::nullopt;
  if (!std::isfinite(*value) || *value <= 0.0) {
    throw Error(std::string(option) + ": " + std::to_string(*value) +
                " found, a positive number expected");
  }
  return Kind(*value);
}

std::string option_name(const std::string& key) {
  std::string name = "--" + key;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

std::vector<std::string> comma_words(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const auto first = text.find_first_not_of(' ', at);
    const auto last = text.find_last_not_of(' ', end == 0 ? 0 : end - 1);
    words.push_back(first < end && last != std::string::npos ? text.substr(first, last - first + 1)
                                                             : "");
    at = end + 1;
  }
  return words;
}

/// Whether an option may be about a source: our own runs state all that it could say.
bool may_concern(const std::string& key, const fs::path& source) {
  if (key == "alpha_array") return fs::exists(source / "system" / "controlDict");
  return !fs::exists(source / "manifest.json");
}

/// The source that `NAME=VALUE` or `VALUE` is about, and the value.
std::pair<std::size_t, std::string> addressed(const std::string& option, const std::string& key,
                                              const std::string& text,
                                              const std::vector<fs::path>& sources) {
  const std::vector<std::string> distinct = run_names(sources);
  const auto sign = text.find('=');
  if (sign != std::string::npos && sign > 0) {
    const std::string name = text.substr(0, sign);
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (name != sources[i].string() && name != run_name(sources[i]) && name != distinct[i])
        continue;
      if (found && sources[*found] != sources[i])
        throw Error(option + ": two sources are called \"" + name + "\", expected a path");
      found = i;
    }
    if (found) return {*found, text.substr(sign + 1)};
  }
  std::string names;
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!may_concern(key, sources[i])) continue;
    candidates.push_back(i);
    names += (names.empty() ? "" : ", ") + distinct[i];
  }
  // With one source there is no doubt, even if it refuses the option.
  if (candidates.empty() && sources.size() == 1) candidates.push_back(0);
  if (candidates.size() == 1) return {candidates.front(), text};
  if (candidates.empty())
    throw Error(option + ": \"" + text + "\" found, but every source states that itself");
  throw Error(option + ": \"" + text + "\" found, expected NAME=VALUE with one of " + names);
}

}  // namespace

void SourceArguments::add_to(CLI::App& app) {
  const std::string group = "What a source's files do not say (NAME=VALUE for one of several)";
  const auto add = [&](const std::string& key, const std::string& help, bool list) {
    given_.push_back(std::make_unique<Given>(Given{key, {}, list}));
    app.add_option(option_name(key), given_.back()->values, help)
        ->group(group)
        ->take_all()
        ->allow_extra_args(false)
        ->type_name(list ? "A,B,..." : "VALUE");
  };
  add("map", "file (TOML) with these facts, its keys as the options with _ for -", false);
  for (const SourceKey& key : source_keys()) add(key.name, key.help, key.list);
}

std::vector<SourceOptions> SourceArguments::get(const std::vector<fs::path>& sources,
                                                std::vector<SourceOptions> options) const {
  // The map comes first, so that an option beside it changes one fact of it.
  for (const auto& given : given_) {
    std::set<std::size_t> seen;
    for (const std::string& text : given->values) {
      const auto [index, value] = addressed(option_name(given->key), given->key, text, sources);
      if (!seen.insert(index).second)
        throw Error(option_name(given->key) + ": found twice for " + sources[index].string() +
                    ", expected once");
      if (given->key == "map") {
        options[index] = read_source_map(value, options[index]);
        continue;
      }
      const std::vector<std::string> words =
          given->list ? comma_words(value) : std::vector<std::string>{value};
      set_source_option(options[index], given->key, words, option_name(given->key), ".");
    }
  }
  return options;
}

SourceOptions SourceArguments::get(const fs::path& source, const SourceOptions& before) const {
  return get(std::vector<fs::path>{source}, std::vector<SourceOptions>{before}).front();
}

SourceOptions source_options(const StudyRun& run) {
  SourceOptions options;
  if (run.map) options = read_source_map(*run.map, options);
  for (const auto& [option, value] : run.read) {
    std::string name = option;
    std::replace(name.begin(), name.end(), '-', '_');
    const auto& keys = source_keys();
    const auto key =
        std::find_if(keys.begin(), keys.end(), [&](const SourceKey& k) { return k.name == name; });
    const std::string place = run.place + ".read." + option;
    if (key == keys.end())
      throw Error(place +
                  ": found no such option, expected one of those about a source's files in "
                  "surge-compare front --help");
    const std::vector<std::string> words =
        key->list ? comma_words(value) : std::vector<std::string>{value};
    set_source_option(options, name, words, place, ".");
  }
  return options;
}

void FrontArguments::add_to(CLI::App& app) {
  const auto add = [&](CLI::Option* option) {
    added_.push_back(option->group("Leading edge"));
    return option;
  };
  add(app.add_option("--strip-height", strip_height_,
                     "only water up to this height above the floor counts, m [0.015]; particles: "
                     "three spacings where that is more"));
  add(app.add_option("--linking-length", options_.linking_length,
                     "particles closer than this many spacings are connected"))
      ->capture_default_str();
  add(app.add_option("--bed-share", options_.bed_share,
                     "over water that lies in the tank: the front is where the water stands higher "
                     "than it by this share of the column above it"))
      ->check(CLI::Range(0.001, 0.999))
      ->capture_default_str();
  add(app.add_flag("--raw-maximum", options_.raw_maximum, "farthest water of all, drops included"));
}

bool FrontArguments::given() const {
  return std::any_of(added_.begin(), added_.end(),
                     [](const CLI::Option* option) { return option->count() > 0; });
}

FrontOptions FrontArguments::get(const std::optional<Study>& study) const {
  FrontOptions options = options_;
  (void)positive<double>("--linking-length", options.linking_length);
  if (study) {
    if (strip_height_) throw Error("--strip-height: given together with --study, which states it");
    options.strip_height = study->strip_height;
  } else if (strip_height_) {
    options.strip_height = *positive<Metres>("--strip-height", strip_height_);
  }
  return options;
}

void StudyArguments::add_to(CLI::App& app) {
  auto* runs = app.add_option("RUN", runs_, "run folders, OpenFOAM cases or particle files");
  app.add_option("--reference", reference_,
                 "run that the others are measured against (one more RUN)")
      ->excludes(app.add_option("--study", study_,
                                "study (TOML) that names runs, reference, strip and series")
                     ->excludes(runs));
  app.add_option("--runs", folder_, "folder of the study's runs")->capture_default_str();
  app.add_option("--published", published_, "published series (CSV) to compare with");
}

std::optional<Study> StudyArguments::study() const {
  if (!study_.empty()) return read_study(study_);
  if (runs_.empty() || reference_.empty())
    throw Error("RUN... with --reference REF, or --study FILE expected");
  return std::nullopt;
}

std::vector<fs::path> StudyArguments::runs(const std::optional<Study>& study) const {
  std::vector<fs::path> paths;
  if (study) {
    for (const StudyRun& run : study->runs) paths.push_back(run.folder(folder_));
    return paths;
  }
  bool has_reference = false;
  for (const std::string& run : runs_) {
    paths.emplace_back(run);
    has_reference = has_reference ||
                    fs::path(run).lexically_normal() == fs::path(reference_).lexically_normal();
  }
  if (!has_reference) paths.emplace_back(reference_);
  return paths;
}

std::string StudyArguments::reference(const std::optional<Study>& study) const {
  if (study) return study->reference;
  const std::vector<fs::path> sources = runs(study);
  const auto found = std::find_if(sources.begin(), sources.end(), [&](const fs::path& source) {
    return source.lexically_normal() == fs::path(reference_).lexically_normal();
  });
  return run_names(sources)[static_cast<std::size_t>(found - sources.begin())];
}

std::vector<PublishedSeries> StudyArguments::published(const std::optional<Study>& study) const {
  std::vector<PublishedSeries> series;
  for (const std::string& file : published_) series.push_back(read_series(file));
  if (study) {
    for (const std::string& name : study->published)
      series.push_back(read_series(series_file(*study, name)));
  }
  return series;
}

void print_notices(const Run& run) {
  for (const std::string& notice : run.notices)
    std::fprintf(stderr, "%s: notice: %s\n", run.name.c_str(), printable(notice).c_str());
}

}  // namespace surge::compare
