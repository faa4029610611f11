"""Runs of a study that were stopped: ./Allrun goes on from their checkpoints."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from project import PARTICLE, Project

# Stopped in the second run, with a checkpoint, until the file `go_on` is there. A restart needs the
# checkpoint and is refused where the file `refuse` is there.
STOPPED = PARTICLE.replace("finished=true\n", """
if [[ $* == *--restart* ]]; then
  [[ -e $4/checkpoint.bin ]] || exit 1
  [[ ! -e refuse ]] || exit 3
fi
mkdir -p "$4"
if [[ $4 == runs/second && ! -e go_on ]]; then
  echo state >"$4/checkpoint.bin"
  printf '{"finished": false}' >"$4/manifest.json"
  exit 130
fi
[[ $* == *--restart* || ! -e $4/checkpoint.bin ]] || exit 1
rm -f "$4/checkpoint.bin"
finished=true
""", 1)


class Resumption(Project):
    def setUp(self):
        super().setUp()
        self.write("build/release/bin/surge-particle", STOPPED, executable=True)
        done = self.allrun()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("second: FAILED", done.stdout)
        self.assertTrue((self.root / "runs/second/checkpoint.bin").exists())
        self.calls()
        self.write("go_on", "")

    def second_calls(self):
        """Whether each call of the second run was a restart."""
        lines = (self.root / "calls").read_text().splitlines()
        return ["--restart" in line for line in lines if line.startswith("start ") and "/second " in line]

    def test_a_stopped_run_goes_on(self):
        done = self.allrun()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("second: goes on from its checkpoint", done.stdout)
        self.assertEqual(self.second_calls(), [True])
        self.assertEqual(sorted(self.calls()), ["report", "second"])
        self.succeed(ran=[])

    def test_what_cannot_go_on_begins_again(self):
        self.write("refuse", "")
        done = self.allrun()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("second: its checkpoint is of other inputs or damaged", done.stdout)
        self.assertEqual(self.second_calls(), [True, False])


if __name__ == "__main__":
    unittest.main()
