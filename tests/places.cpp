#include "tests/places.hpp"

#include <stdlib.h>

#include <cerrno>
#include <system_error>

namespace surge::tests {

std::string sources() {
  return SURGE_SOURCE_DIR;
}

std::string programs() {
  return SURGE_BIN_DIR;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = std::filesystem::temp_directory_path() / "surge_test_XXXXXX";
  if (mkdtemp(name.data()) == nullptr)
    throw std::system_error(errno, std::generic_category(), "cannot create " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace surge::tests
