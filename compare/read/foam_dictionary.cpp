#include "compare/read/foam_dictionary.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

using Tokens = std::vector<std::string>;

std::optional<double> to_number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace

/// Reads one file into a dictionary; another one for each included file.
class FoamParser {
 public:
  FoamParser(const std::filesystem::path& file, int depth) : file_(file), depth_(depth) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw Error(file.string() + ": cannot be opened, an OpenFOAM dictionary expected");
    text_.assign(std::istreambuf_iterator<char>(in), {});
  }

  void parse(FoamDictionary& root) { entries(root, {&root}, ""); }

 private:
  using Scopes = std::vector<const FoamDictionary*>;

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(file_.string() + ":" + std::to_string(line_) + ": " + message);
  }

  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  void advance() {
    if (peek() == '\n') ++line_;
    ++at_;
  }

  void skip_blanks() {
    while (at_ < text_.size()) {
      if (std::isspace(static_cast<unsigned char>(peek()))) {
        advance();
      } else if (peek() == '/' && peek(1) == '/') {
        while (at_ < text_.size() && peek() != '\n') advance();
      } else if (peek() == '/' && peek(1) == '*') {
        while (at_ < text_.size() && !(peek() == '*' && peek(1) == '/')) advance();
        at_ = std::min(at_ + 2, text_.size());
      } else {
        return;
      }
    }
  }

  /// The next token; empty at the end of the file. A quoted string keeps its first quote.
  std::string next() {
    skip_blanks();
    if (at_ >= text_.size()) return {};
    std::string token;
    if (peek() == '"') {
      do {
        token += peek();
        advance();
      } while (at_ < text_.size() && peek() != '"');
      if (at_ >= text_.size()) fail("a string without its end");
      advance();
      return token;
    }
    if (std::string_view("{}()[];").find(peek()) != std::string_view::npos) {
      token = peek();
      advance();
      return token;
    }
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(peek())) &&
           std::string_view("{}()[];\"").find(peek()) == std::string_view::npos) {
      token += peek();
      advance();
    }
    return token;
  }

  void entries(FoamDictionary& into, const Scopes& scopes, const std::string& closing) {
    if (into.place_.empty()) into.place_ = file_.string();
    for (std::string key = next(); key != closing; key = next()) {
      if (key.empty()) fail("the file ends inside { }");
      if (key == ";") continue;
      if (key == "#include" || key == "#includeIfPresent") {
        include(into, key == "#include");
        continue;
      }
      if (key[0] == '"') key.erase(0, 1);
      skip_blanks();
      if (peek() == '{') {
        next();
        FoamDictionary& child = into.dictionaries_[key];
        child.place_ = into.place_ + ": " + key;
        Scopes inner = scopes;
        inner.push_back(&child);
        entries(child, inner, "}");
      } else {
        into.entries_[key] = values(key, scopes);
      }
    }
  }

  void include(FoamDictionary& into, bool required) {
    const std::string name = next();
    if (name.size() < 2 || name[0] != '"') fail("#include without a file name in quotes");
    if (depth_ >= 16) fail("#include deeper than 16 files");
    const std::filesystem::path file = file_.parent_path() / name.substr(1);
    if (!required && !std::filesystem::exists(file)) return;
    FoamParser(file, depth_ + 1).parse(into);
  }

  Tokens values(const std::string& key, const Scopes& scopes) {
    Tokens tokens;
    int braces = 0;
    for (std::string token = next(); token != ";" || braces > 0; token = next()) {
      if (token.empty()) fail(key + ": the file ends before its ;");
      if (token == "{") ++braces;
      if (token == "}" && --braces < 0) fail(key + ": no ; after the value");
      if (token[0] == '$') {
        const Tokens meant = variable(token.substr(1), scopes);
        tokens.insert(tokens.end(), meant.begin(), meant.end());
      } else {
        tokens.push_back(std::move(token));
      }
    }
    return tokens;
  }

  /// The innermost entry of that name; the text itself where there is none (in #eval, say).
  static Tokens variable(std::string name, const Scopes& scopes) {
    if (!name.empty() && name[0] == ':') name.erase(0, 1);
    for (auto scope = scopes.rbegin(); scope != scopes.rend(); ++scope) {
      const auto entry = (*scope)->entries_.find(name);
      if (entry != (*scope)->entries_.end()) return entry->second;
    }
    return {"$" + name};
  }

  std::filesystem::path file_;
  int depth_;
  std::string text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

FoamDictionary FoamDictionary::read(const std::filesystem::path& file) {
  FoamDictionary root;
  FoamParser(file, 0).parse(root);
  return root;
}

const FoamDictionary& FoamDictionary::dictionary(const std::string& key) const {
  const auto entry = dictionaries_.find(key);
  if (entry == dictionaries_.end())
    throw Error(place_ + ": " + key + ": nothing found, a dictionary expected");
  return entry->second;
}

std::vector<double> FoamDictionary::numbers(const std::string& key, std::size_t count) const {
  const auto entry = entries_.find(key);
  if (entry == entries_.end())
    throw Error(place_ + ": " + key + ": nothing found, a value expected");
  std::string found;
  Tokens tokens;
  for (const std::string& token : entry->second) {
    found += (found.empty() ? "" : " ") + token;
    if (token != "(" && token != ")") tokens.push_back(token);
  }
  std::vector<double> numbers;
  for (std::size_t k = tokens.size() - std::min(count, tokens.size()); k < tokens.size(); ++k) {
    const std::optional<double> number = to_number(tokens[k]);
    if (number) numbers.push_back(*number);
  }
  if (numbers.size() != count) {
    throw Error(place_ + ": " + key + ": \"" + found + "\" found, " + std::to_string(count) +
                (count == 1 ? " finite number expected" : " finite numbers expected"));
  }
  return numbers;
}

}  // namespace surge::compare
