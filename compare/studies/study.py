"""Which runs of a study are up to date. Standard library only.

A study is read by `surge-compare study`, which also says what each of its runs is to compute. A run
counts as done when its folder holds a stamp `.finished-<digest>`, where the digest is taken from
everything that decides about the result: the case and the method as the program understands them,
threads, and the program's own code (its object files without those that carry the commit and the
texts of the presets, so that a commit which touches other things repeats nothing). Times of files
play no part.
"""

import functools
import hashlib
import json
import math
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

BUILD = Path("build/release")
PROGRAMS = BUILD / "bin"
RUNS = Path("runs")
REPORT = Path(os.environ.get("SURGE_REPORT", "report"))  # of the catalogue, each study has its own
# The commit; the presets are part of a run's case; the text of the sources, of which comments are a part.
NO_CODE = ("version.cpp.o", "preset_files.cpp.o", "source_hash.cpp.o")

# Of memory, MiB: the scripts around a run; the report; a run of which nothing is known; as foam_cases/size.cpp
# has them, a process of interFoam and a million cells.
SCRIPTS_MB, REPORT_MB, UNKNOWN_MB, FOAM_PROCESS_MB, FOAM_CELLS_MB = 300, 4000, 4000, 140, 1700
MEMORY_MARGIN = 1.25  # what is expected of a run is a guess

FILES = "files"  # in a stamp: names and sizes of all that lies beside it

# What a foam case leaves behind when it is run in place; the rest is the case.
FOAM_OUTPUT = re.compile(
    r"log\..*|processor.*|postProcessing|dynamicCode|VTK|.*\.foam|manifest\.json|\.steps"
    r"|[0-9]+(\.[0-9]+)?(e-?[0-9]+)?"
)


class StudyError(Exception):
    """A mistake in a study, told in one line."""


class NotBuilt(StudyError):
    """The program that reads studies is not there yet."""


@dataclass(frozen=True)
class Run:
    """One run of a study, in all of its roles."""

    name: str
    program: str
    case: Path  # case file, or folder of a foam case; of program = "files" where those are
    settings: tuple[str, ...]
    threads: int
    timed: bool  # alone on the machine
    may_break: bool  # an end before its time is a result, as of the bare equations that break up
    roles: tuple[str, ...]
    resolved: dict  # as `surge-compare study` tells what is to be computed

    @property
    def folder(self) -> Path:
        return RUNS / self.name

    @property
    def log(self) -> Path:
        return RUNS / f"{self.name}.log"

    @property
    def computed(self) -> bool:
        """Whether it is ours to compute, and not the files of another program."""
        return self.program != "files"

    @property
    def made_from_case_file(self) -> bool:
        return self.case.suffix == ".toml"

    def inputs(self) -> dict[str, str]:
        """Everything that decides about the result, under the name that a person knows it by."""
        if not self.computed:
            return {"files": _digest(*_listing(self.case))}
        inputs = {"threads": str(self.threads)}
        if self.program == "surge-particle":
            case = dict(self.resolved["case"])
            inputs["method"] = _digest(_text([case.pop("method", None), case.pop("search", None)]))
            inputs["case"] = _digest(_text(case))
            inputs["program"] = _program_digest("surge-particle")
        elif self.made_from_case_file:
            inputs["settings"] = _digest(_text([s for s in self.settings if s.startswith("foam.")]))
            inputs["case"] = _digest(_text(self.resolved["case"]))
            inputs["program"] = _digest(_program_digest("surge-foam"), *_files([_which("interFoam")]))
        else:
            inputs["settings"] = _digest(_text(self.settings))
            inputs["case"] = _digest(*_tree(self.case))
            inputs["program"] = _digest(*_files([_which("interFoam")]))
        return inputs

    def digest(self) -> str:
        return _digest(json.dumps(self.inputs(), sort_keys=True))[:16]

    def stamp(self) -> Path:
        return self.folder / f".finished-{self.digest()}"

    def state(self) -> str:
        """`up to date`, or why the run has to be made."""
        if not self.computed:
            return "up to date"
        self._withdraw_broken_stamps()
        if self.stamp().exists():
            return "up to date"
        stamps = list(self.folder.glob(".finished-*"))
        if not stamps:
            tried = self.log.exists() or self.folder.exists()
            return "failed or stopped last time" if tried else "not there yet"
        return f"changed: {_changes(stamps[0], self.inputs())}"

    def memory_mb(self) -> int:
        """What a job that makes this run asks a scheduler for, MiB."""
        try:
            if self.program == "surge-particle":
                expected = self.resolved["size"]["memory_bytes"] / 2**20
            elif self.made_from_case_file:
                expected = self.resolved["size"]["memory_bytes"] / 2**20 + FOAM_PROCESS_MB * (self.threads - 1)
            else:
                cells = 36 * self.resolved["parameters"]["cellsPerL"] ** 2
                expected = FOAM_PROCESS_MB * self.threads + FOAM_CELLS_MB * cells / 1e6
        except (KeyError, TypeError):
            print(f"{self.name}: how much memory it takes is not known, {UNKNOWN_MB} MB are asked for",
                  file=sys.stderr)
            return UNKNOWN_MB
        return math.ceil(MEMORY_MARGIN * expected) + SCRIPTS_MB

    def complete(self) -> bool:
        """Whether the program left a manifest that says that it came to its end."""
        try:
            manifest = json.loads((self.folder / "manifest.json").read_text(encoding="utf-8"))
            finished = manifest["finished"] is True and manifest.get("steps", 1) > 0
            return finished or self.may_break and manifest["finished"] is False
        except (OSError, ValueError, KeyError, TypeError):
            return False

    def _withdraw_broken_stamps(self) -> None:
        """A stamp vouches for the folder as it was then: not if somebody wrote there since."""
        for stamp in self.folder.glob(".finished-*"):
            if not self.complete() or not _intact(stamp):
                stamp.unlink()


