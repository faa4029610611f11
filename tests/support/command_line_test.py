"""What the three programs have in common on the command line, and the files that they write to start from.

Usage: command_line_test.py PROGRAM_FOLDER
"""

import os
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
PROGRAMS = Path(sys.argv.pop(1)).resolve()
DAM_BREAK = SOURCE / "particle/cases/dam_break.toml"
SHORT = ("--set", "time.end=0.02", "--set", "output.interval=0.01")


class CommandLine(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name)

    def call(self, program, *words, code=0):
        done = subprocess.run([PROGRAMS / program, *words], cwd=self.folder, text=True, capture_output=True,
                              check=False)
        self.assertEqual(done.returncode, code, (words, done.stdout, done.stderr))
        return done.stdout, done.stderr


class ToStartFrom(CommandLine):
    def test_a_new_case_is_checked_and_computed_as_it_stands(self):
        for dimension in ("2", "3"):
            case = f"case{dimension}.toml"
            self.call("surge-particle", "new", "--dimension", dimension, case)
            self.assertIn(f"dimension   {dimension}\n", self.call("surge-particle", "check", case)[0])
            self.call("surge-foam", "check", case)
            self.call("surge-particle", "run", case, "--out", f"run{dimension}", *SHORT)
        said = self.call("surge-particle", "new", "case2.toml", code=1)[1]
        self.assertEqual(said, "surge-particle: case2.toml: is there already, expected the name of a new file\n")
        self.assertEqual(self.call("surge-particle", "new", "-")[0], (self.folder / "case2.toml").read_text())
        said = self.call("surge-particle", "new", "x", "--dimension", "4", code=1)[1]
        self.assertIn("found 4, expected 2 or 3", said)

    def test_a_new_study_of_a_new_case_is_checked_as_it_stands(self):
        (self.folder / "sub").mkdir()
        self.call("surge-particle", "new", "case.toml")
        self.call("surge-compare", "new-study", "sub/study.toml", "--case", "case.toml")
        said = self.call("surge-compare", "study", "sub/study.toml")[0]
        for run in ("mps", "sph", "isph", "vof"):
            self.assertRegex(said, rf"(?m)^  {run} ")
        self.assertIn("is there already",
                      self.call("surge-compare", "new-study", "sub/study.toml", "--case", "case.toml", code=1)[1])
        said = self.call("surge-compare", "new-study", "s", "--case", "gone.toml", code=1)[1]
        self.assertIn("--case: found \"gone.toml\"", said)


class Plot(CommandLine):
    def setUp(self):
        super().setUp()
        self.call("surge-particle", "run", DAM_BREAK, "--out", "run", *SHORT, "--quiet",
                  "--set", "resolution.spacing=0.0145")

    def test_a_frame_becomes_a_picture(self):
        said = self.call("surge-compare", "plot", "run", "--time", "0.01", "--out", "a.png")[0]
        self.assertEqual(said, "run: t = 0.01 s, 2 of 3 frames: a.png\n")
        self.call("surge-compare", "plot", "run")  # the last one, run.png
        pictures = [(self.folder / name).read_bytes() for name in ("a.png", "run.png")]
        for picture in pictures:
            self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(struct.unpack(">I", picture[16:20])[0], 1200)
        self.assertNotEqual(*pictures)

    def test_the_program_that_made_it_draws_it_too(self):
        said = self.call("surge-particle", "plot", "run", "--time", "0.01", "--out", "b.png")[0]
        self.assertEqual(said, "run: t = 0.01 s, 2 of 3 frames: b.png\n")
        self.call("surge-compare", "plot", "run", "--time", "0.01", "--out", "c.png")
        self.assertEqual((self.folder / "b.png").read_bytes(), (self.folder / "c.png").read_bytes())
        self.assertIn("surge-compare: --time: found 7 s",
                      self.call("surge-particle", "plot", "run", "--time", "7", code=1)[1])
        shutil.copy2(PROGRAMS / "surge-particle", self.folder)
        alone = subprocess.run([self.folder / "surge-particle", "plot", "run"], cwd=self.folder, text=True,
                               capture_output=True, check=False)
        self.assertEqual((alone.returncode, alone.stderr.count("\n")), (1, 1))
        self.assertIn("expected surge-compare there, which draws", alone.stderr)

    def test_mistakes_are_told(self):
        said = self.call("surge-compare", "plot", "run", "--time", "7", code=1)[1]
        self.assertEqual(said, "surge-compare: --time: found 7 s, expected a time of run's frames, 0 to 0.02 s\n")
        self.assertIn("no/such/a.png: cannot be written",
                      self.call("surge-compare", "plot", "run", "--out", "no/such/a.png", code=1)[1])


