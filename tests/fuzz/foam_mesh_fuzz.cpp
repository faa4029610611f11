#include <map>

#include "compare/read/foam_grid.hpp"
#include "compare/read/foam_mesh.hpp"
#include "tests/fuzz/foam_blocks.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// Meshes of OpenFOAM: points, faces, owner, neighbour, boundary, as parts of one input.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  std::map<std::string, std::string_view> files;
  fuzz::each_file(
      text, [&](const std::string& name, std::string_view content) { files[name] = content; });
  const auto block = [&](const std::string& name) {
    const auto blocks = fuzz::blocks_of(files[name], name);
    if (blocks.empty()) throw Error(name + ": nothing found");
    return blocks.front();
  };
  fuzz::try_reading([&] {
    std::vector<compare::FoamMesh> meshes;
    meshes.push_back(compare::read_foam_mesh(block, "polyMesh"));
    compare::compute_geometry(meshes.front());
    compare::check_processor_patches(meshes);
    (void)compare::foam_grid(meshes, {});
  });
  return 0;
}
