"""The flow of this case as its manifest states it: tank, water, obstacles, motion, instruments.

Read from the dictionaries and from what checkMesh has found, so that it holds for a case that was
changed by hand. What the dictionaries hold that cannot be stated is an error: a manifest must hold
all that was in the case.
"""

import functools
import math
import pathlib
import re
import subprocess

from solids import covered, size_of, surfaces

SIDES = ("x-", "x+", "y-", "y+", "z-", "z+")


def fail(where, found, expected):
    raise SystemExit(f"manifest.py: {where}: found {found}, expected {expected}")


# --- dictionaries of OpenFOAM ----------------------------------------------------------------------


def parse(text, at=0):
    """Entries of a dictionary as foamDictionary -expand writes it: text, or a dictionary again."""
    entries = {}
    key = re.compile(r'\s*("[^"]*"|[^\s{};]+)\s*')
    while True:
        found = key.match(text, at)
        if not found:
            end = re.compile(r"\s*[};]?").match(text, at).end()
            return entries, end
        name, at = found[1], found.end()
        if text[at : at + 1] == "{":
            entries[name], at = parse(text, at + 1)
            continue
        start, depth, quote = at, 0, False
        while at < len(text) and (quote or depth > 0 or text[at] != ";"):
            quote ^= text[at] == '"'
            depth += 0 if quote else (text[at] in "({") - (text[at] in ")}")
            at += 1
        entries[name] = " ".join(text[start:at].split())
        at += 1


@functools.cache
def dictionary(path):
    """A dictionary with all macros expanded."""
    command = ["foamDictionary", "-expand", "-precision", "15", path]
    answer = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if answer.returncode != 0:
        raise SystemExit(f"manifest.py: {path}: {' '.join(answer.stdout.split())}")
    return parse(re.sub(r"^/\*.*?\*/|^//[^\n]*", "", answer.stdout, flags=re.S | re.M))[0]


def entry(path, key):
    found = dictionary(path)
    for name in key.split("|"):
        if not isinstance(found, dict) or name not in found:
            fail(f"{path}: {key}", "no such entry", "a value")
        found = found[name]
    return found


def short(value, digits=12):
    """Without the noise of its last digits; without a decimal point where it is whole."""
    value = float(f"{value:.{digits}g}")
    return int(value) if value.is_integer() and abs(value) < 1e15 else value


def numbers(text):
    """All numbers of a text; whole ones without a decimal point."""
    found = [float(x) for x in re.findall(r"(?<![\w.])[-+]?\.?\d[\d.]*(?:e[-+]?\d+)?", text)]
    return [short(x, 17) for x in found]


def number(path, key):
    return numbers(entry(path, key))[0]


def log(name):
    return pathlib.Path(f"log.{name}").read_text()


# --- geometry --------------------------------------------------------------------------------------


