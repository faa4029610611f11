"""What a study is made of, which of its runs are up to date, and how one of them is executed.

The Snakefile beside this file only schedules; Allrun prints `plan`. Standard library only.

A run counts as done when its folder holds a stamp `.finished-<digest>`, where the digest is taken
from everything that decides about the result: case file, presets, overrides, threads and the
program's own code (its object files without the one that carries the commit, so that a commit
which touches other things repeats nothing). Times of files play no part in it.
"""

import argparse
import functools
import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

BUILD = Path("build/release")
PRESETS = Path("particle/cases/presets")
REFERENCE = Path("compare/reference")
RUNS = Path("runs")
REPORT = Path("report")
LOG_LINES = 15  # of a failed run's log are shown

# What a foam case leaves behind when it is run in place; the rest is the case.
FOAM_OUTPUT = re.compile(
    r"\.steps|log\..*|processor.*|postProcessing|VTK|.*\.foam|manifest\.json|[0-9]+(\.[0-9]+)?(e-?[0-9]+)?"
)


class StudyError(Exception):
    """A mistake in a study, told in one line."""


@dataclass(frozen=True)
class Run:
    """One [[run]] table of a study."""

    name: str
    program: str
    case: Path
    set: tuple[str, ...]
    threads: int
    timed: bool

    @property
    def folder(self) -> Path:
        return RUNS / self.name

    @property
    def log(self) -> Path:
        return RUNS / f"{self.name}.log"

    def inputs(self) -> dict[str, str]:
        """Everything that decides about the result, under the name that a person knows it by."""
        inputs = {
            "overrides": _digest(json.dumps(self.set)),
            "threads": str(self.threads),
        }
        if self.program == "interFoam":
            inputs["case"] = _digest(*_tree(self.case))
            inputs["program"] = _digest(*_files([_which("interFoam")]))
        else:
            inputs["case"] = _digest(_canonical(self.case))
            inputs["presets"] = _digest(*[f"{p.name}{_canonical(p)}" for p in _presets()])
            inputs["program"] = _program_digest("surge-particle")
        return inputs

    def digest(self) -> str:
        return _digest(json.dumps(self.inputs(), sort_keys=True))[:16]

    def stamp(self) -> Path:
        return self.folder / f".finished-{self.digest()}"

    def state(self) -> str:
        """`up to date`, or why the run has to be made."""
        _withdraw_broken_stamps(self.folder)
        if self.stamp().exists():
            return "up to date"
        stamps = list(self.folder.glob(".finished-*"))
        if not stamps:
            return "failed or stopped last time" if self.folder.exists() else "not there yet"
        return f"changed: {_changes(stamps[0], self.inputs())}"


@dataclass(frozen=True)
class Study:
    """A study file, as far as the workflow is concerned."""

    path: Path
    runs: tuple[Run, ...]

    def inputs(self) -> dict[str, str]:
        """What decides about the report, besides the runs' own results."""
        return {
            "study": _digest(_canonical(self.path)),
            "runs": _digest(*[run.digest() for run in self.runs]),
            "reference": _digest(*_files(sorted(REFERENCE.glob("*.csv")))),
            "program": _program_digest("surge-compare"),
        }

    def report_stamp(self) -> Path:
        return REPORT / f".finished-{_digest(json.dumps(self.inputs(), sort_keys=True))[:16]}"

    def report_state(self) -> str:
        stamp = self.report_stamp()
        newest = max((r.stamp().stat().st_mtime for r in self.runs if r.stamp().exists()), default=0)
        if any(run.state() != "up to date" for run in self.runs):
            return "follows the runs"
        if stamp.exists():
            return "up to date" if stamp.stat().st_mtime >= newest else "older than a run"
        stamps = list(REPORT.glob(".finished-*"))
        return f"changed: {_changes(stamps[0], self.inputs())}" if stamps else "not there yet"


# --- reading a study -----------------------------------------------------------------------------


def load(path: Path) -> Study:
    """Reads and checks the [[run]] tables; the rest of the study is surge-compare's to check."""
    try:
        text = Path(path).read_text(encoding="utf-8")
        tables = tomllib.loads(text).get("run", [])
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise StudyError(f"{path}: {error}") from error
    lines = [n for n, line in enumerate(text.splitlines(), 1) if re.match(r"\s*\[\[\s*run\s*\]\]", line)]
    if not tables or len(lines) != len(tables):
        raise StudyError(f"{path}: run: found no [[run]] table, expected at least one")
    runs = tuple(_run(table, f"{path}:{line}") for table, line in zip(tables, lines))
    for index, run in enumerate(runs):
        if run.name in [other.name for other in runs[:index]]:
            raise StudyError(f"{path}:{lines[index]}: name: found '{run.name}' a second time")
    return Study(Path(path), runs)


