"""What a study is made of, and which of its runs are up to date. Standard library only.

A run counts as done when its folder holds a stamp `.finished-<digest>`, where the digest is taken
from everything that decides about the result: case file, preset, overrides, threads and the
program's own code (its object files without those that carry the commit and the texts of the
presets, so that a commit which touches other things repeats nothing). Times of files play no part.
"""

import functools
import hashlib
import json
import os
import re
import shutil
import subprocess
import tomllib
from dataclasses import dataclass, replace
from pathlib import Path

BUILD = Path("build/release")
PRESETS = Path("particle/cases/presets")
REFERENCE = Path("compare/reference")
RUNS = Path("runs")
REPORT = Path("report")
# The commit; the presets, looked at one by one; the text of the sources, of which comments are a part.
NO_CODE = ("version.cpp.o", "preset_files.cpp.o", "source_hash.cpp.o")
RUN_KEYS = ("name", "program", "case", "set", "threads", "timed", "may_break", "role", "group",
            "repeats")
# What a run is made for. Those after the first two say in `group` what they belong to.
ROLES = ("comparison", "timing", "sensitivity", "convergence", "verification")

# What a foam case leaves behind when it is run in place; the rest is the case.
FOAM_OUTPUT = re.compile(
    r"log\..*|processor.*|postProcessing|dynamicCode|VTK|.*\.foam|manifest\.json|\.steps"
    r"|[0-9]+(\.[0-9]+)?(e-?[0-9]+)?"
)


# What may be set in a dictionary of OpenFOAM, where ; ends an entry and # and $ start directives.
FOAM_SETTING = re.compile(r"[A-Za-z]\w*=[\w.+\- ()]+", re.ASCII)


class StudyError(Exception):
    """A mistake in a study, told in one line."""


@dataclass(frozen=True)
class Run:
    """One [[run]] table of a study, or several that agree in all but role and group."""

    name: str
    program: str
    case: Path
    set: tuple[str, ...]
    threads: int
    timed: bool  # alone on the machine
    may_break: bool  # an end before its time is a result, as of the bare equations that break up
    role: str = "comparison"  # the first of several

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
            presets = _presets(self.case, self.set)
            inputs["preset"] = _digest(*[p.name + _canonical(p) for p in presets])
            inputs["program"] = _program_digest("surge-particle")
        return inputs

    def digest(self) -> str:
        return _digest(json.dumps(self.inputs(), sort_keys=True))[:16]

    def stamp(self) -> Path:
        return self.folder / f".finished-{self.digest()}"

    def state(self) -> str:
        """`up to date`, or why the run has to be made."""
        self._withdraw_broken_stamps()
        if self.stamp().exists():
            return "up to date"
        stamps = list(self.folder.glob(".finished-*"))
        if not stamps:
            tried = self.log.exists() or self.folder.exists()
            return "failed or stopped last time" if tried else "not there yet"
        return f"changed: {_changes(stamps[0], self.inputs())}"


    def complete(self) -> bool:
        """Whether the program left a manifest that says that it came to its end."""
        try:
            manifest = json.loads((self.folder / "manifest.json").read_text(encoding="utf-8"))
            return manifest["finished"] is True or self.may_break and manifest["finished"] is False
        except (OSError, ValueError, KeyError, TypeError):
            return False

    def _withdraw_broken_stamps(self) -> None:
        """A stamp vouches for the folder as it was then: not if somebody wrote there since."""
        manifest = self.folder / "manifest.json"
        for stamp in self.folder.glob(".finished-*"):
            if not self.complete() or manifest.stat().st_mtime > stamp.stat().st_mtime:
                stamp.unlink()


@dataclass(frozen=True)
class Study:
    """A study file, as far as the workflow is concerned."""

    path: Path
    files: tuple[Path, ...]  # itself and what it includes
    runs: tuple[Run, ...]

    def inputs(self) -> dict[str, str]:
        """What decides about the report, besides the runs' own results."""
        return {
            "study": _digest(*[_canonical(file) for file in self.files]),
            "runs": _digest(*[run.digest() for run in self.runs]),
            "reference": _digest(*_files(sorted(REFERENCE.glob("*.csv")))),
            "program": _program_digest("surge-compare"),
        }

    def report_stamp(self) -> Path:
        return REPORT / f".finished-{_digest(json.dumps(self.inputs(), sort_keys=True))[:16]}"

    def report_state(self) -> str:
        stamp = self.report_stamp()
        if any(run.state() != "up to date" for run in self.runs):
            return "follows the runs"
        newest = max(run.stamp().stat().st_mtime for run in self.runs)
        if stamp.exists():
            return "up to date" if stamp.stat().st_mtime >= newest else "older than a run"
        stamps = list(REPORT.glob(".finished-*"))
        return f"changed: {_changes(stamps[0], self.inputs())}" if stamps else "not there yet"


# --- reading a study -----------------------------------------------------------------------------


def load(path: Path) -> Study:
    """Reads and checks the [[run]] tables; the rest of the study is surge-compare's to check."""
    path = Path(path)
    files: dict[Path, Path] = {}  # as they are, as they were named
    runs: dict[str, Run] = {}
    _add_file(path, files, runs)
    if not runs:
        raise StudyError(f"{path}: run: found no [[run]] table, expected at least one")
    return Study(path, tuple(files.values()), tuple(runs.values()))


