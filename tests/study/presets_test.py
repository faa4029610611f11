"""Every preset against its baseline, by the program's own regression check.

Usage: presets_test.py BUILD_FOLDER
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from presets import FOLDER, check_command, compute, outcome, presets

BUILD = Path(sys.argv.pop(1)).resolve()


class Presets(unittest.TestCase):
    def test_every_preset_gives_what_it_gave(self):
        names = presets(BUILD)
        self.assertGreaterEqual(len(names), 5)
        with tempfile.TemporaryDirectory() as folder:
            for name in names:
                with self.subTest(name):
                    run, report = Path(folder) / name, Path(folder) / f"{name}.json"
                    compute(BUILD, name, run)
                    done = subprocess.run([*check_command(BUILD, name, run), "--json", report],
                                          text=True, capture_output=True, check=False)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    found = outcome(report)
                    self.assertIs(found["passed"], True)
                    quantities = {finding["quantity"] for finding in found["findings"]}
                    self.assertLessEqual({"front", "centre-of-mass.x", "kinetic-energy"}, quantities)

    def test_no_baseline_is_left_over(self):
        self.assertEqual({file.stem for file in FOLDER.glob("*.json")}, set(presets(BUILD)))

    def test_another_method_does_not_pass(self):
        names = presets(BUILD)
        with tempfile.TemporaryDirectory() as folder:
            run = Path(folder) / "run"
            compute(BUILD, names[0], run)
            done = subprocess.run(check_command(BUILD, names[-1], run), text=True, capture_output=True,
                                  check=False)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            self.assertIn("failed", done.stdout)


if __name__ == "__main__":
    unittest.main()
