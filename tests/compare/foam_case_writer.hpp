#pragma once

#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/compare/foam_mesh_writer.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare::testing {

/// How a case is laid out on the disk: what OpenFOAM's writers can be told, and its versions do.
struct FoamLayout {
  bool binary = false;
  bool packed = false;
  int processors = 1;
  bool collated = false;
  bool grouped = false;  ///< collated, two processors to a folder
  std::string alpha = "alpha.water";
  std::string region{};
  std::vector<std::string> times{"0", "0.1", "0.2"};
  std::function<Vec3(Vec3)> place = [](Vec3 x) { return x; };
  Vec3 gravity{0.0, -9.81, 0.0};
};

/// All parts as one text.
template <class... Parts>
std::string joined(const Parts&... parts) {
  std::ostringstream out;
  out.precision(17);
  (out << ... << parts);
  return out.str();
}

inline std::string foam_text(double value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

/// The text of files in OpenFOAM's format.
class FoamFormat {
 public:
  explicit FoamFormat(bool binary) : binary_(binary) {}

  [[nodiscard]] std::string header(const std::string& type, const std::string& location,
                                   const std::string& object, const std::string& note = "") const {
    return joined(
        "FoamFile\n{\n    version 2.0;\n    format ", std::string(binary_ ? "binary" : "ascii"),
        ";\n    arch \"LSB;label=32;scalar=64\";\n",
        (note.empty() ? note : joined("    note \"", note, "\";\n")), "    class ", type,
        ";\n    location \"", location, "\";\n    object ", object, ";\n}\n// * * * //\n\n");
  }
  [[nodiscard]] std::string scalars(const std::vector<double>& values,
                                    std::size_t components) const {
    std::string text = joined(std::to_string(values.size() / components), "\n(");
    if (binary_) {
      text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
      return joined(text, ")");
    }
    for (std::size_t i = 0; i < values.size(); i += components) {
      text += "\n";
      if (components > 1) text += "(";
      for (std::size_t k = 0; k < components; ++k)
        text += joined((k == 0 ? "" : " "), foam_text(values[i + k]));
      if (components > 1) text += ")";
    }
    return joined(text, "\n)");
  }
  [[nodiscard]] std::string labels(const std::vector<int>& values) const {
    std::string text = joined(std::to_string(values.size()), "\n(");
    if (binary_) {
      text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(int));
    } else {
      for (const int value : values) text += joined("\n", std::to_string(value));
      text += "\n";
    }
    return joined(text, ")");
  }
  [[nodiscard]] std::string faces(const std::vector<std::vector<int>>& faces) const {
    if (binary_) {
      std::vector<int> starts{0}, all;
      for (const auto& face : faces) {
        all.insert(all.end(), face.begin(), face.end());
        starts.push_back(static_cast<int>(all.size()));
      }
      return joined(labels(starts), "\n\n", labels(all), "\n");
    }
    std::string text = joined(std::to_string(faces.size()), "\n(\n");
    for (const auto& face : faces) {
      text += joined(std::to_string(face.size()), "(");
      for (std::size_t k = 0; k < face.size(); ++k)
        text += joined((k == 0 ? "" : " "), std::to_string(face[k]));
      text += ")\n";
    }
    return joined(text, ")\n");
  }
  [[nodiscard]] bool binary() const { return binary_; }

 private:
  bool binary_;
};

/// All bytes of a file.
inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

inline void write_packed(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  gzFile out = gzopen(file.c_str(), "wb");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
}

/// Part of a cell (lower and upper corner) that is water at a time.
using FoamWater = std::function<double(Vec3, Vec3, double)>;

/// Writes OpenFOAM cases without OpenFOAM, exact to the last digit.
class FoamCaseWriter {
 public:
  FoamCaseWriter(std::filesystem::path path, FoamTestTank tank, FoamLayout layout)
      : path_(std::move(path)),
        tank_(std::move(tank)),
        layout_(std::move(layout)),
        format_(layout_.binary) {
    // Processors take slices of the cells in their order, which are level ones.
    for (std::size_t i = 0; i < tank_.cells(); ++i)
      part_of_.push_back(
          static_cast<int>(i * static_cast<std::size_t>(layout_.processors) / tank_.cells()));
    for (int p = 0; p < layout_.processors; ++p)
      meshes_.push_back(tank_.mesh(part_of_, p, layout_.place));
  }

  void write(const FoamWater& water) const {
    write_text(path_ / "system/controlDict", plain("dictionary", "system", "controlDict") +
                                                 "application interFoam;\nstartFrom startTime;\n"
                                                 "startTime " +
                                                 layout_.times.front() +
                                                 ";\nwriteControl adjustableRunTime;\n"
                                                 "writeInterval 0.1;\nendTime " +
                                                 layout_.times.back() + ";\n");
    write_text(path_ / "constant/g",
               plain("uniformDimensionedVectorField", "constant", "g") +
                   "dimensions [0 1 -2 0 0 0 0];\nvalue (" + foam_text(layout_.gravity[0]) + " " +
                   foam_text(layout_.gravity[1]) + " " + foam_text(layout_.gravity[2]) + ");\n");
    const std::string phase = layout_.alpha.substr(layout_.alpha.find('.') + 1);
    write_text(path_ / "constant/transportProperties",
               plain("dictionary", "constant", "transportProperties") + "phases (" + phase +
                   " air);\n" + phase +
                   "\n{\n nu 1e-06;\n rho 998.2;\n}\nair { nu 1e-05; rho 1; }\n");
    write_mesh("constant");
    for (const std::string& time : layout_.times) write_field(time, water);
  }

