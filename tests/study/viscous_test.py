"""The viscous dam break, with walls that the water sticks to: all three programs compute the same case.

Usage: viscous_test.py BUILD_FOLDER; 77 without OpenFOAM.
"""

import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
BIN = Path(sys.argv.pop(1)).resolve() / "bin"
# Debian's OpenFOAM finds itself by this.
os.environ.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
VISCOSITY = 5e-3  # m2/s: a layer of sqrt(nu t) = 22 mm in 0.1 s, two spacings of these coarse runs
NAMES = ("mps", "sph", "vof")


def call(*command, cwd=SOURCE):
    return subprocess.run([str(word) for word in command], cwd=cwd, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)


def compute(folder, viscosity, wall):
    """The coarse dam break until 0.1 s by all three methods."""
    for method in NAMES[:2]:
        done = call(BIN / "surge-particle", "run", "particle/cases/dam_break.toml", "--out", folder / method,
                    "--set", f"method.name={method}", "--set", "resolution.spacing=0.0145",
                    "--set", "time.end=0.1", "--set", f"fluid.kinematic_viscosity={viscosity}",
                    "--set", f"tank.wall={wall}")
        assert done.returncode == 0, done.stdout
    shutil.copytree(SOURCE / "foam_cases/damBreak2D", folder / "vof")
    for key, value in {"cellsPerL": 10, "endTime": 0.1, "nuWater": viscosity,
                       "wall": {"slip": "slip", "no-slip": "noSlip"}[wall]}.items():
        call("foamDictionary", "system/caseParameters", "-entry", key, "-set", value, cwd=folder / "vof")
    done = call("./Allrun", cwd=folder / "vof")
    assert done.returncode == 0, done.stdout


def compare(first, second, out):
    return call(BIN / "surge-compare", "metrics", first, "--reference", second, "--strip-height", "0.0435",
                "--out", out)


class Viscous(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        compute(cls.folder / "viscous", VISCOSITY, "no-slip")
        compute(cls.folder / "inviscid", 0, "slip")

    def last_front(self, kind, name):
        out = self.folder / f"{kind}-{name}.csv"
        done = call(BIN / "surge-compare", "front", self.folder / kind / name, "--strip-height", "0.0435",
                    "--out", out)
        self.assertEqual(done.returncode, 0, done.stdout)
        with open(out, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertAlmostEqual(float(rows[-1]["time_s"]), 0.1, places=6)
        return float(rows[-1]["Z_over_L"])

    def test_all_manifests_state_the_same_physics(self):
        for name in NAMES:
            case = json.loads((self.folder / "viscous" / name / "manifest.json").read_text())["case"]
            with self.subTest(name):
                self.assertEqual(case["fluid"]["kinematic_viscosity"], VISCOSITY)
                self.assertEqual(case["tank"]["wall"], "no-slip")

    def test_runs_of_the_same_physics_are_compared(self):
        for name in NAMES[:2]:
            out = self.folder / f"{name}.json"
            done = compare(self.folder / "viscous" / name, self.folder / "viscous/vof", out)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertLess(json.loads(out.read_text())["front"][name]["rms_vs_vof"], 0.15)

    def test_another_viscosity_or_wall_is_refused(self):
        for name in NAMES[:2]:
            done = compare(self.folder / "viscous" / name, self.folder / "inviscid/vof",
                           self.folder / "none.json")
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(f"viscosity: 0.005 m2/s in {name}, 0 m2/s in vof", done.stdout)
            self.assertIn(f"wall: no-slip in {name}, slip in vof", done.stdout)

    def test_viscosity_and_walls_hold_the_water_back(self):
        for name in NAMES:
            with self.subTest(name):
                free, held = self.last_front("inviscid", name), self.last_front("viscous", name)
                print(f"{name}: Z/L at 0.1 s {free:.3f} inviscid, {held:.3f} viscous")
                self.assertLess(held, free - 0.02)
                self.assertGreater(held, 1.05)


if __name__ == "__main__":
    if shutil.which("interFoam") is None:
        print("skipped: interFoam not found")
        sys.exit(77)
    unittest.main()
