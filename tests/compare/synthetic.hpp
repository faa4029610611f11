#pragma once

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "compare/measure/front.hpp"
#include "compare/read/run.hpp"
#include "compare/study/metrics.hpp"
#include "particle/support/error.hpp"
#include "tests/places.hpp"

namespace surge::compare::testing {

using tests::TemporaryFolder;

inline std::filesystem::path write_text(const std::filesystem::path& file,
                                        const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
  return file;
}

/// How many seeded mutations of each kind of source are tried: 60 at every run of the tests, 300
/// and more in the campaign (SURGE_MUTATIONS).
inline unsigned mutation_count() {
  const char* asked = std::getenv("SURGE_MUTATIONS");
  return asked ? static_cast<unsigned>(std::stoul(asked)) : 60U;
}

/// The message of the error that an action throws; empty where it throws none.
inline std::string refusal_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const surge::Error& error) {
    return error.what();
  }
  return {};
}

/// The message of the surge::Error that `action` throws; fails the test where it throws none.
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const surge::Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no surge::Error";
  return {};
}

/// The dam break of the paper: L = 0.145 m, tank 4L wide.
inline Physics dam_break() {
  Physics physics;
  physics.column = {{0, 0, 0}, {0.145, 0.29, 0}};
  physics.tank = Extent{{0, 0, 0}, {0.58, 1.16, 0}};
  physics.density = 1000;
  physics.kinematic_viscosity = 0;
  physics.wall = "slip";
  physics.blocks = {WaterBody{"box", physics.column, {}}};
  physics.obstacles.emplace();
  physics.open = {"y+"};
  physics.periodic.emplace();
  physics.motion = nlohmann::json(nullptr);
  physics.moving_walls = nlohmann::json::array();
  return physics;
}

/// Centres of the cells of size l0 that fill a box.
inline std::vector<Vec3> lattice(const Vec3& lower, const Vec3& upper, double l0) {
  std::array<int, 3> n{};
  for (std::size_t a = 0; a < 3; ++a)
    n[a] = static_cast<int>(std::lround((upper[a] - lower[a]) / l0));
  const bool flat = n[2] == 0;
  std::vector<Vec3> points;
  for (int i = 0; i < n[0]; ++i) {
    for (int j = 0; j < n[1]; ++j) {
      for (int k = 0; k < std::max(n[2], 1); ++k) {
        points.push_back({lower[0] + (i + 0.5) * l0, lower[1] + (j + 0.5) * l0,
                          flat ? lower[2] : lower[2] + (k + 0.5) * l0});
      }
    }
  }
  return points;
}

inline void append(std::vector<Vec3>& points, const std::vector<Vec3>& more) {
  points.insert(points.end(), more.begin(), more.end());
}

/// A frame as observables see it.
inline FrameView view_of(Frame frame, const Physics& physics, double spacing) {
  FrameView view(physics, Metres(spacing));
  view.show(std::move(frame));
  return view;
}

inline ParticleFrame particles(std::vector<Vec3> position, double time = 0.0) {
  ParticleFrame frame;
  frame.time = Seconds(time);
  frame.position = std::move(position);
  return frame;
}

/// A box of nx x ny x nz cells, alpha given by the integral mean over each cell of `water`
/// (sampled `samples` times per axis; 1 takes the centre).
inline MeshFrame box_mesh(const Vec3& upper, std::array<int, 3> n,
                          const std::function<double(Vec3)>& water, int samples = 1) {
  MeshFrame frame;
  frame.grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  frame.alpha_name = "alpha.water";
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const Vec3 h{upper[0] / n[0], upper[1] / n[1], upper[2] / n[2]};
  for (int k = 0; k <= n[2]; ++k) {
    for (int j = 0; j <= n[1]; ++j) {
      for (int i = 0; i <= n[0]; ++i) points->InsertNextPoint(i * h[0], j * h[1], k * h[2]);
    }
  }
  frame.grid->SetPoints(points);
  const auto id = [&](int i, int j, int k) {
    return (vtkIdType{k} * (n[1] + 1) + j) * (n[0] + 1) + i;
  };
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const std::array<vtkIdType, 8> corners{
            id(i, j, k),     id(i + 1, j, k),     id(i + 1, j + 1, k),     id(i, j + 1, k),
            id(i, j, k + 1), id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)};
        frame.grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
        // A single layer of cells is sampled in its middle.
        const int deep = n[2] == 1 ? 1 : samples;
        double sum = 0.0;
        for (int a = 0; a < samples; ++a) {
          for (int b = 0; b < samples; ++b) {
            for (int c = 0; c < deep; ++c) {
              sum += water({(i + (a + 0.5) / samples) * h[0], (j + (b + 0.5) / samples) * h[1],
                            (k + (c + 0.5) / deep) * h[2]});
            }
          }
        }
        frame.alpha.push_back(sum / (samples * samples * deep));
      }
    }
  }
  return frame;
}

