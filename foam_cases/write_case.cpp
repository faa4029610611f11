#include <unistd.h>

#include <fstream>

#include "foam_cases/foam_case.hpp"
#include "particle/support/error.hpp"

namespace surge::foam {

namespace fs = std::filesystem;

namespace {

/// Files that a person runs.
bool is_program(const std::string& path) {
  return path == "Allrun" || path == "Allclean" || path == "manifest.py";
}

void write_files(const Files& files, const fs::path& folder) {
  for (const auto& [path, text] : files) {
    const fs::path file = folder / path;
    fs::create_directories(file.parent_path());
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out)
      throw Error(file.string() + ": found no way to write it, expected room and permission");
    if (is_program(path)) {
      fs::permissions(file, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                      fs::perm_options::add);
    }
  }
}

}  // namespace

void write_case(const Files& files, const fs::path& folder, bool over) {
  const std::string place = "--out " + folder.string();
  try {
    const bool there = fs::exists(folder);
    if (there && !fs::is_directory(folder))
      throw Error(place + ": found a file, expected a folder for the case");
    if (there && !fs::is_empty(folder)) {
      if (!over)
        throw Error(place +
                    ": found a folder that is not empty, expected a new one (--force writes "
                    "into it)");
      if (!fs::exists(folder / "system/caseParameters"))
        throw Error(place +
                    ": found a folder without system/caseParameters, expected a case that "
                    "surge-foam has made");
      // What only the earlier case had would be taken for part of this one.
      for (const char* name :
           {"system/setExprFieldsDict", "system/topoSetDict", "constant/fvOptions",
            "constant/tankMotion", "constant/obstacles.json", "constant/hRef",
            "constant/movingWalls", "constant/dynamicMeshDict", "0.orig/pointDisplacement"})
        fs::remove(folder / name);
      fs::remove_all(folder / "constant/triSurface");
      for (const auto& entry : fs::directory_iterator(folder / "system"))
        if (entry.path().filename().string().starts_with("cutDict.")) fs::remove(entry.path());
      write_files(files, folder);
      return;
    }
    // Whole or not at all.
    fs::path unfinished = folder;
    if (!unfinished.has_filename()) unfinished = unfinished.parent_path();
    unfinished += ".part" + std::to_string(getpid());
    write_files(files, unfinished);
    if (there) fs::remove(folder);
    fs::rename(unfinished, folder.has_filename() ? folder : folder.parent_path());
  } catch (const fs::filesystem_error& error) {
    throw Error(place + ": found no way to write it (" + error.code().message() +
                "), expected a folder that can be made");
  }
}

}  // namespace surge::foam
