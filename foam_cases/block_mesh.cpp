#include <cmath>
#include <sstream>

#include "foam_cases/case_files.hpp"
#include "particle/case/enum_names.hpp"
#include "particle/support/bounds.hpp"

namespace surge::foam {

namespace {

/// Writes the dictionary of a mesh whose vertices are in units of L, or in m.
class BlockMesh {
 public:
  explicit BlockMesh(const FoamCase& c) : c_(c), mesh_(c.mesh), vertices_(c.mesh) {}

  std::string text() {
    out_ << header("dictionary", "blockMeshDict") << "\n#include \"caseParameters\"\n\n";
    write_edges();
    write_vertices();
    write_blocks();
    write_boundary();
    return out_.str();
  }

 private:
  /// A coordinate as the list of vertices has it.
  [[nodiscard]] std::string coordinate(double x) const {
    return number_text(mesh_.squares ? std::round(x / mesh_.length) : x);
  }

  [[nodiscard]] std::string count_name(std::size_t axis, std::size_t piece) const {
    if (c_.flow.dimension == 2 && axis == 2) return "1";
    if (mesh_.squares) return "$cellsPerL";
    return "$n" + std::string(axis_names[axis]) + std::to_string(piece);
  }

  void write_edges() {
    if (mesh_.squares) {
      out_ << "// Squares of L x L with cellsPerL x cellsPerL cells each, so that edges of tank, "
              "water and\n"
              "// obstacles are cell faces at any resolution. (One large block needs products of "
              "whole\n"
              "// numbers; #eval gives floating-point numbers, which blockMesh refuses as numbers "
              "of cells.)\n"
              "scale           "
           << number_text(mesh_.length)
           << ";      // L, m: the width of the first block of water\n";
    } else {
      out_ << "// Blocks between all edges of tank, water and obstacles, so that these are cell "
              "faces. Cells\n"
              "// are "
           << short_text(mesh_.cell) << " m wide, " << c_.settings.cells_per_length
           << " to a length of " << number_text(mesh_.length)
           << " m; their numbers between two edges:\n";
      write_counts();
      out_ << "cellSize        " << number_text(mesh_.cell)
           << ";      // m, for manifest.json\n\nscale           1;      // vertices are in m\n";
    }
    std::string boxes;
    for (std::size_t i = 0; i < c_.flow.obstacles.size(); ++i) {
      if (c_.flow.obstacles[i].surface) continue;
      const Box box = in_three_dimensions(c_.flow, mesh_, c_.flow.obstacles[i]);
      boxes += "    ( " + vector_text(box.lower) + " " + vector_text(box.upper) + " )    // " +
               obstacle_name(i) + '\n';
    }
    if (!boxes.empty())
      out_ << "\n// Left out of the mesh; stated here for manifest.json, in m.\nobstacles\n(\n"
           << boxes << ");\n";
  }

  void write_counts() {
    const std::size_t axes = c_.flow.dimension == 2 ? 2 : 3;
    for (std::size_t a = 0; a < axes; ++a) {
      for (std::size_t i = 0; i < mesh_.count(a); ++i) {
        const Piece& piece = mesh_.axes[a][i];
        const std::string name = count_name(a, i).substr(1);
        out_ << name << std::string(16 - std::min<std::size_t>(name.size(), 15), ' ') << piece.cells
             << ";      // " << axis_names[a] << " from " << number_text(piece.from) << " to "
             << number_text(piece.to) << " m" << (piece.expansion != 1.0 ? ", growing" : "")
             << '\n';
      }
    }
  }

  [[nodiscard]] double corner(std::size_t axis, std::size_t i) const {
    const Axis& pieces = mesh_.axes[axis];
    return i < pieces.size() ? pieces[i].from : pieces.back().to;
  }

  void write_vertices() {
    out_ << "\nvertices\n(\n";
    for (std::size_t k = 0; k < vertices_.count(2); ++k) {
      if (k > 0) out_ << '\n';
      for (std::size_t j = 0; j < vertices_.count(1); ++j) write_row(j, k);
    }
    out_ << ");\n";
  }

