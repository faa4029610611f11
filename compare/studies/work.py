"""Does one piece of a study's work: `plan` (print what is to be done), `run`, `report`.

The Snakefile beside this file calls it; it can be called by hand from the root of the repository.
"""

import argparse
import contextlib
import fcntl
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import estimate
from study import (PROGRAMS, REPORT, RUNS, NotBuilt, Run, Study, StudyError, foam_files, load,
                   write_stamp)

LOG_LINES = 15  # of a failed run's log are shown
CHECKPOINT = "checkpoint.bin"  # in the folder of a particle run that was stopped
NO_RESTART = 3  # surge-particle's status where it cannot go on from that
NOTHING_TO_DO = 4  # our own status after a plan: all is up to date
FAILED = Path(".snakemake/failed.txt")  # what failed since the plan was made, a line each
FULL = 1 << 20  # bytes: with less left, a failure is the disk's


def _say(text: str) -> None:
    print(f"{time.strftime('%H:%M:%S')} {text}", flush=True)


def _call(command: list[str], log, **options) -> int:
    log.write("+ " + shlex.join(command) + "\n")
    log.flush()
    return subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                          check=False, **options).returncode


def _copy_foam_case(run: Run, folder: Path) -> None:
    for file in foam_files(run.case):
        target = folder / file.relative_to(run.case)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(file, target)


def _make_foam_case(run: Run, folder: Path, log, environment: dict) -> int:
    """The case of a run in a folder: made from a case file, or a copy of a folder in which the
    entries of the one included dictionary are set."""
    if run.made_from_case_file:
        words = []
        for setting in run.settings:
            foam = setting.startswith("foam.")
            words += ["--foam", setting.removeprefix("foam.")] if foam else ["--set", setting]
        return _call([str(PROGRAMS / "surge-foam"), "make", str(run.case), "--out", str(folder),
                      *words], log)
    _copy_foam_case(run, folder)
    for setting in run.settings:
        key, value = setting.split("=", 1)
        entry = ["foamDictionary", "-disableFunctionEntries", "-entry", key]
        file = ["system/caseParameters"]
        # -set would add an entry that is not there, and a misspelt one would go unnoticed
        if _call([*entry, "-value", *file], log, cwd=folder, env=environment):
            log.write(f"system/caseParameters: {key}: found no such entry\n")
            return 1
        if status := _call([*entry, "-set", value, *file], log, cwd=folder, env=environment):
            return status
    return 0


def _run_foam(run: Run, log) -> int:
    with _foam_folder(run) as folder:
        # All that Debian's OpenFOAM needs in the environment; it believes PWD, which must be right.
        environment = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ, "PWD": str(folder.absolute())}
        if status := _make_foam_case(run, folder, log, environment):
            return status
        return _call(["./Allrun", "--np", str(run.threads)], log, cwd=folder, env=environment)


@contextlib.contextmanager
def _foam_folder(run: Run):
    """The folder of a run; another one that is moved there in the end where OpenFOAM could not work,
    which takes blanks and quotes out of the names of folders."""
    if not re.search(r"[\s'\"]", str(run.folder.resolve())):
        yield run.folder
        return
    with tempfile.TemporaryDirectory(prefix="surgefront-") as place:
        try:
            yield Path(place, "case")
        finally:
            if Path(place, "case").exists():
                shutil.move(Path(place, "case"), run.folder)


def _run_particle(run: Run, log) -> int:
    settings = [word for setting in run.settings for word in ("--set", setting)]
    # The BLAS has threads of its own, which would not heed --threads.
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": str(run.threads)}
    command = [str(PROGRAMS / "surge-particle"), "run", str(run.case), "--out", str(run.folder),
               "--threads", str(run.threads), *settings]
    if (run.folder / CHECKPOINT).is_file():
        _say(f"{run.name}: goes on from its checkpoint")
        status = _call([*command, "--restart"], log, env=environment)
        if status != NO_RESTART:
            return status
        _say(f"{run.name}: its checkpoint is of other inputs or damaged: from the beginning")
        _remove(run.folder)
    return _call(command, log, env=environment)


