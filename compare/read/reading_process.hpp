#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "compare/read/particle_table.hpp"
#include "compare/read/readers.hpp"

namespace surge::compare {

/// A child process that reads one file of VTK after the other, for the reason that isolated.hpp
/// gives. To start a process for each file would cost more than to read it, the more so the more
/// memory this process has.
class ReadingProcess {
 public:
  ReadingProcess() = default;
  ReadingProcess(const ReadingProcess&) = delete;
  ReadingProcess& operator=(const ReadingProcess&) = delete;
  ~ReadingProcess() { end(); }

  /// Begins to read the file; starts the child where there is none. An answer that was not fetched
  /// is dropped. Throws surge::Error where no process can be started.
  void ask(const std::filesystem::path& file, const ArrayNames& wanted);
  /// What read_vtk() of the file asked for returns or throws.
  [[nodiscard]] ParticleTable answer();
  /// Ends the child. The next ask() starts another.
  void end();

 private:
  void start();
  [[nodiscard]] std::string received();

  pid_t child_ = -1;
  int socket_ = -1;
  std::filesystem::path asked_;  ///< and not answered yet; empty where there is none
};

}  // namespace surge::compare
