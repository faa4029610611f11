#include "compare/read/foam_dictionary.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "compare/read/foam_file.hpp"
#include "compare/read/foam_parser.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

std::optional<double> to_number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// The folder above the file's own: constant/g lies in the case.
fs::path usual_root(const fs::path& file) {
  return fs::absolute(file).parent_path().parent_path();
}

}  // namespace

FoamDictionary FoamDictionary::parse(std::string text, const fs::path& file, const fs::path& root) {
  FoamDictionary dictionary;
  FoamBudget budget;
  FoamParser(std::move(text), file, root, 0, budget).parse(dictionary);
  return dictionary;
}

FoamDictionary FoamDictionary::read(const fs::path& file, const fs::path& root) {
  const fs::path within = root.empty() ? usual_root(file) : root;
  return parse(read_foam_file(file, within), file, within);
}

std::size_t FoamDictionary::size() const {
  std::size_t words = 1;
  for (const auto& [key, value] : entries_) words += 1 + value.size();
  for (const auto& [key, value] : dictionaries_) words += value.size();
  return words;
}

std::size_t FoamDictionary::depth() const {
  std::size_t inner = 0;
  for (const auto& [key, value] : dictionaries_) inner = std::max(inner, value.depth());
  return inner + 1;
}

void FoamDictionary::merge(const FoamDictionary& other) {
  for (const auto& [key, value] : other.entries_) entries_[key] = value;
  for (const auto& [key, value] : other.dictionaries_) {
    FoamDictionary& mine = dictionaries_[key];
    if (mine.place_.empty()) mine.place_ = place_ + ": " + key;
    mine.merge(value);
  }
}

void FoamDictionary::missing(const std::string& key, const std::string& expected) const {
  throw Error(place_ + ": " + key + ": nothing found, " + expected + " expected" +
              (unread_.empty() ? "" : " (not read, outside the case:" + unread_ + ")"));
}

const FoamDictionary& FoamDictionary::dictionary(const std::string& key) const {
  const auto entry = dictionaries_.find(key);
  if (entry == dictionaries_.end()) missing(key, "a dictionary");
  return entry->second;
}

std::vector<std::string> FoamDictionary::words(const std::string& key) const {
  const auto entry = entries_.find(key);
  if (entry == entries_.end()) missing(key, "a value");
  std::vector<std::string> words;
  for (const std::string& word : entry->second)
    if (word != "(" && word != ")") words.push_back(word);
  return words;
}

std::vector<double> FoamDictionary::numbers(const std::string& key, std::size_t count) const {
  const std::vector<std::string> tokens = words(key);
  std::vector<double> numbers;
  for (std::size_t k = tokens.size() - std::min(count, tokens.size()); k < tokens.size(); ++k) {
    const std::optional<double> number = to_number(tokens[k]);
    if (number) numbers.push_back(*number);
  }
  const std::size_t before = tokens.size() - std::min(count, tokens.size());
  const bool more = before > 0 && to_number(tokens[before - 1]);
  if (numbers.size() != count || more) {
    std::string found;
    for (const std::string& token : entries_.at(key)) {
      if (found.size() > 200) break;
      found += (found.empty() ? "" : " ") + token;
    }
    const bool code = found.find("#calc") != std::string::npos ||
                      found.find("#code") != std::string::npos ||
                      found.find("#eval") != std::string::npos;
    throw Error(place_ + ": " + key + ": \"" + found + "\" found, " + std::to_string(count) +
                (count == 1 ? " finite number expected" : " finite numbers expected") +
                (code ? " (#calc, #codeStream and #eval are not carried out)" : ""));
  }
  return numbers;
}

}  // namespace surge::compare
