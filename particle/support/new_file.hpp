#pragma once

#include <string>

namespace surge {

/// Writes a text to a file that is not there yet, or to the standard output for "-". Throws Error
/// where something is there already, or where it cannot be written.
void write_new_file(const std::string& file, const std::string& text);

}  // namespace surge
