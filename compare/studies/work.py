"""Does one piece of a study's work: `plan` (print what is to be done), `run`, `report`.

The Snakefile beside this file calls it; it can be called by hand from the root of the repository.
"""

import argparse
import fcntl
import os
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path

import estimate
from study import BUILD, REPORT, RUNS, Run, Study, StudyError, foam_files, load, write_stamp

LOG_LINES = 15  # of a failed run's log are shown
CHECKPOINT = "checkpoint.bin"  # in the folder of a particle run that was stopped
NO_RESTART = 3  # surge-particle's status where it cannot go on from that


def _say(text: str) -> None:
    print(f"{time.strftime('%H:%M:%S')} {text}", flush=True)


def _call(command: list[str], log, **options) -> int:
    log.write("+ " + shlex.join(command) + "\n")
    log.flush()
    return subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                          check=False, **options).returncode


def _copy_foam_case(run: Run) -> None:
    for file in foam_files(run.case):
        target = run.folder / file.relative_to(run.case)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(file, target)


def _run_foam(run: Run, log) -> int:
    """Copies the case, sets the entries of its one included dictionary, and runs it there."""
    # All that Debian's OpenFOAM needs in the environment.
    environment = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ}
    _copy_foam_case(run)
    for setting in run.set:
        key, value = setting.split("=", 1)
        entry = ["foamDictionary", "-disableFunctionEntries", "-entry", key]
        file = ["system/caseParameters"]
        # -set would add an entry that is not there, and a misspelt one would go unnoticed
        if _call([*entry, "-value", *file], log, cwd=run.folder, env=environment):
            log.write(f"system/caseParameters: {key}: found no such entry\n")
            return 1
        if status := _call([*entry, "-set", value, *file], log, cwd=run.folder, env=environment):
            return status
    return _call(["./Allrun", "--np", str(run.threads)], log, cwd=run.folder, env=environment)


def _run_particle(run: Run, log) -> int:
    settings = [word for setting in run.set for word in ("--set", setting)]
    # The BLAS has threads of its own, which would not heed --threads.
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": str(run.threads)}
    command = [str(BUILD / "bin/surge-particle"), "run", str(run.case), "--out", str(run.folder),
               "--threads", str(run.threads), *settings]
    if (run.folder / CHECKPOINT).is_file():
        _say(f"{run.name}: goes on from its checkpoint")
        status = _call([*command, "--restart"], log, env=environment)
        if status != NO_RESTART:
            return status
        _say(f"{run.name}: its checkpoint is of other inputs or damaged: from the beginning")
        shutil.rmtree(run.folder)
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
            shutil.rmtree(run.folder, ignore_errors=True)
        _say(f"{name}: started, log {run.log}")
        started = time.monotonic()
        status = (_run_foam if run.program == "interFoam" else _run_particle)(run, log)
    seconds = time.monotonic() - started
    broke = run.may_break and status == 1  # not where a signal ended it
    if status != 0 and not broke or not run.complete():
        _show_failure(name, run.log, seconds)
        return False
    write_stamp(run.stamp(), run.inputs())
    _say(f"{name}: {'broke up after' if status else 'finished in'} {seconds:.1f} s"
         f"{estimate.left(study, name)}")
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
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=errors, text=True, check=False)
    seconds = time.monotonic() - started
    if done.returncode != 0:
        _show_failure("report", log, seconds)
        return False
    (REPORT / "summary.txt").write_text(done.stdout, encoding="utf-8")
    write_stamp(study.report_stamp(), study.inputs())
    _say(f"report: finished in {seconds:.1f} s")
    return True


def _show_failure(name: str, log: Path, seconds: float) -> None:
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    _say(f"{name}: FAILED after {seconds:.1f} s; the last lines of {log}:")
    print("\n".join("    " + line for line in lines[-LOG_LINES:]), flush=True)


def plan(study: Study, force: bool, cores: int, keep: bool) -> None:
    """Prints, line by line, what an Allrun would do now, and how long that will take."""
    width = max(len(run.name) for run in study.runs)
    to_make = []
    for run in study.runs:
        state = run.state()
        if force or state != "up to date":
            to_make.append(run)
        print(f"  {run.name:<{width}}  {'keep' if run not in to_make else 'run '}"
              f"  {'forced' if force else state}")
    state = "forced" if force else study.report_state()
    print(f"  {'report':<{width}}  {'keep' if state == 'up to date' else 'make'}  {state}", flush=True)
    found = estimate.estimate(to_make)
    if keep:
        estimate.keep(found, cores)
    if state != "up to date":
        print(f"estimate: {_duration(study, to_make, found, cores)}", flush=True)


def _duration(study: Study, to_make: list[Run], found: estimate.Estimate, cores: int) -> str:
    """"about 12 min on 2 cores (3 of 5 runs as long as last time, the others by calibration)"."""
    unknown = sum(found.seconds[run.name] is None for run in to_make)
    if to_make and unknown == len(to_make):
        return "not possible before the programs are built"
    fronts = sum(run.role != "timing" for run in study.runs)
    seconds = found.total(to_make, cores) + estimate.REPORT_S + fronts * estimate.REPORT_RUN_S
    text = f"about {estimate.words(seconds)} on {cores} {'core' if cores == 1 else 'cores'}"
    if not to_make:
        return text
    text += (f" ({found.from_last_time} of {len(to_make)} runs as long as last time, "
             "the others by a calibration of this machine)")
    return text + (f", without {unknown} of which nothing is known" if unknown else "")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", choices=["plan", "run", "report"])
    parser.add_argument("study", type=Path)
    parser.add_argument("name", nargs="?", help="of the run")
    parser.add_argument("digest", nargs="?", help="of its inputs, as the scheduler saw them")
    parser.add_argument("--force", action="store_true", help="plan: as if nothing were up to date")
    parser.add_argument("--cores", type=int, default=os.cpu_count() or 1, help="plan: that are used")
    parser.add_argument("--keep", action="store_true", help="plan: for the runs to tell what is left")
    options = parser.parse_args()
    try:
        study = load(options.study)
        if options.task == "plan":
            plan(study, options.force, options.cores, options.keep)
            return 0
        if options.task == "report":
            return 0 if report(study) else 1
        return 0 if execute(study, options.name, options.digest) else 1
    except StudyError as error:
        # what the engine's jobs print to stderr ends up in the engine's own log
        print(error, file=sys.stderr if options.task == "plan" else sys.stdout, flush=True)
        return 1


if __name__ == "__main__":
    sys.exit(main())
