#include "compare/read/hdf5_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// Particles of a file at most; more are no count.
constexpr hsize_t most_particles = 1ULL << 31;

hid_t open_file(const fs::path& file) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // its errors become ours
  H5PLset_loading_state(0);
  return H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
}

std::string join(const std::string& group, const std::string& name) {
  return group.empty() ? name : name.empty() ? group : group + "/" + name;
}

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  auto& list = *static_cast<std::vector<std::string>*>(names);
  list.emplace_back(name);
  return list.size() > 1000000 ? -1 : 0;
}

/// "float64", "int32"; empty for what is no number.
std::string type_name(hid_t type) {
  const std::string bits = std::to_string(8 * H5Tget_size(type));
  if (H5Tget_class(type) == H5T_FLOAT) return "float" + bits;
  if (H5Tget_class(type) == H5T_INTEGER || H5Tget_class(type) == H5T_ENUM) return "int" + bits;
  return "";
}

}  // namespace

Hdf5File::Hdf5File(const fs::path& file) : path_(file), file_(open_file(file), H5Fclose) {
  if (!file_.valid())
    throw Error(file.string() + ": HDF5 cannot open it (is it cut short or still being written?)");
}

void Hdf5File::check_path(const std::string& path) const {
  for (std::size_t at = 0; at < path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    const std::string part = path.substr(0, end);
    H5L_info_t info;
    if (H5Lget_info(file_.id(), part.c_str(), &info, H5P_DEFAULT) < 0)
      throw Error(path_.string() + ": " + path + ": none found, one expected");
    if (info.type != H5L_TYPE_HARD)
      throw Error(path_.string() + ": " + part +
                  ": a link to elsewhere found, which is not followed");
    at = end + 1;
  }
}

std::vector<std::string> Hdf5File::members(const std::string& group, bool groups_only) const {
  if (!group.empty()) check_path(group);
  const Hdf5Handle opened(H5Gopen2(file_.id(), group.empty() ? "/" : group.c_str(), H5P_DEFAULT),
                          H5Gclose);
  std::vector<std::string> names;
  if (!opened.valid() ||
      H5Literate(opened.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name, &names) < 0)
    throw Error(path_.string() + ": " + (group.empty() ? "/" : group) +
                ": no group that can be read");
  if (groups_only)
    std::erase_if(names, [&](const std::string& name) { return !has_group(join(group, name)); });
  return names;
}

bool Hdf5File::has_group(const std::string& group) const {
  for (std::size_t at = 0; at < group.size();) {
    const std::size_t end = std::min(group.find('/', at), group.size());
    H5L_info_t info;
    if (H5Lget_info(file_.id(), group.substr(0, end).c_str(), &info, H5P_DEFAULT) < 0 ||
        info.type != H5L_TYPE_HARD)
      return false;
    at = end + 1;
  }
  const Hdf5Handle opened(H5Gopen2(file_.id(), group.c_str(), H5P_DEFAULT), H5Gclose);
  return opened.valid();
}