def _run(table: dict, where: str) -> Run:
    def value(key, check, expected, default=None):
        found = table.get(key, default)
        if found is None or not check(found):
            shown = "nothing" if found is None else repr(found)
            raise StudyError(f"{where}: {key}: found {shown}, expected {expected}")
        return found

    for key in table:
        if key not in ("name", "program", "case", "set", "threads", "timed"):
            expected = "name, program, case, set, threads or timed"
            raise StudyError(f"{where}: {key}: found an unknown key, expected {expected}")
    program = value("program", ("surge-particle", "interFoam").__contains__,
                    "'surge-particle' or 'interFoam'")
    case_there = os.path.isdir if program == "interFoam" else os.path.isfile
    is_text = lambda found: isinstance(found, str)
    return Run(
        name=value("name", lambda n: is_text(n) and re.fullmatch(r"[A-Za-z0-9][\w.-]*", n),
                   "a name of letters, digits, '.', '_' and '-'"),
        program=program,
        case=Path(value("case", lambda c: is_text(c) and case_there(c),
                        f"an existing {'foam case' if program == 'interFoam' else 'case file'}")),
        set=tuple(value("set", lambda s: isinstance(s, list)
                        and all(is_text(e) and re.match(r"[^=\s]+=", e) for e in s),
                        "a list of 'key=value'", [])),
        threads=value("threads", lambda t: type(t) is int and t >= 1, "a whole number >= 1", 1),
        timed=value("timed", lambda t: type(t) is bool, "true or false", True),
    )


# --- digests -------------------------------------------------------------------------------------


def _digest(*parts: str | bytes) -> str:
    total = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        total.update(len(data).to_bytes(8, "big") + data)
    return total.hexdigest()


@functools.cache
def _canonical(path: Path) -> str:
    """A TOML file without comments and layout: its values decide, not how they are written."""
    try:
        return json.dumps(tomllib.loads(path.read_text(encoding="utf-8")), sort_keys=True, default=str)
    except tomllib.TOMLDecodeError:
        return path.read_text(encoding="utf-8")  # the program will say what is wrong with it


@functools.cache
def _presets() -> tuple[Path, ...]:
    return tuple(sorted(PRESETS.rglob("*.toml")))


def _files(paths) -> list[bytes]:
    """Names and contents of files, to be digested."""
    return [part for path in paths if path for part in (path.name.encode(), path.read_bytes())]


def foam_files(case: Path) -> list[Path]:
    """What belongs to a foam case, as opposed to what an earlier run in place left there."""
    entries = [p for p in sorted(case.iterdir()) if not FOAM_OUTPUT.fullmatch(p.name)]
    files = [f for p in entries for f in (sorted(p.rglob("*")) if p.is_dir() else [p])]
    return [f for f in files if f.is_file() and "polyMesh" not in f.relative_to(case).parts]


@functools.cache
def _tree(case: Path) -> tuple[bytes, ...]:
    return tuple(part for file in foam_files(case)
                 for part in (str(file.relative_to(case)).encode(), file.read_bytes()))


def _which(program: str) -> Path | None:
    found = shutil.which(program)
    return Path(found) if found else None


@functools.cache
def _program_digest(program: str) -> str:
    """Of the object files that a program is linked from, but for the one with the commit in it."""
    objects = subprocess.run(["ninja", "-C", str(BUILD), "-t", "inputs", f"bin/{program}"],
                             capture_output=True, text=True, check=False).stdout.split()
    found = [BUILD / o for o in objects if o.endswith(".o") and not o.endswith("/version.cpp.o")]
    found = sorted(path for path in found if path.is_file())
    return _digest(*_files(found)) if found else "not built"


# --- stamps --------------------------------------------------------------------------------------


def finished(folder: Path) -> bool:
    """Whether the program that wrote the folder says that it came to its end."""
    try:
        return json.loads((folder / "manifest.json").read_text())["finished"] is True
    except (OSError, ValueError, KeyError, TypeError):
        return False


def _withdraw_broken_stamps(folder: Path) -> None:
    """A stamp vouches for the folder as it was then: not if somebody wrote there since."""
    for stamp in folder.glob(".finished-*"):
        if not finished(folder) or (folder / "manifest.json").stat().st_mtime > stamp.stat().st_mtime:
            stamp.unlink()


def _write_stamp(stamp: Path, inputs: dict[str, str]) -> None:
    for old in stamp.parent.glob(".finished-*"):
        old.unlink()
    partial = stamp.with_name(".finishing")
    partial.write_text(json.dumps(inputs, indent=1) + "\n")
    partial.rename(stamp)


def _changes(stamp: Path, inputs: dict[str, str]) -> str:
    try:
        before = json.loads(stamp.read_text())
    except ValueError:
        before = {}
    return ", ".join(key for key in inputs if before.get(key) != inputs[key]) or "unknown"


# --- execution -----------------------------------------------------------------------------------


def _say(text: str) -> None:
    print(f"{time.strftime('%H:%M:%S')} {text}", flush=True)


