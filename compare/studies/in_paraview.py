"""Shows runs side by side in ParaView (5.9 or newer): one view each, cameras and time linked.

  pvpython compare/studies/in_paraview.py RUN... [--time S] [--png FILE] [--state FILE.pvsm]

RUN is a run's folder, runs/NAME, of a particle method or of interFoam. On both sides the arrays are then called
`pressure` and `velocity`; water alone is shown, coloured by pressure on one scale. `paraview FILE.pvsm` opens what
--state has written, to go on from.
"""

import argparse
import json
import sys
from pathlib import Path

ARRAYS = {"pressure": "p", "velocity": "U"}  # what particle frames call them: what OpenFOAM does
FRACTION = "alpha.water"
PARTICLES, FOAM = "particles.pvd", "vof.foam"  # what is opened of a run
WATER_FROM = 0.5  # volume fraction


class RunError(Exception):
    """A run that cannot be shown, in one line."""


def opened(folder: Path) -> Path:
    """The file of a run's folder that ParaView reads."""
    for name in (PARTICLES, FOAM):
        if (folder / name).is_file():
            return folder / name
    raise RunError(f"{folder}: found neither {PARTICLES} nor {FOAM}, expected the folder of a finished run")


def manifest(folder: Path) -> dict:
    try:
        return json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise RunError(f"{folder}/manifest.json: {error}") from None


def highest_pressure(case: dict) -> float:
    """That of the resting water, Pa: rho g H, H the height of the first block."""
    gravity, block = case["fluid"]["gravity"], case["blocks"][0]
    axis = max(range(len(gravity)), key=lambda i: abs(gravity[i]))
    return case["fluid"]["density"] * abs(gravity[axis]) * (block["upper"][axis] - block["lower"][axis])


def particles(simple, folder: Path):
    frames = simple.PVDReader(registrationName=folder.name, FileName=str(folder / PARTICLES))
    return simple.Threshold(Input=frames, Scalars=["POINTS", "type"], LowerThreshold=0, UpperThreshold=0)


def mesh(simple, folder: Path):
    case = simple.OpenFOAMReader(registrationName=folder.name, FileName=str(folder / FOAM))
    case.MeshRegions = ["internalMesh"]
    case.CellArrays = [FRACTION, *ARRAYS.values()]
    water = simple.Threshold(Input=case, Scalars=["CELLS", FRACTION], LowerThreshold=WATER_FROM, UpperThreshold=2)
    for name, foam in ARRAYS.items():
        water = simple.Calculator(Input=water, AttributeType="Cell Data", ResultArrayName=name, Function=foam)
    return water


def show(simple, folder: Path, view, highest: float):
    case = manifest(folder)["case"]
    kind = opened(folder).name
    water = particles(simple, folder) if kind == PARTICLES else mesh(simple, folder)
    shown = simple.Show(water, view)
    where = "POINTS" if kind == PARTICLES else "CELLS"
    if kind == PARTICLES:
        shown.SetRepresentationType("Point Gaussian")
        shown.GaussianRadius = 0.5 * case["spacing"]
        shown.ShaderPreset = "Plain circle"
    simple.ColorBy(shown, (where, "pressure"))
    scale = simple.GetColorTransferFunction("pressure")
    scale.RescaleTransferFunction(0.0, highest)
    simple.Show(simple.Text(Text=folder.name), view)
    return water


def side_by_side(simple, folders: list[Path], time: float | None):
    """A layout with a view for each run."""
    layout = simple.CreateLayout("runs")
    highest = highest_pressure(manifest(folders[0])["case"])
    views = []
    for folder in folders:
        view = simple.CreateView("RenderView")
        simple.AssignViewToLayout(view=view, layout=layout, hint=2 * len(views))
        show(simple, folder, view, highest)
        views.append(view)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = scene.TimeKeeper.TimestepValues[-1] if time is None else time
    for view in views:
        view.Update()
        simple.SetActiveView(view)
        simple.ResetCamera(view)
        if view is not views[0]:
            simple.AddCameraLink(views[0], view, f"camera {views.index(view)}")
    return layout


def main(words: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", type=Path, metavar="RUN")
    parser.add_argument("--time", type=float, help="s; the last frame by default")
    parser.add_argument("--png", type=Path, help="picture to write")
    parser.add_argument("--state", type=Path, help="state to write, which ParaView opens")
    options = parser.parse_args(words)
    try:
        for folder in options.runs:
            opened(folder)
        from paraview import simple  # pylint: disable=import-outside-toplevel
        layout = side_by_side(simple, options.runs, options.time)
    except (RunError, ImportError) as error:
        print(f"in_paraview.py: {error}", file=sys.stderr)
        return 1
    if options.png:
        simple.SaveScreenshot(str(options.png), layout, ImageResolution=[600 * len(options.runs), 700])
    if options.state:
        simple.SaveState(str(options.state))
    if not options.png and not options.state:
        print("in_paraview.py: found neither --png nor --state, expected one of them", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
