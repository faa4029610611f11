"""Both methods for a few hundredths of a second with either neighbour search, and their fronts.

Short enough for the sanitizers. Usage: short_run.py BUILD_FOLDER
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
BIN = Path(sys.argv.pop(1)).resolve() / "bin"
CASE = SOURCE / "particle/cases/dam_break.toml"


def call(*command):
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}")
    return done.stdout


class ShortRun(unittest.TestCase):
    def run_and_measure(self, method, search, threads):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "run"
            call(BIN / "surge-particle", "run", CASE, "--out", out, "--threads", threads,
                 "--set", f"method.name={method}", "--set", "resolution.spacing=0.0145",
                 "--set", f"search.neighbours={search}", "--set", "time.end=0.05")
            manifest = json.loads((out / "manifest.json").read_text())
            self.assertIs(manifest["finished"], True)
            self.assertEqual(manifest["fluid_particles"], 200)
            self.assertEqual((manifest["lost_particles"], manifest["nonfinite"]), (0, 0))
            call(BIN / "surge-compare", "front", out, "--strip-height", "0.0435",
                 "--out", Path(folder) / "front.csv")
            with open(Path(folder) / "front.csv", newline="", encoding="utf-8") as file:
                lines = [line for line in file if not line.startswith("#")]
            return [float(row["Z_over_L"]) for row in csv.DictReader(lines)]

    def test_the_column_starts_to_collapse(self):
        for method in ("mps", "sph"):
            with self.subTest(method):
                front = self.run_and_measure(method, "cell_grid", 2)
                self.assertAlmostEqual(front[0], 1.0, places=6)
                # free fall of the front under g would be 0.085 L in 0.05 s
                self.assertGreater(front[-1], 1.01)
                self.assertLess(front[-1], 1.2)

    def test_either_search_gives_the_same_front(self):
        for method in ("mps", "sph"):
            with self.subTest(method):
                cells = self.run_and_measure(method, "cell_grid", 1)
                pairs = self.run_and_measure(method, "all_pairs", 1)
                self.assertEqual(len(cells), len(pairs))
                for a, b in zip(cells, pairs):
                    self.assertAlmostEqual(a, b, places=4)


def simpson(y, width):
    """y(0), ... at an even number of equal steps that make up the width."""
    weights = [1] + [4 if k % 2 else 2 for k in range(1, len(y) - 1)] + [1]
    return sum(w * v for w, v in zip(weights, y)) * width / (len(y) - 1) / 3


class Figures(unittest.TestCase):
    """Figs. 1 to 5 hold what the solvers compute with, from the program to the picture."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = Path(cls.temporary.name)
        runs = ""
        for method in ("mps", "sph"):
            call(BIN / "surge-particle", "run", CASE, "--out", cls.folder / "runs" / method,
                 "--set", f"method.name={method}", "--set", "resolution.spacing=0.0145",
                 "--set", "time.end=0.02")
            runs += (f'[[run]]\nname = "{method}"\nprogram = "surge-particle"\ncase = "{CASE}"\n'
                     f'set = ["method.name={method}", "resolution.spacing=0.0145", "time.end=0.02"]\n')
        (cls.folder / "study.toml").write_text(
            'title = "Short"\nreference = "mps"\nstrip_height = 0.0435\n'
            "snapshot_times = [0.01, 0.02]\npublished = []\n" + runs)

    def figure(self, number):
        call(BIN / "surge-compare", "figure", number, "--study", self.folder / "study.toml",
             "--runs", self.folder / "runs", "--out", self.folder)
        for ending in ("svg", "pdf"):
            self.assertGreater((self.folder / f"fig{number}.{ending}").stat().st_size, 1000)
        with open(self.folder / f"fig{number}.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_weight_function(self):
        rows = [row for row in self.figure(1) if row["function"] == "w"]
        for row in rows:
            r, w = float(row["r_over_l0"]), float(row["w"])
            self.assertAlmostEqual(w, max(2.1 / r - 1, 0), places=9)
        r_w = [2.1] + [float(row["r_over_l0"]) * float(row["w"]) for row in rows[:200]]
        self.assertAlmostEqual(2 * math.pi * simpson(r_w, 2.1), math.pi * 2.1**2, places=9)

    def test_kernel_integrates_to_one(self):
        rows = self.figure(4)[:201]
        r_w = [float(row["r_over_h"]) * float(row["W_times_h2"]) for row in rows]
        self.assertAlmostEqual(2 * math.pi * simpson(r_w, 3), 1, places=6)
        r2_slope = [float(row["r_over_h"])**2 * float(row["dW_dr_times_h3"]) for row in rows]
        self.assertAlmostEqual(2 * math.pi * simpson(r2_slope, 3), -2, places=6)

    def test_flowcharts_name_the_functions_of_the_step(self):
        for number, names in ((3, ("solve_pressure", "correct")), (5, ("apply_continuity", "drift"))):
            rows = self.figure(number)
            svg = (self.folder / f"fig{number}.svg").read_text(encoding="utf-8")
            functions = [row["function"] for row in rows]
            for name in names:
                self.assertIn(name, functions)
            for row in rows:
                self.assertIn(row["function"] + "()", svg)
                self.assertIn(row["does"], svg)

    def test_interaction_domain(self):
        rings = [float(row["ring"]) for row in self.figure(2)]
        self.assertEqual(rings.count(0), 1)
        self.assertGreater(rings.count(1), 7)


if __name__ == "__main__":
    unittest.main()
