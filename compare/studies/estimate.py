"""How long the runs of a study will take on this machine. Standard library only.

A run that was made before, from the same case with the same overrides, is expected to take as long
as then, even if the program has changed since. Any other is expected to take its steps times its
particles (or cells), as the program tells them, times what one costs here: that of each method and preset
is measured by a short run. The rates of the other solvers and searches over those were measured once,
and hold within a factor of two; the estimate is one of the whole plan, not of each run.
"""

import json
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from study import PROGRAMS, RUNS, Run

# A column of 800 particles; long enough for a hundred steps and more, a fraction of a second.
CALIBRATION = ["particle/cases/dam_break.toml", "--set", "resolution.spacing=0.00725"]
CALIBRATION_END = {"sph": 0.02, "mps": 0.1}
PAPER = "paper"  # the preset whose rate the factors below are of
SPH_PAIR = 2.5e-3  # a pair of the all-pairs search, in steps of a particle with the cell grid
MPS_PAIR = 1.6e-4
MPS_MULTIGRID = 0.55  # instead of ICCG
ICCG_GROWTH = 0.2  # its cost per particle goes with this power of their number
VOF_CELL = 0.8  # step of a cell, in those of an MPS particle of the calibration
SPACE = 4.0  # neighbours in three dimensions over those in two, 113 to 28 within three spacings
START_S = 0.3  # of a run besides its steps
FOAM_START_S = 2.0
REPORT_RUN_S = 0.5  # to read a run into the report
REPORT_S = 20.0
FILE = RUNS / ".estimate.json"


@dataclass
class Estimate:
    """Seconds expected of each run; None where nothing is known."""

    seconds: dict[str, float | None] = field(default_factory=dict)
    from_last_time: int = 0

    def total(self, runs: list[Run], cores: int) -> float:
        return _total([(self.seconds.get(run.name) or 0.0, run.timed, run.threads) for run in runs], cores)


def _total(runs: list[tuple[float, bool, int]], cores: int) -> float:
    """Of runs of (seconds, timed, threads): the timed ones one by one, then the others beside each
    other."""
    alone = sum(cost for cost, timed, _ in runs if timed)
    shared = [(cost, threads) for cost, timed, threads in runs if not timed]
    area = sum(cost * min(threads, cores) for cost, threads in shared) / max(cores, 1)
    return alone + max([area, *(cost for cost, _ in shared)])


def estimate(runs: list[Run], rates: dict[str, float | None] | None = None) -> Estimate:
    """`rates`: what earlier calibrations of this machine have found, and those made here."""
    found = Estimate()
    rates = {} if rates is None else rates
    known: dict[tuple, float | None] = {}  # repetitions cost the same
    for run in runs:
        seconds = _last_time(run)
        found.from_last_time += seconds is not None
        if seconds is None:
            work = (run.program, run.case, run.settings, run.threads)
            if work not in known:
                known[work] = _modelled(run, rates)
            seconds = known[work]
        found.seconds[run.name] = seconds
    return found


def _last_time(run: Run) -> float | None:
    """Seconds that it took when it was last made from this case with these overrides."""
    try:
        inputs = run.inputs()
        stamps = list(run.folder.glob(".finished-*"))
        before = json.loads(stamps[0].read_text(encoding="utf-8"))
        if any(before.get(key) != inputs.get(key) for key in ("case", "method", "settings", "threads")):
            return None
        manifest = json.loads((run.folder / "manifest.json").read_text(encoding="utf-8"))
        return float(manifest["wall_s"]["total"])
    except (OSError, ValueError, KeyError, TypeError, IndexError):
        return None


def _modelled(run: Run, rates: dict[str, float | None]) -> float | None:
    try:
        return _foam(run, rates) if run.program == "interFoam" else _particles(run, rates)
    except (OSError, ValueError, KeyError, TypeError, ZeroDivisionError):
        return None


def _particles(run: Run, rates: dict[str, float | None]) -> float | None:
    case, size = run.resolved["case"], run.resolved["size"]
    method, preset = case["method"]["name"], case["method"].get("preset", PAPER)
    options = case["method"]["parameters"]
    rate = _rate(method, rates, preset)
    if rate is None:
        return None
    fluid, wall, steps = (float(size[key]) for key in ("fluid_particles", "wall_particles", "steps"))
    if method != "sph":  # the steps of SPH go with the sound
        steps = max(1.0, steps * _share_of_speed(case, steps))
    pairs = (fluid + wall) ** 2 if case["search"]["neighbours"] == "all_pairs" else 0.0
    if preset != PAPER:
        # the preset itself was measured
        work = fluid + (SPH_PAIR if method == "sph" else MPS_PAIR) * pairs
    elif method == "sph":
        width = options["h_over_l0"] / 1.2
        work = fluid * width**2 + SPH_PAIR * pairs
    else:
        iccg = (fluid / 800) ** ICCG_GROWTH
        work = fluid * (iccg if options.get("ppe_solver") == "iccg" else MPS_MULTIGRID) + MPS_PAIR * pairs
    if case.get("dimension", 2) == 3:
        work *= SPACE
    return START_S + rate * work * steps / min(run.threads, 4) ** 0.7


