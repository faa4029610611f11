#include "compare/study/baseline.hpp"

#include <algorithm>
#include <cmath>

#include "particle/support/bounds.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// Where the files of a source lie: the folder itself, or that of the file or the pattern.
fs::path folder_of(const fs::path& source) {
  return fs::is_directory(source) ? source : source.parent_path();
}

}  // namespace

double Tolerance::of(double expected) const {
  return std::max(absolute, relative * std::abs(expected));
}

std::string BaselineCurve::name() const {
  return time ? series + " at " + number_text(*time) + " s" : series;
}

std::vector<std::string> Baseline::observables() const {
  std::vector<std::string> list;
  for (const BaselineCurve& curve : curves)
    if (std::find(list.begin(), list.end(), curve.observable) == list.end())
      list.push_back(curve.observable);
  return list;
}

SourceOptions stored_options(const Baseline& baseline, const fs::path& source,
                             const std::string& place) {
  SourceOptions options;
  for (const auto& [key, words] : baseline.read)
    set_source_option(options, key, words, place + ": read." + key, folder_of(source));
  return options;
}

std::map<std::string, std::vector<std::string>> options_to_store(const SourceOptions& options,
                                                                 const fs::path& source) {
  auto stored = options.stated;
  // A table of times belongs to the files beside it; the next source has its own.
  const auto times = stored.find("time_file");
  if (times != stored.end())
    times->second = {fs::absolute(options.time_file)
                         .lexically_normal()
                         .lexically_relative(fs::absolute(folder_of(source)).lexically_normal())
                         .string()};
  return stored;
}

}  // namespace surge::compare