class Mesh:
    """Size, sides and boundaries of the mesh, from what blockMesh and checkMesh say."""

    def __init__(self):
        text = log("checkMesh")
        box = numbers(re.search(r"Overall domain bounding box (.*)", text)[1])
        # The log has six digits, the dictionary all.
        corners = numbers(entry("system/blockMeshDict", "vertices"))
        scale = numbers(entry("system/blockMeshDict", "scale"))[0]
        exact = [scale * f(corners[a::3]) for f in (min, max) for a in range(3)]
        # Bodies with a surface may cut off all cells along a side.
        beyond = [s * (b - a) for s, a, b in zip((1, 1, 1, -1, -1, -1), exact, box)]
        near, cut = 1e-5 * (exact[3] - exact[0]), surfaces()["cut"]
        if any(x < -near or (x > near and not cut) for x in beyond):
            fail("system/blockMeshDict: vertices", exact, f"those of the mesh, {box}")
        self.lower, self.upper = exact[:3], exact[3:]
        self.cells = int(re.search(r"^ +cells: +(\d+)", text, re.M)[1])
        self.volume = float(re.search(r"Total volume = (\S+?)\.? ", text)[1])
        boundary = pathlib.Path("constant/polyMesh/boundary").read_text(errors="replace")
        self.types = dict(re.findall(r"(\w+)\s*\{[^{}]*?\btype\s+(\w+);", boundary))
        boxes = re.findall(r"^ +(\w+) +\d+ +\d+ .*?\) +(\([-+.e\d ]+\) \([-+.e\d ]+\))$", text, re.M)
        self.boxes = {name: numbers(corners) for name, corners in boxes if name in self.types}
        self.dimension = 2 if "empty" in self.types.values() else 3
        self.thickness = self.upper[2] - self.lower[2]

    def side(self, patch):
        """The side of the tank that a boundary is all in; None for the surface of an obstacle, and
        for a side of which bodies with a surface have left nothing."""
        if patch not in self.boxes and surfaces()["cut"]:
            return None
        box = self.boxes[patch]
        for side, name in enumerate(SIDES[: 2 * self.dimension]):
            axis, end = side // 2, (self.lower, self.upper)[side % 2]
            near = 1e-6 * (self.upper[axis] - self.lower[axis])
            if abs(box[axis] - end[axis]) < near and abs(box[axis + 3] - end[axis]) < near:
                return name
        return None

    def point(self, values):
        """A point of the case: in two dimensions the mesh is one cell thick."""
        return [short(x) for x in values[: self.dimension]] + [0] * (3 - self.dimension)


def condition(patch):
    """Type of the boundary condition of U on a boundary."""
    for name, body in entry("0.orig/U", "boundaryField").items():
        if name == patch or name[0] == '"' and re.fullmatch(name.strip('"'), patch):
            return body["type"]
    fail(f"0.orig/U: boundaryField: {patch}", "no entry", "one for each boundary")


def tank(mesh):
    walls, opened, periodic = set(), set(), set()
    for patch, kind in mesh.types.items():
        if kind == "empty":
            continue
        side, flow = mesh.side(patch), condition(patch)
        if kind == "cyclic":
            periodic.add(side[0])
        elif flow == "pressureInletOutletVelocity" and side:
            opened.add(side)
        elif flow == "movingWallVelocity":
            continue  # a piston
        elif flow in ("slip", "noSlip"):
            walls.add(flow)
        else:
            fail(f"0.orig/U: {patch}", flow, "slip, noSlip, cyclic, or an open side of the tank")
    walls = walls or {entry("system/caseParameters", "wall")}
    if len(walls) > 1:
        fail("0.orig/U", "walls of both kinds", "slip or noSlip for all")
    box = {"-": list(mesh.lower), "+": list(mesh.upper)}
    for wall in entries("constant/movingWalls").values():
        if "tankSide" in wall:  # the mesh begins at a piston, the tank behind it
            box[wall["tankSide"][1]]["xyz".index(wall["tankSide"][0])] = numbers(wall["tankEnd"])[0]
    return {
        "lower": mesh.point(box["-"]),
        "upper": mesh.point(box["+"]),
        "open": sorted(opened),
        "periodic": sorted(periodic),
        "wall": {"slip": "slip", "noSlip": "no-slip"}[walls.pop()],
    }


def obstacles(mesh, cell):
    """Boxes that blockMeshDict leaves out, all obstacles as a manifest states them, and the volume
    that bodies with a surface leave out of the mesh; all held to the volume of the mesh."""
    path = "system/blockMeshDict"
    values = numbers(dictionary(path).get("obstacles", ""))
    boxes = [(values[i : i + 3], values[i + 3 : i + 6]) for i in range(0, len(values), 6)]
    whole = math.prod(b - a for a, b in zip(mesh.lower, mesh.upper))
    cut = covered(boxes) if boxes else 0.0
    left_out = whole - mesh.volume - cut
    stated = surfaces()["obstacles"]
    bodies = [solid for solid in stated if "polygon" in solid or "vertices" in solid]
    sizes = [size_of(solid, mesh.thickness) for solid in bodies]
    in_bodies = sum(volume for volume, _ in sizes)
    # Cells are cut out by their middles: half a cell of each that the surface passes, at most.
    room = 1e-5 * whole + sum(surface for _, surface in sizes) * cell
    if abs(left_out - in_bodies) > room:
        fail(f"{path}: obstacles", f"{cut + in_bodies:.6g} m3",
             f"the {whole - mesh.volume:.6g} m3 that the mesh leaves out")
    plain = iter([{"lower": mesh.point(a), "upper": mesh.point(b)} for a, b in boxes])
    if not bodies:
        return boxes, list(plain), None
    return boxes, [solid if solid in bodies else next(plain) for solid in stated], left_out


