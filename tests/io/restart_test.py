"""Kills runs of surge-particle at seeded moments and takes them up again: nothing may show.

    restart_test.py BUILD [RUNS]    RUNS: how many runs of how many; without it a few
"""

import csv
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv.pop(1)).resolve() / "bin/surge-particle"
RUNS = int(sys.argv.pop(1)) if len(sys.argv) > 1 else 2
SEED = 20100503
FRAMES = 20
REFUSED = 3
INTERRUPTED = 130

CASE = """
title = "Collapse"
dimension = {dimension}
[fluid]
density = 1000.0
gravity = [0.0, -9.81{z0}]
[tank]
lower = [0.0, 0.0{z0}]
upper = [0.2, 0.2{z1}]
open = ["y+"]
[[block]]
shape = "box"
lower = [0.0, 0.0{z0}]
upper = [0.06, 0.12{z1}]
[[obstacle]]
lower = [0.12, 0.0{z0}]
upper = [0.2, 0.04{z1}]
[[probe]]
name = "foot"
position = [0.12, 0.01{zm}]
[resolution]
spacing = {spacing}
[time]
end = {end}
[output]
interval = {interval}
[method]
name = "{method}"
preset = "{preset}"
"""


def presets() -> list[tuple[str, str]]:
    """Every preset of every method, as the program lists them."""
    told = subprocess.run([str(PROGRAM), "list"], capture_output=True, text=True, check=True).stdout
    table = told.split("Presets:\n", 1)[1].split("\n\n", 1)[0]
    return [tuple(line.split()[0].split("-", 1)) for line in table.splitlines()]


def write_case(file: Path, method: str, preset: str, dimension: int) -> None:
    space = dimension == 3
    end = 0.1
    file.write_text(CASE.format(
        dimension=dimension, method=method, preset=preset, spacing=0.02 if space else 0.01,
        end=end, interval=end / FRAMES, z0=", 0.0" if space else "", z1=", 0.06" if space else "",
        zm=", 0.03" if space else ""), encoding="utf-8")


def start(*arguments) -> subprocess.Popen:
    # Threads that wait must not spin: tests run side by side.
    return subprocess.Popen([str(PROGRAM), "run", *map(str, arguments)], stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True,
                            env={**os.environ, "OMP_WAIT_POLICY": "passive"})


def run(*arguments) -> tuple[int, str]:
    process = start(*arguments)
    text = process.communicate()[0]
    return process.returncode, text


def frames_of(folder: Path) -> int:
    """That are on the disk now, by the collection."""
    try:
        return (folder / "particles.pvd").read_text(encoding="utf-8").count("<DataSet")
    except FileNotFoundError:
        return 0


def kill_at(process: subprocess.Popen, folder: Path, frames: int, how: signal.Signals,
            wait_s: float) -> str:
    """Once so many frames are there, and a moment later. What the program said."""
    while process.poll() is None and frames_of(folder) < frames:
        time.sleep(0.002)
    time.sleep(wait_s)
    process.send_signal(how)
    return process.communicate()[0]


def results(folder: Path) -> dict:
    """All that a run leaves but times of the clock and where it was taken up."""
    rows = list(csv.reader((folder / "steps.csv").read_text(encoding="utf-8").splitlines()))
    timings = [rows[0].index(name) for name in ("ppe_setup_s", "ppe_solve_s")]
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    for key in ("started", "wall_s", "cpu_s", "output_thread_s", "restarts"):
        del manifest[key]
    for key in ("setup_s", "solve_s"):
        manifest.get("ppe", {}).pop(key, None)
    del manifest["case"]["output"]["checkpoint"]
    return {
        "files": sorted(str(file.relative_to(folder)) for file in folder.rglob("*")),
        "frames": [file.read_bytes() for file in sorted((folder / "frames").iterdir())],
        "collection": (folder / "particles.pvd").read_text(encoding="utf-8"),
        "rows": [[cell for k, cell in enumerate(row) if k not in timings] for row in rows],
        "manifest": manifest,
    }


