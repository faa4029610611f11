#pragma once

#include <bit>
#include <cstring>

#include "tests/compare/foreign_flow.hpp"

namespace surge::compare::testing {

// VTK files as other programs write them, each by a small writer of our own.

/// Text of an XML DataArray in ascii.
template <class Values>
std::string data_array(const std::string& name, const std::string& type, int components,
                       const Values& values) {
  std::ostringstream out;
  out << std::setprecision(17) << "<DataArray type=\"" << type << "\" Name=\"" << name
      << "\" NumberOfComponents=\"" << components << "\" format=\"ascii\">\n";
  for (const auto& value : values) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Vec3>) {
      for (int c = 0; c < components; ++c) out << value[static_cast<std::size_t>(c)] << ' ';
      out << '\n';
    } else {
      out << value << '\n';
    }
  }
  out << "</DataArray>\n";
  return out.str();
}

inline std::vector<int> numbers_from(int first, std::size_t count) {
  std::vector<int> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(first + static_cast<int>(i));
  return numbers;
}

/// A .vtu with a vertex for each point.
inline void write_vtu(const fs::path& file, const std::vector<Vec3>& points,
                      const std::string& arrays, const std::string& time_name,
                      std::optional<double> time) {
  const std::string n = std::to_string(points.size());
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
  if (time)
    text += "<FieldData><DataArray type=\"Float64\" Name=\"" + time_name +
            "\" NumberOfTuples=\"1\" format=\"ascii\">" + digits17(*time) +
            "</DataArray></FieldData>\n";
  text += "<Piece NumberOfPoints=\"" + n + "\" NumberOfCells=\"" + n + "\">\n<Points>\n" +
          data_array("Points", "Float64", 3, points) + "</Points>\n<PointData>\n" + arrays +
          "</PointData>\n<Cells>\n" +
          data_array("connectivity", "Int32", 1, numbers_from(0, points.size())) +
          data_array("offsets", "Int32", 1, numbers_from(1, points.size())) +
          data_array("types", "UInt8", 1, std::vector<int>(points.size(), 1)) +
          "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  write_text(file, text);
}

/// A .vtp with a vertex for each point, as SPHinXsys writes it.
inline void write_plain_vtp(const fs::path& file, const std::vector<Vec3>& points,
                            const std::string& arrays, std::optional<double> time) {
  const std::string n = std::to_string(points.size());
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n <PolyData>\n";
  if (time)
    text +=
        "<FieldData>\n<DataArray type=\"Float64\"  Name=\"TimeValue\" NumberOfTuples=\"1\" "
        "format=\"ascii\">\n" +
        digits17(*time) + "\n </DataArray>\n</FieldData>\n";
  text += "  <Piece Name =\"Body\" NumberOfPoints=\"" + n + "\" NumberOfVerts=\"" + n +
          "\">\n   <Points>\n" + data_array("Position", "Float32", 3, points) +
          "   </Points>\n   <PointData  Vectors=\"vector\">\n" + arrays +
          "   </PointData>\n   <Verts>\n" +
          data_array("connectivity", "Int32", 1, numbers_from(0, points.size())) +
          data_array("offsets", "Int32", 1, numbers_from(1, points.size())) +
          "   </Verts>\n  </Piece>\n </PolyData>\n</VTKFile>\n";
  write_text(file, text);
}

/// TrixiParticles 0.3: out/fluid_1_<k>.vtu, boundary_1_<k>.vtu with the time as "time", and
/// fluid_1.pvd.
inline void write_trixi(const fs::path& folder, const ForeignFlow& flow = {}) {
  std::string list;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 0, std::nullopt);
    const double time = i * ForeignFlow::interval;
    const std::string name = "fluid_1_" + std::to_string(i) + ".vtu";
    write_vtu(
        folder / name, p.position,
        data_array("velocity", "Float64", 3, p.velocity) +
            data_array("density", "Float64", 1, std::vector<double>(p.position.size(), 1000.0)) +
            data_array("pressure", "Float64", 1, p.pressure) +
            data_array("index", "Int64", 1, numbers_from(1, p.position.size())),
        "time", time);
    const auto walls = flow.walls();
    write_vtu(folder / ("boundary_1_" + std::to_string(i) + ".vtu"), walls,
              data_array("hydrodynamic_density", "Float64", 1,
                         std::vector<double>(walls.size(), 1000.0)) +
                  data_array("index", "Int64", 1, numbers_from(1, walls.size())),
              "time", time);
    list += "<DataSet timestep=\"" + digits17(time) + "\" part=\"0\" file=\"" + name + "\"/>\n";
  }
  write_text(folder / "fluid_1.pvd",
             "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<VTKFile type=\"Collection\" "
             "version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n" +
                 list + "</Collection>\n</VTKFile>\n");
}

/// SPHinXsys: output/WaterBody_<millionths of a second>.vtp, the wall once; "TimeValue" since 2025.
inline void write_sphinxsys(const fs::path& folder, bool time_value, const ForeignFlow& flow = {}) {
  const auto name = [](const std::string& body, int i) {
    return body + "_" + padded(std::lround(1e6 * ForeignFlow::interval * i), 10) + ".vtp";
  };
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 0, std::nullopt);
    write_plain_vtp(folder / name("WaterBody", i), p.position,
                    data_array("SortedParticle_ID", "Int32", 1, numbers_from(0, 200)) +
                        data_array("Pressure", "Float32", 1, p.pressure) +
                        data_array("Velocity", "Float32", 3, p.velocity),
                    time_value ? std::optional(ForeignFlow::interval * i) : std::nullopt);
  }
  const auto walls = flow.walls();
  write_plain_vtp(folder / name("WallBoundary", 0), walls,
                  data_array("SortedParticle_ID", "Int32", 1, numbers_from(0, walls.size())),
                  time_value ? std::optional(0.0) : std::nullopt);
}

