"""A sweep of seeded valid cases, all methods, 2D and 3D: each ends by itself, loses nothing in silence
and says where it gave up.

Usage: sweep_test.py BUILD_FOLDER FIRST COUNT
"""

import collections
import csv
import json
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from random_case import RandomCase

PROGRAM = Path(sys.argv[1]).resolve() / "bin/surge-particle"
FIRST, COUNT = int(sys.argv[2]), int(sys.argv[3])
del sys.argv[1:4]
LONGEST_CPU_S = 60
TOO_FAST = 10.0  # times what falling and pushing can make: no flow, whatever a run says of itself
# As the paper states them, without what would keep them together in every flow: they may give up where
# they say so. The recommended presets may not.
MAY_BREAK = {("sph", "paper-bare"), ("sph", "paper"), ("mps", "paper")}


def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST_CPU_S, LONGEST_CPU_S + 5))


def call(*words):
    return subprocess.run([str(PROGRAM), *map(str, words)], capture_output=True, text=True, check=False,
                          stdin=subprocess.DEVNULL, preexec_fn=limited)


class Sweep(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="surge_sweep_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.faults = []

    def fault(self, seed, case, what):
        self.faults.append(f"seed {seed} ({case.method}-{case.preset}, {case.dimension}D): {what}")

    def frames(self, out: Path):
        for file in sorted((out / "frames").iterdir()):
            found = re.search(rb'NumberOfPoints="(\d+)"', file.read_bytes()[:4000])
            yield int(found[1]) if found else -1

    def expect_whole(self, seed, case, out: Path, said: str):
        """Of a run that says that it finished."""
        manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
        counts = list(self.frames(out))
        if manifest["finished"] is not True or manifest["frames"] != len(counts) or len(counts) < 5:
            self.fault(seed, case, f"{manifest['frames']} frames told, {len(counts)} found")
        if len(set(counts)) != 1 or counts[0] != manifest["fluid_particles"] + manifest["wall_particles"]:
            self.fault(seed, case, f"particles went missing: {counts}")
        if abs(manifest["simulated_s"] - case.end) > 1e-6 * case.end:
            self.fault(seed, case, f"ended at {manifest['simulated_s']} of {case.end} s")
        if f"{manifest['lost_particles']} particles lost" not in said:
            self.fault(seed, case, f"{manifest['lost_particles']} lost in silence")
        rows = list(csv.DictReader((out / "steps.csv").read_text(encoding="utf-8").splitlines()))
        fastest = max(float(row["v_max"]) for row in rows)
        told = "warning: a particle reached" in said and (case.method, case.preset) in MAY_BREAK
        if fastest > TOO_FAST * case.fastest and not told:
            self.fault(seed, case, f"{fastest:.3g} m/s in a flow of {case.fastest:.3g} m/s, unsaid")

    def one(self, seed) -> str:
        """What became of a case: refused, finished, gave up, fault."""
        case = RandomCase(seed)
        file = self.folder / "case.toml"
        file.write_text(case.toml(), encoding="utf-8")
        checked = call("check", file)
        if checked.returncode == 1:
            if checked.stderr.count("\n") != 1 or not checked.stderr.startswith("surge-particle: "):
                self.fault(seed, case, f"check said {checked.stderr!r}")
            return "refused"
        if checked.returncode != 0:
            self.fault(seed, case, f"check ended with {checked.returncode}: {checked.stderr}")
            return "fault"
        out = self.folder / "run"
        shutil.rmtree(out, ignore_errors=True)
        done = call("run", file, "--out", out)
        before = len(self.faults)
        if done.returncode == 0:
            self.expect_whole(seed, case, out, done.stdout + done.stderr)
            return f"finished by {case.method}" if len(self.faults) == before else "fault"
        manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8")) \
            if (out / "manifest.json").exists() else {}
        if done.returncode != 1 or manifest.get("finished") is not False or not manifest.get("stopped"):
            self.fault(seed, case, f"run ended with {done.returncode}: {done.stderr[-300:]!r}")
        elif (case.method, case.preset) not in MAY_BREAK:
            self.fault(seed, case, f"gave up: {done.stderr.strip()}")
        return f"gave up, said by {case.method}-{case.preset}"

    def test_seeded_cases(self):
        ends = collections.Counter()
        seed, computed = FIRST, 0
        while computed < COUNT:
            end = self.one(seed)
            ends[end] += 1
            computed += end != "refused"
            seed += 1
            # A generator of nonsense would be a sweep of nothing.
            self.assertLess(ends["refused"], 20 + computed // 2, "most cases are refused")
        print(f"sweep from seed {FIRST}: {computed} valid cases computed, " +
              ", ".join(f"{count} {end}" for end, count in sorted(ends.items())))
        self.assertEqual(self.faults, [], "\n" + "\n".join(self.faults))


if __name__ == "__main__":
    unittest.main()
