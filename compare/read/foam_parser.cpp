#include "compare/read/foam_parser.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "compare/read/foam_file.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_bytes = std::size_t{16} << 20U;
constexpr std::size_t most_words = 1'000'000;
constexpr std::size_t most_depth = 64;  ///< of braces
constexpr int most_includes = 16;       ///< one inside the other
constexpr int most_files = 64;

bool is_space(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

/// `$name`, `${name}`, `$:name`, `$..name`: the name alone.
std::string variable_name(const std::string& word) {
  std::string name = word.substr(1);
  if (name.size() >= 2 && name.front() == '{' && name.back() == '}')
    name = name.substr(1, name.size() - 2);
  name.erase(0, name.find_first_not_of(".:!"));
  return name;
}

/// The parts of a path `a.b` or `a/b`.
std::vector<std::string> path_parts(const std::string& name) {
  std::vector<std::string> parts(1);
  for (const char c : name) {
    if (c == '.' || c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace

FoamParser::FoamParser(std::string text, fs::path file, fs::path root, int depth,
                       FoamBudget& budget)
    : text_(std::move(text)),
      file_(std::move(file)),
      root_(std::move(root)),
      depth_(depth),
      budget_(budget) {
  if (text_.size() > most_bytes)
    fail(std::to_string(text_.size()) + " bytes found, a dictionary of at most " +
         std::to_string(most_bytes) + " expected");
  if (++budget_.files > most_files)
    fail("#include of more than " + std::to_string(most_files) + " files");
}

void FoamParser::parse(FoamDictionary& root) {
  Scopes scopes{&root};
  entries(scopes, "");
}

void FoamParser::fail(const std::string& message) const {
  throw Error(file_.string() + ":" + std::to_string(line_) + ": " + message);
}

void FoamParser::spend(std::size_t words) {
  budget_.words += words;
  if (budget_.words > most_words)
    fail("more than " + std::to_string(most_words) + " words, after expansion of $names");
}

FoamDictionary FoamParser::copy_of(const FoamDictionary& meant, std::size_t depth) {
  spend(meant.size());
  if (depth + meant.depth() > most_depth)
    fail("braces deeper than " + std::to_string(most_depth) + " after expansion of $names");
  return meant;
}

char FoamParser::peek(std::size_t ahead) const {
  return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
}

void FoamParser::advance() {
  if (peek() == '\n') ++line_;
  ++at_;
}

void FoamParser::skip_line() {
  while (at_ < text_.size() && peek() != '\n') advance();
}

void FoamParser::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_space(peek())) {
      advance();
    } else if (peek() == '/' && peek(1) == '/') {
      skip_line();
    } else if (peek() == '/' && peek(1) == '*') {
      while (at_ < text_.size() && !(peek() == '*' && peek(1) == '/')) advance();
      if (at_ >= text_.size()) fail("a comment without its end");
      at_ += 2;
    } else {
      return;
    }
  }
}

std::string FoamParser::quoted() {
  std::string token;
  do {
    token += peek();
    advance();
  } while (at_ < text_.size() && peek() != '"');
  if (at_ >= text_.size()) fail("a string without its end");
  advance();
  return token;
}

/// The next token; empty at the end of the file. A quoted string keeps its first quote.
std::string FoamParser::next() {
  skip_blanks();
  if (at_ >= text_.size()) return {};
  if (peek() == '"') return quoted();
  std::string token;
  if (peek() == '$' && peek(1) == '{') {
    while (at_ < text_.size() && peek() != '}') {
      token += peek();
      advance();
    }
    if (at_ >= text_.size()) fail("${ without its }");
    token += '}';
    advance();
    return token;
  }
  constexpr std::string_view punctuation = "{}()[];";
  if (punctuation.find(peek()) != std::string_view::npos) {
    token = peek();
    advance();
    return token;
  }
  while (at_ < text_.size() && !is_space(peek()) && peek() != '"' &&
         punctuation.find(peek()) == std::string_view::npos) {
    token += peek();
    advance();
  }
  return token;
}

void FoamParser::entries(Scopes& scopes, const std::string& closing) {
  FoamDictionary& into = *scopes.back();
  if (into.place_.empty()) into.place_ = file_.string();
  for (std::string key = next(); key != closing; key = next()) {
    spend(1);
    if (key.empty()) fail("the file ends inside { }");
    if (key == ";" || directive(scopes, key)) continue;
    if (key.size() == 1 && std::string_view("{}()[]").find(key[0]) != std::string_view::npos)
      fail(key + " found, an entry expected");
    entry(scopes, std::move(key));
  }
}

void FoamParser::entry(Scopes& scopes, std::string key) {
  FoamDictionary& into = *scopes.back();
  if (key[0] == '$') {
    if (const FoamDictionary* meant = meant_dictionary(key, scopes)) {
      const FoamDictionary copy = copy_of(*meant, scopes.size());
      into.merge(copy);
    }
    skip_blanks();
    if (peek() == ';') advance();
    return;
  }
  if (key[0] == '"') key.erase(0, 1);
  skip_blanks();
  if (peek() == '{') {
    next();
    if (scopes.size() >= most_depth)
      fail(key + ": braces deeper than " + std::to_string(most_depth));
    FoamDictionary& child = into.dictionaries_[key];
    child.place_ = into.place_ + ": " + key;
    scopes.push_back(&child);
    entries(scopes, "}");
    scopes.pop_back();
    return;
  }
  Words words = values(key, scopes);
  const FoamDictionary* meant =
      words.size() == 1 && words[0][0] == '$' ? meant_dictionary(words[0], scopes) : nullptr;
  if (meant != nullptr) {
    FoamDictionary copy = copy_of(*meant, scopes.size());
    copy.place_ = into.place_ + ": " + key;
    into.dictionaries_[key] = std::move(copy);
  } else {
    into.entries_[key] = std::move(words);
  }
}

/// Whether `key` is a directive; what it says is done then.
bool FoamParser::directive(Scopes& scopes, const std::string& key) {
  if (key[0] != '#') return false;
  FoamDictionary& into = *scopes.back();
  if (key == "#include") {
    include(into, true);
  } else if (key == "#includeIfPresent" || key == "#sinclude") {
    include(into, false);
  } else if (key == "#includeEtc" || key == "#sincludeEtc") {
    into.unread_ += std::string(" ").append(key).append(" ").append(next()).append("\"");
  } else if (key == "#includeFunc" || key == "#remove" || key == "#inputMode" ||
             key == "#message") {
    skip_line();
  } else {
    fail(key + " found, which is not understood here; the entries themselves expected");
  }
  return true;
}

fs::path FoamParser::included_file(const std::string& name) const {
  for (const auto& [prefix, folder] : {std::pair{"<case>", root_},
                                       {"$FOAM_CASE", root_},
                                       {"${FOAM_CASE}", root_},
                                       {"<system>", root_ / "system"},
                                       {"<constant>", root_ / "constant"}}) {
    if (!name.starts_with(prefix)) continue;
    std::string rest = name.substr(std::string_view(prefix).size());
    rest.erase(0, rest.find_first_not_of('/'));
    return folder / rest;
  }
  if (name.find('$') != std::string::npos || name.starts_with("~"))
    fail("#include \"" + name + "\" found, a file of the case expected");
  return file_.parent_path() / name;
}

void FoamParser::include(FoamDictionary& into, bool required) {
  const std::string name = next();
  if (name.size() < 2 || name[0] != '"') fail("#include without a file name in quotes");
  if (depth_ >= most_includes)
    fail("#include deeper than " + std::to_string(most_includes) + " files");
  const fs::path file = included_file(name.substr(1));
  if (!required && !has_foam_file(file)) return;
  FoamParser(read_foam_file(file, root_), file, root_, depth_ + 1, budget_).parse(into);
}

FoamParser::Words FoamParser::values(const std::string& key, const Scopes& scopes) {
  Words words;
  int braces = 0;
  for (std::string token = next(); token != ";" || braces > 0; token = next()) {
    if (token.empty()) fail(key + ": the file ends before its ;");
    if (token == "{") ++braces;
    if (token == "}" && --braces < 0) fail(key + ": no ; after the value");
    spend(1);
    if (token[0] == '$') {
      const Words meant = variable(token, scopes);
      spend(meant.size());
      words.insert(words.end(), meant.begin(), meant.end());
    } else {
      words.push_back(std::move(token));
    }
  }
  return words;
}

/// The innermost entry of that name; the text itself where there is none (in #eval, say).
FoamParser::Words FoamParser::variable(const std::string& word, const Scopes& scopes) const {
  const std::vector<std::string> path = path_parts(variable_name(word));
  for (auto scope = scopes.rbegin(); scope != scopes.rend(); ++scope) {
    const FoamDictionary* at = *scope;
    for (std::size_t k = 0; k + 1 < path.size() && at != nullptr; ++k) {
      const auto inner = at->dictionaries_.find(path[k]);
      at = inner == at->dictionaries_.end() ? nullptr : &inner->second;
    }
    if (at == nullptr) continue;
    const auto entry = at->entries_.find(path.back());
    if (entry != at->entries_.end()) return entry->second;
  }
  return {word};
}

const FoamDictionary* FoamParser::meant_dictionary(const std::string& word, const Scopes& scopes) {
  const std::vector<std::string> path = path_parts(variable_name(word));
  for (auto scope = scopes.rbegin(); scope != scopes.rend(); ++scope) {
    const FoamDictionary* at = *scope;
    for (std::size_t k = 0; k < path.size() && at != nullptr; ++k) {
      const auto inner = at->dictionaries_.find(path[k]);
      at = inner == at->dictionaries_.end() ? nullptr : &inner->second;
    }
    // A dictionary that is being read cannot be put into itself.
    if (at != nullptr && std::find(scopes.begin(), scopes.end(), at) == scopes.end()) return at;
  }
  return nullptr;
}

}  // namespace surge::compare
