#pragma once

#include <map>
#include <string>
#include <string_view>

#include "particle/case/case.hpp"

namespace surge::foam {

/// A number for people, to nine digits.
[[nodiscard]] std::string short_text(double value);
/// "(0 0.1 2)"
[[nodiscard]] std::string vector_text(const Point& v);
/// The header of an OpenFOAM dictionary or field.
[[nodiscard]] std::string header(std::string_view kind, std::string_view object);
/// A text between quotes of a dictionary: letters that end or expand it become others.
[[nodiscard]] std::string quoted_text(std::string_view text);
/// A text behind // in a dictionary.
[[nodiscard]] std::string comment(std::string_view text);
/// A word that OpenFOAM takes as a name, out of any text: wall_pressure becomes wallPressure.
[[nodiscard]] std::string word(std::string_view text);

/// The files of a case by their paths, as texts.
using Files = std::map<std::string, std::string>;

/// A text of the folder `template` with @name@ replaced; a line that holds nothing but @name@ is
/// left out where its value is empty. Throws Error for a name without a value.
[[nodiscard]] std::string filled(std::string_view text,
                                 const std::map<std::string, std::string>& values);

/// The files of the folder `template`, built into the program.
[[nodiscard]] const std::map<std::string_view, std::string_view>& template_files();

}  // namespace surge::foam
