#include <algorithm>
#include <sstream>

#include "foam_cases/acceleration.hpp"
#include "foam_cases/case_files.hpp"
#include "foam_cases/laws.hpp"
#include "particle/case/enum_names.hpp"
#include "particle/support/bounds.hpp"

namespace surge::foam {

namespace {

AccelerationTable table_of(const FoamCase& c) {
  return {c.flow.motion, c.flow.gravity, c.flow.time.end, c.settings.maximum_step};
}

}  // namespace

std::string tank_motion(const FoamCase& c) {
  if (c.flow.motion.kind == TankMotion::Kind::none) return {};
  std::ostringstream out;
  out << "\n// The tank moves, and the flow is computed in its frame: g of constant/g is what acts "
         "at rest,\n"
         "// and the table holds what the motion adds, row by row\n"
         "//     (time (linear acceleration, angular velocity, angular acceleration)).\n"
         "tankMotion\n{\n    type            tabulatedAccelerationSource;\n    active          "
         "yes;\n"
         "    timeDataFileName \"<constant>/tankMotion\";\n    CofG            (0 0 0);\n\n"
         "    // What the table was made from, for manifest.json.\n    stated\n    {\n";
  write_entry(out, "kind", std::string(name_of(c.flow.motion.kind)));
  write_entry(out, "direction", vector_text(c.flow.motion.direction));
  if (c.flow.motion.kind == TankMotion::Kind::rotation)
    write_entry(out, "centre", vector_text(c.flow.motion.centre));
  write_law(out, c.flow.motion.law);
  out << "    }\n}\n";
  return out.str();
}

std::string motion_table(const FoamCase& c) {
  if (c.flow.motion.kind == TankMotion::Kind::none) return {};
  const AccelerationTable table = table_of(c);
  std::string text = "(\n";
  for (const AccelerationRow& row : table.rows()) {
    text += "(" + number_text(row.time) + " (" + vector_text(row.linear) + " " +
            vector_text(row.omega) + " " + vector_text(row.alpha) + "))\n";
  }
  return text + ")\n";
}

std::vector<std::string> motion_notes(const FoamCase& c) {
  std::vector<std::string> notes;
  if (c.flow.motion.kind == TankMotion::Kind::none) return notes;
  const AccelerationTable table = table_of(c);
  if (table.jumps() > 0) {
    notes.push_back(std::to_string(table.jumps()) + " jump" + (table.jumps() > 1 ? "s" : "") +
                    " of the tank's velocity, each spread over the " +
                    short_text(table.jump_time()) + " s that follow it");
  }
  const bool open = std::any_of(c.boundaries.begin(), c.boundaries.end(),
                                [](const Patch& patch) { return patch.kind == Patch::Kind::open; });
  if (c.flow.motion.kind == TankMotion::Kind::rotation && !open) {
    notes.emplace_back(
        "a closed tank that turns: OpenFOAM leaves the forces of the rotation out of the "
        "pressure's "
        "slope at walls, and velocities in the cells there are false");
  }
  return notes;
}

}  // namespace surge::foam
