#include "compare/read/foam_case.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <cmath>
#include <limits>
#include <set>

#include "compare/read/foam_dictionary.hpp"
#include "compare/read/foam_file.hpp"
#include "compare/read/readers.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr const char* axis_names = "xyz";

/// A file of constant/, the region's own where there is one; empty where there is none.
std::optional<FoamDictionary> constant_file(const FoamReader& reader, const std::string& name) {
  for (const fs::path& folder :
       {reader.root() / "constant" / reader.region(), reader.root() / "constant"}) {
    if (has_foam_file(folder / name)) return FoamDictionary::read(folder / name, reader.root());
  }
  return std::nullopt;
}

Vec3 gravity_of(const FoamReader& reader, const SourceOptions& options) {
  if (options.gravity) {
    Vec3 gravity{};
    gravity[static_cast<std::size_t>(options.vertical_axis)] = -*options.gravity;
    return gravity;
  }
  const auto file = constant_file(reader, "g");
  if (!file)
    throw Error((reader.root() / "constant" / "g").string() +
                ": cannot be opened, no such file; the gravity expected there (or --gravity with "
                "--vertical)");
  const std::vector<double> g = file->numbers("value", 3);
  return {g[0], g[1], g[2]};
}

/// Name of the water's phase; empty where the field's name does not say it.
std::string phase_of(const std::string& alpha) {
  const auto dot = alpha.find('.');
  return dot == std::string::npos ? "" : alpha.substr(dot + 1);
}

/// A number of a dictionary that no fluid has below zero, a density above it.
double property(const FoamDictionary& d, const char* key, bool may_be_zero) {
  const double value = d.number(key);
  if (value < 0.0 || (value == 0.0 && !may_be_zero))
    throw Error(d.place() + ": " + key + ": " + number_text(value) + " found, " +
                (may_be_zero ? "at least 0" : "more than 0") + " expected");
  return value;
}

/// The water is the heavier phase; its field named wrongly is the air's, and everything of it
/// wrong.
void expect_heaviest(double density, const std::string& phase, FoamReader& reader) {
  const auto transport = constant_file(reader, "transportProperties");
  const auto phases =
      transport && transport->has("phases") ? transport : constant_file(reader, "phaseProperties");
  if (!phases || !phases->has("phases")) return;
  for (const std::string& other : phases->words("phases")) {
    if (other == phase) continue;
    auto d = constant_file(reader, "physicalProperties." + other);
    if (!d) d = constant_file(reader, "transportProperties." + other);
    if (!d && transport && transport->has_dictionary(other)) d = transport->dictionary(other);
    if (!d || !d->has("rho")) continue;
    const double found = property(*d, "rho", false);
    if (found > density)
      throw Error(d->place() + ": rho: " + number_text(found) + " of " + other + " found and " +
                  number_text(density) + " of " + phase + ", whose field " + reader.alpha() +
                  " is read as the water's; the heavier phase expected");
  }
}

/// Density and viscosity, by the names that the versions of OpenFOAM have for them. What is not
/// found stays empty: Z/L does not need it.
void apply_properties(Physics& physics, FoamReader& reader) {
  std::string phase = phase_of(reader.alpha());
  const auto take = [&](const FoamDictionary& d) {
    if (d.has("rho")) physics.density = property(d, "rho", false);
    if (d.has("nu")) {
      physics.kinematic_viscosity = property(d, "nu", true);
    } else if (d.has("mu") && physics.density) {
      physics.kinematic_viscosity = property(d, "mu", true) / *physics.density;
    }
  };
  const auto transport = constant_file(reader, "transportProperties");
  if (phase.empty() && transport && transport->has("phases") && !transport->words("phases").empty())
    phase = transport->words("phases").front();
  for (const char* name : {"physicalProperties.", "transportProperties."}) {
    if (const auto own = constant_file(reader, name + phase)) take(*own);
  }
  const bool found = physics.density && physics.kinematic_viscosity;
  if (!found && transport && transport->has_dictionary(phase)) take(transport->dictionary(phase));
  if (physics.density) expect_heaviest(*physics.density, phase, reader);
  if (!physics.density || !physics.kinematic_viscosity)
    reader.tell("no density and viscosity of " + (phase.empty() ? reader.alpha() : phase) +
                " in constant/ (physicalProperties, transportProperties): not compared");
}

