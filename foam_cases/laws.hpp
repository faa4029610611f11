#pragma once

#include <ostream>
#include <string>

#include "particle/case/motion.hpp"

namespace surge::foam {

/// `key  value;` of a dictionary within another.
void write_entry(std::ostream& out, const std::string& key, const std::string& value);

/// A law as the case states it: the entries that act, and no others.
void write_law(std::ostream& out, const ScalarMotion& law);

}  // namespace surge::foam
