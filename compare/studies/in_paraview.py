"""Shows runs side by side in ParaView (5.11 or newer, Debian 12's): one view each, cameras and time linked.

  pvpython compare/studies/in_paraview.py RUN... [--time S] [--png FILE] [--state FILE.pvsm]

RUN is a run's folder, runs/NAME, of a particle method or of interFoam. On both sides the arrays are then called
`pressure` and `velocity`; water alone is shown, coloured by pressure on one scale. `paraview FILE.pvsm` opens what
--state has written, to go on from.
"""

import argparse
import json
import math
import sys
from pathlib import Path

ARRAYS = {"pressure": "p", "velocity": "U"}  # what particle frames call them: what OpenFOAM does
FRACTION = "alpha.water"
PARTICLES, FOAM = "particles.pvd", "vof.foam"  # what is opened of a run
WATER_FROM = 0.5  # volume fraction
WATER_HEIGHTS = 1.5  # of the water at the start are shown
VIEW, SIDE, HEAD, FOOT = 640, 16, 48, 96  # pixels: width of a view, and its margins
COLUMNS = 3  # of views; further ones stand below


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


def vertical_axis(case: dict) -> int:
    gravity = case["fluid"]["gravity"]
    return max(range(len(gravity)), key=lambda i: abs(gravity[i]))


def highest_pressure(case: dict) -> float:
    """That of the resting water, Pa: rho g H, H the height of the first block."""
    up, block = vertical_axis(case), case["blocks"][0]
    height = block["upper"][up] - block["lower"][up]
    return case["fluid"]["density"] * abs(case["fluid"]["gravity"][up]) * height


def shown_plane(case: dict) -> tuple[list[float], list[float]]:
    """What every view shows, lower and upper corner in m: the tank along x, and up from its floor half as high again
    as the water stands at the start. Where a side of the tank is not known, the water's own."""
    up, tank = vertical_axis(case), case.get("tank") or {"lower": [math.nan] * 3, "upper": [math.nan] * 3}
    lower = [min(block["lower"][i] for block in case["blocks"]) for i in range(3)]
    upper = [max(block["upper"][i] for block in case["blocks"]) for i in range(3)]
    known = lambda value: value is not None and math.isfinite(value)  # noqa: E731
    for i in range(3):
        lower[i] = tank["lower"][i] if known(tank["lower"][i]) else lower[i]
        if i != up:
            upper[i] = tank["upper"][i] if known(tank["upper"][i]) else upper[i]
    top = lower[up] + WATER_HEIGHTS * (upper[up] - lower[up])
    upper[up] = min(top, tank["upper"][up]) if known(tank["upper"][up]) else top
    return lower, upper


def picture_size(case: dict) -> tuple[int, int]:
    """Pixels of one view: as wide as VIEW, and as high as the plane and its margins need."""
    lower, upper = shown_plane(case)
    up = vertical_axis(case)
    return VIEW, round(HEAD + FOOT + (upper[up] - lower[up]) * pixels_per_metre(case))


def pixels_per_metre(case: dict) -> float:
    lower, upper = shown_plane(case)
    return (VIEW - 2 * SIDE) / (upper[0] - lower[0])


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


def show_solids(simple, case: dict, view) -> None:
    """The tank's outline and its obstacles."""
    boxes = [(case["tank"], "Outline")] if case.get("tank") else []
    boxes += [(box, "Surface") for box in case.get("obstacles", [])]
    for box, kind in boxes:
        lower, upper = box["lower"], box["upper"]
        if not all(value is not None and math.isfinite(value) for value in [*lower, *upper]):
            continue
        solid = simple.Box(Center=[(a + b) / 2 for a, b in zip(lower, upper)])
        solid.XLength, solid.YLength, solid.ZLength = (b - a for a, b in zip(lower, upper))
        shown = simple.Show(solid, view)
        shown.SetRepresentationType(kind)
        shown.ColorArrayName = [None, ""]
        shown.AmbientColor = shown.DiffuseColor = [0.35, 0.35, 0.35]