def _share_of_speed(case: dict, steps: float) -> float:
    """Mean speed of a fall from rest over the speed that the program has taken for its steps; one
    where the run is longer than it takes to reach that."""
    end = case["time"]["end"]
    speed = steps * case["time"]["courant"] * case["spacing"] / end
    return min(1.0, 9.81 * end / (2 * speed)) if 9.81 * end < speed else 1.0


def _foam(run: Run, rates: dict[str, float | None]) -> float | None:
    rate = _rate("mps", rates)
    if rate is None:
        return None
    if "parameters" in run.resolved:
        entries = run.resolved["parameters"]
        cells = 36 * entries["cellsPerL"] ** 2
        steps = 60 * entries["cellsPerL"] * entries["endTime"] * 0.5 / entries["maxCo"]
    else:
        cells, steps = (run.resolved["size"][key] for key in ("cells", "steps"))
    return FOAM_START_S + rate * VOF_CELL * cells * steps / min(run.threads, 4) ** 0.7


def _rate(method: str, rates: dict[str, float | None], preset: str = PAPER) -> float | None:
    """Seconds of a step of one fluid particle here, by a short run."""
    key = f"{method} {preset}"
    if key not in rates:
        rates[key] = _calibrate(method, preset)
    return rates[key]


def _calibrate(method: str, preset: str) -> float | None:
    end = CALIBRATION_END.get(method, CALIBRATION_END["mps"])
    with tempfile.TemporaryDirectory(prefix="calibration-") as folder:
        command = [str(PROGRAMS / "surge-particle"), "run", *CALIBRATION, "--out", f"{folder}/run",
                   "--set", f"method.name={method}", "--set", f"method.preset={preset}",
                   "--set", f"time.end={end}",
                   "--set", f"output.interval={end}"]
        try:
            subprocess.run(command, capture_output=True, check=True)
            manifest = json.loads(Path(folder, "run/manifest.json").read_text(encoding="utf-8"))
            wall = manifest["wall_s"]
            solve = wall["total"] - wall["setup"] - wall["output"]
            return solve / (manifest["steps"] * manifest["fluid_particles"])
        except (OSError, ValueError, KeyError, ZeroDivisionError, subprocess.CalledProcessError):
            return None


# --- the rest of a plan --------------------------------------------------------------------------


def keep(found: Estimate, runs: list[Run], cores: int) -> None:
    """Leaves the estimate to the runs, which tell what is left of it."""
    FILE.parent.mkdir(exist_ok=True)
    plan = [{"name": run.name, "seconds": found.seconds.get(run.name), "timed": run.timed,
             "threads": run.threads, "stamp": str(run.stamp())} for run in runs]
    FILE.write_text(json.dumps({"cores": cores, "runs": plan}), encoding="utf-8")


def most_urgent_last(runs: list[Run]) -> list[Run]:
    """The runs from the one to start last to the one to start first. Those that need several cores at
    once start first, while all are free; then the longest, so that what is left at the end is short
    and no core is without work for long. keep() left how long they take; a run that it does not
    know is taken for the longest."""
    try:
        plan = json.loads(FILE.read_text(encoding="utf-8"))
        seconds = {run["name"]: run["seconds"] for run in plan["runs"]}
    except (OSError, ValueError, KeyError, TypeError):
        seconds = {}

    def urgency(run: Run) -> tuple[bool, int, float]:
        expected = seconds.get(run.name)
        return run.timed, run.threads, float("inf") if expected is None else float(expected)

    return sorted(runs, key=urgency)


def left(done: str) -> str:
    """", about 12 min left" after a run; empty where nothing is known."""
    try:
        plan = json.loads(FILE.read_text(encoding="utf-8"))
        rest = [run for run in plan["runs"] if run["name"] != done and not Path(run["stamp"]).exists()]
        seconds = _total([(run["seconds"] or 0.0, run["timed"], run["threads"]) for run in rest],
                         plan["cores"])
        return f", about {words(seconds)} left" if rest else ""
    except (OSError, ValueError, KeyError, TypeError):
        return ""


def words(seconds: float) -> str:
    if seconds < 90:
        return f"{max(10, round(seconds, -1)):.0f} s"
    if seconds < 90 * 60:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h"
