#!/usr/bin/env python3
"""Writes manifest.json: what this case has run, read from its dictionaries and logs, and how long.

Run by Allrun after the last step. The file appears whole or not at all, and only for a run that
has reached its end time.
"""

import datetime
import json
import os
import pathlib
import platform
import re
import subprocess


def entry(dictionary, key):
    """The value of an entry as text, after all macros are expanded."""
    command = ["foamDictionary", "-entry", key, "-value", dictionary]
    answer = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if answer.returncode != 0:
        raise SystemExit(f"manifest.py: {dictionary}: {key}: {' '.join(answer.stdout.split())}")
    return answer.stdout.strip()


def numbers(text):
    """All numbers of a text; whole ones without a decimal point."""
    found = [float(x) for x in re.findall(r"(?<![\w.])[-+]?\d[\d.]*(?:e[-+]?\d+)?", text)]
    return [int(x) if x.is_integer() and abs(x) < 1e15 else x for x in found]


def number(dictionary, key):
    return numbers(entry(dictionary, key))[0]


def flat(point):
    """A point of the case in two dimensions: the mesh is one cell thick."""
    return [round(point[0], 12), round(point[1], 12), 0]


def seconds(*names):
    """Wall seconds that these steps of Allrun took; a serial run has fewer of them."""
    total = 0.0
    for name in names:
        marker = pathlib.Path(".steps", name)
        if marker.exists():
            _, start, end = marker.read_text().split()
            total += float(end) - float(start)
    return round(total, 3)


def utc(epoch):
    return datetime.datetime.fromtimestamp(epoch, datetime.timezone.utc).strftime("%FT%TZ")


def rows(function_object):
    """The rows of the table that a function object has written, as lists of text."""
    (path,) = pathlib.Path("postProcessing", function_object, "0").glob("*.dat")
    lines = path.read_text().splitlines()
    return [line.split("\t") for line in lines if not line.startswith("#")]


def processor_name():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def water_regions():
    """Boxes that setFields fills with water, in its order: [lower, upper] each.

    What it cannot state as boxes of water is refused: a manifest must hold all that was in the case.
    """
    text = entry("system/setFieldsDict", "regions")
    found = re.findall(r"(\w+)\s*\{([^{}]*)\}", text)
    if not found:
        raise SystemExit("manifest.py: system/setFieldsDict: regions: found none, expected at least one")
    boxes = []
    for name, body in found:
        where = f"manifest.py: system/setFieldsDict: regions: {name}"
        if name != "boxToCell":
            raise SystemExit(f"{where}: found a region of this kind, expected boxToCell")
        box = re.search(r"\bbox\s*(\([^()]*\)\s*\([^()]*\))", body)
        values = re.findall(r"volScalarFieldValue\s+alpha\.water\s+([^\s()]+)", body)
        if not box or len(numbers(box[1])) != 6 or values != ["1"]:
            raise SystemExit(f"{where}: found {' '.join(body.split())}, expected a box with alpha.water 1")
        corners = numbers(box[1])
        boxes.append((corners[:3], corners[3:]))
    return boxes


def covered_area(blocks):
    """Area of the union of boxes in the plane: what two of them share counts once."""
    def edges(axis):
        return sorted({block[end][axis] for block in blocks for end in ("lower", "upper")})

    def is_in(block, x, y):
        return (block["lower"][0] < x < block["upper"][0]) and (block["lower"][1] < y < block["upper"][1])

    xs, ys = edges(0), edges(1)
    return sum((right - left) * (top - bottom)
               for left, right in zip(xs, xs[1:]) for bottom, top in zip(ys, ys[1:])
               if any(is_in(block, (left + right) / 2, (bottom + top) / 2) for block in blocks))


def geometry():
    """Tank and water, from the mesh and the dictionary that filled it."""
    mesh = pathlib.Path("log.blockMesh").read_text()
    box = numbers(re.search(r"boundingBox: (.*)", mesh)[1])
    wall = entry("0.orig/U", "boundaryField/floor/type")
    tank = {
        "lower": flat(box[:3]),
        "upper": flat(box[3:]),
        "open": ["y+"],
        "periodic": [],
        "wall": {"slip": "slip", "noSlip": "no-slip"}[wall],
    }
    blocks = []
    for region_lower, region_upper in water_regions():
        lower = [max(a, b) for a, b in zip(box[:3], region_lower)]
        upper = [min(a, b) for a, b in zip(box[3:], region_upper)]
        if all(a < b for a, b in zip(lower, upper)):
            blocks.append({"shape": "box", "lower": flat(lower), "upper": flat(upper),
                           "velocity": [0, 0, 0]})
    if not blocks:
        raise SystemExit("manifest.py: system/setFieldsDict: regions: found no water inside the mesh")
    return tank, blocks, int(re.search(r"nCells: (\d+)", mesh)[1])


