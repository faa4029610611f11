#include "compare/read/layouts.hpp"

#include <algorithm>
#include <cctype>

#include "particle/support/error.hpp"
#include "particle/support/text.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

bool speaks_of(const std::string& name, std::initializer_list<const char*> words) {
  const std::string text = lower_case(name);
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return text.find(word) != std::string::npos; });
}

Stems stems_at(const fs::path& path, const SourceOptions& options) {
  Stems stems;
  if (fs::is_directory(path)) {
    stems = stems_of(path);
    leave_out_pieces(stems);
    return stems;
  }
  if (path.filename().string().find('*') != std::string::npos) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder)) return stems;
    for (const auto& [stem, files] : stems_of(folder))
      for (const fs::path& file : files)
        if (matches(file.filename().string(), path.filename().string()))
          stems[stem].push_back(file);
    return stems;
  }
  SourceOptions plain = options;
  plain.files.clear();
  plain.walls.clear();
  for (const SeriesEntry& entry : list_series(path, plain))
    for (const fs::path& file : entry.files) {
      const auto name = number_in_name(file);
      stems[name ? name->stem : file.filename().string()].push_back(file);
    }
  return stems;
}

}  // namespace

bool names_fluid(const std::string& name) {
  return speaks_of(name, {"fluid", "water", "liquid"}) && !names_wall(name);
}

bool names_wall(const std::string& name) {
  return speaks_of(name, {"wall", "bound", "solid", "tank", "rigid", "obstacle", "gate", "dummy",
                          "container", "fixed", "moving", "floating", "observer", "isosurface"});
}

SourceView::SourceView(const fs::path& path, const SourceOptions& options)
    : path_(path),
      folder_(fs::is_directory(path)   ? path
              : path.has_parent_path() ? path.parent_path()
                                       : fs::path(".")),
      options_(options) {
  try {
    stems_ = stems_at(path, options);
  } catch (const Error&) {
    stems_.clear();  // who reads them says what is wrong
  }
}

const ParticleTable& SourceView::table(const std::string& stem) const {
  const auto known = tables_.find(stem);
  if (known != tables_.end()) return known->second;
  ParticleTable& table = tables_[stem];
  const auto files = stems_.find(stem);
  if (files == stems_.end()) return table;
  try {
    const fs::path& file = files->second.front();
    table = read_table(file, parts_of(file, options_).front(), std::nullopt, options_);
  } catch (const Error&) {
    table = {};
  }
  return table;
}

fs::path SourceView::first_file() const {
  return stems_.empty() ? fs::path() : stems_.begin()->second.front();
}

SourceView SourceView::inside(const std::string& folder) const {
  return {folder_ / folder, options_};
}

void Layout::assume_velocity(const std::vector<std::string>& names) {
  assume(options.velocity_array, SourceOptions().velocity_array, names,
         "velocity " + comma_list(names));
}

void Layout::assume_pressure(const std::string& name) {
  assume(options.pressure_array, SourceOptions().pressure_array, name, "pressure " + name);
}

void Layout::assume_position(const std::vector<std::string>& names) {
  assume(options.position_array, {}, names, "position " + comma_list(names));
}

void Layout::assume_type(const ParticleTable& table, const std::string& name,
                         const std::vector<long>& fluid) {
  if (options.type_required || options.all_fluid) return;
  const ParticleArray* array = table.find(name);
  if (array == nullptr || array->components != 1) return;
  options.type_array = name;
  options.type_required = true;
  if (options.fluid_type) {
    assumed.push_back("type " + name);
    return;
  }
  for (const long value : fluid) {
    const bool there = std::find(array->values.begin(), array->values.end(),
                                 static_cast<double>(value)) != array->values.end();
    if (!there) continue;
    options.fluid_type = TypeValues(value);
    assumed.push_back("fluid where " + name + " is " + std::to_string(value));
    return;
  }
}

void Layout::assume_axes(const std::string& surge, const std::string& up) {
  if (options.axes || options.vertical_stated) return;
  const std::vector<std::string> words{surge, up};
  options.axes = FileAxes::parse(words, "axes");
  assumed.push_back("the surge along " + surge + ", " + up + " upwards");
}

void Layout::assume_files(const std::vector<std::string>& fluid,
                          const std::vector<std::string>& walls) {
  if (options.files.empty() && !fluid.empty()) {
    options.files = fluid;
    assumed.push_back("fluid in " + comma_list(fluid));
  }
  if (options.walls.empty() && !walls.empty()) {
    options.walls = walls;
    assumed.push_back("no fluid in " + comma_list(walls));
  }
}

void Layout::assume_all_fluid() {
  if (!options.type_required && !options.fluid_type) options.all_fluid = true;
}

std::vector<std::string> Layout::notices() const {
  std::vector<std::string> lines;
  if (!assumed.empty()) {
    std::string line = "assumed, because " +
                       (program.empty() ? because
                                        : "the files are laid out as " + program +
                                              " writes them (" + because + ")") +
                       ": ";
    for (std::size_t i = 0; i < assumed.size(); ++i) line += (i > 0 ? "; " : "") + assumed[i];
    lines.push_back(line);
  }
  for (const std::string& fact : read) lines.push_back(fact);
  return lines;
}

Layout recognise(const fs::path& path, const SourceOptions& stated) {
  const SourceView view(path, stated);
  for (const auto recogniser :
       {recognise_dualsphysics, recognise_pysph, recognise_trixi, recognise_sphinxsys,
        recognise_splishsplash, recognise_mps, recognise_openmps, recognise_gadget,
        recognise_gpusph, recognise_aquagpusph, recognise_lammps, recognise_names}) {
    Layout layout;
    layout.path = path;
    layout.options = stated;
    if (recogniser(view, layout)) return layout;
  }
  Layout none;
  none.path = path;
  none.options = stated;
  return none;
}

}  // namespace surge::compare
