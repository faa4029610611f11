"""The fault campaign: whatever is done to a study, ./Allrun then ends with the same metrics.

Usage: campaign_test.py BUILD_FOLDER [CLASS]
"""

import os
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from campaign import Campaign

Campaign.BUILD = Path(sys.argv.pop(1)).resolve()
NOBODY = 65534


class Kills(Campaign):
    """kill -9 at seeded moments."""

    def kill_one(self, words, wait_s):
        """Kills a process a moment after it is there; one that has ended by then, the next. Whether it did."""
        started = self.start()
        while started.poll() is None and not self.processes(words):
            time.sleep(0.01)
        time.sleep(wait_s)
        killed = 0
        while started.poll() is None and not killed:
            killed = self.kill(self.processes(words))
            time.sleep(0.01)
        told = started.communicate()[0]
        self.refuse_tracebacks(told)
        self.wait_until_quiet()
        return killed > 0

    def campaign(self, name, words, tries, longest_s, from_scratch=True):
        struck = 0
        for number in range(tries):
            if from_scratch:
                self.forget()
            else:
                shutil.rmtree(self.root / "report")
            moment = self.random.uniform(0.0, longest_s)
            struck += self.kill_one(words, moment)
            self.expect_same(f"{name} killed after {moment:.3f} s, try {number}")
        print(f"kill -9 of {name}: {tries} tries, {struck} of them at work, {tries} survived")
        self.assertGreater(struck, 0, "no kill struck")

    def test_solvers(self):
        self.campaign("a solver", ["surge-particle run"], 4, 1.0)

    def test_foam(self):
        if not self.has_foam:
            self.skipTest("no interFoam here")
        self.campaign("interFoam", ["interFoam", "blockMesh", "setFields"], 3, 1.0)

    def test_report(self):
        self.campaign("the report's writer", ["surge-compare report"], 3, 1.5, from_scratch=False)

    def test_workflow(self):
        tries = 4
        for number in range(tries):
            self.forget()
            started = self.start()
            time.sleep(self.random.uniform(0.2, 8.0))
            alone = number % 2 == 0  # Allrun and the engine; else all of it, as by a power cut
            words = ["Allrun", "snakemake", "work.py"] if alone else [""]
            self.kill(self.processes(words))
            started.communicate()
            self.wait_until_quiet()
            self.expect_same(f"workflow killed, try {number}")
        print(f"kill -9 of the workflow: {tries} tries, {tries} survived")


class Damage(Campaign):
    """Files of a finished study that are cut, changed or gone."""

    def files(self, folder):
        found = [path for path in sorted((self.root / folder).rglob("*"))
                 if path.is_file() and not path.name.startswith(".") and path.stat().st_size > 0]
        return found

    def strike(self, path: Path) -> str:
        way = self.random.choice(["cut", "changed", "removed"])
        if way == "removed":
            path.unlink()
        elif way == "cut":
            os.truncate(path, self.random.randrange(path.stat().st_size))
        else:
            data = bytearray(path.read_bytes())
            for _ in range(8):
                data[self.random.randrange(len(data))] ^= 1 << self.random.randrange(8)
            path.write_bytes(data)
        return f"{path.relative_to(self.root)} {way}"

    def test_runs_and_report(self):
        tries = 7
        for number in range(tries):
            self.restore()
            folder = ["runs/mps", "runs/sph", "runs/vof", "report"][number % 4]
            struck = self.files(folder)
            if not struck:  # no interFoam here
                continue
            told = self.strike(self.random.choice(struck))
            self.expect_same(told)
        print(f"damaged files: {tries} tries, {tries} survived")

    def test_checkpoints(self):
        """Stopped runs whose checkpoint is damaged begin again."""
        tries = 2
        for number in range(tries):
            self.forget()
            started = self.start()
            while started.poll() is None and not list(self.root.glob("runs/*/checkpoint.bin")):
                time.sleep(0.02)
            self.kill(self.processes())
            started.communicate()
            for path in self.root.glob("runs/*/checkpoint.bin"):
                self.strike(path)
            self.expect_same(f"checkpoints damaged, try {number}")
        print(f"damaged checkpoints: {tries} tries, {tries} survived")


