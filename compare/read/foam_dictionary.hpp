#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace surge::compare {

/// An OpenFOAM dictionary file, as far as a case's physics needs it: nested dictionaries, lists,
/// comments, #include inside the case, and $name of an entry or a dictionary that stands before.
/// What #includeEtc names lies outside the case and is not read; entries made by #calc, #eval and
/// the like are kept as text. Both are an error only where what they hold is asked for.
///
/// Depth of braces and of #include, number of files and of words after expansion are bounded.
class FoamDictionary {
 public:
  /// `root`: the case, which no #include leaves; the folder above the file's own where not given.
  /// Throws surge::Error `file:line: ...`.
  static FoamDictionary read(const std::filesystem::path& file,
                             const std::filesystem::path& root = {});
  /// The same for the text of a file that was read already.
  static FoamDictionary parse(std::string text, const std::filesystem::path& file,
                              const std::filesystem::path& root);

  [[nodiscard]] bool has(const std::string& key) const { return entries_.contains(key); }
  [[nodiscard]] bool has_dictionary(const std::string& key) const {
    return dictionaries_.contains(key);
  }
  /// Names of all entries but the sub-dictionaries.
  [[nodiscard]] std::vector<std::string> keys() const {
    std::vector<std::string> names;
    for (const auto& entry : entries_) names.push_back(entry.first);
    return names;
  }
  /// Sub-dictionary; throws where there is none.
  [[nodiscard]] const FoamDictionary& dictionary(const std::string& key) const;
  /// The words of an entry without brackets; throws where there is none.
  [[nodiscard]] std::vector<std::string> words(const std::string& key) const;
  /// Last `count` numbers of an entry, so that a name or dimensions before them do no harm:
  /// `nu nu [0 2 -1 0 0 0 0] 1e-06;` Throws where there are not that many finite ones.
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count) const;
  [[nodiscard]] double number(const std::string& key) const { return numbers(key, 1)[0]; }
  /// File, and the path of the sub-dictionary.
  [[nodiscard]] const std::string& place() const { return place_; }

 private:
  friend class FoamParser;
  [[nodiscard]] std::size_t size() const;   ///< words
  [[nodiscard]] std::size_t depth() const;  ///< of dictionaries
  void merge(const FoamDictionary& other);
  [[noreturn]] void missing(const std::string& key, const std::string& expected) const;

  std::string place_;
  std::string unread_;  ///< files that #includeEtc names
  std::map<std::string, std::vector<std::string>> entries_;
  std::map<std::string, FoamDictionary> dictionaries_;
};

}  // namespace surge::compare