  void write_mesh(const std::string& folder) const {
    const std::string where = joined(folder, "/", region(), "polyMesh");
    each("points", where, "vectorField", [&](const FoamTestMesh& m) {
      std::vector<double> flat;
      for (const Vec3& p : m.points) flat.insert(flat.end(), p.begin(), p.end());
      return joined(format_.scalars(flat, 3), "\n");
    });
    each("faces", where, layout_.binary ? "faceCompactList" : "faceList",
         [&](const FoamTestMesh& m) { return format_.faces(m.faces); });
    each("owner", where, "labelList",
         [&](const FoamTestMesh& m) { return joined(format_.labels(m.owner), "\n"); });
    each("neighbour", where, "labelList",
         [&](const FoamTestMesh& m) { return joined(format_.labels(m.neighbour), "\n"); });
    each("boundary", where, "polyBoundaryMesh", [](const FoamTestMesh& m) {
      std::string text = joined(std::to_string(m.patches.size()), "\n(\n");
      for (const auto& p : m.patches)
        text += joined("    ", p.name, "\n    {\n        type ", p.type, ";\n        nFaces ",
                       std::to_string(p.count), ";\n        startFace ", std::to_string(p.start),
                       ";\n    }\n");
      return joined(text, ")\n");
    });
  }

  void write_field(const std::string& time, const FoamWater& water) const {
    each(layout_.alpha, time + joined(layout_.region.empty() ? "" : "/", layout_.region),
         "volScalarField", [&](const FoamTestMesh& m) {
           std::vector<double> values;
           for (const std::size_t c : m.cells)
             values.push_back(water(tank_.lower(c), tank_.upper(c), std::stod(time)));
           std::string text = joined(
               "dimensions [0 0 0 0 0 0 0];\n\ninternalField nonuniform "
               "List<scalar> \n",
               format_.scalars(values, 1), ";\n\nboundaryField\n{\n");
           for (const auto& p : m.patches) {
             text += joined("    ", p.name, "\n    {\n        type ",
                            (p.type == "wall" ? "zeroGradient" : p.type), ";\n");
             if (p.type == "processor")
               text += joined("        value nonuniform List<scalar> ",
                              format_.scalars(std::vector<double>(p.count, 0.25), 1), ";\n");
             text += "    }\n";
           }
           return joined(text, "}\n\n// * * * //\n");
         });
  }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const FoamFormat& format() const { return format_; }

 private:
  [[nodiscard]] std::string region() const {
    return joined(layout_.region.empty() ? "" : layout_.region, "/");
  }
  static std::string plain(const std::string& type, const std::string& location,
                           const std::string& object) {
    return FoamFormat(false).header(type, location, object);
  }
  void put(const std::filesystem::path& file, const std::string& text) const {
    if (layout_.packed) {
      write_packed(file.string() + ".gz", text);
    } else {
      write_text(file, text);
    }
  }

  /// Writes a file of every processor: `contents` of its mesh, below a header.
  void each(const std::string& name, const std::string& folder, const std::string& type,
            const auto& contents) const {
    const auto text = [&](std::size_t p) {
      const FoamTestMesh& m = meshes_[p];
      const std::string note =
          name == "owner"
              ? joined("nPoints:", m.points.size(), "  nCells:", m.cells.size(),
                       "  nFaces:", m.faces.size(), "  nInternalFaces:", m.neighbour.size())
              : "";
      return joined(format_.header(type, folder, name, note), contents(m));
    };
    if (!layout_.collated) {
      for (std::size_t p = 0; p < meshes_.size(); ++p) {
        const std::string part = layout_.processors > 1 ? joined("processor", p) : ".";
        put(path_ / part / folder / name, text(p));
      }
      return;
    }
    const std::size_t group = layout_.grouped ? 2 : meshes_.size();
    for (std::size_t first = 0; first < meshes_.size(); first += group) {
      const std::string part =
          joined("processors", meshes_.size(),
                 layout_.grouped ? joined("_", first, "-", first + group - 1) : "");
      std::string all = FoamFormat(true).header("decomposedBlockData",
                                                (path_ / part / folder / name).string(), name);
      for (std::size_t p = first; p < first + group; ++p) {
        std::string block = text(p);
        // Only the first block of a file has a header.
        if (p > first) block.erase(0, block.find("}\n") + 2);
        all += joined("\n// Processor", std::to_string(p), "\n\n", std::to_string(block.size()),
                      "\n(", block, ")\n");
      }
      put(path_ / part / folder / name, all);
    }
  }

  std::filesystem::path path_;
  FoamTestTank tank_;
  FoamLayout layout_;
  FoamFormat format_;
  std::vector<int> part_of_;
  std::vector<FoamTestMesh> meshes_;
};

}  // namespace surge::compare::testing