class Talk(CommandLine):
    RUN = ("run", DAM_BREAK, *SHORT, "--set", "resolution.spacing=0.0145")

    def test_quiet_prints_errors_alone(self):
        self.assertIn("finished", self.call("surge-particle", *self.RUN, "--out", "a")[0])
        self.assertEqual(self.call("surge-particle", *self.RUN, "--out", "b", "--quiet"), ("", ""))
        self.assertEqual(self.call("surge-foam", "make", DAM_BREAK, "--out", "c", "--quiet"), ("", ""))
        said = self.call("surge-particle", *self.RUN, "--out", "b", "--quiet", code=1)
        self.assertEqual((said[0], said[1].count("\n")), ("", 1))

    def test_a_misspelt_option_gets_a_suggestion(self):
        for program, words, near in (("surge-particle", ("run", "a.toml", "--out", "b", "--thread", "2"), "--threads"),
                                     ("surge-compare", ("front", "a", "--strip-heigth=1"), "--strip-height"),
                                     ("surge-foam", ("check", "a.toml", "--jsno"), "--json")):
            said = self.call(program, *words, code=1)[1]
            self.assertIn(f"did you mean {near}?", said)
            self.assertEqual(said.count("\n"), 1)
        # Which option it was is told, not that the one that it was meant to be is missing.
        self.assertEqual(self.call("surge-particle", "run", "a.toml", "--ouy", "b", code=1)[1],
                         "surge-particle: found an unknown option --ouy of run, did you mean --out?\n")
        self.assertIn("zzzzzz", self.call("surge-particle", "check", "a.toml", "--zzzzzz", code=1)[1])

    def test_what_is_missing_is_told_in_one_line(self):
        for program, words, said in (("surge-particle", ("run", "a.toml"), "--out is required"),
                                     ("surge-compare", ("report",), "--study is required"),
                                     ("surge-foam", ("make", "a.toml"), "--out is required")):
            self.assertEqual(self.call(program, *words, code=1)[1],
                             f"{program}: {said} ({program} {words[0]} --help tells the usage)\n")
            self.assertEqual(self.call(program, code=1)[1],
                             f"{program}: A subcommand is required ({program} --help tells the usage)\n")

    def test_manual_and_completion_name_all_that_help_does(self):
        for program in ("surge-particle", "surge-compare", "surge-foam"):
            manual, completion = (self.call(program, "--print", what)[0] for what in ("man", "completion"))
            manual = manual.replace("\\-", "-")
            commands = re.findall(r"(?m)^  ([a-z][a-z-]*)  ", self.call(program, "--help")[0].split("Subcommands:")[1])
            self.assertGreater(len(commands), 2)
            for command in commands:
                self.assertIn(f"\n.SS {command}\n", manual)
                completed = re.search(rf"(?m)^      {command}\) words='(.*)' ;;$", completion)
                options = set(re.findall(r"(?m)^  (?:-\w,)?(--[a-z-]+)", self.call(program, command, "--help")[0]))
                self.assertEqual(set(completed[1].split()), options, command)
                section = manual.split(f"\n.SS {command}\n")[1].split("\n.SS ")[0]
                for option in options:
                    self.assertRegex(section, rf"(?m)^\.B .*{option}\b")

    def test_colour_is_for_a_terminal(self):
        words = [PROGRAMS / "surge-particle", "check", "gone.toml"]
        self.assertNotIn("\x1b", self.call("surge-particle", "check", "gone.toml", code=1)[1])
        for more, coloured in (({"TERM": "xterm"}, True), ({"TERM": "xterm", "NO_COLOR": "1"}, False),
                               ({"TERM": "dumb"}, False)):
            ours, theirs = pty.openpty()
            environment = {key: value for key, value in os.environ.items() if key != "NO_COLOR"} | more
            subprocess.run(words, cwd=self.folder, stderr=theirs, env=environment, check=False)
            os.close(theirs)
            said = os.read(ours, 4096).decode()
            os.close(ours)
            self.assertEqual("\x1b[1;31msurge-particle:\x1b[0m " in said, coloured, more)


if __name__ == "__main__":
    unittest.main()