def region(mesh, name, body):
    """A body of water of setFieldsDict as a manifest states it; None outside of the mesh."""
    where = f"system/setFieldsDict: regions: {name}"
    values = re.search(r"\bfieldValues \(\s*(.*?)\s*\)\s*;", body)
    stated = re.fullmatch(r"volScalarFieldValue alpha\.water 1(?: volVectorFieldValue U (\([^()]*\)))?",
                          " ".join(values[1].split()) if values else "")
    if not stated:
        fail(where, " ".join(body.split()), "alpha.water 1, and U perhaps")

    def point(key):
        found = re.search(rf"\b{key} \(([^()]*)\)", body)
        return numbers(found[1]) if found else fail(where, f"no {key}", "one")

    block = {"shape": "box" if name == "boxToCell" else "ball"}
    if name == "boxToCell":
        corners = numbers(re.search(r"\bbox (\([^()]*\) \([^()]*\))", body)[1])
        lower = [max(a, b) for a, b in zip(mesh.lower, corners[:3])]
        upper = [min(a, b) for a, b in zip(mesh.upper, corners[3:])]
        if any(a >= b for a, b in zip(lower, upper)):
            return None
    elif name in ("sphereToCell", "cylinderToCell"):
        radius = numbers(re.search(r"\bradius ([^;]*);", body)[1])[0]
        middle = point("centre") if name == "sphereToCell" else point("p1")
        if (name == "sphereToCell") != (mesh.dimension == 3):
            fail(where, "this kind of region", "a sphere in 3D, a cylinder across the mesh in 2D")
        lower, upper = [x - radius for x in middle], [x + radius for x in middle]
    else:
        fail(where, "a region of this kind", "boxToCell, sphereToCell or cylinderToCell")
    block["lower"], block["upper"] = mesh.point(lower), mesh.point(upper)
    block["velocity"] = numbers(stated[1]) if stated[1] else [0, 0, 0]
    gradient = re.search(r"\bvelocityGradient \(([^;]*)\)\s*;", body)
    rows3 = numbers(gradient[1]) if gradient else [0] * 9
    block["velocity_gradient"] = [rows3[i : i + 3] for i in (0, 3, 6)]
    wave = re.search(r"\bwaveAmplitude ([^;]*);", body)
    block["wave_amplitude"] = numbers(wave[1])[0] if wave else 0
    return block


def blocks(mesh):
    """All water at time zero, in the order in which setFields fills it."""
    path = "system/setFieldsDict"
    found = re.findall(r"(\w+) \{([^{}]*)\}", entry(path, "regions"))
    made = [block for name, body in found if (block := region(mesh, name, body))]
    if not made:
        fail(f"{path}: regions", "no water inside the mesh", "at least one region")
    varied = any(b["wave_amplitude"] or any(map(any, b["velocity_gradient"])) for b in made)
    if varied != pathlib.Path("system/setExprFieldsDict").exists():
        fail("system/setExprFieldsDict", "velocities that no region states", "both or neither")
    return made


def stated_volume(mesh, water, solids):
    """Volume (m3) of boxes of water outside of obstacles, and of balls; in 2D for the thickness."""
    def box(block):
        lower, upper = list(block["lower"]), list(block["upper"])
        if mesh.dimension == 2:
            lower[2], upper[2] = mesh.lower[2], mesh.upper[2]
        return lower, upper

    boxes = [box(block) for block in water if block["shape"] == "box"]
    total = covered(boxes + solids) - covered(solids) if boxes and solids else covered(boxes) if boxes else 0.0
    for block in water:
        if block["shape"] == "ball":
            radius = (block["upper"][0] - block["lower"][0]) / 2
            total += (4 / 3 * math.pi * radius**3 if mesh.dimension == 3
                      else math.pi * radius**2 * mesh.thickness)
    return total