def execute(study: Study, name: str, digest: str) -> bool:
    """Makes one run, from its checkpoint or from scratch; the stamp is the last thing written."""
    run = next(r for r in study.runs if r.name == name)
    if run.digest() != digest:
        raise StudyError(f"{name}: its inputs changed after the start of the study; start it again")
    run.log.parent.mkdir(exist_ok=True)
    with open(run.log, "a", encoding="utf-8") as log:
        # The program inherits its log, and with it the lock: held for as long as it is at work.
        try:
            fcntl.flock(log, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise StudyError(f"{name}: a program of an earlier study is still at work in "
                             f"{run.folder}; wait for it or end it") from None
        log.truncate(0)
        if run.program == "interFoam" or not (run.folder / CHECKPOINT).is_file():
            _remove(run.folder)
        _say(f"{name}: started, log {run.log}")
        started = time.monotonic()
        status = (_run_foam if run.program == "interFoam" else _run_particle)(run, log)
    seconds = time.monotonic() - started
    broke = run.may_break and status == 1  # not where a signal ended it
    if status != 0 and not broke or not run.complete():
        _show_failure(name, run.log, seconds, status)
        return False
    write_stamp(run.stamp(), run.inputs())
    _say(f"{name}: {'broke up after' if status else 'finished in'} {seconds:.1f} s{estimate.left(name)}")
    return True


def _remove(folder: Path) -> None:
    """Removes the folder of an earlier run; a link is taken away, and what it leads to is not."""
    if folder.is_symlink() or folder.is_file():
        folder.unlink()
    elif folder.exists():
        shutil.rmtree(folder)


def report(study: Study) -> bool:
    """Lets surge-compare measure the runs. The old report stays until the new one is whole."""
    log = RUNS / "report.log"
    log.parent.mkdir(exist_ok=True)
    started = time.monotonic()
    _say(f"report: started, log {log}")
    command = [str(PROGRAMS / "surge-compare"), "report", "--study", str(study.path),
               "--runs", str(RUNS), "--out", str(REPORT), "--programs", str(PROGRAMS)]
    with open(log, "w", encoding="utf-8") as errors:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=errors, text=True, check=False)
    seconds = time.monotonic() - started
    if done.returncode != 0:
        _show_failure("report", log, seconds, done.returncode)
        return False
    write_stamp(study.report_stamp(), study.inputs())
    _say(f"report: finished in {seconds:.1f} s")
    return True


def _show_failure(name: str, log: Path, seconds: float, status: int) -> None:
    """Shows the end of a log, and leaves the cause in a line to whoever started the study."""
    lines = [line for line in log.read_text(encoding="utf-8", errors="replace").splitlines() if line]
    _say(f"{name}: FAILED after {seconds:.1f} s; the last lines of {log}:")
    print("\n".join("    " + line for line in lines[-LOG_LINES:]), flush=True)
    cause = next((line for line in reversed(lines) if not line.startswith("+ ")), "")
    if status < 0:
        cause = f"ended by signal {-status}, {signal.strsignal(-status)}"
    if shutil.disk_usage(log.parent).free < FULL:
        cause = f"the disk that {log.parent} lies on is full" + (f": {cause}" if cause else "")
    _keep_cause(f"{name}: {cause or 'it ended without a word'} (log {log})")


def _keep_cause(text: str) -> None:
    try:
        FAILED.parent.mkdir(exist_ok=True)
        with open(FAILED, "a", encoding="utf-8") as file:
            file.write(text + "\n")
    except OSError:
        pass  # it was printed, too


