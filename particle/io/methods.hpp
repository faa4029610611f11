#pragma once

#include <any>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "particle/case/case_checks.hpp"
#include "particle/core/particle_count.hpp"
#include "particle/core/search.hpp"
#include "particle/io/any_solver.hpp"
#include "particle/support/options.hpp"

namespace surge {

/// A method as the programs see it: all that they know of any. The options travel as std::any and
/// hold the method's own Params. An entry is made from particle/<name>/method.hpp.
struct Method {
  std::string_view name;           ///< its table in case files, its folder, its presets' prefix
  std::string_view density_array;  ///< what frames call the density
  bool solves_pressure = false;    ///< by an equation whose solver reports iterations
  bool needs_reference_speed = false;
  Supports supports;  ///< what of a case it computes

  std::any (*defaults)();
  /// Sets those options that a table of a file has.
  void (*read)(const TomlTable& table, std::any& options);
  nlohmann::json (*to_json)(const std::any& options);
  std::vector<OptionText> (*describe)(const std::any& options);

  /// What is wrong with the options together, if anything is.
  std::optional<OptionFault> (*fault)(const std::any& options);

  double (*interaction_radius)(const std::any& options);  ///< in l0
  int (*wall_layers)(const std::any& options);

  /// The longest stable step (s) when the fastest particle has this speed (m/s).
  double (*step_limit)(const Case& c, const std::any& options, double speed);
  /// Bytes of memory that a run's particles take, roughly.
  double (*memory)(const std::any& options, int dimension, const ParticleCount& count);

  template <int D>
  using Maker = std::unique_ptr<AnySolver<D>> (*)(const Case& c, const std::any& options,
                                                  Search search);
  Maker<2> make_2d;
  Maker<3> make_3d;
  /// One that goes on from the state of another.
  template <int D>
  using Restorer = std::unique_ptr<AnySolver<D>> (*)(const Case& c, const std::any& options,
                                                     Search search, StateReader& state);
  Restorer<2> restore_2d;
  Restorer<3> restore_3d;

  template <int D>
  [[nodiscard]] std::unique_ptr<AnySolver<D>> make(const Case& c, const std::any& options,
                                                   Search search) const {
    if constexpr (D == 2) return make_2d(c, options, search);
    if constexpr (D == 3) return make_3d(c, options, search);
  }
  template <int D>
  [[nodiscard]] std::unique_ptr<AnySolver<D>> restore(const Case& c, const std::any& options,
                                                      Search search, StateReader& state) const {
    if constexpr (D == 2) return restore_2d(c, options, search, state);
    if constexpr (D == 3) return restore_3d(c, options, search, state);
  }
};

/// All methods, in the order in which they are listed.
[[nodiscard]] std::span<const Method> methods();

/// The method of a name that is known to be one.
[[nodiscard]] const Method& method_named(std::string_view name);

}  // namespace surge
