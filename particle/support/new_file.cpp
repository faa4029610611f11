#include "particle/support/new_file.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>

#include "particle/support/error.hpp"
#include "particle/support/write_error.hpp"

namespace surge {

void write_new_file(const std::string& file, const std::string& text) {
  if (file == "-") {
    std::cout << text << std::flush;
    if (!std::cout) throw write_error("standard output");
    return;
  }
  if (std::filesystem::exists(std::filesystem::symlink_status(file)))
    throw Error(file + ": is there already, expected the name of a new file");
  errno = 0;
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw write_error(file);
}

}  // namespace surge
