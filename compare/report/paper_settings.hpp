#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

namespace surge::compare {

/// What Alves & Dreux say of one parameter of a method, in the words of our case files.
struct PaperSetting {
  const char* method;     ///< "mps" or "sph"
  const char* parameter;  ///< as in a manifest's method.parameters
  const char* value;      ///< JSON; empty where the paper leaves it open
  const char* place;      ///< where in the paper, or what is missing there
  /// "a or b=c": it acts where option a is on, or b is c, see is_any_on(); empty: always
  const char* acts_with = "";
};

enum class Agreement {
  as_stated,  ///< the paper's value
  departs,    ///< another value than the paper's
  open,       ///< the paper gives none
  inert,      ///< it has no effect with the other options
  unknown     ///< a parameter that the list below does not have
};
[[nodiscard]] std::string agreement_text(Agreement agreement);

[[nodiscard]] std::span<const PaperSetting> paper_settings();
/// Null where the list has no such parameter.
[[nodiscard]] const PaperSetting* find_paper_setting(const std::string& method,
                                                     const std::string& parameter);
/// `stated`: the manifest's "case".
[[nodiscard]] Agreement compare_with_paper(const PaperSetting* setting, const nlohmann::json& value,
                                           const nlohmann::json& stated);

}  // namespace surge::compare
