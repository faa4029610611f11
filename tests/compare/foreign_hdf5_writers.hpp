#pragma once

#include <hdf5.h>

#include "compare/read/hdf5_file.hpp"
#include "tests/compare/foreign_flow.hpp"

namespace surge::compare::testing {

/// Writes HDF5 files; groups are made as they are named.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(const fs::path& file)
      : file_(H5Fcreate(prepared(file).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose),
        links_(H5Pcreate(H5P_LINK_CREATE), H5Pclose) {
    H5Pset_create_intermediate_group(links_.id(), 1);
  }

  void group(const std::string& path) const {
    const Hdf5Handle made(
        H5Gcreate2(file_.id(), path.c_str(), links_.id(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  }

  /// Doubles in rows of `columns`.
  void values(const std::string& path, const std::vector<double>& values,
              hsize_t columns = 1) const {
    const hsize_t sizes[2] = {values.size() / columns, columns};
    const Hdf5Handle space(H5Screate_simple(columns == 1 ? 1 : 2, sizes, nullptr), H5Sclose);
    const Hdf5Handle set(H5Dcreate2(file_.id(), path.c_str(), H5T_NATIVE_DOUBLE, space.id(),
                                    links_.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Dclose);
    if (!values.empty())
      H5Dwrite(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }

  /// The same in chunks, compressed.
  void packed(const std::string& path, const std::vector<double>& values, hsize_t columns) const {
    const hsize_t sizes[2] = {values.size() / columns, columns};
    const hsize_t chunk[2] = {64, columns};
    const Hdf5Handle space(H5Screate_simple(2, sizes, nullptr), H5Sclose);
    const Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(layout.id(), 2, chunk);
    H5Pset_deflate(layout.id(), 4);
    const Hdf5Handle set(H5Dcreate2(file_.id(), path.c_str(), H5T_NATIVE_DOUBLE, space.id(),
                                    links_.id(), layout.id(), H5P_DEFAULT),
                         H5Dclose);
    H5Dwrite(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }

  /// One number in a data set without dimensions.
  void number(const std::string& path, double value) const {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle set(H5Dcreate2(file_.id(), path.c_str(), H5T_NATIVE_DOUBLE, space.id(),
                                    links_.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Dclose);
    H5Dwrite(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value);
  }

  void attribute(const std::string& object, const std::string& name, double value) const {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle made(
        H5Acreate_by_name(file_.id(), object.c_str(), name.c_str(), H5T_NATIVE_DOUBLE, space.id(),
                          H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    H5Awrite(made.id(), H5T_NATIVE_DOUBLE, &value);
  }

  [[nodiscard]] hid_t id() const { return file_.id(); }

 private:
  static fs::path prepared(const fs::path& file) {
    fs::create_directories(file.parent_path());
    return file;
  }

  Hdf5Handle file_;
  Hdf5Handle links_;
};

inline std::vector<double> component(const std::vector<Vec3>& vectors, std::size_t axis) {
  std::vector<double> values;
  for (const Vec3& x : vectors) values.push_back(x[axis]);
  return values;
}

/// PySPH (commit a57e653): <case>_<step>.hdf5; arrays that are not saved are empty.
inline void write_pysph(const fs::path& folder, const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const Hdf5Writer out(folder / ("dam_break_2d_" + padded(100 * i, 5) + ".hdf5"));
    for (const std::string body : {"fluid", "boundary"}) {
      const auto all = flow.particles(i, 0, std::nullopt);
      const std::vector<Vec3> x = body == "fluid" ? all.position : flow.walls();
      const std::string arrays = "particles/" + body + "/arrays/";
      const std::size_t n = x.size();
      out.group("particles/" + body + "/constants");
      out.values(arrays + "x", component(x, 0));
      out.values(arrays + "y", component(x, 1));
      out.values(arrays + "z", component(x, 2));
      out.values(arrays + "u", std::vector<double>(n, 0.5));
      out.values(arrays + "v", std::vector<double>(n, -0.25));
      out.values(arrays + "w", std::vector<double>(n, 0.0));
      std::vector<double> pressure = all.pressure;
      pressure.resize(n, 0.0);
      out.values(arrays + "p", pressure);
      out.values(arrays + "m", std::vector<double>(n, 0.1));
      out.values(arrays + "rho", std::vector<double>(n, 1000.0));
      out.values(arrays + "au", {});
    }
    out.group("solver_data");
    out.attribute("solver_data", "t", i * ForeignFlow::interval);
    out.attribute("solver_data", "count", 100.0 * i);
  }
}

/// One file for all times in the manner of H5Part: Step#<k> with x, y, u, v, p, kind, and the time
/// as an attribute.
inline void write_h5part(const fs::path& file, const ForeignFlow& flow = {}) {
  const Hdf5Writer out(file);
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 4, 9);
    const std::string group = "Step#" + std::to_string(i);
    out.values(group + "/x", component(p.position, 0));
    out.values(group + "/y", component(p.position, 1));
    out.values(group + "/vel_x", component(p.velocity, 0));
    out.values(group + "/vel_y", component(p.velocity, 1));
    out.values(group + "/p", p.pressure);
    std::vector<double> kind(p.type.begin(), p.type.end());
    out.values(group + "/kind", kind);
    out.attribute(group, "TimeValue", i * ForeignFlow::interval);
  }
}

/// Units in which a file of SWIFT holds its values, in m, s and kg.
struct GadgetUnits {
  double length = 1.0, time = 1.0, mass = 1.0;
};

/// SWIFT 1.0 and Gadget 4: snap_####.hdf5 with PartType0 and Header@Time; compressed in chunks, as
/// SWIFT does. Only SWIFT writes Units, in cgs.
inline void write_gadget(const fs::path& folder, const std::optional<GadgetUnits>& units,
                         const ForeignFlow& flow = {}) {
  const GadgetUnits unit = units.value_or(GadgetUnits{});
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 0, std::nullopt);
    const Hdf5Writer out(folder / ("snap_" + padded(i, 4) + ".hdf5"));
    std::vector<double> position, velocity, pressure;
    for (const Vec3& x : p.position)
      for (const double c : x) position.push_back(c / unit.length);
    for (const Vec3& v : p.velocity)
      for (const double c : v) velocity.push_back(c * unit.time / unit.length);
    for (const double value : p.pressure)
      pressure.push_back(value * unit.length * unit.time * unit.time / unit.mass);
    out.packed("PartType0/Coordinates", position, 3);
    out.packed("PartType0/Velocities", velocity, 3);
    out.packed("PartType0/Pressures", pressure, 1);
    out.group("Header");
    out.attribute("Header", "Time", i * ForeignFlow::interval / unit.time);
    if (!units) continue;
    out.group("Units");
    out.attribute("Units", "Unit length in cgs (U_L)", 100.0 * unit.length);
    out.attribute("Units", "Unit time in cgs (U_t)", unit.time);
    out.attribute("Units", "Unit mass in cgs (U_M)", 1000.0 * unit.mass);
  }
}

}  // namespace surge::compare::testing
