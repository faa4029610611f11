#include "compare/read/foam_mesh.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

constexpr std::int64_t most_labels = std::numeric_limits<std::int32_t>::max();

/// A list of numbers that are all in 0 ... limit - 1.
std::vector<std::uint32_t> indices(const FoamCursor& cursor, const std::vector<std::int64_t>& list,
                                   std::int64_t limit, const std::string& of) {
  std::vector<std::uint32_t> result;
  result.reserve(list.size());
  for (const std::int64_t value : list) {
    if (value < 0 || value >= limit) {
      cursor.fail(of + " " + std::to_string(value) + " found, 0 to " + std::to_string(limit - 1) +
                  " expected");
    }
    result.push_back(static_cast<std::uint32_t>(value));
  }
  return result;
}

void read_points(FoamMesh& mesh, const FoamBlock& block, const std::string& place) {
  FoamCursor cursor(block.text, place);
  const FoamHeader header = cursor.header(block.header);
  const std::vector<double> values = cursor.scalars(header, 3);
  mesh.points.resize(values.size() / 3);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    mesh.points[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

/// Corners of all faces: a list of lists, or (binary) where each begins and all corners.
void read_faces(FoamMesh& mesh, const FoamBlock& block, const std::string& place) {
  FoamCursor cursor(block.text, place);
  const FoamHeader header = cursor.header(block.header);
  const auto points = static_cast<std::int64_t>(mesh.points.size());
  if (header.type == "faceCompactList") {
    const std::vector<std::int64_t> starts = cursor.labels(header);
    const std::vector<std::int64_t> all = cursor.labels(header);
    mesh.corners = indices(cursor, all, points, "point");
    for (const std::int64_t start : starts) {
      const bool in_order = mesh.face_start.empty()
                                ? start == 0
                                : start >= static_cast<std::int64_t>(mesh.face_start.back()) + 3;
      if (!in_order || start > static_cast<std::int64_t>(all.size()))
        cursor.fail("a face that begins at corner " + std::to_string(start) +
                    " found, at least 3 corners to each expected");
      mesh.face_start.push_back(static_cast<std::size_t>(start));
    }
    if (mesh.face_start.empty()) mesh.face_start.push_back(0);
    if (mesh.face_start.back() != all.size())
      cursor.fail(std::to_string(all.size()) + " corners found, " +
                  std::to_string(mesh.face_start.back()) + " expected");
    return;
  }
  mesh.face_start.push_back(0);
  const std::uint64_t count = cursor.count();
  if (count > block.text.size() / 4) cursor.cut_short(std::to_string(count) + " faces");
  cursor.expect("(");
  for (std::uint64_t f = 0; f < count; ++f) {
    const auto face = indices(cursor, cursor.labels(header), points, "point");
    if (face.size() < 3)
      cursor.fail("a face of " + std::to_string(face.size()) + " corners found, 3 expected");
    mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
    mesh.face_start.push_back(mesh.corners.size());
  }
  cursor.expect(")");
}

/// "nCells:800" in the note of a mesh file.
std::optional<std::size_t> stated(const std::string& note, const std::string& key) {
  const auto at = note.find(key);
  if (at == std::string::npos) return std::nullopt;
  const auto first = note.find_first_not_of(" \t", at + key.size());
  if (first == std::string::npos) return std::nullopt;
  const std::string digits = note.substr(first);
  std::size_t value = 0;
  const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return failed == std::errc{} ? std::optional(value) : std::nullopt;
}

void check_note(const FoamCursor& cursor, const FoamMesh& mesh, const std::string& note) {
  const std::map<std::string, std::size_t> found{{"nPoints:", mesh.points.size()},
                                                 {"nCells:", mesh.cells},
                                                 {"nFaces:", mesh.faces()},
                                                 {"nInternalFaces:", mesh.neighbour.size()}};
  for (const auto& [key, count] : found) {
    const auto expected = stated(note, key);
    if (expected && *expected != count) {
      cursor.fail("its note says " + key + std::to_string(*expected) + ", " +
                  std::to_string(count) + " found (files of two meshes?)");
    }
  }
}

void read_cells(FoamMesh& mesh, const FoamBlock& owners, const FoamBlock& neighbours,
                const std::string& place) {
  FoamCursor owner(owners.text, place + "/owner");
  const FoamHeader header = owner.header(owners.header);
  mesh.owner = indices(owner, owner.labels(header), most_labels, "cell");
  if (mesh.owner.size() != mesh.face_start.size() - 1) {
    owner.fail(std::to_string(mesh.owner.size()) + " faces found, " +
               std::to_string(mesh.face_start.size() - 1) + " expected");
  }
  FoamCursor neighbour(neighbours.text, place + "/neighbour");
  std::vector<std::int64_t> others = neighbour.labels(neighbour.header(neighbours.header));
  if (others.size() > mesh.faces())
    neighbour.fail(std::to_string(others.size()) + " faces found, fewer expected");
  // Old versions list the boundary's faces, too, with -1.
  while (!others.empty() && others.back() == -1) others.pop_back();
  for (const std::uint32_t cell : mesh.owner)
    mesh.cells = std::max(mesh.cells, std::size_t{cell} + 1);
  // A cell has four faces at least, so that a wrong number cannot ask for much memory.
  if (mesh.cells > 4 * mesh.faces())
    owner.fail("cell " + std::to_string(mesh.cells - 1) + " found among " +
               std::to_string(mesh.faces()) + " faces, fewer cells expected");
  mesh.neighbour = indices(neighbour, others, static_cast<std::int64_t>(mesh.cells), "cell");
  for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) {
    if (mesh.neighbour[f] <= mesh.owner[f]) {
      neighbour.fail("face " + std::to_string(f) + " lies between cells " +
                     std::to_string(mesh.owner[f]) + " and " + std::to_string(mesh.neighbour[f]) +
                     ", the smaller one as its owner expected");
    }
  }
  check_note(owner, mesh, header.note);
}

FoamPatch read_patch(FoamCursor& cursor, const FoamHeader& header) {
  FoamPatch patch;
  patch.name = cursor.token();
  cursor.expect("{");
  bool has_start = false, has_count = false;
  while (cursor.peek() != '}') {
    if (cursor.at_end()) cursor.cut_short("its patches do");
    const std::string key(cursor.token());
    if (key == "type") {
      patch.type = cursor.token();
    } else if (key == "nFaces") {
      patch.count = static_cast<std::size_t>(cursor.count());
      has_count = true;
    } else if (key == "startFace") {
      patch.start = static_cast<std::size_t>(cursor.count());
      has_start = true;
    }
    cursor.skip_value(header);
  }
  cursor.expect("}");
  if (!has_start || !has_count) cursor.fail(patch.name + ": no nFaces and startFace found");
  return patch;
}

void read_boundary(FoamMesh& mesh, const FoamBlock& block, const std::string& place) {
  FoamCursor cursor(block.text, place);
  const FoamHeader header = cursor.header(block.header);
  const std::uint64_t count = cursor.count();
  cursor.expect("(");
  std::size_t next = mesh.neighbour.size();
  for (std::uint64_t k = 0; k < count; ++k) {
    FoamPatch patch = read_patch(cursor, header);
    if (patch.start != next || patch.count > mesh.faces() - next) {
      cursor.fail(patch.name + ": " + std::to_string(patch.count) + " faces from " +
                  std::to_string(patch.start) + " found; faces from " + std::to_string(next) +
                  " to at most " + std::to_string(mesh.faces()) + " expected");
    }
    next += patch.count;
    mesh.patches.push_back(std::move(patch));
  }
  cursor.expect(")");
  if (next != mesh.faces()) {
    cursor.fail("patches end at face " + std::to_string(next) + ", " +
                std::to_string(mesh.faces()) + " expected");
  }
}

}  // namespace

