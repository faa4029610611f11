#include "particle/case/case_keys.hpp"

#include <array>

namespace surge {

namespace {

constexpr std::array keys{
    CaseKey{"", "title", "text", "what the case is called"},
    CaseKey{"", "dimension", "2 | 3", ""},
    CaseKey{"[fluid]", "density", "kg/m3", ""},
    CaseKey{"[fluid]", "kinematic_viscosity", "m2/s; 0", ""},
    CaseKey{"[fluid]", "reference_speed", "m/s; from the case", "the largest speed of the flow"},
    CaseKey{"[fluid]", "gravity", "point, m/s2", "in any direction"},
    CaseKey{"[tank]", "lower", "point, m", "without [tank] there are no walls around the fluid"},
    CaseKey{"[tank]", "upper", "point, m", ""},
    CaseKey{"[tank]", "polygon", "list of points, m",
            "2D: the room of the water in the tank's box; lower and upper then may be left out"},
    CaseKey{"[tank]", "stl", "file beside the case file", "3D: the same, inside lower and upper"},
    CaseKey{"[tank]", "scale", "number; 1", "stl: m per unit of the file"},
    CaseKey{"[tank]", "vertices", "list of points, m", "3D: the surface in the case file"},
    CaseKey{"[tank]", "triangles", "lists of 3 numbers", "of vertices, from 0"},
    CaseKey{"[tank]", "open", "list of x-, x+, y-, y+, z-, z+; none", "sides without a wall"},
    CaseKey{"[tank]", "periodic", "list of x, y, z; none", "axes along which the flow repeats"},
    CaseKey{"[tank]", "wall", "slip | no-slip; slip", "what viscous fluid does at walls"},
    CaseKey{"[[block]]", "shape", "box | ball", "a body of fluid at time zero"},
    CaseKey{"[[block]]", "lower", "point, m", "of the box, or of the one around the ball"},
    CaseKey{"[[block]]", "upper", "point, m", ""},
    CaseKey{"[[block]]", "velocity", "point, m/s; 0", "at the centre of the block"},
    CaseKey{"[[block]]", "velocity_gradient", "list of points, 1/s; 0", "rows are dv_a/dx_b"},
    CaseKey{"[[block]]", "wave_amplitude", "m; 0", "of a standing wave, as velocities"},
    CaseKey{"[[obstacle]]", "lower", "point, m", "a fixed solid box"},
    CaseKey{"[[obstacle]]", "upper", "point, m", ""},
    CaseKey{"[[obstacle]]", "polygon", "list of points, m", "2D: instead, a body by its corners"},
    CaseKey{"[[obstacle]]", "stl", "file beside the case file",
            "3D: instead, a body by its surface"},
    CaseKey{"[[obstacle]]", "scale", "number; 1", "stl: m per unit of the file"},
    CaseKey{"[[obstacle]]", "vertices", "list of points, m", "3D: the surface in the case file"},
    CaseKey{"[[obstacle]]", "triangles", "lists of 3 numbers", "of vertices, from 0"},
    CaseKey{"[motion]", "kind", "translation | rotation", "how the tank moves"},
    CaseKey{"[motion]", "direction", "point", "of the translation, or in 3D the axis"},
    CaseKey{"[motion]", "centre", "point, m", "of the rotation"},
    CaseKey{"[motion]", "law", "harmonic | constant | table", "how far by time"},
    CaseKey{"[motion]", "amplitude", "m | rad", "harmonic: A sin(2 pi (t - start)/period + phase)"},
    CaseKey{"[motion]", "period", "s", "harmonic"},
    CaseKey{"[motion]", "phase", "rad; 0", "harmonic"},
    CaseKey{"[motion]", "ramp", "s; 0", "harmonic: it grows from nothing over this time"},
    CaseKey{"[motion]", "speed", "m/s | rad/s", "constant, from start to stop"},
    CaseKey{"[motion]", "start", "s; 0", "harmonic and constant"},
    CaseKey{"[motion]", "stop", "s", "constant"},
    CaseKey{"[motion]", "quantity", "displacement | acceleration", "table: what its values are"},
    CaseKey{"[motion]", "table", "file beside the case file", "table: lines of time,value"},
    CaseKey{"[motion]", "samples", "list of [s, value]", "table: the same in the case file"},
    CaseKey{"[[moving_wall]]", "name", "text",
            "a piston or a gate; its law has the keys of [motion]"},
    CaseKey{"[[moving_wall]]", "lower", "point, m", "at displacement zero"},
    CaseKey{"[[moving_wall]]", "upper", "point, m", ""},
    CaseKey{"[[moving_wall]]", "direction", "point", ""},
    CaseKey{"[[probe]]", "name", "text", "where the pressure is recorded"},
    CaseKey{"[[probe]]", "position", "point, m", ""},
    CaseKey{"[[probe]]", "diameter", "m; the program's", "of the sensor's face"},
    CaseKey{"[[gauge]]", "name", "text", "where the height of the water is recorded"},
    CaseKey{"[[gauge]]", "position", "point, m", "its height does not matter"},
    CaseKey{"[[force]]", "on", "side, obstacle.N or a moving wall's name",
            "where the force is recorded"},
    CaseKey{"[[force]]", "name", "text; what it is on", ""},
    CaseKey{"[resolution]", "spacing", "m", "l0, the distance of particles"},
    CaseKey{"[resolution]", "per", "number", "instead of spacing: particles per length"},
    CaseKey{"[resolution]", "length", "m", "that holds `per` particles"},
    CaseKey{"[time]", "end", "s", ""},
    CaseKey{"[time]", "initial_step", "s; 1e-4", "the first step is no longer"},
    CaseKey{"[time]", "maximum_step", "s; 1e-3", ""},
    CaseKey{"[time]", "courant", "number up to 1; 0.2", "v_max dt / l0"},
    CaseKey{"[output]", "interval", "s", "between frames"},
    CaseKey{"[output]", "checkpoint", "s of the clock; 600",
            "between checkpoints; 0: only where the run is stopped"},
};

}  // namespace

std::span<const CaseKey> case_keys() {
  return keys;
}

}  // namespace surge