def _add_file(path: Path, files: dict[Path, Path], runs: dict[str, Run]) -> None:
    """Adds the runs of the files that a study includes, then its own; no file counts twice."""
    if path.resolve() in files:
        return
    files[path.resolve()] = path
    try:
        text = path.read_text(encoding="utf-8")
        document = tomllib.loads(text)
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise StudyError(f"{path}: {error}") from error
    included = document.get("include", [])
    where = _lines(text, r"include\s*=") or [1]
    if not isinstance(included, list) or not all(isinstance(name, str) for name in included):
        raise StudyError(f"{path}:{where[0]}: include: found {included!r}, expected a list of studies")
    for name in included:
        if not (path.parent / name).is_file():
            raise StudyError(f"{path}:{where[0]}: include: found '{name}', "
                             "expected a study, named relative to this file")
        _add_file(Path(os.path.normpath(path.parent / name)), files, runs)
    tables = document.get("run", [])
    lines = _lines(text, r"\[\[\s*run\s*\]\]")
    if not isinstance(tables, list) or len(lines) != len(tables):
        raise StudyError(f"{path}: run: found something else, expected [[run]] tables")
    for table, line in zip(tables, lines):
        for run in _repeats(table, f"{path}:{line}"):
            known = runs.setdefault(run.name, run)
            if replace(known, role=run.role, timed=run.timed) != run:
                raise StudyError(f"{path}:{line}: name: found '{run.name}' a second time, "
                                 "for another computation")
            runs[run.name] = replace(known, timed=known.timed or run.timed)


def _lines(text: str, pattern: str) -> list[int]:
    return [n for n, line in enumerate(text.splitlines(), 1) if re.match(r"\s*" + pattern, line)]


def _repeats(table: dict, where: str) -> list[Run]:
    """The run, and its repetitions, which differ from it in the name only."""
    run = _run(table, where)
    count = table.get("repeats", 1)
    if type(count) is not int or not 1 <= count <= 99:
        raise StudyError(f"{where}: repeats: found {count!r}, expected a whole number from 1 to 99")
    return [run] + [replace(run, name=f"{run.name}-repeat{k}") for k in range(2, count + 1)]


def _run(table: dict, where: str) -> Run:
    def value(key, check, expected, default=None):
        found = table.get(key, default)
        if found is None or not check(found):
            shown = "nothing" if found is None else repr(found)
            raise StudyError(f"{where}: {key}: found {shown}, expected {expected}")
        return found

    for key in table:
        if key not in RUN_KEYS:
            expected = ", ".join(RUN_KEYS)
            raise StudyError(f"{where}: {key}: found an unknown key, expected one of {expected}")
    program = value("program", ("surge-particle", "interFoam").__contains__,
                    "'surge-particle' or 'interFoam'")
    role = value("role", ROLES.__contains__, f"one of {', '.join(ROLES)}", ROLES[0])
    belongs = value("group", lambda found: isinstance(found, str), "a text", "")
    if not belongs and role not in ROLES[:2]:
        raise StudyError(f"{where}: group: found nothing, expected what a run of role {role} belongs to")
    if program == "interFoam":
        for setting in table.get("set", []):
            if isinstance(setting, str) and "=" in setting and not FOAM_SETTING.fullmatch(setting):
                raise StudyError(f"{where}: set: found {setting!r}, expected 'name=value' of letters, "
                                 "digits, blanks and . + - ( ) _, which a dictionary takes as it is")
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
        may_break=value("may_break", lambda t: type(t) is bool, "true or false", False),
        role=role,
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
    text = path.read_text(encoding="utf-8")
    try:
        return json.dumps(tomllib.loads(text), sort_keys=True, default=str)
    except tomllib.TOMLDecodeError:
        return text  # the program will say what is wrong with it


def _presets(case: Path, settings: tuple[str, ...]) -> list[Path]:
    """The preset that a run uses and those that it extends; all of them where that is not clear."""
    everything = sorted(PRESETS.glob("*.toml"))
    try:
        method = dict(tomllib.loads(case.read_text(encoding="utf-8")).get("method", {}))
        for setting in settings:
            key, value = setting.split("=", 1)
            if key in ("method.name", "method.preset"):
                method[key.removeprefix("method.")] = value.strip("\"'")
        chain = [PRESETS / f"{method['name']}-{method['preset']}.toml"]
        while base := tomllib.loads(chain[-1].read_text(encoding="utf-8")).get("extends"):
            chain.append(PRESETS / f"{method['name']}-{base}.toml")
            if chain[-1] in chain[:-1]:
                return everything
        return chain
    except (OSError, ValueError, KeyError, AttributeError):
        return everything


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
    partial.write_text(json.dumps(inputs, indent=1) + "\n")
    partial.rename(stamp)


def _changes(stamp: Path, inputs: dict[str, str]) -> str:
    try:
        before = json.loads(stamp.read_text())
    except ValueError:
        before = {}
    return ", ".join(key for key in inputs if before.get(key) != inputs[key]) or "unknown"
