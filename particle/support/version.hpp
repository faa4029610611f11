#pragma once

#include <string>

namespace surge {

/// What this binary was built from and with; goes into every manifest.
struct BuildInfo {
  std::string version;  ///< of the project, as in CMakeLists.txt
  std::string
      commit;  ///< git commit, with "-dirty" where the tree had changes; "unknown" outside git
  std::string compiler;  ///< name and version
  std::string flags;     ///< compile options that decide about floating point
};

[[nodiscard]] BuildInfo build_info();

}  // namespace surge