def _call(command: list[str], log, **options) -> bool:
    log.write("+ " + shlex.join(command) + "\n")
    log.flush()
    return subprocess.run(command, stdout=log, stderr=subprocess.STDOUT,
                          stdin=subprocess.DEVNULL, check=False, **options).returncode == 0


def _copy_foam_case(run: Run) -> None:
    for file in foam_files(run.case):
        target = run.folder / file.relative_to(run.case)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(file, target)


def _run_foam(run: Run, log) -> bool:
    """Copies the case, sets the entries of its one included dictionary, and runs it there."""
    # All that Debian's OpenFOAM needs in the environment.
    environment = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ}
    _copy_foam_case(run)
    for setting in run.set:
        key, value = setting.split("=", 1)
        entry = ["foamDictionary", "-disableFunctionEntries", "-entry", key]
        file = ["system/caseParameters"]
        # -set would add an entry that is not there, and a misspelt one would go unnoticed
        if not _call([*entry, "-value", *file], log, cwd=run.folder, env=environment):
            log.write(f"system/caseParameters: {key}: found no such entry\n")
            return False
        if not _call([*entry, "-set", value, *file], log, cwd=run.folder, env=environment):
            return False
    return _call(["./Allrun", "--np", str(run.threads)], log, cwd=run.folder, env=environment)


def _run_particle(run: Run, log) -> bool:
    settings = [word for setting in run.set for word in ("--set", setting)]
    # The BLAS has threads of its own, which would not heed --threads.
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": str(run.threads)}
    return _call([str(BUILD / "bin/surge-particle"), "run", str(run.case), "--out", str(run.folder),
                  "--threads", str(run.threads), *settings], log, env=environment)


def execute(study: Study, name: str, digest: str) -> bool:
    """Makes one run from scratch; the stamp is the last thing that is written."""
    run = next(r for r in study.runs if r.name == name)
    if run.digest() != digest:
        raise StudyError(f"{name}: its inputs changed after the study was started; start it again")
    shutil.rmtree(run.folder, ignore_errors=True)
    run.log.parent.mkdir(exist_ok=True)
    started = time.monotonic()
    _say(f"{name}: started, log {run.log}")
    with open(run.log, "w", encoding="utf-8") as log:
        ran = (_run_foam if run.program == "interFoam" else _run_particle)(run, log)
    seconds = time.monotonic() - started
    if not ran or not finished(run.folder):
        _show_failure(name, run.log, seconds)
        return False
    _write_stamp(run.stamp(), run.inputs())
    _say(f"{name}: finished in {seconds:.1f} s")
    return True


def report(study: Study) -> bool:
    """Lets surge-compare measure the runs; what it prints is kept as report/summary.txt."""
    log = RUNS / "report.log"
    started = time.monotonic()
    shutil.rmtree(REPORT, ignore_errors=True)
    REPORT.mkdir()
    _say(f"report: started, log {log}")
    command = [str(BUILD / "bin/surge-compare"), "report", "--study", str(study.path),
               "--runs", str(RUNS), "--out", str(REPORT)]
    with open(log, "w", encoding="utf-8") as errors:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=errors, text=True, check=False)
    seconds = time.monotonic() - started
    if done.returncode != 0:
        _show_failure("report", log, seconds)
        return False
    (REPORT / "summary.txt").write_text(done.stdout, encoding="utf-8")
    _write_stamp(study.report_stamp(), study.inputs())
    _say(f"report: finished in {seconds:.1f} s")
    return True


def _show_failure(name: str, log: Path, seconds: float) -> None:
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    _say(f"{name}: FAILED after {seconds:.1f} s; the last lines of {log}:")
    print("\n".join("    " + line for line in lines[-LOG_LINES:]), flush=True)


def plan(study: Study, force: bool) -> None:
    """Prints, line by line, what an Allrun would do now."""
    width = max(len(run.name) for run in study.runs)
    for run in study.runs:
        state = run.state()
        todo = force or state != "up to date"
        print(f"  {run.name:<{width}}  {'run ' if todo else 'keep'}  {'forced' if force else state}")
    state = "forced" if force else study.report_state()
    print(f"  {'report':<{width}}  {'keep' if state == 'up to date' else 'make'}  {state}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", choices=["plan", "run", "report"])
    parser.add_argument("study", type=Path)
    parser.add_argument("name", nargs="?", help="of the run")
    parser.add_argument("digest", nargs="?", help="of its inputs, as the scheduler saw them")
    parser.add_argument("--force", action="store_true", help="plan: as if nothing were up to date")
    options = parser.parse_args()
    try:
        study = load(options.study)
        if options.task == "plan":
            plan(study, options.force)
            return 0
        done = report(study) if options.task == "report" else execute(study, options.name, options.digest)
        return 0 if done else 1
    except StudyError as error:
        print(error, file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