def show(simple, folder: Path, view, highest: float, with_scale: bool):
    case = manifest(folder)["case"]
    is_particles = opened(folder).name == PARTICLES
    water = particles(simple, folder) if is_particles else mesh(simple, folder)
    shown = simple.Show(water, view)
    if is_particles:
        shown.SetRepresentationType("Point Gaussian")
        shown.GaussianRadius = 0.5 * case["spacing"]
        shown.ShaderPreset = "Plain circle" if case["dimension"] == 2 else "Sphere"
    simple.ColorBy(shown, ("POINTS" if is_particles else "CELLS", "pressure"))
    colours = simple.GetColorTransferFunction("pressure")
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(0.0, highest)
    colours.AutomaticRescaleRangeMode = "Never"  # one scale on both sides, whatever time is shown
    if with_scale:
        bar = simple.GetScalarBar(colours, view)
        bar.Title, bar.ComponentTitle = "pressure, Pa", ""
        bar.Orientation, bar.WindowLocation = "Horizontal", "Lower Center"
        bar.TitleColor = bar.LabelColor = [0, 0, 0]
        bar.TitleFontSize = bar.LabelFontSize = 16
        bar.ScalarBarLength, bar.ScalarBarThickness = 0.6, 14
        bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = False, "%g", "%.0f"
        bar.Visibility = True
    show_solids(simple, case, view)
    name = folder.name.replace("{", "{{").replace("}", "}}")
    title = simple.Show(simple.AnnotateTimeFilter(Input=water, Format=name + ", t = {time:.3f} s"), view)
    title.WindowLocation, title.Color, title.FontSize = "Upper Center", [0, 0, 0], 18


def look_at(view, case: dict) -> None:
    """The plane of x and up, seen along the third axis without perspective."""
    lower, upper = shown_plane(case)
    up = vertical_axis(case)
    across = 3 - up
    metre = pixels_per_metre(case)
    top, bottom = upper[up] + HEAD / metre, lower[up] - FOOT / metre
    focus = [(a + b) / 2 for a, b in zip(lower, upper)]
    focus[up] = (top + bottom) / 2
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = focus
    away = 5 * max(upper[0] - lower[0], top - bottom)
    # x to the right: seen from +z where y is up, from -y where z is up.
    view.CameraPosition = [x + (away if across == 2 else -away) * (i == across) for i, x in enumerate(focus)]
    view.CameraViewUp = [float(i == up) for i in range(3)]
    view.CameraParallelScale = (top - bottom) / 2


def grid_of_views(layout, count: int) -> tuple[list[int], int, int]:
    """Places of a layout for that many views of one size: (places, columns, rows)."""
    rows = -(-count // COLUMNS)
    columns = -(-count // rows)
    places, rest = [], 0
    for row in range(rows):
        place = rest
        if row + 1 < rows:
            place = layout.SplitVertical(rest, 1 / (rows - row))
            rest = place + 1
        for column in range(columns):
            mine = place
            if column + 1 < columns:
                mine = layout.SplitHorizontal(place, 1 / (columns - column))
                place = mine + 1
            places.append(mine)
    return places[:count], columns, rows


def side_by_side(simple, folders: list[Path], time: float | None):
    """A layout with a view for each run, and its size in pixels."""
    simple._DisableFirstRenderCameraReset()  # pylint: disable=protected-access
    layout = simple.CreateLayout("runs")
    first = manifest(folders[0])["case"]
    places, columns, rows = grid_of_views(layout, len(folders))
    width, height = picture_size(first)
    views = []
    for folder, place in zip(folders, places):
        view = simple.CreateView("RenderView")
        view.ViewSize = [width, height]
        view.UseColorPaletteForBackground = 0
        view.Background = [1, 1, 1]
        view.OrientationAxesVisibility = 0
        layout.AssignView(place, view)
        show(simple, folder, view, highest_pressure(first), with_scale=not views)
        views.append(view)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = scene.TimeKeeper.TimestepValues[-1] if time is None else time
    for view in views:
        look_at(view, first)
        if view is not views[0]:
            simple.AddCameraLink(views[0], view, f"camera {views.index(view)}")
    return layout, [columns * width, rows * height]


def main(words: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", type=Path, metavar="RUN")
    parser.add_argument("--time", type=float, help="s; the last frame by default")
    parser.add_argument("--png", type=Path, help="picture to write")
    parser.add_argument("--state", type=Path, help="state to write, which ParaView opens")
    options = parser.parse_args(words)
    try:
        if not options.png and not options.state:
            raise RunError("found neither --png nor --state, expected one of them")
        for folder in options.runs:
            opened(folder)
        from paraview import simple  # pylint: disable=import-outside-toplevel
        try:
            # A state is opened from anywhere.
            layout, size = side_by_side(simple, [folder.resolve() for folder in options.runs], options.time)
            if options.png:
                simple.SaveScreenshot(str(options.png), layout, ImageResolution=size)
            if options.state:
                simple.SaveState(str(options.state))
        finally:
            simple.Disconnect()  # else ParaView 5.11 crashes at the end where there are several views
    except (RunError, ImportError) as error:
        print(f"in_paraview.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