# --- motion and instruments ------------------------------------------------------------------------


def law(body):
    """A law of motion and what moves by it, as the case states it."""
    stated = {}
    for key, value in body.items():
        values = numbers(value)
        if key in ("kind", "law", "quantity", "name", "tankSide"):
            stated[key] = value.strip('"')
        elif key == "samples":
            stated[key] = [list(pair) for pair in zip(values[::2], values[1::2])]
        else:
            stated[key] = values if len(values) == 3 else values[0]
    return {key: value for key, value in stated.items() if key not in ("tankSide", "tankEnd")}


def entries(path):
    """Entries of a dictionary that a case may have, by name."""
    if not pathlib.Path(path).exists():
        return {}
    return {k: v for k, v in dictionary(path).items() if isinstance(v, dict) and k != "FoamFile"}


def gravity():
    """With that part which acts as a force, along periodic axes."""
    drive = entries("constant/fvOptions").get("drive", {}).get("acceleration", "(0 0 0)")
    return [short(a + b) for a, b in zip(numbers(entry("constant/g", "value")), numbers(drive))]


def motions():
    """Motion of the tank (None where it is at rest) and walls that move, held to fvOptions."""
    options, walls = entries("constant/fvOptions"), entries("constant/movingWalls")
    rows = {name for name, body in options.items() if body["type"] == "explicitPorositySource"}
    others = set(options) - rows - {"tankMotion", "drive"}
    gates = [wall for wall in walls.values() if "tankSide" not in wall]
    if others or bool(rows) != bool(gates):
        fail("constant/fvOptions", ", ".join(sorted(options)) or "nothing",
             "the tankMotion and the gates of constant/movingWalls, and nothing else")
    moved = law(options["tankMotion"]["stated"]) if "tankMotion" in options else None
    return moved, [law(body) for body in walls.values()]


def instruments(mesh, cell):
    """Probes, gauges and forces among the function objects, with the files that they write."""
    found = {"probes": [], "gauges": [], "forces": []}
    for name, body in entry("system/controlDict", "functions").items():
        folder = f"postProcessing/{name}/0"
        if "probe" in body:
            place, stated = numbers(body["probeLocations"]), numbers(body["position"])
            # A cell that an obstacle with a surface has cut out gives its place to a neighbour.
            near = 5 * cell if surfaces()["obstacles"] else 1e-5 * math.dist(mesh.lower, mesh.upper)
            if math.dist(place[: mesh.dimension], stated[: mesh.dimension]) > near:
                fail(f"{name}: position", stated, f"the place of probeLocations, {place}")
            found["probes"].append({"name": body["probe"].strip('"'), "position": mesh.point(stated),
                                    "diameter": 0, "file": f"{folder}/p"})
        elif "gauge" in body:
            measure = {key: numbers(body[key])[0] for key in ("area", "height") if key in body}
            found["gauges"].append({"name": body["gauge"].strip('"'), **measure,
                                    "position": mesh.point(numbers(body["position"])),
                                    "file": f"{folder}/volFieldValue.dat"})
        elif "force" in body:
            found["forces"].append({"name": body["force"].strip('"'), "on": body["on"].strip('"'),
                                    "file": f"{folder}/force.dat"})
    return found


def flow(mesh, cell):
    """Those entries of a manifest's case that say where things are, the volume of water in m3, and
    that of bodies with a surface in the mesh (None where there are none)."""
    water, (boxes, solids, left_out) = blocks(mesh), obstacles(mesh, cell)
    moved, walls = motions()
    stated = {
        "tank": tank(mesh),
        "blocks": water,
        "obstacles": solids,
        "motion": moved,
        "moving_walls": walls,
        **instruments(mesh, cell),
    }
    taken = surfaces()["cut_from_water"] * (mesh.thickness if mesh.dimension == 2 else 1)
    return stated, stated_volume(mesh, water, boxes) - taken, left_out