/// Lower and upper corner of the mesh, and the axes along which it has one layer of cells.
struct MeshBox {
  Extent box;
  std::vector<std::size_t> single;
};

MeshBox box_of(vtkUnstructuredGrid& grid) {
  MeshBox result;
  std::array<std::set<double>, 3> layers;
  result.box.lower.fill(std::numeric_limits<double>::infinity());
  result.box.upper.fill(-std::numeric_limits<double>::infinity());
  for (vtkIdType i = 0; i < grid.GetPoints()->GetNumberOfPoints(); ++i) {
    Vec3 x;
    grid.GetPoints()->GetPoint(i, x.data());
    for (std::size_t a = 0; a < 3; ++a) {
      result.box.lower[a] = std::min(result.box.lower[a], x[a]);
      result.box.upper[a] = std::max(result.box.upper[a], x[a]);
      if (layers[a].size() < 3) layers[a].insert(x[a]);
    }
  }
  for (std::size_t a = 0; a < 3; ++a)
    if (layers[a].size() == 2) result.single.push_back(a);
  return result;
}

/// Length of most cells along x.
Metres cell_length(vtkUnstructuredGrid& grid, FoamReader& reader) {
  std::vector<double> lengths;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    double b[6];
    grid.GetCellBounds(c, b);
    lengths.push_back(b[1] - b[0]);
  }
  const auto [least, most] = std::minmax_element(lengths.begin(), lengths.end());
  const double low = *least, high = *most;
  const double middle = boost::math::statistics::median(lengths);
  if (high > 1.01 * low)
    reader.tell("cells are " + six_digits(low) + " to " + six_digits(high) +
                " m long along x: the median " + six_digits(middle) + " m is taken as spacing");
  return Metres(middle);
}

/// Greatest speed of a frame, m/s; 0 where it has no velocity.
double speed_of(const MeshFrame& frame) {
  vtkDataArray* velocity = frame.grid->GetCellData()->GetArray("U");
  return velocity == nullptr ? 0.0 : velocity->GetMaxNorm();
}

/// Whether the first time, later than 0, is the start of the flow: the case starts there, no solver
/// has written it, and the water is at rest.
bool starts_there(FoamReader& reader, double time) {
  try {
    const auto control =
        FoamDictionary::read(reader.root() / "system" / "controlDict", reader.root());
    if (std::abs(control.number("startTime") - time) > 1e-9 * std::abs(time)) return false;
  } catch (const Error&) {
    return false;
  }
  const fs::path written = reader.first_time_folder() / "uniform" / "time";
  if (has_foam_file(written) && FoamDictionary::read(written, reader.root()).number("index") > 0.0)
    return false;
  const auto frame = std::get<MeshFrame>(reader.read(0, Fields{.velocity = true}));
  return speed_of(frame) <= 1e-9;
}

void settle_start(FoamReader& reader) {
  const double first = reader.times().front().value();
  if (std::abs(first) <= 1e-12 || !starts_there(reader, first)) return;
  reader.count_from_start();
  reader.tell("times count from the start of the case, " + number_text(first) + " s");
}

/// What controlDict says of the times; what it does not say in plain numbers is not known.
struct StatedTimes {
  double interval = 0.0;  ///< s
  double end = 0.0;       ///< s
};

StatedTimes stated_times(const fs::path& root) {
  StatedTimes stated;
  try {
    const auto control = FoamDictionary::read(root / "system" / "controlDict", root);
    const std::vector<std::string> kind = control.words("writeControl");
    if (kind.size() == 1 &&
        (kind[0] == "adjustableRunTime" || kind[0] == "runTime" || kind[0] == "adjustable"))
      stated.interval = control.number("writeInterval");
    stated.end = control.number("endTime");
  } catch (const Error&) {
    // Only a hint at times that are missing.
  }
  return stated;
}

