#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compare/read/particle_table.hpp"
#include "compare/read/units.hpp"

namespace surge::compare {

// VTK's readers of XML and HDF5 take what a file says on trust in more places than can be checked
// before: a damaged file ends the process that reads it. So that is another process.

/// Runs `work` in a child process and gives back the bytes that it returned; what it throws is
/// thrown here again. Throws surge::Error naming the file where the child ended in any other way,
/// or took more time or memory than reading such a file can.
[[nodiscard]] std::string in_child(const std::filesystem::path& file,
                                   const std::function<std::string()>& work);

// The same for what the readers return.
[[nodiscard]] ParticleTable table_in_child(const std::filesystem::path& file,
                                           const std::function<ParticleTable()>& work);
[[nodiscard]] std::vector<FilePart> parts_in_child(
    const std::filesystem::path& file, const std::function<std::vector<FilePart>()>& work);

}  // namespace surge::compare
