#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace surge::compare {

/// A statement that a publication makes from its results, and the rule that judges it.
struct Statement {
  std::string id, text;
  std::string place;      ///< in the publication
  std::string rule;       ///< one of statement_rules()
  std::string criterion;  ///< in words; its numbers are filled in
  std::string condition;  ///< what a verdict depends on where not all runs agree
  std::vector<std::string> methods;
  std::map<std::string, double> numbers;  ///< thresholds
};

/// What a publication says of one parameter of a method, in the words of our case files.
struct StatedSetting {
  std::string method;     ///< "mps" or "sph"
  std::string parameter;  ///< as in a manifest's method.parameters
  nlohmann::json value;   ///< null where it is left open
  std::string place;      ///< where in the publication, or what is missing there
  std::string acts_with;  ///< options of is_any_on(); empty: always
};

/// A mistake in print.
struct Erratum {
  std::string place, printed, correct;
  std::string derivation;       ///< in one line
  std::string test_file, test;  ///< in the repository; the test holds the corrected form
};

/// What a publication says: the files claims.toml, settings.toml and errata.toml of a folder
/// beside the studies that judge it.
struct Statements {
  std::string citation;
  std::string comparator;            ///< how our reference differs from the publication's
  std::vector<std::string> presets;  ///< the statements are about runs of these and about no other
  std::vector<Statement> claims;
  std::vector<StatedSetting> settings;
  std::vector<Erratum> errata;

  [[nodiscard]] bool is_about(const std::string& preset) const;
  /// Null where nothing is said of it.
  [[nodiscard]] const StatedSetting* setting(const std::string& method,
                                             const std::string& parameter) const;
  /// The first claim of a rule; null where there is none.
  [[nodiscard]] const Statement* of_rule(const std::string& rule) const;
};

/// How a claim may be judged: how many methods it is about (0: any number), and its thresholds.
struct StatementRule {
  std::string name;
  std::size_t methods = 0;
  std::vector<std::string> numbers;
};
/// agrees: the leading edge of all runs of the method agrees with the reference.
/// more_accurate: the leading edge of the first method is nearer to the reference.
/// alike: the water overlaps that of the reference by at least `overlap`.
/// only_fragments: `part` of the water is detached in the first method and in no other.
/// cheaper: the first method takes less time than the second.
/// pressure_takes: the pressure takes more than `share` of the time.
/// grows: the time grows with the number of particles to the power `exponent`, by `within`.
/// keeps_apart: particles of the first method stay farther apart than those of the second, and,
/// without collisions, `apart` spacings.
/// comes_to_end: no run breaks up or loses particles.
[[nodiscard]] const std::vector<StatementRule>& statement_rules();

/// Throws surge::Error, with file, line and key, for whatever is missing, unknown or of no use.
[[nodiscard]] Statements read_statements(const std::filesystem::path& folder);

}  // namespace surge::compare
