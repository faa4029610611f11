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

/// ParaView's parallel files: w_<k>.pvtu over two pieces each.
inline void write_parallel(const fs::path& folder, const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto points = flow.fluid(i);
    const std::string stem = "w_" + std::to_string(i);
    const std::vector<Vec3> first(points.begin(), points.begin() + 90);
    const std::vector<Vec3> second(points.begin() + 90, points.end());
    const double time = i * ForeignFlow::interval;
    write_vtu(folder / (stem + "_0.vtu"), first, "", "Time", time);
    write_vtu(folder / (stem + "_1.vtu"), second, "", "Time", time);
    write_text(folder / (stem + ".pvtu"),
               "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid GhostLevel=\"0\"><Piece "
               "Source=\"" +
                   stem + "_0.vtu\"/><Piece Source=\"" + stem +
                   "_1.vtu\"/></PUnstructuredGrid></VTKFile>");
  }
}

/// ParaView's all.vtp.series over files without times.
inline void write_file_series(const fs::path& folder, const ForeignFlow& flow = {}) {
  std::string list;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const std::string name = "water_" + std::to_string(i) + ".vtp";
    write_plain_vtp(folder / name, flow.fluid(i), "", std::nullopt);
    list += (i > 0 ? ", " : "") + std::string("{\"name\": \"") + name +
            "\", \"time\": " + digits17(i * ForeignFlow::interval) + "}";
  }
  write_text(folder / "all.vtp.series",
             "{\"file-series-version\": \"1.0\", \"files\": [" + list + "]}");
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

/// GPUSPH 5.0: data/PART_#####.vtp, z upwards, single precision of all but the position, raw
/// appended values; VTUinp.pvd names planes and particles as groups without parts.
inline void write_gpusph(const fs::path& folder, const ForeignFlow& flow = {}) {
  std::string list;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 0, 1);
    const std::size_t n = p.position.size();
    std::string head, values;
    const auto append = [&](const std::string& type, const std::string& name, int components,
                            const std::string& bytes) {
      head += "\t<DataArray type='" + type + "' Name='" + name + "'" +
              (components > 1 ? " NumberOfComponents='" + std::to_string(components) + "'" : "") +
              " format='appended' offset='" + std::to_string(values.size()) + "'/>\n";
      const auto size = static_cast<std::uint32_t>(bytes.size());
      values.append(reinterpret_cast<const char*>(&size), sizeof(size));
      values += bytes;
    };
    const auto raw = [](const auto& numbers) {
      return std::string(reinterpret_cast<const char*>(numbers.data()),
                         numbers.size() * sizeof(numbers[0]));
    };
    std::vector<double> position;
    std::vector<float> velocity;
    for (std::size_t k = 0; k < n; ++k) {
      for (const double c : upright(p.position[k])) position.push_back(c);
      for (const double c : upright(p.velocity[k])) velocity.push_back(static_cast<float>(c));
    }
    append("Float64", "Position", 3, raw(position));
    const std::string points = head;
    head.clear();
    append("Float32", "Pressure", 1, raw(std::vector<float>(p.pressure.begin(), p.pressure.end())));
    append("Float32", "Velocity", 3, raw(velocity));
    append("UInt8", "Part type", 1, raw(std::vector<unsigned char>(p.type.begin(), p.type.end())));
    append("UInt16", "Part flags", 1, raw(std::vector<unsigned short>(n, 0)));
    append("UInt32", "Part id", 1, raw(numbers_from(0, n)));
    const std::string data = head;
    head.clear();
    append("UInt32", "connectivity", 1, raw(numbers_from(0, n)));
    append("UInt32", "offsets", 1, raw(numbers_from(1, n)));
    const std::string name = "PART_" + padded(i, 5) + ".vtp", count = std::to_string(n);
    write_text(folder / name,
               "<?xml version='1.0'?>\n<VTKFile type='PolyData'  version='0.1'  "
               "byte_order='LittleEndian'>\n <PolyData>\n  <Piece NumberOfPoints='" +
                   count + "' NumberOfVerts='" + count + "'>\n   <Points>\n" + points +
                   "   </Points>\n   <PointData Scalars='Pressure' Vectors='Velocity'>\n" + data +
                   "   </PointData>\n   <Verts>\n" + head +
                   "   </Verts>\n  </Piece>\n </PolyData>\n <AppendedData encoding='raw'>\n_" +
                   values + " </AppendedData>\n</VTKFile>\n");
    const std::string time = "  <DataSet timestep='" + digits17(i * ForeignFlow::interval);
    list += time + "' group='0' name='Planes' file='PLANES.vtu'/>\n";
    list += time + "' group='1' name='Particles' file='" + name + "'/>\n";
  }
  write_vtu(folder / "PLANES.vtu", {{0, 0, 0}, {0.4, 0, 0}}, "", "", std::nullopt);
  write_text(folder / "VTUinp.pvd",
             "<?xml version='1.0'?>\n<VTKFile type='Collection' version='0.1'>\n <Collection>\n" +
                 list + " </Collection>\n</VTKFile>\n");
}

/// AQUAgpusph 4: set0.<k>.vtu with "imove", and set0.pvd.
inline void write_aquagpusph(const fs::path& folder, const ForeignFlow& flow = {}) {
  std::string list;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 1, -3);
    const std::string name = "set0." + std::to_string(i) + ".vtu";
    write_vtu(folder / name, p.position,
              data_array("id", "UInt32", 1, numbers_from(0, p.position.size())) +
                  data_array("u", "Float32", 3, p.velocity) +
                  data_array("p", "Float32", 1, p.pressure) +
                  data_array("imove", "Int32", 1, p.type),
              "", std::nullopt);
    list += "<DataSet timestep=\"" + digits17(i * ForeignFlow::interval) +
            "\" group=\"\" part=\"0\" file=\"" + name + "\"/>\n";
  }
  write_text(folder / "set0.pvd",
             "<?xml version=\"1.0\"?><VTKFile type=\"Collection\" version=\"0.1\"><Collection>" +
                 list + "</Collection></VTKFile>\n");
}

}  // namespace surge::compare::testing
