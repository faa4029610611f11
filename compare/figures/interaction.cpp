#include <algorithm>
#include <cmath>
#include <sstream>

#include "compare/figures/method.hpp"
#include "compare/figures/style.hpp"

namespace surge::compare {

namespace {

constexpr const char* interaction_title = "Fig. 2. Interaction domain of a particle";
constexpr double beyond = 1.5;  ///< by which the picture reaches beyond the largest radius, l0

/// The run's last frame that is not after the study's second snapshot time.
std::size_t chosen_frame(const StudyResult& study, const std::vector<Seconds>& times) {
  const auto& wanted = study.study.snapshot_times;
  if (wanted.empty()) return times.size() / 2;
  const Seconds time = wanted[std::min<std::size_t>(1, wanted.size() - 1)];
  std::size_t found = 0;
  while (found + 1 < times.size() && times[found + 1] <= time + Seconds(1e-9)) ++found;
  return found;
}

/// Index of the particle nearest to the mean position.
std::size_t central_particle(const std::vector<Vec3>& position) {
  Vec3 mean{};
  for (const Vec3& r : position) {
    for (std::size_t a = 0; a < 3; ++a) mean[a] += r[a] / static_cast<double>(position.size());
  }
  const auto distance = [&](const Vec3& r) {
    return std::hypot(r[0] - mean[0], r[1] - mean[1], r[2] - mean[2]);
  };
  const auto nearest =
      std::min_element(position.begin(), position.end(),
                       [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(nearest - position.begin());
}

/// A circle around the particle as part of a plot command: a dashed object would be drawn white.
std::string circle(double radius, const std::string& dash) {
  const std::string r = plot_number(radius);
  return ", \\\n     [a=0:2*pi] '+' using (" + r + "*cos($1)):(" + r +
         "*sin($1)) with lines lw 1.4 lc rgb \"#202020\" dt " + dash;
}

/// A line from the particle to a circle with the radius on it, where the picture has room for it.
std::string radius_arrow(double radius, double degrees, const std::string& text) {
  const double angle = degrees * std::acos(-1.0) / 180.0;
  const double x = radius * std::cos(angle), y = radius * std::sin(angle);
  return "set arrow from 0,0 to " + plot_number(x) + "," + plot_number(y) +
         " front head size 0.25,20 filled lw 1 lc rgb \"#202020\"\nset label \"" + text + "\" at " +
         plot_number(0.55 * x) + "," + plot_number(0.55 * y) + " center front boxed\n";
}

}  // namespace

std::optional<Interaction> find_interaction(const StudyResult& study) {
  auto from = sheet_run(study, "mps");
  if (!from) from = sheet_run(study, "sph");
  if (!from) return std::nullopt;
  Interaction out;
  out.run = from->run;
  const Run& run = from->run->measured->run;
  const double l0 = run.spacing.value();
  for (const auto& f : from->sheet.functions) {
    const double radius = f.support / l0;
    if (std::find(out.radii_over_l0.begin(), out.radii_over_l0.end(), radius) ==
        out.radii_over_l0.end())
      out.radii_over_l0.push_back(radius);
  }
  std::sort(out.radii_over_l0.rbegin(), out.radii_over_l0.rend());
  const std::size_t index = chosen_frame(study, run.frames->times());
  out.time = run.frames->times()[index];
  const Frame frame = run.frames->read(index, {});
  const auto& position = std::get<ParticleFrame>(frame).position;
  const std::size_t centre = central_particle(position);
  out.position = position[centre];
  const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
  const double reach = out.radii_over_l0.front() + beyond + 1.0;
  out.points.push_back({});
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (i == centre) continue;
    Interaction::Point p;
    p.x = (position[i][0] - out.position[0]) / l0;
    p.y = (position[i][up] - out.position[up]) / l0;
    p.distance = std::hypot(p.x, p.y, (position[i][3 - up] - out.position[3 - up]) / l0);
    if (std::abs(p.x) < reach && std::abs(p.y) < reach) out.points.push_back(p);
  }
  for (const double radius : out.radii_over_l0) {
    out.neighbours.push_back(static_cast<std::size_t>(
        std::count_if(out.points.begin() + 1, out.points.end(),
                      [&](const Interaction::Point& p) { return p.distance < radius; })));
  }
  return out;
}

Figure interaction_figure(const StudyResult& study) {
  const auto found = find_interaction(study);
  if (!found)
    return empty_figure("fig2", interaction_title,
                        "No particle run of this study has a method.json.");
  const auto& radii = found->radii_over_l0;
  const double reach = radii.front() + beyond;
  const Scales scales = study.reference_run().run.physics.scales();

  Figure figure;
  figure.name = "fig2";
  figure.title = interaction_title;
  figure.caption = "From the run " + found->run->study.name +
                   " at t = " + fixed_text(found->time.value(), 3) +
                   " s (T = " + fixed_text(scales.dimensionless(found->time).value(), 2) +
                   "): the fluid particle nearest to the centre of mass of the water (orange), and "
                   "the particles within ";
  Table table{"fig2", {"x_over_l0", "y_over_l0", "distance_over_l0", "ring"}, {}};
  const bool in_space = found->run->measured->run.physics.dimension == 3;
  for (const auto& p : found->points) {
    // In 3D the layer that the particle lies in: all others would hide it.
    const double aside = p.distance * p.distance - p.x * p.x - p.y * p.y;
    if (in_space && aside > 0.25) continue;
    // 0 the particle, 1 within the smallest radius, and so on; the last is outside of all.
    double ring = p.distance > 0.0 ? 1.0 : 0.0;
    for (const double radius : radii) ring += ring > 0.0 && p.distance >= radius ? 1.0 : 0.0;
    table.add({p.x, p.y, p.distance, ring});
  }
  figure.tables.push_back(std::move(table));
  const std::array<const char*, 3> colours{"#0072b2", "#9ccbe6", "#d9d9d9"};
  std::ostringstream script;
  script << "set size ratio -1\nset xrange [" << -reach << ':' << reach << "]\nset yrange ["
         << -reach << ':' << reach
         << "]\nset border 15\nunset grid\nunset key\nset xtics 2\nset ytics 2\n"
         << "set style textbox opaque noborder fc rgb \"white\" margins 0.4,0.4\n"
         << "set xlabel \"({/:Italic x} − {/:Italic x_i})/{/:Italic l}_0\"\n"
         << "set ylabel \"({/:Italic y} − {/:Italic y_i})/{/:Italic l}_0\" offset 1\n";
  double degrees = 30.0;
  std::string circles;
  for (std::size_t k = radii.size(); k-- > 0;) {
    const std::string text = std::to_string(found->neighbours[k]) + " neighbours";
    circles += circle(radii[k], k + 1 == radii.size() ? "solid" : "'-'");
    script << radius_arrow(radii[k], degrees,
                           "{/:Italic r_e} = " + fixed_text(radii[k], 1) + " {/:Italic l}_0");
    degrees += 100.0;
    figure.caption +=
        (k + 1 == radii.size() ? "" : " and ") + fixed_text(radii[k], 1) + " l0 (" + text + ")";
  }
  figure.caption += ". Particles are discs of diameter l0.";
  if (in_space)
    figure.caption += " Of the water in three dimensions one layer is drawn; all neighbours count.";
  script << "plot ";
  const auto rings = static_cast<int>(radii.size()) + 1;
  for (int ring = rings; ring >= 0; --ring) {
    const char* colour =
        ring == 0 ? "#e69f00"
                  : colours[ring == rings ? 2 : static_cast<std::size_t>(std::min(ring, 2) - 1)];
    script << (ring == rings ? "" : ", \\\n     ") << "\"fig2.csv\" using ($4 == " << ring
           << " ? $1 : NaN):2:(0.5) with circles fs solid 1 border lc rgb \"white\" fc rgb \""
           << colour << "\"";
  }
  figure.script = "set samples 200\nset dummy a\n" + script.str() + circles + "\n";
  figure.height_mm = single_column_mm;
  return figure;
}

}  // namespace surge::compare