@dataclass(frozen=True)
class Study:
    """A study, as far as the workflow is concerned."""

    path: Path
    head: dict  # all that is said besides the runs
    runs: tuple[Run, ...]
    notices: tuple[str, ...] = ()  # what is known before a run is made and a user should know

    @property
    def computed(self) -> tuple[Run, ...]:
        return tuple(run for run in self.runs if run.computed)

    def inputs(self) -> dict[str, str]:
        """What decides about the report, besides the runs' own results."""
        series = [Path(entry["file"]) for entry in self.head["published"]]
        said = [self.head["said"], [(run.name, run.roles) for run in self.runs]]
        return {
            "study": _digest(_text(said)),
            "runs": _digest(*[run.digest() for run in self.runs]),
            "reference": _digest(*_files(series)),
            "program": _program_digest("surge-compare"),
        }

    def report_stamp(self) -> Path:
        return REPORT / f".finished-{_digest(json.dumps(self.inputs(), sort_keys=True))[:16]}"

    def report_state(self) -> str:
        stamp = self.report_stamp()
        if any(run.state() != "up to date" for run in self.runs):
            return "follows the runs"
        newest = max((run.stamp().stat().st_mtime for run in self.computed), default=0.0)
        if stamp.exists() and not _intact(stamp):
            stamp.unlink()
            return "its files were changed or cut since"
        if stamp.exists():
            return "up to date" if stamp.stat().st_mtime >= newest else "older than a run"
        stamps = list(REPORT.glob(".finished-*"))
        return f"changed: {_changes(stamps[0], self.inputs())}" if stamps else "not there yet"


# --- reading a study -----------------------------------------------------------------------------


