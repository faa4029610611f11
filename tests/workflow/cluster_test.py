"""A small study through a real Slurm, by the profile compare/studies/slurm.

Usage: cluster_test.py BUILD_FOLDER [TEST...]; 77 where Slurm or OpenFOAM is not there, with the reason.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

from slurm import NODES, NoSlurm, Slurm

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/study"))
from project import make_project  # noqa: E402

BUILD = Path(sys.argv.pop(1)).resolve()
PROFILE = ("--profile", "compare/studies/slurm")
STUDY = """title = "Small"
reference = "vof"
strip_height = 0.087
snapshot_times = [0.1]
published = []

[defaults]
case = "particle/cases/dam_break.toml"

[[run]]
name = "mps"
program = "surge-particle"
set = ["method.name=mps", "resolution.spacing=0.003625", "time.end=0.2"]
threads = 1

[[run]]
name = "sph"
program = "surge-particle"
set = ["method.name=sph", "resolution.spacing=0.0145", "time.end=0.2"]
threads = 2

[[run]]
name = "vof"
program = "interFoam"
set = ["foam.cellsPerL=10", "time.end=0.2"]
threads = 1
"""


def run(root, *command, **environment):
    return subprocess.run(command, cwd=root, env={**os.environ, **environment}, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def fresh_project(name):
    root = make_project(BUILD, name)
    for folder in ("runs", "report", ".snakemake"):
        shutil.rmtree(root / folder, ignore_errors=True)
    study = root / "small.toml"
    study.write_text(STUDY)
    return root


def results(root):
    """All that the report's numbers say but for times and what was built when."""
    metrics = json.loads((root / "report/metrics.json").read_text(encoding="utf-8"))
    return {key: metrics[key] for key in ("front", "patterns", "observables", "wall_pressure") if key in metrics}


class Cluster(unittest.TestCase):
    """One study through Slurm, with a job that is killed; each test looks at a part of what came of it."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="surgefront-slurm-")
        cls.addClassCleanup(folder.cleanup)
        cls.slurm = Slurm(Path(folder.name))
        cls.addClassCleanup(cls.slurm.stop)
        cls.root = fresh_project("slurm")
        cls.killed, cls.ended = [], threading.Event()
        killer = threading.Thread(target=cls.kill, daemon=True)
        killer.start()
        cls.done = run(cls.root, "/usr/bin/snakemake", *PROFILE, "--config", "study=small.toml",
                       CI="true", **cls.slurm.environment)  # it then looks after its jobs every second
        cls.ended.set()
        killer.join()
        told = cls.slurm.command("scontrol", "--oneliner", "show", "job").splitlines()
        cls.jobs = [dict(re.findall(r"(\w+)=(\S*)", line)) for line in told]

    @classmethod
    def kill(cls):
        """Kills the job of `mps` once it computes: seconds of work are then still before it."""
        while not cls.killed and not cls.ended.wait(0.05):
            cls.killed = cls.slurm.command("squeue", "--noheader", "--name=mps", "--states=RUNNING",
                                           "--format=%i").split()[:1]
        while not list(cls.root.glob("runs/mps/frames/*")) and not cls.ended.wait(0.02):
            pass
        cls.slurm.command("scancel", *cls.killed)

    def test_it_is_finished_and_its_report_is_that_of_a_run_without_slurm(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.slurm.logs())
        local = fresh_project("slurm-local")
        done = run(local, "./Allrun", "--no-install", "--no-build", "--study", "small.toml")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(set(results(local)["front"]), {"mps", "sph", "vof"})
        self.assertEqual(results(self.root), results(local))

    def test_each_job_asks_for_the_threads_and_the_memory_of_its_run(self):
        asked = {job["JobName"]: (int(job["NumCPUs"]), int(job["MinMemoryNode"].removesuffix("M")))
                 for job in self.jobs if job["JobState"] == "COMPLETED"}
        self.assertEqual({name: cpus for name, (cpus, _) in asked.items()},
                         {"mps": 1, "sph": 2, "vof": 1, "report": 1})
        # 25 % more than the program expects, and 300 MiB; interFoam: 140 MB and 1700 bytes for each of 3600 cells
        self.assertEqual(asked["vof"][1], 300 + -(-1.25 * 146.12e6 / 2**20 // 1))
        self.assertGreater(asked["mps"][1], 2 * 300)  # repeated, with twice the memory
        self.assertLess(asked["sph"][1], 400)

    def test_a_job_that_was_killed_is_repeated(self):
        states = sorted((job["JobState"], job["JobId"] in self.killed) for job in self.jobs
                        if job["JobName"] == "mps")
        self.assertEqual(states, [("CANCELLED", True), ("COMPLETED", False)])

    def test_both_nodes_were_at_work(self):
        self.assertEqual({job["NodeList"] for job in self.jobs}, set(NODES))

    def test_nothing_is_left_to_do(self):
        done = run(self.root, "/usr/bin/snakemake", *PROFILE, "--config", "study=small.toml",
                   **self.slurm.environment)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("Nothing to be done", done.stdout)

    def test_status_when_the_controller_has_forgotten_the_job(self):
        status = SOURCE / "compare/studies/slurm/status"
        with tempfile.TemporaryDirectory() as folder:
            ended = Path(folder, ".snakemake/slurm")
            ended.mkdir(parents=True)
            for code, word in (("0\n", "success"), ("1\n", "failed"), ("", "failed"), (None, "failed")):
                if code is not None:
                    (ended / "99999.ended").write_text(code)
                else:
                    (ended / "99999.ended").unlink()
                self.assertEqual(run(folder, status, "99999", **self.slurm.environment).stdout, word + "\n")
            away = {**self.slurm.environment, "SLURM_CONF": "/nowhere"}
            self.assertEqual(run(folder, status, "99999", **away).stdout, "running\n")


class Sweep(unittest.TestCase):
    def test_a_thousand_runs_are_planned(self):
        root = fresh_project("slurm-sweep")
        sweep = ('name = "mps-{n}"\nset = ["method.name=mps", "time.end={end}"]\ntimed = false\n'
                 f"sweep = {{n = {list(range(1000))}, end = {[0.1 + 1e-4 * n for n in range(1000)]}}}\n")
        head, _, rest = STUDY.partition('name = "mps"\n')
        program, rest = rest.split("threads = 1\n", 1)
        (root / "sweep.toml").write_text(head + sweep + program.splitlines()[0] + "\n" + rest)
        started = time.monotonic()
        done = run(root, "/usr/bin/snakemake", *PROFILE, "--dry-run", "--quiet", "--config", "study=sweep.toml")
        seconds = time.monotonic() - started
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"(?m)^run +1002 ")
        self.assertFalse((root / "runs").exists())
        print(f"dry run of 1002 runs: {seconds:.1f} s", file=sys.stderr)


if __name__ == "__main__":
    if not shutil.which("interFoam"):
        print("skipped: no OpenFOAM")
        sys.exit(77)
    try:
        with tempfile.TemporaryDirectory(prefix="surgefront-slurm-") as place:
            Slurm(Path(place)).stop()
    except NoSlurm as reason:
        print(f"skipped: Slurm cannot be started here: {reason}")
        sys.exit(77)
    unittest.main()