class Disk(Campaign):
    """No room for what is written."""

    @staticmethod
    def limit(size):
        def prepare():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        return prepare

    def test_files_that_cannot_grow(self):
        """By the system's limit on the size of a file, which needs no rights."""
        tries = 3
        for number in range(tries):
            self.forget()
            size = self.random.randrange(2_000, 60_000)
            done = self.allrun(prepare=self.limit(size))
            self.assertNotEqual(done.returncode, 0, f"{size} bytes sufficed:\n{done.stdout}")
            self.refuse_tracebacks(done.stdout)
            self.assertRegex(done.stdout.lower(), "file too large|full|no space|file size limit exceeded", done.stdout)
            self.expect_same(f"files of at most {size} bytes, try {number}")
        print(f"files that cannot grow: {tries} tries, {tries} survived")

    def test_small_file_system(self):
        """By a file system of 300 kB, where this process may mount one."""
        runs = self.root / "runs"
        self.forget()
        runs.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=300k", "surge_faults", str(runs)],
                                 capture_output=True, text=True, check=False)
        if mounted.returncode != 0:
            print(f"small file system: not tried, {mounted.stderr.strip()}")
            self.skipTest("mount: not permitted here")
        try:
            done = self.allrun()
        finally:
            subprocess.run(["umount", "-l", str(runs)], check=True)
        self.assertNotEqual(done.returncode, 0, done.stdout)
        self.refuse_tracebacks(done.stdout)
        self.assertRegex(done.stdout.lower(), "full|no space", done.stdout)
        self.expect_same("a full file system")
        print("small file system: 1 try, 1 survived")


class Rights(Campaign):
    """Folders that may not be written to. Root may always: it becomes nobody for the try."""

    @staticmethod
    def become_nobody():
        if os.geteuid() == 0:
            os.setgroups([])
            os.setgid(NOBODY)
            os.setuid(NOBODY)

    def test_folders_that_are_read_only(self):
        tries = 0
        os.chmod(self.outside, 0o755)
        for name in ("", "runs", "report"):
            self.restore()
            shutil.rmtree(self.root / "runs/mps")  # something to do
            for path in [self.root, *self.root.rglob("*")]:
                if not path.is_symlink():
                    os.chmod(path, 0o777 if path.is_dir() else 0o666)
            folder = self.root / name
            os.chmod(folder, 0o555)
            try:
                done = self.allrun(prepare=self.become_nobody, HOME=str(self.outside))
            finally:
                os.chmod(folder, 0o755)
            self.assertNotEqual(done.returncode, 0, f"{name or '.'}:\n{done.stdout}")
            self.refuse_tracebacks(done.stdout)
            self.assertRegex(done.stdout, "cannot be written|ermission denied", done.stdout)
            self.forget()
            self.expect_same(f"{name or '.'} was read only")
            tries += 1
        print(f"read-only folders: {tries} tries, {tries} survived")


class Two(Campaign):
    """Two at once in one folder."""

    def test_the_second_is_refused_and_both_leave_one_study(self):
        tries = 2
        for number in range(tries):
            self.forget()
            first = self.start()
            time.sleep(self.random.uniform(0.0, 0.5))  # less than a study takes
            second = self.start()
            told = [process.communicate()[0] for process in (first, second)]
            ends = sorted(process.returncode for process in (first, second))
            self.assertEqual(ends, [0, 1], "\n".join(told))
            self.assertIn("still at work in this folder", "\n".join(told))
            self.expect_same(f"two at once, try {number}")
        print(f"two at once: {tries} tries, {tries} survived")


if __name__ == "__main__":
    unittest.main()
