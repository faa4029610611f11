#include "compare/report/viewer.hpp"

#include <algorithm>
#include <cmath>

#include "compare/figures/figures.hpp"
#include "compare/figures/style.hpp"
#include "compare/figures/surface.hpp"
#include "compare/report/viewer_encoding.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// The part of the reference's water that the panels must show; drops above are marked.
constexpr double shown_part = 0.98;

/// gnuplot's dash as lengths for a drawing on the screen.
json dash_lengths(const std::string& dash) {
  json lengths = json::array();
  if (dash == "solid") return lengths;
  for (char c : dash) {
    if (c != '-' && c != '.' && c != '_') continue;
    lengths.push_back(c == '-' ? 6.0 : c == '_' ? 11.0 : 1.5);
    lengths.push_back(3.0);
  }
  return lengths;
}

/// As in Fig. 8.
LineStyle style_of(const StudyResult& study, const RunResult* shown) {
  std::size_t index = 0;
  for (const RunResult* run : study.measured()) {
    if (run == shown) break;
    if (run != &study.reference()) ++index;
  }
  return shown == &study.reference() ? reference_style() : run_style(index);
}

struct Shown {  // NOLINT(bugprone-exception-escape): what json destroys throws nothing
  json run;
  double height = 0.0;           ///< that the water needs, over L
  std::array<double, 2> span{};  ///< along x, over L
};

/// Water at all times of the plan. `add(patches)` and `encoded()` are the track's; in 3D it gets
/// all of the water, and the line of the free surface is that of the slice.
template <typename Track, typename Prepare>
Shown followed(const RunResult* result, const ViewerPlan& plan, Track water, Prepare prepare) {
  const Run& run = result->measured->run;
  const bool in_space = run.physics.dimension == 3;
  SurfaceTrack surface(run.spacing / run.physics.column_width());
  const Solids solids = solids_of(run);
  Shown shown;
  for (Seconds time : plan.times) {
    const auto index = frame_near(run.frames->times(), time);
    if (!index) {
      water.add({});
      surface.add({});
      continue;
    }
    const Frame frame = run.frames->read(*index, {.pressure = true, .velocity = true});
    const WaterPicture picture = water_picture(frame, run);
    water.add(prepare(in_space ? water_in_space(frame, run) : picture.patches));
    surface.add(free_surface(picture, solids, time));
    shown.height = std::max(shown.height, picture.height_of(shown_part));
  }
  shown.run["water"] = water.encoded();
  shown.run["surface"] = surface.encoded();
  shown.span = water.span();
  return shown;
}

Shown encode(const StudyResult& study, const ViewerPlan& plan, const RunResult* result) {
  const Run& run = result->measured->run;
  const int dimension = run.physics.dimension;
  const double edge = viewer_square(run), spacing = run.spacing / run.physics.column_width();
  Shown shown = run.is_mesh()
                    ? followed(result, plan, MeshTrack(edge, dimension),
                               [&](const auto& cells) { return coarse_cells(cells, edge); })
                    : followed(result, plan, ParticleTrack(spacing, dimension),
                               [](const auto& particles) { return particles; });
  const LineStyle style = style_of(study, result);
  shown.run["name"] = result->study.name;
  shown.run["label"] = result->label();
  shown.run["note"] = result->note;
  shown.run["colour"] = style.colour.hex();
  shown.run["dash"] = dash_lengths(style.dash);
  return shown;
}

std::string palette() {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 256; ++i) {
    const Colour colour = viridis(i / 255.0);
    bytes.insert(bytes.end(), {colour.red, colour.green, colour.blue});
  }
  return base64(bytes);
}

/// A side that is not known is null.
json number_or_null(double value) {
  return std::isfinite(value) ? json(value) : json();
}

json rectangle_json(const Rectangle& box) {
  return {number_or_null(box.x0), number_or_null(box.y0), number_or_null(box.x1),
          number_or_null(box.y1)};
}

json box_json(const Rectangle& plane, const DepthRange& depth) {
  return {number_or_null(plane.x0), number_or_null(plane.y0), number_or_null(depth.from),
          number_or_null(plane.x1), number_or_null(plane.y1), number_or_null(depth.to)};
}