/// Tells of times that are missing: against what controlDict states, else against each other.
void check_gaps(FoamReader& reader) {
  const StatedTimes stated = stated_times(reader.root());
  const double start = reader.start();
  const std::vector<Seconds>& times = reader.times();
  std::vector<double> gaps;
  for (std::size_t i = 1; i < times.size(); ++i) gaps.push_back((times[i] - times[i - 1]).value());
  double usual = stated.interval;
  if (!(usual > 0.0)) {
    if (gaps.empty()) return;
    std::vector<double> sorted = gaps;
    std::sort(sorted.begin(), sorted.end());
    usual = sorted[(sorted.size() - 1) / 2];
  }
  std::string where;
  std::size_t count = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (gaps[i] <= 1.5 * usual || ++count > 5) continue;
    where.append(where.empty() ? "" : ", ")
        .append(number_text(times[i].value()))
        .append(" to ")
        .append(number_text(times[i + 1].value()));
  }
  if (count > 0)
    reader.tell(std::to_string(count) + (count == 1 ? " gap" : " gaps") +
                " in the times, which are else " + six_digits(usual) + " s apart: " + where +
                (count > 5 ? ", ..." : ""));
  const double last = start + times.back().value();
  if (stated.interval > 0.0 && stated.end - last > 0.5 * usual)
    reader.tell("the last time is " + six_digits(last) + " s, endTime of the case " +
                six_digits(stated.end) + " s (not finished?)");
}

void settle_axes(FoamReader& reader, const Vec3& gravity, std::optional<std::size_t> empty,
                 const std::optional<FileAxes>& stated) {
  const auto frame = std::get<MeshFrame>(reader.read(0, Fields{}));
  const FoamAxes axes = foam_axes(gravity, empty, frame, stated);
  if (axes == FoamAxes{}) return;
  reader.set_axes(axes);
  const auto name = [&](std::size_t a) {
    return std::string(axes.sign[a] < 0.0 ? "-" : "") + axis_names[axes.from[a]];
  };
  reader.tell("axes: " + name(0) + ", " + name(1) + ", " + name(2) +
              " of the case are read as x (along the surge), y, z");
}

}  // namespace

void apply_foam_case(Run& run, const SourceOptions& options) {
  auto& reader = dynamic_cast<FoamReader&>(*run.frames);
  run.method = "vof";
  run.reading["alpha_array"] = reader.alpha();
  Physics& physics = run.physics;
  const Vec3 gravity = gravity_of(reader, options);
  apply_properties(physics, reader);
  MeshBox mesh = box_of(*std::get<MeshFrame>(reader.read(0, Fields{})).grid);
  std::optional<std::size_t> empty = reader.empty_axis();
  if (!empty && !mesh.single.empty()) {
    empty = mesh.single.back();
    reader.tell(std::string("one layer of cells along ") + axis_names[*empty] +
                ": read as a 2D case");
  }
  settle_axes(reader, gravity, empty, options.axes);
  settle_start(reader);
  check_gaps(reader);
  const auto frame = std::get<MeshFrame>(reader.read(0, Fields{}));
  physics.gravity = reader.axes().read(gravity);
  physics.dimension = options.dimension.value_or(empty ? 2 : 3);
  physics.tank = box_of(*frame.grid).box;
  run.spacing = options.spacing ? *options.spacing : cell_length(*frame.grid, reader);
  physics.column = *physics.tank;
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  physics.column.upper[up] = not_a_number;
  if (options.column_width) return;
  if (std::abs(reader.times().front().value()) > 1e-12)
    throw Error(run.path.string() + ": the first time is " +
                number_text(reader.times().front().value()) +
                " s: the column at time 0 expected, or --column-width");
  WaterDepths depths =
      water_depths(frame, reader.volumes(), *physics.tank, up, run.spacing.value());
  const double highest = *std::max_element(depths.depth.begin(), depths.depth.end());
  // The column is what stands out of the water that lies in the tank.
  if (options.bed_depth) {
    for (double& depth : depths.depth) depth = std::max(0.0, depth - options.bed_depth->value());
  }
  physics.column.upper[0] = column_edge(depths, run.path.string());
  physics.column.upper[up] = physics.floor() + highest;
}

}  // namespace surge::compare