namespace {

/// Not valid where the file has none of that name itself: what lies in another file is not
/// followed.
Hdf5Handle own_data_set(hid_t file, const std::string& path) {
  H5L_info_t link;
  if (H5Lget_info(file, path.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
    return {H5I_INVALID_HID, H5Dclose};
  return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose};
}

}  // namespace

std::optional<Hdf5File::DataSet> Hdf5File::data_set(const std::string& group,
                                                    const std::string& name) const {
  const std::string path = join(group, name);
  const Hdf5Handle set = own_data_set(file_.id(), path);
  if (!set.valid()) return std::nullopt;
  const Hdf5Handle type(H5Dget_type(set.id()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (!type.valid() || rank < 1 || rank > 2) return std::nullopt;
  hsize_t sizes[2] = {0, 1};
  if (H5Sget_simple_extent_dims(space.id(), sizes, nullptr) < 0) return std::nullopt;
  const std::string kind = type_name(type.id());
  if (kind.empty() || sizes[0] > most_particles || sizes[1] > 9) return std::nullopt;
  return DataSet{name, static_cast<std::size_t>(sizes[0]), static_cast<std::size_t>(sizes[1]),
                 kind};
}

void Hdf5File::collect(const std::string& group, const std::string& inside, int depth,
                       std::vector<DataSet>& sets) const {
  constexpr int deepest = 8;
  constexpr std::size_t most = 10000;
  for (const std::string& name : members(join(group, inside), false)) {
    const std::string path = join(inside, name);
    if (sets.size() > most || depth > deepest)
      throw Error(path_.string() + ": more groups and data sets than particles have");
    if (auto found = data_set(group, path)) {
      sets.push_back(std::move(*found));
    } else if (has_group(join(group, path))) {
      collect(group, path, depth + 1, sets);
    }
  }
}

std::vector<Hdf5File::DataSet> Hdf5File::data_sets(const std::string& group) const {
  std::vector<DataSet> sets;
  collect(group, "", 0, sets);
  return sets;
}

namespace {

/// Whether every chunk of a data set is there. H5Dget_space_status compares bytes, so that
/// compressed values look as if a part of them were missing.
bool has_all_chunks(hid_t opened, hid_t created, const Hdf5File::DataSet& set) {
  hsize_t chunk[2] = {0, 1};
  const int rank = H5Pget_chunk(created, 2, chunk);
  const hsize_t sizes[2] = {set.count, set.columns};
  hsize_t expected = 1, found = 0;
  for (int a = 0; a < rank && a < 2; ++a) {
    if (chunk[a] == 0) return false;
    expected *= (sizes[a] + chunk[a] - 1) / chunk[a];
  }
  const Hdf5Handle space(H5Dget_space(opened), H5Sclose);
  return rank > 0 && H5Dget_num_chunks(opened, space.id(), &found) >= 0 && found == expected;
}

}  // namespace

std::vector<double> Hdf5File::values(const std::string& group, const DataSet& set) const {
  const std::string path = join(group, set.name);
  check_path(path);
  const auto fail = [&](const std::string& what) {
    throw Error(path_.string() + ": " + path + ": " + what);
  };
  const Hdf5Handle opened(H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!opened.valid()) fail("cannot be opened");
  const Hdf5Handle created(H5Dget_create_plist(opened.id()), H5Pclose);
  if (!created.valid()) fail("cannot be opened");
  const H5D_layout_t layout = H5Pget_layout(created.id());
  if (layout == H5D_VIRTUAL || H5Pget_external_count(created.id()) != 0)
    fail("its values lie in another file, which is not followed");
  std::vector<double> values;
  if (set.count == 0) return values;
  // Values that were never written would be read as zeros.
  const std::size_t total = set.count * set.columns;
  const hsize_t stored = H5Dget_storage_size(opened.id());
  if (stored == 0) fail("announces values and holds none");
  if (total / 2000 > stored) fail("more values than it can hold");
  if (layout == H5D_CHUNKED && !has_all_chunks(opened.id(), created.id(), set))
    fail("a part of its values was never written");
  values.resize(total);
  if (H5Dread(opened.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail("cannot be read (is the file cut short?)");
  return values;
}

std::optional<double> Hdf5File::number(const std::string& path) const {
  const auto slash = path.rfind('/');
  if (slash != std::string::npos && !has_group(path.substr(0, slash))) return std::nullopt;
  const Hdf5Handle set = own_data_set(file_.id(), path);
  if (!set.valid()) return std::nullopt;
  const Hdf5Handle type(H5Dget_type(set.id()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
  const Hdf5Handle created(H5Dget_create_plist(set.id()), H5Pclose);
  if (type_name(type.id()).empty() || H5Sget_simple_extent_npoints(space.id()) != 1 ||
      H5Pget_layout(created.id()) == H5D_VIRTUAL || H5Pget_external_count(created.id()) != 0 ||
      H5Dget_storage_size(set.id()) == 0)
    return std::nullopt;
  double value = 0.0;
  if (H5Dread(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) < 0)
    return std::nullopt;
  return value;
}

std::optional<double> Hdf5File::attribute(const std::string& object,
                                          const std::string& name) const {
  if (!object.empty() && object != "/") check_path(object);
  const Hdf5Handle found(H5Aopen_by_name(file_.id(), object.empty() ? "/" : object.c_str(),
                                         name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (!found.valid()) return std::nullopt;
  const Hdf5Handle type(H5Aget_type(found.id()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(found.id()), H5Sclose);
  if (type_name(type.id()).empty() || H5Sget_simple_extent_npoints(space.id()) != 1)
    return std::nullopt;
  double value = 0.0;
  if (H5Aread(found.id(), H5T_NATIVE_DOUBLE, &value) < 0) return std::nullopt;
  return value;
}

std::string group_of(const std::string& pattern, const std::string& star) {
  std::string group = pattern;
  const auto at = group.find('*');
  if (at != std::string::npos) group.replace(at, 1, star);
  while (group.starts_with('/')) group.erase(0, 1);
  while (group.ends_with('/')) group.pop_back();
  return group;
}

std::vector<std::string> stars_of(const Hdf5File& file, const std::string& pattern) {
  const auto star = pattern.find('*');
  if (star == std::string::npos) return {""};
  const std::string before = pattern.substr(0, star);
  const auto slash = before.rfind('/');
  const std::string folder =
      slash == std::string::npos ? "" : group_of(before.substr(0, slash), "");
  const std::string stem = slash == std::string::npos ? before : before.substr(slash + 1);
  const std::string after = pattern.substr(star + 1, pattern.find('/', star) - star - 1);
  std::vector<std::pair<double, std::string>> found;
  for (const std::string& name : file.members(folder, true)) {
    if (name.size() <= stem.size() + after.size() || !name.starts_with(stem) ||
        !name.ends_with(after))
      continue;
    const std::string text = name.substr(stem.size(), name.size() - stem.size() - after.size());
    double number = 0.0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failed == std::errc() && end == text.data() + text.size() && std::isfinite(number))
      found.emplace_back(number, text);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> stars;
  stars.reserve(found.size());
  for (const auto& [number, text] : found) stars.push_back(text);
  return stars;
}

}  // namespace surge::compare
