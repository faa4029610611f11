#include <algorithm>
#include <sstream>

#include "foam_cases/acceleration.hpp"
#include "foam_cases/case_files.hpp"
#include "particle/case/enum_names.hpp"
#include "particle/support/bounds.hpp"

namespace surge::foam {

namespace {

AccelerationTable table_of(const FoamCase& c) {
  return {c.flow.motion, c.flow.gravity, c.flow.time.end, c.settings.maximum_step};
}

void write_entry(std::ostream& out, const std::string& key, const std::string& value) {
  out << "        " << key << std::string(16 - std::min<std::size_t>(key.size(), 15), ' ') << value
      << ";\n";
}

/// The law as the case states it, entry by entry.
void write_law(std::ostream& out, const TankMotion& motion) {
  const ScalarMotion& law = motion.law;
  const auto number = [&](const char* key, double value) {
    write_entry(out, key, number_text(value));
  };
  write_entry(out, "kind", std::string(name_of(motion.kind)));
  write_entry(out, "direction", vector_text(motion.direction));
  if (motion.kind == TankMotion::Kind::rotation)
    write_entry(out, "centre", vector_text(motion.centre));
  write_entry(out, "law", std::string(name_of(law.kind)));
  if (law.kind == ScalarMotion::Kind::harmonic) {
    number("amplitude", law.amplitude);
    number("period", law.period);
    number("phase", law.phase);
    number("ramp", law.ramp);
    number("start", law.start);
  } else if (law.kind == ScalarMotion::Kind::constant) {
    number("speed", law.speed);
    number("start", law.start);
    number("stop", law.stop);
  } else {
    write_entry(out, "quantity", std::string(name_of(law.quantity)));
    std::string samples = "(";
    for (const auto& sample : law.samples)
      samples += "\n            (" + number_text(sample[0]) + " " + number_text(sample[1]) + ")";
    write_entry(out, "samples", samples + "\n        )");
  }
}

}  // namespace

std::string tank_motion(const FoamCase& c) {
  if (c.flow.motion.kind == TankMotion::Kind::none) return {};
  std::ostringstream out;
  out << header("dictionary", "fvOptions")
      << "\n// The tank moves, and the flow is computed in its frame: g of constant/g is what acts "
         "at rest,\n"
         "// and the table holds what the motion adds, row by row\n"
         "//     (time (linear acceleration, angular velocity, angular acceleration)).\n"
         "tankMotion\n{\n    type            tabulatedAccelerationSource;\n    active          "
         "yes;\n"
         "    timeDataFileName \"<constant>/tankMotion\";\n    CofG            (0 0 0);\n\n"
         "    // What the table was made from, for manifest.json.\n    stated\n    {\n";
  write_law(out, c.flow.motion);
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
