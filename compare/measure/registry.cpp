#include "compare/measure/registry.hpp"

#include <array>
#include <vector>

#include "compare/measure/kinds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/spelling.hpp"
#include "particle/support/text.hpp"

namespace surge::compare {
namespace {

std::map<std::string, std::string> parse(const std::string& request, std::size_t colon) {
  std::map<std::string, std::string> entries;
  if (colon == std::string::npos) return entries;
  for (std::size_t at = colon + 1; at <= request.size();) {
    const std::size_t end = std::min(request.find(',', at), request.size());
    const std::string entry = request.substr(at, end - at);
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == entry.size())
      throw Error(request + ": found \"" + entry + "\", expected key=value");
    if (!entries.emplace(entry.substr(0, equals), entry.substr(equals + 1)).second)
      throw Error(request + ": found " + entry.substr(0, equals) + " twice, expected it once");
    at = end + 1;
  }
  return entries;
}

}  // namespace

std::span<const ObservableKind> observable_kinds() {
  static const std::array kinds{
      centre_of_mass_kind(), column_height_kind(), detached_kind(),
      force_kind(),          front_kind(),         gauge_kind(),
      kinetic_energy_kind(), overlap_kind(),       potential_energy_kind(),
      pressure_kind(),       profile_kind(),       volume_kind(),
  };
  return kinds;
}

std::vector<std::string> observable_names() {
  std::vector<std::string> names;
  for (const ObservableKind& kind : observable_kinds()) names.emplace_back(kind.name);
  return names;
}

std::unique_ptr<Observable> make_observable(const std::string& name, const std::string& kind,
                                            const std::map<std::string, std::string>& parameters,
                                            const ObservableContext& context) {
  std::vector<std::string> known;
  for (const ObservableKind& entry : observable_kinds()) {
    known.emplace_back(entry.name);
    if (entry.name != kind) continue;
    Parameters taken(parameters, name);
    std::unique_ptr<Observable> observable = entry.make(taken, name, context);
    taken.finish();
    return observable;
  }
  const std::string near = nearest(kind, known);
  throw Error(name + ": found an unknown observable \"" + kind + "\", expected one of " +
              comma_list(known) + (near.empty() ? "" : " (\"" + near + "\"?)"));
}

void check_observable(const std::string& name, const std::string& kind,
                      const std::map<std::string, std::string>& parameters,
                      ObservableContext context) {
  context.planned = true;
  static_cast<void>(make_observable(name, kind, parameters, context));
}

std::unique_ptr<Observable> make_observable(const std::string& request,
                                            const ObservableContext& context) {
  const std::size_t colon = request.find(':');
  return make_observable(request, request.substr(0, colon), parse(request, colon), context);
}

}  // namespace surge::compare
