#include <algorithm>
#include <charconv>

#include "compare/read/hdf5_file.hpp"
#include "compare/read/isolated.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// Groups with the fluid: as the options say, else the root.
std::vector<std::string> patterns_of(const SourceOptions& options) {
  return options.groups.empty() ? std::vector<std::string>{""} : options.groups;
}

/// The time of a part: an attribute `group@name` or a data set with one number, else one with a
/// usual name in the group of the time, in its parents or in the file.
std::optional<double> time_of_part(const fs::path& path, const Hdf5File& file,
                                   const std::string& group, const std::string& star,
                                   const SourceOptions& options) {
  if (!options.time_array.empty()) {
    const auto at = options.time_array.rfind('@');
    const std::string object =
        at == std::string::npos ? "" : group_of(options.time_array.substr(0, at), star);
    const std::string name =
        at == std::string::npos ? options.time_array : options.time_array.substr(at + 1);
    auto time = file.attribute(object, name);
    if (!time && at == std::string::npos) time = file.number(group_of(name, star));
    if (!time)
      throw Error(path.string() + ": no number in the attribute " + object + "@" + name +
                  (at == std::string::npos ? " or the data set " + name : "") + " (--time-array)");
    return time;
  }
  for (std::string object = group;;) {
    for (const char* name : {"time", "Time", "TIME", "TimeValue", "t"}) {
      if (const auto time = file.attribute(object, name)) return time;
      if (const auto time = file.number(object.empty() ? name : object + "/" + name)) return time;
    }
    if (object.empty()) return std::nullopt;
    const auto slash = object.rfind('/');
    object = slash == std::string::npos ? "" : object.substr(0, slash);
  }
}

/// Appends the arrays of one more group (another body of fluid) to those of the first.
void append(ParticleTable& table, ParticleTable more, const fs::path& file,
            const std::string& group) {
  if (table.arrays.empty() && table.count == 0) {
    table = std::move(more);
    return;
  }
  table.count += more.count;
  for (ParticleArray& array : table.arrays) {
    const ParticleArray* other = more.find(array.name);
    if (!other || other->components != array.components)
      throw Error(file.string() + ": " + group + ": no data set " + array.name +
                  " as in the other groups");
    array.values.insert(array.values.end(), other->values.begin(), other->values.end());
  }
}

}  // namespace

namespace {

std::vector<FilePart> parts_in(const fs::path& file, const SourceOptions& options) {
  const Hdf5File opened(file);
  const std::string pattern = patterns_of(options).front();
  std::vector<FilePart> parts;
  for (const std::string& star : stars_of(opened, pattern)) {
    FilePart part;
    part.star = star;
    part.time = time_of_part(file, opened, group_of(pattern, star), star, options);
    long long step = 0;
    const auto [end, failed] = std::from_chars(star.data(), star.data() + star.size(), step);
    if (!star.empty() && failed == std::errc() && end == star.data() + star.size())
      part.step = step;
    parts.push_back(part);
  }
  if (parts.empty())
    throw Error(file.string() + ": no group found that fits \"" + pattern + "\" (--groups)");
  return parts;
}

ParticleTable table_in(const fs::path& file, const FilePart& part, const ArrayNames& wanted,
                       const SourceOptions& options) {
  const Hdf5File opened(file);
  ParticleTable table;
  for (const std::string& pattern : patterns_of(options)) {
    const std::string group = group_of(pattern, part.star);
    if (!group.empty() && !opened.has_group(group))
      throw Error(file.string() + ": " + group + ": no such group, one with the fluid expected");
    std::vector<Hdf5File::DataSet> sets;
    if (wanted) {
      for (const std::string& name : *wanted)
        if (auto set = opened.data_set(group, group_of(name, ""))) {
          set->name = name;
          sets.push_back(std::move(*set));
        }
    } else {
      sets = opened.data_sets(group);
    }
    ParticleTable found;
    for (const auto& set : sets) found.count = std::max(found.count, set.count);
    for (const auto& set : sets) {
      if (set.count == 0) continue;  // an array that is not saved
      if (wanted && set.count != found.count)
        throw Error(file.string() + ": " + group + "/" + set.name + ": " +
                    std::to_string(set.count) + " values found, " + std::to_string(found.count) +
                    " expected");
      found.arrays.push_back(
          {set.name, static_cast<int>(set.columns), set.type,
           opened.values(group, {group_of(set.name, ""), set.count, set.columns, set.type})});
    }
    append(table, std::move(found), file, group);
  }
  return table;
}

}  // namespace

std::vector<FilePart> hdf5_parts(const fs::path& file, const SourceOptions& options) {
  require_regular(file);
  return parts_in_child(file, [&] { return parts_in(file, options); });
}

ParticleTable read_hdf5(const fs::path& file, const FilePart& part, const ArrayNames& wanted,
                        const SourceOptions& options) {
  require_regular(file);
  return table_in_child(file, [&] { return table_in(file, part, wanted, options); });
}

}  // namespace surge::compare
