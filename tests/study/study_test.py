"""The coarse dam break by MPS, SPH and interFoam, from the command of the README to its report.

Usage: study_test.py BUILD_FOLDER
"""

import json
import math
import subprocess
import sys
import unittest
from pathlib import Path

from project import check_command, make_project, run_study, study

BUILD = Path(sys.argv.pop(1))


class CoarseStudy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = make_project(BUILD)
        cls.first = run_study(cls.root)
        cls.study = study(BUILD)
        cls.runs = cls.study["runs"]
        cls.metrics_file = cls.root / "report/metrics.json"

    def setUp(self):
        self.assertEqual(self.first.returncode, 0, self.first.stdout)

    def metrics(self):
        return json.loads(self.metrics_file.read_text(encoding="utf-8"))

    def test_all_three_methods_take_part(self):
        programs = {run["program"] for run in self.runs}
        methods = {entry for run in self.runs for entry in run["settings"] if entry.startswith("method.name")}
        self.assertEqual(programs, {"surge-particle", "interFoam"})
        self.assertEqual(methods, {"method.name=mps", "method.name=sph"})

    def test_fronts_are_those_of_the_baselines(self):
        for run in self.runs:
            with self.subTest(run["name"]):
                done = subprocess.run(check_command(self.root, run["name"]), text=True,
                                      capture_output=True, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_no_particle_is_lost(self):
        for run in self.runs:
            manifest = json.loads((self.root / "runs" / run["name"] / "manifest.json").read_text())
            with self.subTest(run["name"]):
                self.assertIs(manifest["finished"], True)
                self.assertEqual(manifest.get("lost_particles", 0), 0)
                self.assertEqual(manifest.get("nonfinite", 0), 0)

    def test_metrics_hold_what_the_readme_promises(self):
        metrics = self.metrics()
        for run in self.runs:
            for key in (f"front.{run['name']}.impact_time_s", f"timing.{run['name']}.wall_s",
                        f"timing.{run['name']}.steps", f"timing.{run['name']}.threads"):
                with self.subTest(key):
                    value = find(metrics, key)
                    self.assertTrue(math.isfinite(value) and value > 0, value)
            if run["name"] != self.study["reference"]:
                for kind in ("rms", "max", "bias"):
                    value = find(metrics, f"front.{run['name']}.{kind}_vs_vof")
                    self.assertTrue(math.isfinite(value), (run["name"], kind, value))

    def test_the_last_lines_are_a_table_and_the_report(self):
        lines = self.first.stdout.rstrip().splitlines()
        report = self.root / "report/index.html"
        self.assertEqual(lines[-1], f"report: {report}")
        self.assertIn("</html>", report.read_text(encoding="utf-8")[-200:])
        summary = (self.root / "report/summary.txt").read_text(encoding="utf-8")
        table = summary.split("\nreport: ")[0].strip()
        self.assertIn(table, self.first.stdout)
        for run in self.runs:
            self.assertIn(run["name"], table)

    def test_a_second_call_computes_nothing(self):
        before = self.metrics_file.stat().st_mtime_ns
        second = run_study(self.root)
        self.assertEqual(second.returncode, 0, second.stdout)
        self.assertNotIn("started", second.stdout)
        self.assertEqual(self.metrics_file.stat().st_mtime_ns, before)


def find(metrics, key):
    """A value by its dotted name; names of runs have dots in them, too."""
    if key in metrics:
        return metrics[key]
    for head in sorted((k for k in metrics if key.startswith(k + ".")), key=len, reverse=True):
        if isinstance(metrics[head], dict):
            return find(metrics[head], key[len(head) + 1:])
    raise AssertionError(f"metrics.json: {key}: found nothing")


if __name__ == "__main__":
    unittest.main()