def load(path: Path, only: str = "") -> Study:
    """The study as `surge-compare study` tells it, which reads and checks it; `only` one of its runs."""
    program = PROGRAMS / "surge-compare"
    command = [str(program), "study", str(path), "--json", "-", "--programs", str(PROGRAMS)]
    if only:
        command.append(f"--only={only}")
    try:
        told = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        raise NotBuilt(f"{program}: not there yet, and it reads the studies; ./Allrun builds it") from None
    if told.returncode != 0:
        lines = told.stderr.strip().splitlines() or [f"{program}: it ended by itself ({told.returncode})"]
        raise StudyError("\n".join(lines).removeprefix("surge-compare: "))
    document = json.loads(told.stdout)
    runs = tuple(_run(entry) for entry in document.pop("runs"))
    notices = tuple(document.pop("notices"))
    said = {key: document[key] for key in document if key not in ("files", "published")}
    said["published"] = [entry["name"] for entry in document["published"]]
    return Study(Path(path), {"said": said, "published": document["published"]}, runs, notices)


def _run(entry: dict) -> Run:
    return Run(name=entry["name"], program=entry["program"], case=Path(entry["case"]),
               settings=tuple(entry["settings"]), threads=entry["threads"], timed=entry["timed"],
               may_break=entry["may_break"], resolved=entry["resolved"] or {},
               roles=tuple(f"{role['role']} {role['group']}" for role in entry["roles"]))


# --- digests -------------------------------------------------------------------------------------


def _digest(*parts: str | bytes) -> str:
    total = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        total.update(len(data).to_bytes(8, "big") + data)
    return total.hexdigest()


def _text(value) -> str:
    return json.dumps(value, sort_keys=True)


def _files(paths) -> list[bytes]:
    """Names and contents of files, to be digested."""
    return [part for path in paths if path for part in (path.name.encode(), path.read_bytes())]


def _listing(source: Path) -> list[str]:
    """Names, sizes and times of another program's files: too large to be read for this."""
    if "*" in source.name:
        found = sorted(source.parent.glob(source.name))
    else:
        found = sorted(source.rglob("*")) if source.is_dir() else [source]
    return [f"{path} {path.stat().st_size} {path.stat().st_mtime_ns}" for path in found if path.is_file()]


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
    """Of the object files that a program is linked from, but for those that hold no code."""
    try:
        objects = subprocess.run(["ninja", "-C", str(BUILD), "-t", "inputs", f"bin/{program}"],
                                 capture_output=True, text=True, check=False).stdout.split()
    except FileNotFoundError:  # a dry run comes before the packages
        return "not built"
    found = sorted(BUILD / o for o in objects if o.endswith(".o"))
    found = [path for path in found if path.name not in NO_CODE and path.is_file()]
    return _digest(*_files(found)) if found else "not built"


# --- stamps --------------------------------------------------------------------------------------


def write_stamp(stamp: Path, inputs: dict[str, str]) -> None:
    for old in stamp.parent.glob(".finished-*"):
        old.unlink()
    partial = stamp.with_name(".finishing")
    partial.unlink(missing_ok=True)
    partial.write_text(json.dumps(inputs | {FILES: _sizes(stamp.parent)}, indent=1) + "\n")
    partial.rename(stamp)


def _sizes(folder: Path) -> dict[str, int]:
    return {str(path.relative_to(folder)): path.stat().st_size
            for path in sorted(folder.rglob("*"))
            if path.is_file() and not path.name.startswith(".")}


def _intact(stamp: Path) -> bool:
    """Whether the files beside a stamp are those that it was made for: all there, of the same size,
    and none written to since. What was added to them does no harm."""
    try:
        inputs = json.loads(stamp.read_text(encoding="utf-8"))
        made = stamp.stat().st_mtime
        if FILES not in inputs:  # a stamp of an earlier version
            manifest = stamp.parent / "manifest.json"
            return not manifest.exists() or manifest.stat().st_mtime <= made
        files = inputs[FILES]
        found = {name: (stamp.parent / name).stat() for name in files}
        return all(found[name].st_size == size and found[name].st_mtime <= made
                   for name, size in files.items())
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return False


def _changes(stamp: Path, inputs: dict[str, str]) -> str:
    try:
        before = json.loads(stamp.read_text())
    except ValueError:
        before = {}
    return ", ".join(key for key in inputs if before.get(key) != inputs[key]) or "unknown"
