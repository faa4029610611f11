"""A column at the right wall is the flow of the one at the left wall: the programs print the same table for both.

Usage: mirror_test.py BUILD_FOLDER
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
BIN = Path(sys.argv.pop(1)).resolve() / "bin"
# MPS as in the paper is not among them: the factors of its pressure solver go through the particles from one side.
PRESETS = (("mps", "improved"), ("sph", "paper"), ("sph", "delta-plus"), ("isph", "shifted"))


class Mirror(unittest.TestCase):
    def front(self, case, method, preset):
        """Time and Z/L as `surge-compare front` prints them, ten particles to L, while rounding is still rounding."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([BIN / "surge-particle", "run", SOURCE / "particle/cases" / case, "--out", f"{folder}/run",
                            "--threads", "1", "--set", f"method.name={method}", "--set", f"method.preset={preset}",
                            "--set", "resolution.spacing=0.0145", "--set", "time.end=0.3"],
                           check=True, stdout=subprocess.DEVNULL)
            return subprocess.run([BIN / "surge-compare", "front", f"{folder}/run", "--out", "-"], check=True,
                                  text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout

    def test_left_and_right_print_the_same_front(self):
        for method, preset in PRESETS:
            with self.subTest(method=method, preset=preset):
                left = self.front("square_column.toml", method, preset)
                self.assertEqual(left, self.front("square_column_right.toml", method, preset))
                end = left.splitlines()[-1].split(",")
                self.assertEqual(end[0], "0.3")
                self.assertGreater(float(end[2]), 2.5)


if __name__ == "__main__":
    unittest.main()