/// Gives each cell a value of its middle.
inline void add_cell_field(MeshFrame& frame, const char* name, int components,
                           const std::function<Vec3(Vec3)>& value) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (vtkIdType c = 0; c < frame.grid->GetNumberOfCells(); ++c) {
    double b[6];
    frame.grid->GetCellBounds(c, b);
    const Vec3 v = value({0.5 * (b[0] + b[1]), 0.5 * (b[2] + b[3]), 0.5 * (b[4] + b[5])});
    array->InsertNextTuple(v.data());
  }
  frame.grid->GetCellData()->AddArray(array);
}

inline void add_velocity(MeshFrame& frame, const std::function<Vec3(Vec3)>& velocity) {
  add_cell_field(frame, "U", 3, velocity);
}

inline void add_pressure(MeshFrame& frame, const std::function<double(Vec3)>& pressure) {
  add_cell_field(frame, "p", 1, [&](const Vec3& x) { return Vec3{pressure(x), 0, 0}; });
}

/// Writes particles as surge-particle does.
inline void write_vtp(const std::filesystem::path& file, const std::vector<Vec3>& position,
                      const std::vector<int>& type, const std::string& type_name = "type",
                      std::optional<double> time = std::nullopt) {
  std::filesystem::create_directories(file.parent_path());
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIntArray> types;
  types->SetName(type_name.c_str());
  vtkNew<vtkDoubleArray> pressure;
  pressure->SetName("pressure");
  vtkNew<vtkDoubleArray> velocity;
  velocity->SetName("velocity");
  velocity->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < position.size(); ++i) {
    points->InsertNextPoint(position[i].data());
    types->InsertNextValue(type.empty() ? 0 : type[i]);
    pressure->InsertNextValue(100.0 * static_cast<double>(i));
    velocity->InsertNextTuple3(static_cast<double>(i), 2.0, 0.0);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(types);
  data->GetPointData()->AddArray(pressure);
  data->GetPointData()->AddArray(velocity);
  if (time) {
    vtkNew<vtkDoubleArray> value;
    value->SetName("TimeValue");
    value->InsertNextValue(*time);
    data->GetFieldData()->AddArray(value);
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(data);
  writer->Write();
}

/// A manifest of the dam break with the keys that both programs write.
inline nlohmann::json dam_break_manifest() {
  return nlohmann::json::parse(R"({
    "program": "surge-particle", "version": "0.1.0", "commit": "c", "compiler": "g", "flags": "", "cpu": "x",
    "threads": 1, "started": "2026-01-01T00:00:00Z", "finished": true, "wall_s": {"total": 2.5, "setup": 0.1},
    "steps": 1200, "simulated_s": 1.0, "fluid_particles": 1682, "wall_particles": 300, "lost_particles": 0,
    "nonfinite": 0,
    "case": {"title": "dam break", "dimension": 2, "spacing": 0.005,
      "fluid": {"density": 1000, "kinematic_viscosity": 0, "gravity": [0, -9.81, 0]},
      "tank": {"lower": [0, 0, 0], "upper": [0.58, 1.16, 0], "open": ["y+"], "periodic": [], "wall": "slip"},
      "blocks": [{"shape": "box", "lower": [0, 0, 0], "upper": [0.145, 0.29, 0], "velocity": [0, 0, 0]}],
      "obstacles": [], "method": {"name": "mps", "preset": "paper", "parameters": {}}}})");
}

/// A run folder whose floor layers of water reach x(t) at each time.
inline void write_run(const std::filesystem::path& folder, const std::vector<double>& times,
                      const std::function<double(double)>& edge,
                      const nlohmann::json& manifest = dam_break_manifest()) {
  write_text(folder / "manifest.json", manifest.dump());
  std::string list;
  // As the manifest says, where it says it in a form that can be read.
  const auto spacing = nlohmann::json::json_pointer("/case/spacing");
  const bool stated = manifest.contains(spacing) && manifest.at(spacing).is_number() &&
                      manifest.at(spacing).get<double>() > 0.0;
  const double l0 = stated ? manifest.at(spacing).get<double>() : 0.005;
  for (std::size_t i = 0; i < times.size(); ++i) {
    std::vector<Vec3> points = lattice({0, 0, 0}, {0.145, 0.29, 0}, l0);
    // Layers that end exactly at the edge, however far: the last particle is moved back to it.
    const double reach = edge(times[i]);
    for (double x = 0.145 + l0 / 2; x < reach - l0 / 2; x += l0) points.push_back({x, l0 / 2, 0});
    points.push_back({reach - l0 / 2, l0 / 2, 0});
    std::vector<int> type(points.size(), 0);
    points.push_back({0.58 + l0 / 2, l0 / 2, 0});
    type.push_back(1);
    const std::string name = "frames/particles_" + std::to_string(i) + ".vtp";
    write_vtp(folder / name, points, type);
    list += "<DataSet timestep=\"" + std::to_string(times[i]) + "\" file=\"" + name + "\"/>\n";
  }
  write_text(folder / "particles.pvd",
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
             "<Collection>\n" +
                 list + "</Collection>\n</VTKFile>\n");
}

/// A front through points (T, Z/L).
inline DimensionlessFront front_of(const std::vector<std::pair<double, double>>& points) {
  DimensionlessFront front;
  for (const auto& [t, z] : points)
    front.samples.push_back({DimensionlessTime(t), DimensionlessLength(z)});
  return front;
}

}  // namespace surge::compare::testing
