"""The catalogue of flows as a whole: `names` of its studies, `plan` of what is to be made, `page`.

A catalogue is a file with the name of a study on each line, `#` for comments, beside the studies. `page`
reads the metrics.json of each study's report (catalogue/NAME/) and writes catalogue/metrics.json, which
holds every number of the page, and catalogue/index.html. It repeats no measurement and no verdict: only
the ratio of computed over measured, bias and scatter of a method are its own, as in Peacock, Reneke, Davis &
Jones (1999, Fire Safety J. 33) and the validation guide of NIST's Fire Dynamics Simulator.
"""

import argparse
import json
import math
import os
import sys
from pathlib import Path

import catalogue_plots as plots
import estimate
from study import NotBuilt, StudyError, load

FOLDER = Path("catalogue")
TEMPLATE = Path(__file__).parent.parent / "report/page/templates"
STYLE = TEMPLATE.parent / "style.css"
# Measures of which computed over measured means something: what is positive and has a zero.
RATIOS = ("peak", "impulse", "arrival", "amplitude", "final")
LEAST_RATIOS = 2  # of which a scatter is told


def names(path: Path) -> list[str]:
    lines = [line.split("#", 1)[0].strip() for line in path.read_text(encoding="utf-8").splitlines()]
    found = [line for line in lines if line]
    if not found:
        raise StudyError(f"{path}: found no study, expected a name on each line")
    for name in found:
        if not (path.parent / f"{name}.toml").is_file():
            raise StudyError(f"{path}: found \"{name}\", expected the name of a study beside it")
        if found.count(name) > 1:
            raise StudyError(f"{path}: found \"{name}\" twice, expected each study once")
    return found


def plan(path: Path, force: bool, cores: int) -> None:
    """A line for each study, and the time that all of it will take."""
    studies = names(path)
    width = max(map(len, studies))
    total, unknown = 0.0, 0
    rates: dict[str, float | None] = {}
    for name in studies:
        study = load(path.parent / f"{name}.toml")
        to_make = [run for run in study.computed if force or run.state() != "up to date"]
        found = estimate.estimate(to_make, rates)
        seconds = found.total(to_make, cores)
        missing = sum(found.seconds[run.name] is None for run in to_make)
        total += seconds + estimate.REPORT_S + len(study.runs) * estimate.REPORT_RUN_S
        unknown += missing
        print(f"  {name:<{width}}  {len(to_make):3} of {len(study.computed)} runs to make, about "
              f"{estimate.words(seconds)}" + (f" without {missing} of which nothing is known" if missing else ""),
              flush=True)
    print(f"estimate of the catalogue: about {estimate.words(total)} on {cores} "
          f"{'core' if cores == 1 else 'cores'}" + (f", without {unknown} runs" if unknown else ""), flush=True)


# --- the page -------------------------------------------------------------------------------------


def method_of(run: dict) -> str:
    """"mps improved" of a run in metrics.json, which has its settings as the study states them."""
    said = dict(setting.split("=", 1) for setting in run["settings"])
    if run["program"] != "surge-particle":
        return said.get("foam.solver", said.get("solver", run["program"]))
    return f"{said.get('method.name', '?')} {said.get('method.preset', '?')}"


def _rows(name: str, metrics: dict, compared: set[str]) -> list[dict]:
    """A row for each run that is compared, each quantity and each measure of it."""
    rows = []
    for key, quantity in metrics.get("observables", {}).items():
        for run, entry in quantity["runs"].items():
            if run not in compared:
                continue
            told = metrics["runs"][run]
            for against, found in entry["against"].items():
                if found["status"] != "passed":
                    continue
                for measure, one in found["measures"].items():
                    rows.append({
                        "flow": name, "quantity": key, "title": quantity["title"], "run": run,
                        "method": method_of(told), "against": against, "label": found["label"],
                        "kind": metrics.get("references", {}).get(against, {}).get("kind", "run"),
                        "measure": measure, "unit": one["unit"], "computed": one["run"],
                        "measured": one["reference"], "E": one["E"], "U": one.get("U"),
                        "u_data": one.get("u_data"), "tolerance": one.get("tolerance"),
                        "verdict": one["verdict"], "why": one["why"], "shift_s": found.get("shift_s", 0.0)})
    return rows


def _ratio(row: dict) -> float | None:
    if row["kind"] != "experiment" or row["measure"] not in RATIOS:
        return None
    computed, measured = row["computed"], row["measured"]
    if computed is None or measured is None or measured <= 0.0 or computed <= 0.0:
        return None
    return computed / measured


def statistics(rows: list[dict]) -> dict[str, dict]:
    """For each method: bias exp(mean ln(computed/measured)) and relative scatter, the standard deviation
    of ln(computed/measured), over all ratios of all flows."""
    logs: dict[str, list[float]] = {}
    for row in rows:
        ratio = _ratio(row)
        if ratio is not None:
            logs.setdefault(row["method"], []).append(math.log(ratio))
    found = {}
    for method, values in sorted(logs.items()):
        mean = sum(values) / len(values)
        scatter = None
        if len(values) >= LEAST_RATIOS:
            scatter = math.sqrt(sum((value - mean) ** 2 for value in values) / (len(values) - 1))
        found[method] = {"points": len(values), "bias": math.exp(mean), "scatter": scatter}
    return found


