"""Sizes of the solid bodies of this case: boxes, polygons and surfaces of triangles."""

import itertools
import json
import math
import pathlib


def covered(boxes):
    """Volume of the union of boxes ([lower, upper]): what two of them share counts once."""
    edges = [sorted({box[end][a] for box in boxes for end in (0, 1)}) for a in range(3)]
    total = 0.0
    for cell in itertools.product(*(zip(e, e[1:]) for e in edges)):
        middle = [(low + high) / 2 for low, high in cell]
        if any(all(b[0][a] < middle[a] < b[1][a] for a in range(3)) for b in boxes):
            total += math.prod(high - low for low, high in cell)
    return total


def surfaces():
    """What the case states of obstacles with a surface: all obstacles, and the water they replace;
    and whether there are any."""
    path = pathlib.Path("constant/obstacles.json")
    if not path.exists():
        return {"obstacles": [], "cut_from_water": 0, "cut": False}
    return {**json.loads(path.read_text()), "cut": True}


def size_of(solid, thickness):
    """Volume (m3) and surface (m2) of a body; of a polygon for the thickness of the mesh."""
    if "polygon" in solid:
        pairs = list(zip(solid["polygon"], solid["polygon"][1:] + solid["polygon"][:1]))
        area = sum(a[0] * b[1] - a[1] * b[0] for a, b in pairs) / 2
        return area * thickness, sum(math.dist(a, b) for a, b in pairs) * thickness
    volume = surface = 0.0
    first = solid["vertices"][0]
    for triangle in solid["triangles"]:
        a, b, c = ([x - y for x, y in zip(solid["vertices"][k], first)] for k in triangle)
        u, v = ([x - y for x, y in zip(p, a)] for p in (b, c))
        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        volume += sum(x * y for x, y in zip(a, n)) / 6
        surface += math.hypot(*n) / 2
    return volume, surface