class Restart(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="surge_restart_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.case = self.folder / "case.toml"

    def expect_same(self, whole: Path, resumed: Path) -> None:
        expected, found = results(whole), results(resumed)
        for key, value in expected.items():
            self.assertTrue(value == found[key], f"{key} differ: {resumed}")

    def kill_and_resume(self, method: str, preset: str, dimension: int, threads: int,
                        rng: random.Random) -> list[str]:
        """A run that is killed and stopped, each at a seeded moment; says by which signals it was."""
        write_case(self.case, method, preset, dimension)
        whole, resumed = self.folder / "whole", self.folder / "resumed"
        for folder in (whole, resumed):
            shutil.rmtree(folder, ignore_errors=True)
        self.assertEqual(run(self.case, "--out", whole, "--threads", threads)[0], 0)
        arguments = [self.case, "--out", resumed, "--threads", threads, "--set",
                     "output.checkpoint=1e-9"]
        hits = []
        moments = sorted(rng.sample(range(2, FRAMES), 2))  # the first frame is there before any step
        for frames, how in zip(moments, rng.sample([signal.SIGKILL, signal.SIGTERM], 2)):
            taken_up = ["--restart"] if hits else []
            process = start(*arguments, *taken_up)
            said = kill_at(process, resumed, frames, how, rng.uniform(0.0, 0.01))
            if process.returncode == 0:
                return hits  # it was faster; what was there before has been taken up
            hits.append(how.name)
            expected = INTERRUPTED if how == signal.SIGTERM else -signal.SIGKILL
            self.assertEqual(process.returncode, expected, said)
            self.assertTrue((resumed / "checkpoint.bin").is_file())
            manifest = json.loads((resumed / "manifest.json").read_text(encoding="utf-8"))
            self.assertFalse(manifest["finished"])
        status, said = run(*arguments, "--restart")
        self.assertEqual(status, 0, said)
        self.expect_same(whole, resumed)
        manifest = json.loads((resumed / "manifest.json").read_text(encoding="utf-8"))
        steps = [restart["step"] for restart in manifest["restarts"]]
        self.assertTrue(0 < len(steps) <= len(hits) and steps == sorted(steps), manifest["restarts"])
        self.assertEqual({restart["threads"] for restart in manifest["restarts"]}, {threads})
        return hits

    def test_killed_runs_go_on_as_if_nothing_had_been(self):
        rng = random.Random(SEED)
        kinds = [(*preset, dimension, threads) for preset in presets() for dimension in (2, 3)
                 for threads in (1, 2)]
        hits = []
        for k in range(RUNS):
            kind = kinds[k % len(kinds)] if RUNS >= len(kinds) else rng.choice(kinds)
            with self.subTest(kind):
                hits += self.kill_and_resume(*kind, rng)
        killed, stopped = hits.count("SIGKILL"), hits.count("SIGTERM")
        print(f"{RUNS} runs, {killed} killed, {stopped} stopped, all taken up", flush=True)
        self.assertGreater(len(hits), 0)

    def start_stopped_run(self, method: str = "sph", preset: str = "paper") -> Path:
        """An interrupted run."""
        write_case(self.case, method, preset, 2)
        folder = self.folder / "run"
        process = start(self.case, "--out", folder)
        said = kill_at(process, folder, 2, signal.SIGINT, 0.0)
        self.assertEqual(process.returncode, INTERRUPTED, said)
        self.assertIn("with --restart it goes on from here", said)
        return folder

    def expect_refused(self, folder: Path, text: str, *more) -> None:
        before = {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}
        status, said = run(self.case, "--out", folder, "--restart", *more)
        self.assertEqual(status, REFUSED, said)
        self.assertIn(text, said)
        self.assertEqual(1, said.count("\n"), said)
        self.assertEqual(before, {f: f.read_bytes() for f in folder.rglob("*") if f.is_file()})

    def test_what_cannot_be_taken_up_is_refused_and_left_alone(self):
        folder = self.start_stopped_run()
        self.expect_refused(folder, "fluid.density = 1000.0, expected 998.0", "--set",
                            "fluid.density=998")
        self.expect_refused(folder, 'method.name = "sph", expected "mps"', "--set", "method.name=mps")
        status, said = run(self.case, "--out", folder)
        self.assertEqual(status, 1)
        self.assertIn("--restart goes on with it from its checkpoint, --force replaces it", said)

        frame = folder / "frames/frame_00001.vtp"
        kept = frame.read_bytes()
        frame.unlink()
        self.expect_refused(folder, "frame_00001.vtp: found no such frame")
        frame.write_bytes(kept)
        steps = folder / "steps.csv"
        kept = steps.read_bytes()
        steps.write_bytes(kept[:len(kept) // 2])
        self.expect_refused(folder, "rows, expected the")
        steps.write_bytes(kept)
        checkpoint = folder / "checkpoint.bin"
        kept = checkpoint.read_bytes()
        checkpoint.write_bytes(kept[:-100])
        self.expect_refused(folder, "checkpoint.bin: found a checksum")
        checkpoint.write_bytes(kept)
        status, said = run(self.case, "--out", folder, "--restart")
        self.assertEqual(status, 0, said)
        self.expect_refused(folder, "checkpoint.bin: found no checkpoint")

    def test_a_place_without_a_run_is_left_alone(self):
        write_case(self.case, "sph", "paper", 2)
        status, said = run(self.case, "--out", self.folder / "new", "--restart")
        self.assertEqual(status, REFUSED, said)
        self.assertFalse((self.folder / "new").exists())
        status, said = run(self.case, "--out", self.folder / "new", "--restart", "--force")
        self.assertEqual(status, 1, said)

    def test_the_case_in_the_folder_is_enough(self):
        folder = self.start_stopped_run("mps", "improved")
        whole = self.folder / "whole"
        self.assertEqual(run(self.case, "--out", whole)[0], 0)
        status, said = run(folder / "case.toml", "--out", folder, "--restart")
        self.assertEqual(status, 0, said)
        self.expect_same(whole, folder)

    def test_a_stop_before_the_first_step_takes_none(self):
        """A set-up that is long: many particles, and probes whose surroundings are measured in 3D."""
        write_case(self.case, "sph", "delta-plus", 3)
        probes = "".join(f'[[probe]]\nname = "p{k}"\nposition = [0.1, 0.1, 0.03]\n' for k in range(1000))
        with open(self.case, "a", encoding="utf-8") as file:
            file.write(probes)
        folder = self.folder / "run"
        process = start(self.case, "--out", folder, "--set", "resolution.spacing=0.002")
        while process.poll() is None and not (folder / "manifest.json").exists():
            time.sleep(0.001)
        process.send_signal(signal.SIGTERM)
        said = process.communicate()[0]
        self.assertEqual(process.returncode, -signal.SIGTERM, said)
        self.assertEqual(frames_of(folder), 0)
        self.assertFalse((folder / "steps.csv").exists())
        # and nothing was lost that would have to be asked for
        write_case(self.case, "sph", "delta-plus", 2)
        self.assertEqual(run(self.case, "--out", folder)[0], 0)


if __name__ == "__main__":
    sys.exit(unittest.main())
