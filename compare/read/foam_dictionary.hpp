#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace surge::compare {

/// An OpenFOAM dictionary file, as far as constant/ needs it: nested dictionaries, lists, comments,
/// #include, and $name of an entry that stands before. Entries made by #calc, #eval or other
/// directives are kept as text and are an error only where they are asked for.
class FoamDictionary {
 public:
  /// Throws surge::Error `file:line: ...`.
  static FoamDictionary read(const std::filesystem::path& file);

  [[nodiscard]] bool has(const std::string& key) const { return entries_.contains(key); }
  /// Sub-dictionary; throws where there is none.
  [[nodiscard]] const FoamDictionary& dictionary(const std::string& key) const;
  /// Last `count` numbers of an entry, so that a name or dimensions before them do no harm:
  /// `nu nu [0 2 -1 0 0 0 0] 1e-06;` Throws where there are not that many finite ones.
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count) const;
  [[nodiscard]] double number(const std::string& key) const { return numbers(key, 1)[0]; }

 private:
  friend class FoamParser;
  std::string place_;  ///< file, and the path of the sub-dictionary
  std::map<std::string, std::vector<std::string>> entries_;
  std::map<std::string, FoamDictionary> dictionaries_;
};

}  // namespace surge::compare
