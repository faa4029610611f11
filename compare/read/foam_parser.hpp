#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "compare/read/foam_dictionary.hpp"

namespace surge::compare {

/// What one dictionary may cost, all of its included files together.
struct FoamBudget {
  std::size_t words = 0;  ///< after expansion
  int files = 0;
};

/// Reads one file into a dictionary; another one for each included file.
class FoamParser {
 public:
  FoamParser(std::string text, std::filesystem::path file, std::filesystem::path root, int depth,
             FoamBudget& budget);
  void parse(FoamDictionary& root);

 private:
  using Scopes = std::vector<FoamDictionary*>;
  using Words = std::vector<std::string>;

  [[noreturn]] void fail(const std::string& message) const;
  [[nodiscard]] char peek(std::size_t ahead = 0) const;
  void advance();
  void skip_blanks();
  void skip_line();
  std::string next();
  std::string quoted();
  void spend(std::size_t words);
  FoamDictionary copy_of(const FoamDictionary& meant, std::size_t depth);
  void entries(Scopes& scopes, const std::string& closing);
  void entry(Scopes& scopes, std::string key);
  bool directive(Scopes& scopes, const std::string& key);
  void include(FoamDictionary& into, bool required);
  [[nodiscard]] std::filesystem::path included_file(const std::string& name) const;
  Words values(const std::string& key, const Scopes& scopes);
  [[nodiscard]] Words variable(const std::string& word, const Scopes& scopes) const;
  [[nodiscard]] static const FoamDictionary* meant_dictionary(const std::string& word,
                                                              const Scopes& scopes);

  std::string text_;
  std::filesystem::path file_;
  std::filesystem::path root_;
  int depth_;
  FoamBudget& budget_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace surge::compare