def plan(study: Study, force: bool, cores: int, keep: bool) -> bool:
    """Prints, line by line, what an Allrun would do now, and how long that will take. Returns
    whether there is anything to do."""
    width = max(len(run.name) for run in study.runs)
    to_make = []
    for run in study.runs:
        state = run.state()
        if run.computed and (force or state != "up to date"):
            to_make.append(run)
        word = "read" if not run.computed else "run " if run in to_make else "keep"
        print(f"  {run.name:<{width}}  {word}  {'forced' if force and run in to_make else state}")
    state = "forced" if force else study.report_state()
    print(f"  {'report':<{width}}  {'keep' if state == 'up to date' else 'make'}  {state}", flush=True)
    for notice in study.notices:
        print(f"notice: {notice}", flush=True)
    _check_disk(to_make)
    found = estimate.estimate(to_make)
    if keep:
        FAILED.unlink(missing_ok=True)
        estimate.keep(found, to_make, cores)
    if state != "up to date":
        print(f"estimate: {_duration(study, to_make, found, cores)}", flush=True)
    return bool(to_make) or state != "up to date"


def _bytes(number: float) -> str:
    """"1.5 GB"; decimal units, as the programs print them."""
    for unit in ("B", "kB", "MB"):
        if number < 999.5:
            return f"{number:.3g} {unit}"
        number /= 1000
    return f"{number:.1f} GB"


def _check_disk(to_make: list[Run]) -> None:
    """Refuses a plan whose particle runs will not find room; what foam runs take is not known."""
    needed = sum(run.resolved.get("size", {}).get("disk_bytes", 0.0) for run in to_make)
    free = shutil.disk_usage(RUNS if RUNS.exists() else ".").free
    if needed > free:
        raise StudyError(f"{RUNS}: no space for the runs: found {_bytes(free)} free on its disk, expected "
                         f"room for the {_bytes(needed)} that they will take")


def _duration(study: Study, to_make: list[Run], found: estimate.Estimate, cores: int) -> str:
    """"about 12 min on 2 cores (3 of 5 runs as long as last time, the others by calibration)"."""
    unknown = sum(found.seconds[run.name] is None for run in to_make)
    if to_make and unknown == len(to_make):
        return "not possible before the programs are built"
    fronts = sum(any(not role.startswith("timing") for role in run.roles) for run in study.runs)
    seconds = found.total(to_make, cores) + estimate.REPORT_S + fronts * estimate.REPORT_RUN_S
    text = f"about {estimate.words(seconds)} on {cores} {'core' if cores == 1 else 'cores'}"
    if not to_make:
        return text
    text += (f" ({found.from_last_time} of {len(to_make)} runs as long as last time, "
             "the others by a calibration of this machine)")
    return text + (f", without {unknown} of which nothing is known" if unknown else "")


def _do(options: argparse.Namespace) -> int:
    """The exit status."""
    study = load(options.study, options.name if options.task == "run" else "")
    if options.task == "plan":
        anything = plan(study, options.force, options.cores, options.keep)
        return 0 if anything or options.dry else NOTHING_TO_DO
    if options.task == "report":
        return 0 if report(study) else 1
    return 0 if execute(study, options.name, options.digest) else 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", choices=["plan", "run", "report"])
    parser.add_argument("study", type=Path)
    parser.add_argument("name", nargs="?", help="of the run")
    parser.add_argument("digest", nargs="?", help="of its inputs, as the scheduler saw them")
    parser.add_argument("--force", action="store_true", help="plan: as if nothing were up to date")
    parser.add_argument("--cores", type=int, default=os.cpu_count() or 1, help="plan: that are used")
    parser.add_argument("--keep", action="store_true", help="plan: for the runs to tell what is left")
    parser.add_argument("--dry", action="store_true", help="plan: before the programs are built, say so")
    options = parser.parse_args()
    try:
        return _do(options)
    except NotBuilt as error:
        print(f"runs: {error}", file=sys.stdout if options.dry else sys.stderr)
        return 0 if options.dry else 1
    except OSError as error:
        cause = f"{error.filename or options.study}: {error.strerror or error}"
    except StudyError as error:
        cause = str(error)
    # what the engine's jobs print to stderr ends up in the engine's own log
    print(cause, file=sys.stderr if options.task == "plan" else sys.stdout, flush=True)
    if options.task != "plan":
        _keep_cause(cause)
    return 1


if __name__ == "__main__":
    sys.exit(main())
