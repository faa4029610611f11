"""A small study of real programs in a folder of its own, and what is done to it in the fault campaign."""

import json
import os
import random
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
SEED = 20100503
LONGEST_S = 1200  # for one ./Allrun, on a loaded machine

STUDY = """title = "Campaign"
reference = "vof"
strip_height = 0.0435
snapshot_times = [0.1]
published = ["martin_moyce_1952_2.25in"]

[[run]]
name = "mps"
program = "surge-particle"
case = "particle/cases/dam_break.toml"
set = ["method.name=mps", "resolution.spacing=0.0145", "time.end=0.2", "output.interval=0.02",
       "output.checkpoint=0.2"]
timed = false

[[run]]
name = "sph"
program = "surge-particle"
case = "particle/cases/dam_break.toml"
set = ["method.name=sph", "resolution.spacing=0.0145", "time.end=0.2", "output.interval=0.02",
       "output.checkpoint=0.2"]
timed = false
{foam}
"""
FOAM = """
[[run]]
name = "vof"
program = "interFoam"
case = "foam_cases/damBreak2D"
set = ["cellsPerL=10", "wall=slip", "endTime=0.2"]
timed = false
"""
# What a computer's mood decides: seconds, when, what of a kill was made good by a restart.
MOOD = re.compile(r"wall|cpu|timing|cost|second|started|pareto|scaling|commit|restart|setup_s|solve_s|"
                  r"particle_steps|rate|output_thread|duration|version")


def steady(value):
    """A value of metrics.json without what differs from one execution to the next."""
    if isinstance(value, dict):
        return {key: steady(inner) for key, inner in value.items() if not MOOD.search(key)}
    if isinstance(value, list):
        return [steady(inner) for inner in value]
    return value


class Campaign(unittest.TestCase):
    """Tries and survivals are counted and printed by each test."""

    BUILD: Path

    @classmethod
    def setUpClass(cls):
        cls.outside = Path(tempfile.mkdtemp(prefix="surge_faults_"))
        cls.addClassCleanup(shutil.rmtree, cls.outside, ignore_errors=True)
        cls.root = cls.outside / "project;&(é)$HOME"  # a name that a shell would take apart
        (cls.root / "build").mkdir(parents=True)
        for name in ("Allrun", ".ci", "compare", "particle", "foam_cases"):
            (cls.root / name).symlink_to(SOURCE / name)
        (cls.root / "build/release").symlink_to(cls.BUILD)
        cls.has_foam = shutil.which("interFoam") is not None
        study = STUDY.replace("{foam}", FOAM if cls.has_foam else "")
        if not cls.has_foam:
            study = study.replace('reference = "vof"', 'reference = "sph"')
        (cls.root / "tiny.toml").write_text(study, encoding="utf-8")
        done = cls.allrun()
        if done.returncode != 0:
            raise AssertionError("the study without faults failed:\n" + done.stdout)
        cls.expected = cls.metrics()
        cls.clean = cls.outside / "clean"
        cls.clean.mkdir()
        cls.keep(cls.root, cls.clean)

    def setUp(self):
        self.random = random.Random(f"{SEED} {self.id()}")
        self.restore()

    @classmethod
    def keep(cls, source: Path, target: Path):
        for name in ("runs", "report", ".snakemake"):
            shutil.rmtree(target / name, ignore_errors=True)
            if (source / name).exists():
                shutil.copytree(source / name, target / name, symlinks=True)  # times of files, too

    def restore(self):
        """The finished study again."""
        self.keep(self.clean, self.root)

    def forget(self):
        """No study yet."""
        for name in ("runs", "report", ".snakemake"):
            shutil.rmtree(self.root / name, ignore_errors=True)

    @classmethod
    def command(cls):
        return ["./Allrun", "--no-install", "--no-build", "--study", "tiny.toml", "--jobs", "2"]

    @classmethod
    def allrun(cls, prepare=None, **environment):
        return subprocess.run(cls.command(), cwd=cls.root, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False, timeout=LONGEST_S,
                              stdin=subprocess.DEVNULL, preexec_fn=prepare,
                              env={**os.environ, "OMP_WAIT_POLICY": "passive", **environment})

    def start(self):
        return subprocess.Popen(self.command(), cwd=self.root, text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                start_new_session=True,
                                env={**os.environ, "OMP_WAIT_POLICY": "passive"})

    @classmethod
    def metrics(cls):
        return steady(json.loads((cls.root / "report/metrics.json").read_text(encoding="utf-8")))

    def processes(self, words=("",)):
        """Those that work in this project with one of the words in their command lines."""
        found = []
        for process in Path("/proc").glob("[0-9]*"):
            try:
                inside = Path(os.readlink(process / "cwd")).is_relative_to(self.root)
                command = (process / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            except OSError:
                continue  # it has ended, or is not ours
            if inside and any(word in command for word in words):
                found.append(int(process.name))
        return found

    def kill(self, pids):
        killed = 0
        for pid in pids:
            try:
                os.kill(pid, signal.SIGKILL)
                killed += 1
            except ProcessLookupError:
                pass
        return killed

    def wait_until_quiet(self):
        """What a killed workflow left at work comes to its end by itself."""
        deadline = time.monotonic() + LONGEST_S
        while self.processes():
            self.assertLess(time.monotonic(), deadline, "something goes on for ever")
            time.sleep(0.1)

    def refuse_tracebacks(self, text: str):
        self.assertNotIn("Traceback", text)
        self.assertNotIn("terminate called", text)

    def expect_same(self, what: str):
        """./Allrun now ends, with the metrics of the undisturbed study."""
        done = self.allrun()
        self.assertEqual(done.returncode, 0, f"{what}:\n{done.stdout}")
        self.refuse_tracebacks(done.stdout)
        found = self.metrics()
        if found != self.expected:
            self.fail(f"{what}: other metrics: {difference(self.expected, found)}")


def difference(expected, found, place="metrics") -> str:
    """The first place where two documents differ."""
    if isinstance(expected, dict) and isinstance(found, dict):
        for key in sorted(expected.keys() | found.keys()):
            if expected.get(key) != found.get(key):
                return difference(expected.get(key), found.get(key), f"{place}.{key}")
    if isinstance(expected, list) and isinstance(found, list) and len(expected) == len(found):
        for number, (one, other) in enumerate(zip(expected, found)):
            if one != other:
                return difference(one, other, f"{place}.{number}")
    return f"{place}: {str(found)[:200]} found, {str(expected)[:200]} expected"
