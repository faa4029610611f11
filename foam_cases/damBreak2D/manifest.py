#!/usr/bin/env -S python3 -B
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

from flow import Mesh, dictionary, entry, flow, gravity, log, number, numbers, short


def seconds(*names):
    """Wall seconds that these steps of Allrun took; a case has not all of them."""
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


def cell_size():
    """Width of a cell that has not grown, m."""
    mesh = dictionary("system/blockMeshDict")
    if "cellSize" in mesh:
        return numbers(mesh["cellSize"])[0]
    return numbers(mesh["scale"])[0] / number("system/caseParameters", "cellsPerL")


def method(solver):
    """The numerical choices, each as the solver has read it."""
    schemes, solution, control = "system/fvSchemes", "system/fvSolution", "system/controlDict"
    alpha = 'solvers|"alpha.water.*"|'
    chosen = {
        "ddt": entry(schemes, "ddtSchemes|default"),
        "div_U": entry(schemes, "divSchemes|div(rhoPhi,U)"),
        "alpha_corrections": number(solution, alpha + "nAlphaCorr"),
        "alpha_sub_cycles": number(solution, alpha + "nAlphaSubCycles"),
        "pressure_corrections": number(solution, "PIMPLE|nCorrectors"),
        "momentum_predictor": entry(solution, "PIMPLE|momentumPredictor"),
        "pressure_tolerance": number(solution, "solvers|p_rghFinal|tolerance"),
        "alpha_courant": number(control, "maxAlphaCo"),
    }
    if solver == "interFoam":
        chosen["div_alpha"] = entry(schemes, "divSchemes|div(phi,alpha)")
        chosen["c_alpha"] = number(solution, alpha + "cAlpha")
    return chosen


def case(mesh, stated, solver):
    """The case, in the words of a case file of surge-particle; see its manifest."""
    control, transport = "system/controlDict", "constant/transportProperties"
    size = cell_size()
    first = stated["blocks"][0]
    return {
        "title": entry(control, "title").strip('"'),
        "dimension": mesh.dimension,
        "spacing": short(size),
        "cells_per_L": short((first["upper"][0] - first["lower"][0]) / size, 9),
        "fluid": {
            "density": number(transport, "water|rho"),
            "kinematic_viscosity": number(transport, "water|nu"),
            "gravity": gravity(),
        },
        "gas": {
            "density": number(transport, "air|rho"),
            "kinematic_viscosity": number(transport, "air|nu"),
        },
        "surface_tension": number(transport, "sigma"),
        **stated,
        "time": {
            "end": number(control, "endTime"),
            "initial_step": number(control, "deltaT"),
            "maximum_step": number(control, "maxDeltaT"),
            "courant": number(control, "maxCo"),
        },
        "output": {"interval": number(control, "writeInterval")},
        "method": {"name": "vof", "preset": stated["tank"]["wall"], "parameters": method(solver)},
    }


def manifest():
    solver = entry("system/controlDict", "application")
    text = log(solver)
    mesh = Mesh()
    stated, volume, left_out = flow(mesh, cell_size())
    made = case(mesh, stated, solver)
    end = made["time"]["end"]
    simulated = numbers("\n".join(re.findall(r"^Time = (\S+)$", text, re.M)))
    processes = re.search(r"^nProcs : (\d+)", text, re.M)
    volumes = [float(row[1]) for row in rows("waterVolume")]
    # Cells fill a ball, and what is beside a surface, as well as they can: the change is counted
    # from what they hold.
    balls = any(block["shape"] == "ball" for block in stated["blocks"])
    initial = volumes[0] if balls or left_out is not None else volume
    extremes = [(float(row[2]), float(row[4])) for row in rows("alphaRange")]
    setup = seconds("blockMesh", "checkMesh", "topoSet", "setFields", "setExprFields", "decomposePar")
    solve, output = seconds("solve"), seconds("reconstructPar")
    return {
        "program": solver,
        "version": re.search(r"OPENFOAM=(\S+)", text)[1],
        "build": re.search(r"^Build\s*: (.*)", text, re.M)[1],
        "cpu": processor_name(),
        "threads": int(processes[1]) if processes else 1,
        "started": utc(float(pathlib.Path(".steps/blockMesh").read_text().split()[1])),
        "finished": simulated[-1] > end * (1 - 1e-6),
        "wall_s": {
            "total": round(setup + solve + output, 3),
            "setup": setup,
            "solve": solve,
            "output": output,
        },
        "cpu_s": numbers(re.findall(r"^ExecutionTime = (.*) s ", text, re.M)[-1])[0],
        "steps": len(simulated),
        "simulated_s": simulated[-1],
        "cells": mesh.cells,
        "thickness": mesh.thickness,
        "water_volume_stated": volume,
        "water_volume_start": volumes[0],
        "water_volume_change": max((v / initial - 1 for v in volumes), key=abs),
        **({} if left_out is None else {"solid_volume_cut_out": left_out}),
        "alpha_min": min(low for low, _ in extremes),
        "alpha_max": max(high for _, high in extremes),
        "case": made,
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
