#include "compare/study/statements.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "particle/support/table.hpp"
#include "particle/support/toml.hpp"

namespace surge::compare {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// A text, number or truth value as it stands in the file.
json typed(const std::string& word) {
  if (word == "true" || word == "false") return word == "true";
  double number = 0.0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (fault == std::errc() && end == word.data() + word.size()) return number;
  return word;
}

const StatementRule& rule_of(const TomlTable& table) {
  std::vector<std::string_view> names;
  for (const StatementRule& rule : statement_rules()) names.push_back(rule.name);
  return statement_rules()[table.choice("rule", names)];
}

std::map<std::string, double> numbers_of(const TomlTable& table, const StatementRule& rule) {
  std::map<std::string, double> numbers;
  if (rule.numbers.empty()) return numbers;
  const TomlTable stated = table.table("numbers");
  for (const std::string& name : rule.numbers)
    numbers[name] = stated.number(name, Bounds::above(0.0));
  return numbers;
}

Statement read_claim(const TomlTable& table) {
  Statement claim;
  const StatementRule& rule = rule_of(table);
  claim.id = table.text("id");
  claim.text = table.text("statement");
  claim.place = table.text("place");
  claim.rule = rule.name;
  claim.criterion = table.text("criterion");
  claim.condition = table.text("condition");
  claim.methods = table.texts("methods");
  claim.numbers = numbers_of(table, rule);
  if (claim.methods.empty() || (rule.methods > 0 && claim.methods.size() != rule.methods)) {
    throw table.error("methods", std::to_string(claim.methods.size()) + " methods",
                      rule.methods > 0 ? std::to_string(rule.methods) + " of them for this rule"
                                       : "at least one");
  }
  return claim;
}

std::vector<Statement> read_claims(const TomlTable& root) {
  std::vector<Statement> claims;
  std::set<std::string> ids;
  for (const TomlTable& table : root.tables("claim")) {
    claims.push_back(read_claim(table));
    if (!ids.insert(claims.back().id).second)
      throw table.error("id", "\"" + claims.back().id + "\" a second time", "different names");
  }
  if (claims.empty()) throw root.error("claim", "no claim", "at least one [[claim]]");
  return claims;
}

std::vector<StatedSetting> read_settings(const fs::path& file) {
  const TomlTable root = TomlTable::read(file);
  std::vector<StatedSetting> settings;
  std::set<std::pair<std::string, std::string>> known;
  for (const TomlTable& table : root.tables("setting")) {
    StatedSetting setting{table.text("method"), table.text("parameter"),
                          table.has("value") ? typed(table.scalar("value")) : json(),
                          table.text("place"), table.text_or("acts_with", "")};
    if (!known.emplace(setting.method, setting.parameter).second)
      throw table.error("parameter", "\"" + setting.parameter + "\" a second time",
                        "one entry for each parameter of a method");
    settings.push_back(std::move(setting));
  }
  root.finish();
  return settings;
}

std::vector<Erratum> read_errata(const fs::path& file) {
  const TomlTable root = TomlTable::read(file);
  std::vector<Erratum> errata;
  for (const TomlTable& table : root.tables("erratum")) {
    errata.push_back({table.text("place"), table.text("printed"), table.text("correct"),
                      table.text("derivation"), table.text("test_file"), table.text("test")});
  }
  root.finish();
  return errata;
}

}  // namespace

const std::vector<StatementRule>& statement_rules() {
  static const std::vector<StatementRule> rules{{"agrees", 1, {}},
                                                {"more_accurate", 2, {}},
                                                {"alike", 0, {"overlap"}},
                                                {"only_fragments", 2, {"part"}},
                                                {"cheaper", 2, {}},
                                                {"pressure_takes", 1, {"share"}},
                                                {"grows", 0, {"exponent", "within"}},
                                                {"keeps_apart", 2, {"apart"}},
                                                {"comes_to_end", 0, {}}};
  return rules;
}

bool Statements::is_about(const std::string& preset) const {
  return std::find(presets.begin(), presets.end(), preset) != presets.end();
}

const StatedSetting* Statements::setting(const std::string& method,
                                         const std::string& parameter) const {
  const auto found = std::find_if(settings.begin(), settings.end(), [&](const StatedSetting& s) {
    return method == s.method && parameter == s.parameter;
  });
  return found == settings.end() ? nullptr : &*found;
}

const Statement* Statements::of_rule(const std::string& rule) const {
  const auto found = std::find_if(claims.begin(), claims.end(),
                                  [&](const Statement& claim) { return claim.rule == rule; });
  return found == claims.end() ? nullptr : &*found;
}

Statements read_statements(const fs::path& folder) {
  const TomlTable root = TomlTable::read(folder / "claims.toml");
  Statements statements;
  statements.citation = root.text("citation");
  statements.comparator = root.text("comparator");
  statements.presets = root.texts("presets");
  statements.claims = read_claims(root);
  root.finish();
  statements.settings = read_settings(folder / "settings.toml");
  statements.errata = read_errata(folder / "errata.toml");
  return statements;
}

}  // namespace surge::compare
