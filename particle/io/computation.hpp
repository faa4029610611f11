#pragma once

#include <any>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "particle/case/case.hpp"
#include "particle/core/search.hpp"
#include "particle/io/methods.hpp"

namespace surge {

/// A case and what computes it: a method with its options, checked and complete.
struct Computation {
  Case flow;
  Search search = Search::cell_grid;
  const Method* method = nullptr;
  std::string preset = "paper";
  std::any options;  ///< the method's Params

  [[nodiscard]] std::string method_name() const { return std::string(method->name); }
  template <class Params>
  [[nodiscard]] const Params& params() const {
    return std::any_cast<const Params&>(options);
  }
  template <int D>
  [[nodiscard]] std::unique_ptr<AnySolver<D>> make_solver() const {
    return method->make<D>(flow, options, search);
  }
  template <int D>
  [[nodiscard]] std::unique_ptr<AnySolver<D>> restore_solver(StateReader& state) const {
    return method->restore<D>(flow, options, search, state);
  }
};

/// Reads a case file with overrides `table.key=value`, on top of the preset that it names, and
/// checks it. Throws Error with the place of the first bad entry.
[[nodiscard]] Computation read_computation(const std::filesystem::path& file,
                                           std::span<const std::string> overrides = {});

/// The same for a text; `source` stands for the file's name in errors.
[[nodiscard]] Computation parse_computation(std::string_view text, const std::string& source,
                                            std::span<const std::string> overrides = {});

/// What of the case a run leaves to others: gauges and forces that it does not record.
[[nodiscard]] std::vector<std::string> notes_on(const Computation& computation);

/// It as the text of a case file: every option is written out, and reading it gives the same.
[[nodiscard]] std::string to_toml(const Computation& computation);

/// It as the manifest holds it: the case, "search" and "method".
[[nodiscard]] nlohmann::json to_json(const Computation& computation);

}  // namespace surge
