#pragma once

#include "tests/compare/foreign_flow.hpp"

namespace surge::compare::testing {

// Text files as other programs write them, each by a small writer of our own.

/// Rows of numbers under a line of names.
inline std::string csv_text(const std::vector<std::string>& names,
                            const std::vector<std::vector<double>>& rows,
                            const std::string& separator, bool trailing = false) {
  std::ostringstream out;
  out << std::setprecision(17);
  for (std::size_t i = 0; i < names.size(); ++i) out << (i > 0 ? separator : "") << names[i];
  out << (trailing ? separator : "") << '\n';
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) out << (i > 0 ? separator : "") << row[i];
    out << (trailing ? separator : "") << '\n';
  }
  return out.str();
}

/// OpenMps (commit 86da127): result/particles_#####.csv; 0 fluid, 1 wall; x-z plane; no times.
inline void write_openmps(const fs::path& folder, const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 0, 1);
    std::vector<std::vector<double>> rows;
    for (std::size_t k = 0; k < p.position.size(); ++k)
      rows.push_back({static_cast<double>(p.type[k]), p.position[k][0], p.position[k][1],
                      p.velocity[k][0], p.velocity[k][1], p.pressure[k], 6.5});
    write_text(folder / ("particles_" + padded(i, 5) + ".csv"),
               csv_text({"Type", "x", "z", "u", "w", "p", "n"}, rows, ", "));
  }
}

inline std::vector<std::vector<double>> dualsphysics_rows(const ForeignFlow::Particles& p,
                                                          bool pressure) {
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < p.position.size(); ++k) {
    const Vec3 x = upright(p.position[k]), v = upright(p.velocity[k]);
    rows.push_back({x[0], x[1], x[2], static_cast<double>(k), v[0], v[1], v[2], 1000.0,
                    static_cast<double>(p.type[k])});
    if (pressure) rows.back().insert(rows.back().begin() + 8, p.pressure[k]);
  }
  return rows;
}

/// DualSPHysics 5.4, the solver's own -sv:csv: data/PartCsv_####.csv. It states no pressure.
inline void write_dualsphysics_csv(const fs::path& folder, const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i)
    write_text(folder / ("PartCsv_" + padded(i, 4) + ".csv"),
               csv_text({"Pos.x [m]", "Pos.y [m]", "Pos.z [m]", "Idp", "Vel.x [m/s]", "Vel.y [m/s]",
                         "Vel.z [m/s]", "Rho [kg/m^3]", "Type"},
                        dualsphysics_rows(flow.particles(i, 3, 0), false), ";", true));
}

/// DualSPHysics 5.2, PartVTK -savecsv -vars:+type,+press: a head with the time above the table.
inline void write_partvtk_csv(const fs::path& folder, const std::string& separator = ";",
                              const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 3, 0);
    const std::string head = csv_text(
        {"TimeStep [s]", "Np", "Nbound", "Nfixed", "Nmoving", "Nfloat", "Nfluid"},
        {{i * ForeignFlow::interval, static_cast<double>(p.position.size()), 102, 102, 0, 0, 200}},
        separator);
    write_text(folder / ("PartAll_" + padded(i, 4) + ".csv"),
               head + "\n" +
                   csv_text({"Pos.x [m]", "Pos.y [m]", "Pos.z [m]", "Idp", "Vel.x [m/s]",
                             "Vel.y [m/s]", "Vel.z [m/s]", "Rhop [kg/m^3]", "Press [Pa]", "Type"},
                            dualsphysics_rows(p, true), separator, true));
  }
}

/// The files beside a run of DualSPHysics 5.4 that state its particle distance, gravity and times.
inline void write_dualsphysics_run(const fs::path& folder) {
  write_text(folder / "Run.csv",
             "#RunName;Np;Hardware;Nbound;Dp;H\nCase;302;CPU;102;0.01;0.0141\n");
  write_text(folder / "Run.out", "Kernel=\"Wendland\"\nGravity=(0,0,-9.81)\nRhopOut=True\n");
  std::string parts = "Part;TimeStep [s];Steps\n";
  for (int i = 0; i < ForeignFlow::frames; ++i)
    parts += std::to_string(i) + ";" + digits17(i * ForeignFlow::interval) + ";" +
             std::to_string(166 * i) + "\n";
  write_text(folder / "RunPARTs.csv", parts);
}