def missed_by_all(rows: list[dict]) -> list[dict]:
    """Measures against an experiment from which every method differs by more than its tolerance, by the
    sizes of the differences alone: where the methods agree with each other, it is no method's own error.
    `side` says whether all are above the measured value, below it, or some each; `least` and `most` are
    sizes, over the measured value where `part` says so."""
    groups: dict[tuple, list[dict]] = {}
    for row in rows:
        if row["kind"] == "experiment" and row["E"] is not None and row["tolerance"]:
            groups.setdefault((row["flow"], row["quantity"], row["against"], row["measure"]), []).append(row)
    missed = []
    for key, group in groups.items():
        if len(group) < 2 or not all(abs(row["E"]) > row["tolerance"] for row in group):
            continue
        sizes = [abs(row["E"]) for row in group]
        measured = group[0]["measured"]
        part = key[3] != "rms" and measured is not None and measured > 0.0
        over = measured if part else 1.0
        below = sum(row["E"] < 0.0 for row in group)
        side = None if key[3] == "rms" else "low" if below == len(group) else "high" if below == 0 else "both"
        missed.append({"flow": key[0], "title": group[0]["title"], "measure": key[3], "unit": group[0]["unit"],
                       "tolerance": group[0]["tolerance"] / over, "least": min(sizes) / over, "most": max(sizes) / over,
                       "part": part, "side": side, "methods": len(group)})
    return missed


def _cpu_seconds(timing: dict | None) -> float | None:
    """CPU time of all threads: stated (of interFoam that of one process), else wall time times threads."""
    if not timing:
        return None
    threads = timing.get("threads") or 1
    if timing.get("cpu_s"):
        return timing["cpu_s"] * (threads if "cells" in timing else 1)
    return timing["wall_s"] * threads if timing.get("wall_s") else None


def errors(rows: list[dict], seconds: dict[str, float | None]) -> dict | None:
    """Of one flow: the RMS of the first quantity that is held against data, else against the reference
    run, of every run with what it cost."""
    ranked = [row for row in rows if row["measure"] == "rms" and row["E"] is not None]
    data = [row for row in ranked if row["kind"] != "run"] or ranked
    if not data:
        return None
    first = data[0]
    chosen = [row for row in data if (row["quantity"], row["against"]) == (first["quantity"], first["against"])]
    return {"quantity": first["quantity"], "title": first["title"], "label": first["label"], "unit": first["unit"],
            "tolerance": first["tolerance"],
            "points": [{"run": row["run"], "method": row["method"], "E": row["E"], "U": row["U"],
                        "cpu_s": seconds.get(row["run"])} for row in chosen]}


def collect(path: Path, folder: Path = FOLDER) -> dict:
    """All that the page shows."""
    flows, rows = [], []
    for name in names(path):
        file = folder / name / "metrics.json"
        if not file.is_file():
            flows.append({"name": name, "title": name, "made": False, "runs": []})
            continue
        metrics = json.loads(file.read_text(encoding="utf-8"))
        study = load(path.parent / f"{name}.toml")
        compared = {run.name for run in study.runs
                    if any(role.split()[0] == "comparison" for role in run.roles)} & set(metrics["runs"])
        timing = metrics.get("timing", {})
        seconds = {run: _cpu_seconds(timing.get(run)) for run in metrics["runs"]}
        its_rows = _rows(name, metrics, compared)
        flows.append({"name": name, "title": metrics.get("study", {}).get("title", name), "made": True,
                      "errors": errors(its_rows, seconds),
                      "runs": [{"run": run, "method": method_of(told), "cpu_s": seconds.get(run),
                                "wall_s": (timing.get(run) or {}).get("wall_s")}
                               for run, told in metrics["runs"].items() if run in compared]})
        rows += its_rows
    return {"flows": flows, "rows": rows, "methods": statistics(rows), "missed_by_all": missed_by_all(rows)}


def scatter_points(rows: list[dict]) -> list[dict]:
    """Computed and measured values, each with its bar of 95 %: U of the data."""
    points = []
    for row in rows:
        if _ratio(row) is not None:
            points.append({"method": row["method"], "measured": row["measured"], "computed": row["computed"],
                           "bar": 2.0 * (row["u_data"] or 0.0), "unit": row["unit"],
                           "label": f"{row['flow']}: {row['title']}, {row['measure']}"})
    return points


def page(path: Path) -> None:
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    found = collect(path)
    FOLDER.mkdir(exist_ok=True)
    environment = Environment(loader=FileSystemLoader(TEMPLATE), autoescape=True, undefined=StrictUndefined,
                              trim_blocks=True, lstrip_blocks=True)
    points = scatter_points(found["rows"])
    look = plots.looks({run["method"] for flow in found["flows"] for run in flow["runs"]})
    text = environment.get_template("catalogue.html").render(
        c=found, style=STYLE.read_text(encoding="utf-8"), looks=look, marker=plots.marker, size=plots,
        costs=[made for flow in found["flows"] if (made := plots.error_over_cost(flow, look))],
        scatter=plots.computed_over_measured(points, look))
    for name, content in (("metrics.json", json.dumps(found, indent=1)), ("index.html", text)):
        part = FOLDER / (name + ".part")
        part.write_text(content + "\n", encoding="utf-8")
        os.replace(part, FOLDER / name)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", choices=["names", "plan", "page"])
    parser.add_argument("catalogue", type=Path)
    parser.add_argument("--force", action="store_true", help="plan: as if nothing were up to date")
    parser.add_argument("--cores", type=int, default=os.cpu_count() or 1, help="plan: that are used")
    parser.add_argument("--dry", action="store_true", help="plan: before the programs are built, say so")
    options = parser.parse_args()
    try:
        if options.task == "names":
            print("\n".join(names(options.catalogue)))
        elif options.task == "plan":
            plan(options.catalogue, options.force, options.cores)
        else:
            page(options.catalogue)
        return 0
    except NotBuilt as error:
        print(f"runs: {error}", file=sys.stdout if options.dry else sys.stderr)
        return 0 if options.dry else 1
    except (OSError, StudyError, ValueError, KeyError) as error:
        print(error, file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
