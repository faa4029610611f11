#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "compare/measure/front.hpp"
#include "compare/read/foam_dictionary.hpp"
#include "compare/read/readers.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Lower and upper corner of points.
Extent extent_of(std::size_t count, const auto& point) {
  Extent box;
  box.lower.fill(std::numeric_limits<double>::infinity());
  box.upper.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 x = point(i);
    for (std::size_t a = 0; a < 3; ++a) {
      box.lower[a] = std::min(box.lower[a], x[a]);
      box.upper[a] = std::max(box.upper[a], x[a]);
    }
  }
  return box;
}

void require_start(const Run& run, const std::string& option) {
  if (std::abs(run.frames->times().front().value()) > 1e-12) {
    throw Error(run.path.string() + ": the first time is " +
                std::to_string(run.frames->times().front().value()) +
                " s: the column at time 0 expected, or " + option);
  }
}

}  // namespace

void apply_foam_case(Run& run, const SourceOptions& options) {
  run.method = "vof";
  Physics& physics = run.physics;
  const fs::path constant = run.path / "constant";
  if (options.gravity) {
    physics.gravity = Vec3{};
    physics.gravity[static_cast<std::size_t>(options.vertical_axis)] = -*options.gravity;
  } else {
    const std::vector<double> g = FoamDictionary::read(constant / "g").numbers("value", 3);
    physics.gravity = {g[0], g[1], g[2]};
  }
  const std::string phase = options.alpha_array.substr(options.alpha_array.find('.') + 1);
  const auto transport = FoamDictionary::read(constant / "transportProperties");
  physics.density = transport.dictionary(phase).number("rho");
  physics.kinematic_viscosity = transport.dictionary(phase).number("nu");

  const auto frame = std::get<MeshFrame>(run.frames->read(0, Fields{}));
  vtkPoints& points = *frame.grid->GetPoints();
  std::set<double> layers;
  physics.tank =
      extent_of(static_cast<std::size_t>(points.GetNumberOfPoints()), [&](std::size_t i) {
        Vec3 x;
        points.GetPoint(static_cast<vtkIdType>(i), x.data());
        if (layers.size() < 3) layers.insert(x[2]);
        return x;
      });
  physics.dimension = options.dimension.value_or(layers.size() == 2 ? 2 : 3);
  double cell[6];
  frame.grid->GetCellBounds(0, cell);
  run.spacing = options.spacing.value_or(Metres(cell[1] - cell[0]));

  physics.column = *physics.tank;
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  physics.column.upper[up] = unknown;
  if (!options.column_width) {
    require_start(run, "--column-width");
    FrontOptions whole;
    whole.raw_maximum = true;
    const std::optional<double> edge = MeshFront().leading_edge(frame, physics, whole);
    if (!edge)
      throw Error(run.path.string() + ": no water at time 0, a column or --column-width expected");
    if (*edge > physics.tank->upper[0] - 1.5 * run.spacing.value()) {
      throw Error(run.path.string() +
                  ": the water reaches the far wall, x = " + number_text(physics.tank->upper[0]) +
                  " m, at time 0 (a layer of water in the tank, or a column there?); expected a "
                  "column with a free side, or its width (--column-width)");
    }
    physics.column.upper[0] = *edge;
  }
}

}  // namespace surge::compare