/// The same in space, boxes of [x0, y0, z0, x1, y1, z1]: {"tank", "obstacles", "walls": [one box
/// per time]}, the plane of the slice, {"middle"}, over L, and {"towards"}: 1 where x, up and the
/// depth are a right-handed system, else -1; {"surfaces"}: corners of triangles, each a list.
json space_json(const Run& run, const Solids& solids, const std::vector<Seconds>& times) {
  const PictureScale scale(run);
  json out{{"tank", solids.tank ? box_json(*solids.tank, solids.tank_depth) : json()},
           {"middle", scale.z(scale.middle)},
           {"towards", scale.up == 1 ? 1 : -1},
           {"surfaces", solids.surfaces},
           {"obstacles", json::array()},
           {"walls", json::array()}};
  for (const Solids::Block& block : solids.blocks)
    out["obstacles"].push_back(box_json(block.plane, block.depth));
  for (const Solids::MovingWall& wall : solids.walls) {
    json boxes = json::array();
    for (Seconds time : times) boxes.push_back(box_json(wall.at(time), wall.depth_at(time)));
    out["walls"].push_back(boxes);
  }
  return out;
}

/// {"tank": [x0, y0, x1, y1] or null, "open": sides, "obstacles": [boxes], "outlines": [[[x, y]
/// of corners]], "walls": [{"boxes": one
/// per time}]}, over L.
json solids_json(const Solids& solids, const std::vector<Seconds>& times) {
  json out{{"tank", solids.tank ? rectangle_json(*solids.tank) : json()},
           {"open", solids.open},
           {"up", solids.up_side.substr(0, 1)},
           {"outlines", solids.outlines},
           {"obstacles", json::array()},
           {"walls", json::array()}};
  for (const Rectangle& box : solids.obstacles) out["obstacles"].push_back(rectangle_json(box));
  for (const Solids::MovingWall& wall : solids.walls) {
    json boxes = json::array();
    for (Seconds time : times) boxes.push_back(rectangle_json(wall.at(time)));
    out["walls"].push_back(boxes);
  }
  return out;
}

json page_data(const StudyResult& study, const ViewerPlan& plan, const json& metrics) {
  const Run& solid = viewer_solid_run(study, plan);
  const Solids solids = solids_of(solid);
  json data{{"metrics", metrics.at("viewer")},
            {"palette", palette()},
            {"runs", json::array()},
            {"title", study.study.title},
            {"solids", solids_json(solids, plan.times)},
            {"space", nullptr}};
  if (solid.physics.dimension == 3) data["space"] = space_json(solid, solids, plan.times);
  const auto end = window_end(study);
  data["window_end"] = end ? json(end->value()) : json();
  double left = 0.0, right = 1.0, height = 1.0;
  bool left_known = false, right_known = false;
  if (solids.tank) {
    left_known = std::isfinite(solids.tank->x0);
    right_known = std::isfinite(solids.tank->x1);
    if (left_known) left = solids.tank->x0;
    if (right_known) right = solids.tank->x1;
  }
  for (const RunResult* run : plan.runs) {
    Shown shown = encode(study, plan, run);
    const bool reference = run == &study.reference();
    if (!left_known) left = std::min(left, shown.span[0]);
    if (!right_known) right = std::max(right, shown.span[1]);
    if (reference) height = shown.height;
    shown.run["reference"] = reference;
    data["runs"].push_back(std::move(shown.run));
  }
  height = std::ceil(2.0 * (height + 0.05)) / 2.0;
  // A tank that is hardly higher than its water is shown to its roof.
  if (solids.tank && std::isfinite(solids.tank->y1))
    height = std::min(height, std::max(solids.tank->y1, 0.1));
  data["view"] = {{"x0", left}, {"y0", 0.0}, {"width", right - left}, {"height", height}};
  return data;
}

}  // namespace

json viewer_json(const StudyResult& study, const json& metrics) {
  const ViewerPlan plan = plan_viewer(study);
  json left_out = json::array();
  for (const RunResult* run : plan.left_out) left_out.push_back(run->study.name);
  return {{"data", page_data(study, plan, metrics)}, {"left_out", left_out}};
}

}  // namespace surge::compare