/// MPS-Basic (commit 9399a21): vtu/output_####.vtu; 0 ghost, 1 fluid, 2 wall.
inline void write_mps_basic(const fs::path& folder, const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 1, 2);
    write_vtu(
        folder / ("output_" + padded(i, 4) + ".vtu"), p.position,
        data_array("Particle Type", "Int32", 1, p.type) +
            data_array("Velocity", "Float64", 3, p.velocity) +
            data_array("Pressure", "Float64", 1, p.pressure) +
            data_array("Boundary Condition", "Int32", 1, std::vector<int>(p.position.size(), 3)),
        "Time", i * ForeignFlow::interval);
  }
}

/// PolyMPS (2022, ascii, "auxiliar" output): output#####.vtu without a time; 0 fluid, 2 wall.
inline void write_polymps(const fs::path& folder, const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 0, 2);
    write_vtu(folder / ("output" + padded(i, 5) + ".vtu"), p.position,
              data_array("Velocity", "Float32", 3, p.velocity) +
                  data_array("pressure", "Float32", 1, p.pressure) +
                  data_array("BC", "Int32", 1, std::vector<int>(p.position.size(), 0)) +
                  data_array("ParticleType", "Int32", 1, p.type),
              "", std::nullopt);
  }
}

/// Big-endian bytes, as legacy files hold them.
template <class T>
void append_big(std::string& text, T value) {
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::little)
    std::reverse(bytes.begin(), bytes.end());
  text.append(bytes.data(), bytes.size());
}

inline std::string big_floats(const std::vector<Vec3>& values, bool exchange) {
  std::string text;
  for (const Vec3& x : values)
    for (const double c : exchange ? upright(x) : x) append_big(text, static_cast<float>(c));
  return text;
}

/// DualSPHysics 5.4, the solver's own -sv:vtk: vtks/PartVtk_####.vtk, x-z plane, no time.
inline void write_dualsphysics_vtk(const fs::path& folder, const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 3, 0);
    const std::string n = std::to_string(p.position.size());
    std::string text = "# vtk DataFile Version 3.0\nvtk output\nBINARY\nDATASET POLYDATA\nPOINTS " +
                       n + " float\n" + big_floats(p.position, true) + "\nVERTICES " + n + " " +
                       std::to_string(2 * p.position.size()) + "\n";
    for (std::size_t k = 0; k < p.position.size(); ++k) {
      append_big(text, std::int32_t{1});
      append_big(text, static_cast<std::int32_t>(k));
    }
    text += "\nPOINT_DATA " + n + "\nSCALARS Idp int\nLOOKUP_TABLE default\n";
    for (std::size_t k = 0; k < p.position.size(); ++k)
      append_big(text, static_cast<std::int32_t>(k));
    text += "\nFIELD FieldData 3\nVel 3 " + n + " float\n" + big_floats(p.velocity, true);
    text += "\nPress 1 " + n + " float\n";
    for (const double value : p.pressure) append_big(text, static_cast<float>(value));
    text += "\nType 1 " + n + " short\n";
    for (const int type : p.type) append_big(text, static_cast<std::int16_t>(type));
    write_text(folder / ("PartVtk_" + padded(i, 4) + ".vtk"), text + "\n");
  }
}

/// SPlisHSPlasH 2.13, VTK exporter: vtk/ParticleData_Fluid_<frame>.vtk, frames from 1 on.
inline void write_splishsplash(const fs::path& folder, const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 0, std::nullopt);
    const std::string n = std::to_string(p.position.size());
    std::string text =
        "# vtk DataFile Version 4.1\nSPlisHSPlasH particle data\nBINARY\nDATASET "
        "UNSTRUCTURED_GRID\nPOINTS " +
        n + " float\n" + big_floats(p.position, false) + "\nCELLS " + n + " " +
        std::to_string(2 * p.position.size()) + "\n";
    for (std::size_t k = 0; k < p.position.size(); ++k) {
      append_big(text, std::uint32_t{1});
      append_big(text, static_cast<std::uint32_t>(k));
    }
    text += "\nCELL_TYPES " + n + "\n";
    for (std::size_t k = 0; k < p.position.size(); ++k) append_big(text, std::int32_t{1});
    text += "\nPOINT_DATA " + n + "\nSCALARS id unsigned_int 1\nLOOKUP_TABLE id_table\n";
    for (std::size_t k = 0; k < p.position.size(); ++k)
      append_big(text, static_cast<std::uint32_t>(k));
    text += "\nFIELD FieldData 2\nvelocity 3 " + n + " float\n" + big_floats(p.velocity, false);
    text += "\npressure 1 " + n + " float\n";
    for (const double value : p.pressure) append_big(text, static_cast<float>(value));
    write_text(folder / ("ParticleData_Fluid_" + std::to_string(i + 1) + ".vtk"), text + "\n");
  }
}

}  // namespace surge::compare::testing
