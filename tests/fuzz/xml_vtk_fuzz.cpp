#include <functional>

#include "compare/read/readers.hpp"
#include "compare/read/xml_vtk.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// VTK files in XML: particles (.vtp, .vtu), the pieces of parallel ones, collections.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const auto& folder = fuzz::scratch_with({"file.vtp", "file.vtu", "sub dir/b.vtp"});
  const bool grid = text.find("UnstructuredGrid") != std::string_view::npos;
  const bool parallel = text.find("<PPoints") != std::string_view::npos;
  const bool collection = text.find("Collection") != std::string_view::npos;
  const std::string kind = collection ? "pvd" : parallel ? "pvtu" : grid ? "vtu" : "vtp";
  const auto file = folder.put("file." + kind, text);
  fuzz::try_reading([&] {
    if (collection || parallel) {
      (void)compare::list_series(file);
    } else {
      compare::check_xml_vtk(file);
      // What that lets through VTK reads in a process of its own, which takes long.
      if (std::hash<std::string_view>()(text) % 8 == 0) (void)compare::read_vtk(file, std::nullopt);
    }
  });
  return 0;
}
