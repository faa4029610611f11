"""Three programs' files in three formats beside a run of ours and VOF: one command, one report.

Usage: foreign_study_test.py BUILD_FOLDER; 77 without OpenFOAM.
"""

import csv
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from foreign_files import INTERVAL, front, write_dualsphysics, write_lammps, write_openmps
from project import make_project

BUILD = Path(sys.argv.pop(1))
FRAMES = 11  # to 0.1 s
FACTS = 'spacing = 0.0145\ngravity = 9.81\ntank_width = 0.58\ntank_height = 2.32\ndensity = 1000\n'
STUDY = f"""title = "Others' files"
reference = "vof"
strip_height = 0.0435
snapshot_times = [0.05, 0.1]
published = []

[[run]]
name = "openmps"
program = "files"
source = "openmps"
map = "facts.toml"
[run.read]
time-step = {INTERVAL}

[[run]]
name = "dualsphysics"
program = "files"
source = "dual_out"
[run.read]
tank-width = 0.58
tank-height = 2.32
density = 1000

[[run]]
name = "lammps"
program = "files"
source = "lammps/dump.lammpstrj"
map = "facts.toml"
[run.read]
fluid-type = 1

[[run]]
name = "ours"
program = "surge-particle"
case = "particle/cases/dam_break.toml"
set = ["method.preset=improved", "resolution.spacing=0.0145", "time.end=0.1", "output.interval=0.01"]

[[run]]
name = "vof"
program = "interFoam"
case = "particle/cases/dam_break.toml"
set = ["time.end=0.1", "output.interval=0.01", "foam.cellsPerL=10"]
"""
FOREIGN = ("openmps", "dualsphysics", "lammps")


class ForeignStudy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = make_project(BUILD, "foreign")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        write_openmps(cls.folder / "openmps", FRAMES)
        write_dualsphysics(cls.folder / "dual_out", FRAMES)
        write_lammps(cls.folder / "lammps", FRAMES)
        (cls.folder / "facts.toml").write_text(FACTS)
        (cls.folder / "study.toml").write_text(STUDY)
        cls.done = subprocess.run(
            ["./Allrun", "--study", cls.folder / "study.toml", "--no-install", "--no-build"], cwd=cls.root,
            text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)

    def setUp(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout)

    def metrics(self):
        return json.loads((self.root / "report/metrics.json").read_text(encoding="utf-8"))

    def test_each_has_the_front_that_was_written(self):
        fronts = self.metrics()["front"]
        first = fronts["openmps"]
        for name in (*FOREIGN, "ours"):
            with self.subTest(name):
                self.assertGreater(fronts[name]["rms_vs_vof"], 0)
        for name in FOREIGN:
            with self.subTest(name):
                self.assertAlmostEqual(fronts[name]["rms_vs_vof"], first["rms_vs_vof"], places=4)
                self.assertAlmostEqual(fronts[name]["max_vs_vof"], first["max_vs_vof"], places=4)
        with open(self.root / "report/figures/fig8.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        for name in FOREIGN:
            mine = [row for row in rows if name in row]
            self.assertTrue(mine, (name, rows[:3]))
            self.assertAlmostEqual(float(mine[-1][4]), front(FRAMES - 1), places=4)

    def test_the_report_has_all_five(self):
        page = (self.root / "report/index.html").read_text(encoding="utf-8")
        for name in (*FOREIGN, "ours", "vof"):
            self.assertIn(name, page)
        verdicts = json.dumps(self.metrics()["verdicts"])
        for name in FOREIGN:
            self.assertIn(name, verdicts)

    def test_cost_is_shown_where_it_is_stated_and_not_invented(self):
        timing = self.metrics()["timing"]
        self.assertGreater(timing["ours"]["wall_s"], 0)
        for name in FOREIGN:
            self.assertNotIn("wall_s", timing.get(name, {}))


if __name__ == "__main__":
    if not shutil.which("interFoam"):
        sys.exit(77)
    unittest.main()
