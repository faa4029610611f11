#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/measure/front.hpp"
#include "compare/measure/observable.hpp"
#include "compare/measure/parameters.hpp"

namespace surge::compare {

/// What an observable is made for: a run, the study's definition of the front, and the run that
/// it is compared with where one is needed.
struct ObservableContext {
  const Run& run;
  FrontOptions front;
  const Run* reference = nullptr;
  /// The run is described by its case and not computed yet. A maker checks all that the case says
  /// and gives nothing where it would read what the run is to record.
  bool planned = false;
};

/// A kind of observable: how it is asked for, and its maker, which takes its parameters and throws
/// surge::Error where the run does not say what it needs.
struct ObservableKind {
  std::string_view name;
  std::string_view measures;    ///< one line, with the unit
  std::string_view parameters;  ///< one line; empty where it has none
  std::unique_ptr<Observable> (*make)(Parameters& parameters, const std::string& name,
                                      const ObservableContext& context);
};

/// All kinds, by name. A new one is its own file and an entry here.
[[nodiscard]] std::span<const ObservableKind> observable_kinds();

[[nodiscard]] std::vector<std::string> observable_names();

/// From "kind" or "kind:key=value,key=value". The text is the name of what is measured. Throws
/// surge::Error for an unknown kind or parameter, with what it may be.
[[nodiscard]] std::unique_ptr<Observable> make_observable(const std::string& request,
                                                          const ObservableContext& context);
/// The same from the name of the result, a kind and its parameters as texts (a study's table).
[[nodiscard]] std::unique_ptr<Observable> make_observable(
    const std::string& name, const std::string& kind,
    const std::map<std::string, std::string>& parameters, const ObservableContext& context);

/// Throws what make_observable would throw for a run that its case describes.
void check_observable(const std::string& name, const std::string& kind,
                      const std::map<std::string, std::string>& parameters,
                      ObservableContext context);

}  // namespace surge::compare
