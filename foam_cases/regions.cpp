#include <cmath>
#include <numbers>
#include <sstream>

#include "foam_cases/case_files.hpp"
#include "particle/case/scales.hpp"
#include "particle/support/bounds.hpp"

namespace surge::foam {

namespace {

bool has_gradient(const FluidBlock& block) {
  for (const Point& row : block.velocity_gradient)
    if (length(row) > 0.0) return true;
  return false;
}

/// Whether the velocity differs from place to place.
bool varies(const FluidBlock& block) {
  return has_gradient(block) || block.wave_amplitude > 0.0;
}

Point centre(const FoamCase& c, const FluidBlock& block) {
  const Box box = in_three_dimensions(c.flow, c.mesh, block.box);
  Point x;
  for (std::size_t a = 0; a < 3; ++a) x[a] = 0.5 * (box.lower[a] + box.upper[a]);
  return x;
}

double radius(const FluidBlock& block) {
  return 0.5 * (block.box.upper[0] - block.box.lower[0]);
}

void write_region(std::ostream& out, const FoamCase& c, const FluidBlock& block) {
  const Box box = in_three_dimensions(c.flow, c.mesh, block.box);
  if (block.shape == FluidBlock::Shape::box) {
    out << "    boxToCell\n    {\n        box         " << vector_text(box.lower) << " "
        << vector_text(box.upper) << ";\n";
  } else if (c.flow.dimension == 3) {
    out << "    sphereToCell\n    {\n        centre      " << vector_text(centre(c, block))
        << ";\n        radius      " << number_text(radius(block)) << ";\n";
  } else {
    Point lower = centre(c, block), upper = lower;
    lower[2] = c.mesh.lower(2);
    upper[2] = c.mesh.upper(2);
    out << "    cylinderToCell\n    {\n        p1          " << vector_text(lower)
        << ";\n        p2          " << vector_text(upper) << ";\n        radius      "
        << number_text(radius(block)) << ";\n";
  }
  if (has_gradient(block)) {
    out << "        velocityGradient (";
    for (const Point& row : block.velocity_gradient) out << vector_text(row);
    out << ");   // 1/s, about the middle; for manifest.json\n";
  }
  if (block.wave_amplitude > 0.0)
    out << "        waveAmplitude " << number_text(block.wave_amplitude)
        << ";   // m; for manifest.json\n";
  out << "        fieldValues ( volScalarFieldValue alpha.water 1";
  if (length(block.velocity) > 0.0) out << " volVectorFieldValue U " << vector_text(block.velocity);
  out << " );\n    }\n";
}

/// "1.5*(pos().x() - 0.25)": what an expression reads as a term, empty for zero.
std::string offset(double factor, std::size_t axis, double from) {
  if (factor == 0.0) return {};
  const char* names[] = {"x", "y", "z"};
  return " + (" + number_text(factor) + ")*(pos()." + names[axis] + "() - (" + number_text(from) +
         "))";
}

/// A component of the velocity of a block as an expression; see initial_velocity() and, for the
/// wave, Lamb, Hydrodynamics, Art. 228.
std::string component(const FoamCase& c, const FluidBlock& block, std::size_t a) {
  const Point middle = centre(c, block);
  std::string text = number_text(block.velocity[a]);
  for (std::size_t b = 0; b < 3; ++b) text += offset(block.velocity_gradient[a][b], b, middle[b]);
  if (block.wave_amplitude <= 0.0 || a == 2) return text;
  const double k = std::numbers::pi / (block.box.upper[0] - block.box.lower[0]);
  const double depth = k * (block.box.upper[1] - block.box.lower[1]);
  const double scale = block.wave_amplitude *
                       std::sqrt(length(c.flow.gravity) * k * std::tanh(depth)) / std::sinh(depth);
  const std::string along =
      number_text(k) + "*(pos().x() - (" + number_text(block.box.lower[0]) + "))";
  const std::string height =
      number_text(k) + "*(pos().y() - (" + number_text(block.box.lower[1]) + "))";
  text += a == 0 ? " - " : " + ";
  text += number_text(scale) + (a == 0 ? "*sin(" : "*cos(") + along + ")*0.5*(exp(" + height +
          ") " + (a == 0 ? "+" : "-") + " exp(-(" + height + ")))";
  return text;
}

/// Where a block is, as an expression.
std::string condition(const FoamCase& c, const FluidBlock& block) {
  const Point middle = centre(c, block);
  const char* names[] = {"x", "y", "z"};
  std::string text;
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.flow.dimension); ++a) {
    const std::string off =
        std::string("(pos().") + names[a] + "() - (" + number_text(middle[a]) + "))";
    if (block.shape == FluidBlock::Shape::ball) {
      text += (a > 0 ? " + " : "") + off + "*" + off;
    } else {
      text += std::string(a > 0 ? " && " : "") + "(mag" + off + " < " +
              number_text(0.5 * (block.box.upper[a] - block.box.lower[a])) + ")";
    }
  }
  if (block.shape == FluidBlock::Shape::ball)
    text += " < " + number_text(radius(block) * radius(block));
  return text;
}

}  // namespace

std::string set_fields(const FoamCase& c) {
  std::ostringstream out;
  out << header("dictionary", "setFieldsDict")
      << "\n#include \"caseParameters\"\n\ndefaultFieldValues  ( volScalarFieldValue alpha.water 0 "
         ");\n\n"
         "// Boxes end on cell faces, so that choosing cells by their centres fills them exactly.\n"
         "regions\n(\n";
  for (const FluidBlock& block : c.flow.blocks) write_region(out, c, block);
  out << ");\n";
  return out.str();
}

std::string set_expressions(const FoamCase& c) {
  std::ostringstream out;
  for (std::size_t i = 0; i < c.flow.blocks.size(); ++i) {
    const FluidBlock& block = c.flow.blocks[i];
    if (!varies(block)) continue;
    out << "    block" << i
        << "\n    {\n        field       U;\n        dimensions  [0 1 -1 0 0 0 0];\n"
        << "        condition\n        #{\n            " << condition(c, block)
        << "\n        #};\n        expression\n        #{\n            vector\n            (\n";
    for (std::size_t a = 0; a < 3; ++a)
      out << "                " << component(c, block, a) << (a < 2 ? ",\n" : "\n");
    out << "            )\n        #};\n    }\n";
  }
  const std::string blocks = out.str();
  if (blocks.empty()) return {};
  return header("dictionary", "setExprFieldsDict") +
         "\n#include \"caseParameters\"\n\n// Velocities that differ from place to place.\n"
         "expressions\n(\n" +
         blocks + ");\n";
}

}  // namespace surge::foam
