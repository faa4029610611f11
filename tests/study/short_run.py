"""Both methods for a few hundredths of a second with either neighbour search, and their fronts.

Short enough for the sanitizers. Usage: short_run.py BUILD_FOLDER
"""

import csv
import json
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


if __name__ == "__main__":
    unittest.main()