FoamMesh read_foam_mesh(const FoamMeshFile& file, const std::string& place) {
  FoamMesh mesh;
  mesh.place = place;
  read_points(mesh, file("points"), place + "/points");
  read_faces(mesh, file("faces"), place + "/faces");
  read_cells(mesh, file("owner"), file("neighbour"), place);
  read_boundary(mesh, file("boundary"), place + "/boundary");
  compute_geometry(mesh);
  return mesh;
}

void check_processor_patches(const std::vector<FoamMesh>& meshes) {
  for (std::size_t from = 0; from < meshes.size(); ++from) {
    for (const FoamPatch& patch : meshes[from].patches) {
      if (!patch.type.starts_with("processor")) continue;
      // procBoundary0to1, or procBoundary0to1through... where the patch was cyclic: one side of
      // each is enough.
      const std::string mine = "procBoundary" + std::to_string(from) + "to";
      if (!patch.name.starts_with(mine)) {
        throw Error(meshes[from].place + "/boundary: patch " + patch.name +
                    " found, one of processor " + std::to_string(from) +
                    " expected (folders of two processors exchanged?)");
      }
      std::size_t to = meshes.size();
      const std::string digits = patch.name.substr(mine.size());
      const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), to);
      if (failed != std::errc{} || to >= meshes.size())
        throw Error(meshes[from].place + "/boundary: patch " + patch.name +
                    " leads to a processor that is not there");
      if (end != digits.data() + digits.size()) continue;
      const std::string theirs = "procBoundary" + std::to_string(to) + "to" + std::to_string(from);
      const auto& others = meshes[to].patches;
      const auto other = std::find_if(others.begin(), others.end(),
                                      [&](const FoamPatch& p) { return p.name == theirs; });
      const std::string both = meshes[from].place + "/boundary: patch " + patch.name + ": ";
      if (other == others.end() || other->count != patch.count)
        throw Error(both + std::to_string(patch.count) + " faces, " +
                    (other == others.end() ? std::string("none") : std::to_string(other->count)) +
                    " on the other side (processors of two cases?)");
      for (std::size_t k = 0; k < patch.count; ++k) {
        const Vec3& a = meshes[from].face_centre[patch.start + k];
        const Vec3& b = meshes[to].face_centre[other->start + k];
        const Vec3& s = meshes[from].face_area[patch.start + k];
        const double size = std::sqrt(std::hypot(s[0], s[1], s[2]));
        if (std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) > 1e-3 * size)
          throw Error(both + "face " + std::to_string(k) +
                      " lies elsewhere on the other side (processors of two cases, or damaged?)");
      }
    }
  }
}

}  // namespace surge::compare