def method(solver):
    """The numerical choices, each as the solver has read it."""
    schemes, solution, control = "system/fvSchemes", "system/fvSolution", "system/controlDict"
    alpha = "solvers/alpha.water.*/"
    chosen = {
        "ddt": entry(schemes, "ddtSchemes/default"),
        "div_U": entry(schemes, "divSchemes/div(rhoPhi,U)"),
        "alpha_corrections": number(solution, alpha + "nAlphaCorr"),
        "alpha_sub_cycles": number(solution, alpha + "nAlphaSubCycles"),
        "pressure_corrections": number(solution, "PIMPLE/nCorrectors"),
        "momentum_predictor": entry(solution, "PIMPLE/momentumPredictor"),
        "pressure_tolerance": number(solution, "solvers/p_rghFinal/tolerance"),
        "alpha_courant": number(control, "maxAlphaCo"),
    }
    if solver == "interFoam":
        chosen["div_alpha"] = entry(schemes, "divSchemes/div(phi,alpha)")
        chosen["c_alpha"] = number(solution, alpha + "cAlpha")
    return chosen


def manifest():
    control, transport = "system/controlDict", "constant/transportProperties"
    solver = entry(control, "application")
    log = pathlib.Path(f"log.{solver}").read_text()
    tank, blocks, cells = geometry()
    end = number(control, "endTime")
    simulated = numbers("\n".join(re.findall(r"^Time = (.*)", log, re.M)))
    processes = re.search(r"^nProcs : (\d+)", log, re.M)
    volumes = [float(row[1]) for row in rows("waterVolume")]
    thickness = numbers(pathlib.Path("log.blockMesh").read_text().split("boundingBox:")[1])[5]
    probe = flat(numbers(entry(control, "functions/wallPressure/probeLocations")))
    initial = covered_area(blocks) * thickness
    extremes = [(float(row[2]), float(row[4])) for row in rows("alphaRange")]
    setup = seconds("blockMesh", "setFields", "decomposePar")
    solve, output = seconds("solve"), seconds("reconstructPar")
    return {
        "program": solver,
        "version": re.search(r"OPENFOAM=(\S+)", log)[1],
        "build": re.search(r"^Build\s*: (.*)", log, re.M)[1],
        "cpu": processor_name(),
        "threads": int(processes[1]) if processes else 1,
        "started": utc(float(pathlib.Path(".steps/blockMesh").read_text().split()[1])),
        "finished": abs(simulated[-1] - end) < 1e-6 * end,
        "wall_s": {
            "total": round(setup + solve + output, 3),
            "setup": setup,
            "solve": solve,
            "output": output,
        },
        "cpu_s": numbers(re.findall(r"^ExecutionTime = (.*) s ", log, re.M)[-1])[0],
        "steps": len(simulated),
        "simulated_s": simulated[-1],
        "cells": cells,
        "water_volume_change": max((v / initial - 1 for v in volumes), key=abs),
        "alpha_min": min(low for low, _ in extremes),
        "alpha_max": max(high for _, high in extremes),
        "case": {
            "title": entry(control, "title").strip('"'),
            "dimension": 2,
            "cells_per_L": number(control, "cellsPerL"),
            "fluid": {
                "density": number(transport, "water/rho"),
                "kinematic_viscosity": number(transport, "water/nu"),
                "gravity": numbers(entry("constant/g", "value")),
            },
            "gas": {
                "density": number(transport, "air/rho"),
                "kinematic_viscosity": number(transport, "air/nu"),
            },
            "surface_tension": number(transport, "sigma"),
            "tank": tank,
            "blocks": blocks,
            "obstacles": [],
            "probes": [{"name": "wall_pressure", "position": probe}],
            "time": {
                "end": end,
                "initial_step": number(control, "deltaT"),
                "maximum_step": number(control, "maxDeltaT"),
                "courant": number(control, "maxCo"),
            },
            "output": {"interval": number(control, "writeInterval")},
            "method": {"name": "vof", "preset": tank["wall"], "parameters": method(solver)},
        },
    }


def main():
    contents = manifest()
    if not contents["finished"]:
        raise SystemExit("manifest.py: the log ends before endTime: the run has not finished")
    temporary = pathlib.Path("manifest.json.new")
    temporary.write_text(json.dumps(contents, indent=2) + "\n")
    os.replace(temporary, "manifest.json")


if __name__ == "__main__":
    main()
