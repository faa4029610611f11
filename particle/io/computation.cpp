#include "particle/io/computation.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "particle/case/case_checks.hpp"
#include "particle/case/case_file.hpp"
#include "particle/case/case_json.hpp"
#include "particle/io/presets.hpp"
#include "particle/io/run_size.hpp"

namespace surge {

namespace {

void read_method(const TomlTable& root, Computation& computation) {
  const TomlTable table = root.table("method");
  std::vector<std::string_view> names;
  for (const Method& method : methods()) names.push_back(method.name);
  computation.method = &methods()[table.choice("name", names)];
  const std::vector<std::string> presets = preset_names(computation.method->name);
  if (table.has("preset")) {
    const std::vector<std::string_view> known(presets.begin(), presets.end());
    computation.preset = presets[table.choice("preset", known)];
  } else if (std::find(presets.begin(), presets.end(), computation.preset) == presets.end()) {
    computation.preset = presets.front();  // no paper states this method
  }
  // A file may hold a table for each method; all are checked, one is used.
  for (const Method& method : methods()) {
    const bool used = &method == computation.method;
    std::any options = method.defaults();
    if (used) apply_preset(method, computation.preset, options);
    if (const auto own = root.optional_table(method.name)) method.read(*own, options);
    if (used) computation.options = std::move(options);
  }
}

/// An override of a method that is not used is a mistake.
void check_overrides(const Computation& computation, std::span<const std::string> overrides) {
  for (const std::string& override : overrides) {
    for (const Method& other : methods()) {
      const std::string name(other.name);
      if (&other == computation.method || !override.starts_with(name + ".")) continue;
      throw Error("--set " + override + ": found an option of " + name +
                  ", expected one of the case's method, " + computation.method_name());
    }
  }
}

void check_options(const Computation& computation, const TomlTable& root) {
  const std::string method = computation.method_name();
  const auto fault = computation.method->fault(computation.options);
  if (!fault) return;
  // The table may be missing: the preset's options come first.
  const auto table = root.optional_table(method);
  if (table && table->has(fault->name))
    throw table->error(fault->name, fault->found, fault->expected);
  throw root.error(method + "." + fault->name, fault->found, fault->expected);
}

Computation checked(const TomlTable& root, std::span<const std::string> overrides) {
  Computation computation;
  computation.flow = read_case(root);
  if (const auto search = root.optional_table("search")) {
    computation.search = search->enumerator("neighbours", enum_names<Search>);
  }
  read_method(root, computation);
  root.finish();
  check_case(computation.flow, root);
  const Method& method = *computation.method;
  check_case_for({method.name, method.interaction_radius(computation.options),
                  method.needs_reference_speed, method.supports},
                 computation.flow, root);
  check_options(computation, root);
  check_overrides(computation, overrides);
  check_size(run_size(computation), root, available_memory());
  return computation;
}

}  // namespace

Computation read_computation(const std::filesystem::path& file,
                             std::span<const std::string> overrides) {
  return checked(TomlTable::read(file, overrides), overrides);
}

Computation parse_computation(std::string_view text, const std::string& source,
                              std::span<const std::string> overrides) {
  return checked(TomlTable::parse(text, source, overrides), overrides);
}

std::vector<std::string> notes_on(const Computation& computation) {
  const std::size_t gauges = computation.flow.gauges.size();
  if (gauges == 0) return {};
  return {std::to_string(gauges) + (gauges == 1 ? " gauge" : " gauges") +
          " of the case not recorded by the run: surge-compare measures them on its frames"};
}

nlohmann::json to_json(const Computation& computation) {
  nlohmann::json j = to_json(computation.flow);
  j["search"] = {{"neighbours", name_of(computation.search)}};
  j["method"] = {{"name", computation.method_name()},
                 {"preset", computation.preset},
                 {"parameters", computation.method->to_json(computation.options)}};
  return j;
}

std::string to_toml(const Computation& computation) {
  const nlohmann::json j = to_json(computation);
  const nlohmann::json chosen{{"name", j["method"]["name"]}, {"preset", j["method"]["preset"]}};
  return to_toml(computation.flow) + toml_table("[search]", j["search"]) +
         toml_table("[method]", chosen) +
         toml_table(std::string("[").append(computation.method->name).append("]"),
                    j["method"]["parameters"]);
}

}  // namespace surge
