#pragma once

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "particle/support/write_error.hpp"

namespace surge::compare {

/// Calls write(stream) on a file, or on the standard output for "-". Throws surge::Error where it
/// cannot be written.
void write_to(const std::string& file, const auto& write) {
  errno = 0;
  if (file == "-") {
    write(std::cout);
    std::cout.flush();
    if (!std::cout) throw write_error("standard output");
    return;
  }
  std::ofstream out(file);
  if (out) write(out);
  out.close();
  if (!out) throw write_error(file);
}

/// JSON for a file; bytes that are no UTF-8, as names of files may have, are replaced.
[[nodiscard]] inline std::string dump(const nlohmann::json& value) {
  return value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace surge::compare