  /// Vertices of equal y and z, and their numbers.
  void write_row(std::size_t j, std::size_t k) {
    std::string row;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < vertices_.count(0); ++i) {
      const Place at{i, j, k};
      if (!vertices_.used(at)) continue;
      row += " (" + coordinate(corner(0, i)) + " " + coordinate(corner(1, j)) + " " +
             coordinate(corner(2, k)) + ")";
      numbers.push_back(vertices_.number(at));
    }
    if (numbers.empty()) return;
    out_ << "   " << row << "    // " << numbers.front();
    if (numbers.size() > 1) out_ << "-" << numbers.back();
    out_ << '\n';
  }

  void write_blocks() {
    out_ << '\n';
    if (const std::string growth = growing_text(); !growth.empty()) out_ << growth;
    out_ << "blocks\n(\n";
    mesh_.for_each_place([&](const Place& p) {
      if (mesh_.is_solid(p)) return;
      const auto v = [&](std::size_t i, std::size_t j, std::size_t k) {
        return std::to_string(vertices_.number({p[0] + i, p[1] + j, p[2] + k}));
      };
      out_ << "    hex (" << v(0, 0, 0) << ' ' << v(1, 0, 0) << ' ' << v(1, 1, 0) << ' '
           << v(0, 1, 0) << ' ' << v(0, 0, 1) << ' ' << v(1, 0, 1) << ' ' << v(1, 1, 1) << ' '
           << v(0, 1, 1) << ") (";
      for (std::size_t a = 0; a < 3; ++a) out_ << (a > 0 ? " " : "") << count_name(a, p[a]);
      out_ << ") simpleGrading (";
      for (std::size_t a = 0; a < 3; ++a)
        out_ << (a > 0 ? " " : "") << number_text(mesh_.axes[a][p[a]].expansion);
      out_ << ")\n";
    });
    out_ << ");\n";
  }

  /// What is said about the zone of growing cells.
  [[nodiscard]] std::string growing_text() const {
    const Axis& pieces = mesh_.axes[mesh_.up];
    const Piece& top = mesh_.up_is_plus ? pieces.back() : pieces.front();
    if (top.expansion == 1.0) return {};
    const double factor = std::max(top.expansion, 1.0 / top.expansion);
    return "// Beyond " + std::string(axis_names[mesh_.up]) + " = " +
           number_text(mesh_.up_is_plus ? top.from : top.to) +
           " m there is only spray: as many cells as L has, growing from\n// L/cellsPerL by a "
           "factor of " +
           number_text(factor) + " in all.\n";
  }

  void write_boundary() {
    out_ << "\nboundary\n(\n";
    for (const Patch& patch : c_.boundaries) {
      if (patch.kind == Patch::Kind::empty) continue;
      const char* type = patch.kind == Patch::Kind::wall       ? "wall"
                         : patch.kind == Patch::Kind::piston   ? "wall"
                         : patch.kind == Patch::Kind::periodic ? "cyclic"
                                                               : "patch";
      out_ << "    " << patch.name << "\n    {\n        type            " << type << ";\n";
      if (!patch.neighbour.empty()) out_ << "        neighbourPatch  " << patch.neighbour << ";\n";
      out_ << "        faces\n        (\n";
      for (std::size_t i = 0; i < patch.faces.size(); ++i)
        out_ << (i % 6 == 0 ? "            " : " ") << patch.faces[i]
             << (i % 6 == 5 || i + 1 == patch.faces.size() ? "\n" : "");
      out_ << "        );\n    }\n";
    }
    out_ << ");\n";
    if (c_.flow.dimension == 2)
      out_ << "\ndefaultPatch\n{\n    name            frontAndBack;\n    type            "
              "empty;\n}\n";
  }

  const FoamCase& c_;
  const Mesh& mesh_;
  Vertices vertices_;
  std::ostringstream out_;
};

}  // namespace

std::string block_mesh(const FoamCase& c) {
  return BlockMesh(c).text();
}

}  // namespace surge::foam