/// MPS-Basic (commit 9399a21): csv/output_####.csv with time and count above the table; 1 fluid, 2
/// wall.
inline void write_mps_basic_csv(const fs::path& folder, const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 1, 2);
    std::vector<std::vector<double>> rows;
    for (std::size_t k = 0; k < p.position.size(); ++k)
      rows.push_back({static_cast<double>(p.type[k]), 0, p.position[k][0], p.position[k][1], 0,
                      p.velocity[k][0], p.velocity[k][1], 0});
    write_text(folder / ("output_" + padded(i, 4) + ".csv"),
               digits17(i * ForeignFlow::interval) + "\n" + std::to_string(rows.size()) + "\n" +
                   csv_text({"type", "fluidType", "x", "y", "z", "vx", "vy", "vz"}, rows, ","));
  }
}

/// MPS-Basic's prof/output_####.prof: time, count, then type, position and velocity in blanks.
inline void write_mps_basic_prof(const fs::path& folder, const ForeignFlow& flow = {}) {
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 1, 2);
    std::string text =
        digits17(i * ForeignFlow::interval) + "\n" + std::to_string(p.position.size()) + "\n";
    for (std::size_t k = 0; k < p.position.size(); ++k)
      text += std::to_string(p.type[k]) + " " + digits17(p.position[k][0]) + " " +
              digits17(p.position[k][1]) + " 0 0.5 -0.25 0\n";
    write_text(folder / ("output_" + padded(i, 4) + ".prof"), text);
  }
}

/// How a LAMMPS dump (2 Aug 2023, dump custom) holds its coordinates.
struct DumpLayout {
  bool scaled = false;
  bool one_file = true;
  bool time = false;             ///< dump_modify time yes
  std::optional<double> tilt{};  ///< xy of a triclinic box
  std::string bounds = "ff ff pp";
};

inline void write_lammps(const fs::path& folder, const DumpLayout& layout,
                         const ForeignFlow& flow = {}) {
  const double lower = -0.02, size = 0.5;
  std::string all;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 1, 2);
    std::ostringstream out;
    out << std::setprecision(17) << "ITEM: TIMESTEP\n" << 200 * i << '\n';
    if (layout.time) out << "ITEM: TIME\n" << i * ForeignFlow::interval << '\n';
    out << "ITEM: NUMBER OF ATOMS\n"
        << p.position.size() << "\nITEM: BOX BOUNDS " << (layout.tilt ? "xy xz yz " : "")
        << layout.bounds << '\n';
    for (int a = 0; a < 3; ++a) {
      out << lower << ' ' << lower + size;
      if (layout.tilt) out << ' ' << (a == 0 ? *layout.tilt : 0.0);
      out << '\n';
    }
    out << (layout.scaled ? "ITEM: ATOMS id type xs ys zs vx vy vz\n"
                          : "ITEM: ATOMS id type x y z vx vy vz\n");
    for (std::size_t k = 0; k < p.position.size(); ++k) {
      out << k + 1 << ' ' << p.type[k];
      for (const double x : p.position[k]) out << ' ' << (layout.scaled ? (x - lower) / size : x);
      for (const double v : p.velocity[k]) out << ' ' << v;
      out << '\n';
    }
    if (layout.one_file) {
      all += out.str();
    } else {
      write_text(folder / ("dump.fluid." + std::to_string(200 * i)), out.str());
    }
  }
  if (layout.one_file) write_text(folder / "dump.lammpstrj", all);
}

/// A table of all times with a column for the time, as a script of one's own writes it.
inline void write_time_table(const fs::path& file, const std::string& separator,
                             const ForeignFlow& flow = {}) {
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = flow.particles(i, 1, 2);
    for (std::size_t k = 0; k < p.position.size(); ++k)
      rows.push_back({i * ForeignFlow::interval, 1000.0 * p.position[k][0],
                      1000.0 * p.position[k][1], 500.0, -250.0, p.pressure[k] / 1000.0,
                      static_cast<double>(p.type[k])});
  }
  write_text(file, csv_text({"t", "px", "py", "vx", "vy", "p", "kind"}, rows, separator));
}

}  // namespace surge::compare::testing
