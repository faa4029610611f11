#include "particle/io/methods.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "particle/core/initial_particles.hpp"
#include "particle/isph/method.hpp"
#include "particle/mps/method.hpp"
#include "particle/sph/method.hpp"

namespace surge {

namespace {

template <class Params>
nlohmann::json options_json(const Params& params) {
  nlohmann::json j = nlohmann::json::object();
  visit_options(params, [&](const char* name, const auto& member, Bounds, const char*) {
    if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(member)>>) {
      j[name] = name_of(member);
    } else {
      j[name] = member;
    }
  });
  return j;
}

template <class M>
const typename M::Params& params_of(const std::any& options) {
  return std::any_cast<const typename M::Params&>(options);
}

template <class M, int D>
std::unique_ptr<AnySolver<D>> make_solver(const Case& c, const std::any& options, Search search) {
  return std::make_unique<WrappedSolver<M, D>>(c, params_of<M>(options), search);
}

/// The particles of a state are those of the case: what they are is found by their ids.
template <int D>
void check_particles(const Particles<D>& p, const Particles<D>& initial, const StateReader& state) {
  const auto refuse = [&] { state.refuse("the particles of the case", "other particles"); };
  if (p.size() != initial.size()) refuse();
  std::vector<char> seen(p.size(), 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto id = static_cast<std::size_t>(p.id[i]);
    if (p.id[i] < 0 || id >= p.size() || seen[id] != 0 || p.type[i] != initial.type[id]) refuse();
    seen[id] = 1;
  }
}

template <class M, int D>
std::unique_ptr<AnySolver<D>> restore_solver(const Case& c, const std::any& options, Search search,
                                             StateReader& reader) {
  using Solver = typename M::template Solver<D>;
  std::remove_cvref_t<decltype(std::declval<const Solver&>().state())> state;
  reader.read(state);
  const auto& params = params_of<M>(options);
  check_particles(state.p, initial_particles<D>(c, M::wall_layers(params)), reader);
  for (const StateField& field : fields_of(state))
    if (!field.single && field.count != state.p.size())
      reader.refuse("a value per particle", std::to_string(field.count) + " of " + field.name);
  return std::make_unique<WrappedSolver<M, D>>(c, params, search, std::move(state));
}

template <class M>
Method entry() {
  using Params = typename M::Params;
  return {
      .name = M::name,
      .density_array = M::density_array,
      .solves_pressure = M::solves_pressure,
      .needs_reference_speed = M::needs_reference_speed,
      .supports = M::supports,
      .defaults = [] { return std::any(Params{}); },
      .read = [](const TomlTable& table,
                 std::any& options) { read_options(table, std::any_cast<Params&>(options)); },
      .to_json = [](const std::any& options) { return options_json(params_of<M>(options)); },
      .describe = [](const std::any& options) { return option_texts(params_of<M>(options)); },
      .fault = [](const std::any& options) { return M::fault(params_of<M>(options)); },
      .interaction_radius =
          [](const std::any& options) { return M::interaction_radius(params_of<M>(options)); },
      .wall_layers = [](const std::any& options) { return M::wall_layers(params_of<M>(options)); },
      .step_limit = [](const Case& c, const std::any& options,
                       double speed) { return M::step_limit(c, params_of<M>(options), speed); },
      .memory =
          [](const std::any& options, int dimension, const ParticleCount& count) {
            return M::memory(params_of<M>(options), dimension, count);
          },
      .make_2d = make_solver<M, 2>,
      .make_3d = make_solver<M, 3>,
      .restore_2d = restore_solver<M, 2>,
      .restore_3d = restore_solver<M, 3>,
  };
}

}  // namespace

std::span<const Method> methods() {
  // A new method is one entry here.
  static const std::array all{entry<mps::Method>(), entry<sph::Method>(), entry<isph::Method>()};
  return all;
}

const Method& method_named(std::string_view name) {
  const auto all = methods();
  const auto found = std::find_if(all.begin(), all.end(), [&](auto& m) { return m.name == name; });
  if (found == all.end()) {
    std::string known;
    for (const Method& method : all)
      known += (known.empty() ? "" : ", ") + std::string(method.name);
    throw Error("method: found \"" + std::string(name) + "\", expected one of " + known);
  }
  return *found;
}

}  // namespace surge
