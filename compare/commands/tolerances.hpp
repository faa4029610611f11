#pragma once

#include <map>
#include <string>
#include <vector>

namespace surge::compare {

/// Numbers given as VALUE, for all (name ""), or NAME=VALUE, where the last `=` counts. Throws
/// surge::Error, beginning with the option's name, for what is no number of at least 0 and for a
/// name that is given twice.
[[nodiscard]] std::map<std::string, double> read_tolerances(const std::string& option,
                                                            const std::vector<std::string>& given);

}  // namespace surge::compare
