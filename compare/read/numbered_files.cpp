#include "compare/read/numbered_files.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>

#include "compare/read/delimited.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* digits = "0123456789";

bool is_parallel(const std::string& stem) {
  return stem.ends_with(".pvtu") || stem.ends_with(".pvtp");
}

std::string names_of(const Stems& stems) {
  std::string text;
  for (const auto& [stem, files] : stems)
    text += "\n  \"" + stem + "\" (" + std::to_string(files.size()) + " files)";
  return text;
}

/// Files of one series by their numbers.
std::map<long long, SeriesEntry> by_number(const fs::path& folder,
                                           const std::vector<fs::path>& files) {
  std::map<long long, SeriesEntry> entries;
  std::size_t padded = 0, shortest = 99;
  for (const fs::path& file : files) {
    const NameNumber name = number_in_name(file).value();
    SeriesEntry entry{std::nullopt, name.number, {file}, {}};
    if (name.time) {
      entry.part.time = name.time;
      entry.number.reset();
    }
    const auto [other, is_new] = entries.emplace(name.number, std::move(entry));
    if (!is_new) {
      throw Error(folder.string() + ": both " + other->second.files[0].filename().string() +
                  " and " + file.filename().string() + " are number " +
                  std::to_string(name.number) +
                  ", one series expected (name it by a pattern such as \"fluid_*.vtk\")");
    }
    if (name.padded) padded = std::max(padded, name.digits);
    shortest = std::min(shortest, name.digits);
  }
  if (padded > shortest)
    throw Error(folder.string() + ": numbers of " + std::to_string(shortest) + " and of " +
                std::to_string(padded) +
                " digits with zeros in front found, files of one run expected");
  return entries;
}

/// The one stem that a pattern fits.
const std::vector<fs::path>& one_stem(const fs::path& folder, const Stems& stems,
                                      const std::string& pattern) {
  if (stems.empty())
    throw Error((folder / pattern).string() +
                ": no frame found, numbered files of particles expected");
  if (stems.size() == 1) return stems.begin()->second;
  throw Error(folder.string() + ": " + std::to_string(stems.size()) +
              " series of files found, one expected (are two runs, or fluid and walls, in one "
              "folder? Name one by a pattern, or with --files and --walls):" +
              names_of(stems));
}

}  // namespace

std::optional<NameNumber> number_in_name(const fs::path& file) {
  std::string name = file.filename().string();
  // In "dump.1000" the number stands where others have their extension.
  std::string extension = file.extension().string();
  if (extension.size() > 1 && extension.find_first_not_of(digits, 1) == std::string::npos)
    extension.clear();
  const std::string stem = name.substr(0, name.size() - extension.size());
  const auto last = stem.find_last_of(digits);
  if (last == std::string::npos) return std::nullopt;
  const auto before = stem.find_last_not_of(digits, last);
  auto first = before == std::string::npos ? 0 : before + 1;
  if (last - first >= 18) return std::nullopt;
  NameNumber found;
  const std::string text = stem.substr(first, last - first + 1);
  found.number = std::stoll(text);
  found.digits = text.size();
  found.padded = text.size() > 1 && text[0] == '0';
  // "_0.050": a decimal number is a time, if it is all that the name ends with.
  if (!extension.empty() && last + 1 == stem.size() && first > 1 && stem[first - 1] == '.') {
    const auto whole = stem.find_last_not_of(digits, first - 2);
    const auto begin = whole == std::string::npos ? 0 : whole + 1;
    // "set0.5" is number 5 of set0; "t0.050" is a time.
    const auto is_letter = [&](std::size_t at) {
      return std::isalpha(static_cast<unsigned char>(stem[at])) != 0;
    };
    const bool separated =
        whole == std::string::npos ||
        (stem[whole] != '.' &&
         (!is_letter(whole) || (stem[whole] == 't' && (whole == 0 || !is_letter(whole - 1)))));
    if (begin + 1 < first && separated && first - 1 - begin < 9 && text.size() < 9) {
      const std::string decimal = stem.substr(begin);
      found.time = number_in(decimal);
      found.number = static_cast<long long>(*found.time * 1e9 + 0.5);
      found.padded = false;
      found.digits = 1;
      first = begin;
    }
  }
  found.stem = stem.substr(0, first) + "*" + stem.substr(last + 1) + extension;
  return found;
}

bool matches(std::string_view text, std::string_view pattern) {
  // The last `*` may take one more character until the rest fits.
  std::size_t t = 0, p = 0, star = std::string_view::npos, taken = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++taken;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

Stems stems_of(const fs::path& folder) {
  constexpr std::size_t most = 10000000;
  Stems stems;
  std::size_t count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (++count > most) throw Error(folder.string() + ": too many files");
    if (!has_particle_name(entry.path()) || !entry.is_regular_file()) continue;
    if (const auto name = number_in_name(entry.path())) stems[name->stem].push_back(entry.path());
  }
  for (auto& [stem, files] : stems) std::sort(files.begin(), files.end());
  return stems;
}

void leave_out_pieces(Stems& stems) {
  std::set<std::string> pieces;
  for (const auto& [stem, files] : stems)
    for (const fs::path& file : files)
      if (is_parallel(stem))
        for (const fs::path& piece : parallel_pieces(file))
          pieces.insert(piece.filename().string());
  for (auto& [stem, files] : stems)
    std::erase_if(files,
                  [&](const fs::path& file) { return pieces.contains(file.filename().string()); });
  std::erase_if(stems, [](const auto& entry) { return entry.second.empty(); });
}

std::vector<SeriesEntry> list_numbered(const fs::path& folder,
                                       const std::vector<std::string>& patterns,
                                       const std::vector<std::string>& left_out) {
  Stems all;
  for (const auto& [stem, files] : stems_of(folder))
    for (const fs::path& file : files) {
      const std::string name = file.filename().string();
      const bool out = std::any_of(left_out.begin(), left_out.end(),
                                   [&](const std::string& p) { return matches(name, p); });
      if (!out) all[stem].push_back(file);
    }
  std::map<long long, SeriesEntry> entries;
  std::vector<std::string> wanted = patterns;
  if (wanted.empty()) wanted = {"*"};
  if (patterns.empty()) leave_out_pieces(all);
  for (const std::string& pattern : wanted) {
    Stems fitting;
    for (const auto& [stem, files] : all) {
      for (const fs::path& file : files)
        if (matches(file.filename().string(), pattern)) fitting[stem].push_back(file);
    }
    if (fitting.empty() && patterns.empty()) break;
    auto series = by_number(folder, one_stem(folder, fitting, pattern));
    if (&pattern == &wanted.front()) {
      entries = std::move(series);
      continue;
    }
    for (const auto& [number, entry] : series)
      if (!entries.contains(number))
        throw Error(folder.string() + ": " + entry.files[0].filename().string() +
                    " has no partner that fits " + wanted.front());
    for (auto& [number, entry] : entries) {
      const auto partner = series.find(number);
      if (partner == series.end())
        throw Error(folder.string() + ": " + entry.files[0].filename().string() +
                    " has no partner that fits " + pattern);
      entry.files.push_back(partner->second.files[0]);
    }
  }
  std::vector<SeriesEntry> list;
  list.reserve(entries.size());
  for (auto& [number, entry] : entries) list.push_back(std::move(entry));
  return list;
}

}  // namespace surge::compare
