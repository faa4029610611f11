"""What `cmake --install` puts on a disk: programs that run there, pages, completion, and the library, with
which the example of the documentation is built.

Usage: install_test.py BUILD_FOLDER
"""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv.pop(1)).resolve()
PROGRAMS = ("surge-particle", "surge-compare", "surge-foam")


def call(*command, **settings):
    return subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False, **settings)


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.prefix = cls.folder / "prefix"
        done = call("cmake", "--install", BUILD, "--prefix", cls.prefix)
        assert done.returncode == 0, done.stdout

    def test_nothing_is_missing(self):
        for name in ("share/surgefront/particle/cases/presets/mps-paper.toml",
                     "share/surgefront/particle/cases/dam_break.toml",
                     "share/surgefront/compare/studies/dam_break_quick.toml",
                     "share/surgefront/compare/reference/martin_moyce_1952_2.25in.csv",
                     "share/surgefront/foam_cases/damBreak2D/Allrun", "share/doc/surgefront/copyright",
                     "share/doc/surgefront/worked-examples.md", "include/surgefront/surgefront.hpp",
                     *(f"bin/{name}" for name in PROGRAMS),
                     *(f"share/man/man1/{name}.1" for name in PROGRAMS),
                     *(f"share/bash-completion/completions/{name}" for name in PROGRAMS)):
            self.assertTrue((self.prefix / name).is_file(), name)

    def test_programs_run_where_they_are_installed(self):
        done = call(self.prefix / "bin/surge-compare", "study", "compare/studies/dam_break_quick.toml",
                    cwd=self.prefix / "share/surgefront")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("reference: vof-10", done.stdout)
        done = call(self.prefix / "bin/surge-foam", "check", "particle/cases/dam_break.toml",
                    cwd=self.prefix / "share/surgefront")
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_pages_say_what_help_says(self):
        for program in PROGRAMS:
            page = (self.prefix / f"share/man/man1/{program}.1").read_text(encoding="utf-8")
            plain = page.replace("\\-", "-").replace("\\e", "\\").replace("\\&", "")
            text = call(self.prefix / "bin" / program, "--help").stdout
            commands = re.findall(r"^  ([a-z]+) ", text.split("Subcommands:")[1], re.MULTILINE)
            self.assertTrue(commands)
            for command in commands:
                self.assertIn(f".SS {command}\n", plain)
                said = call(self.prefix / "bin" / program, command, "--help").stdout
                for option in set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", said, re.MULTILINE)):
                    self.assertIn(option, plain, (program, command))

    def test_completion_knows_subcommands_and_options(self):
        def complete(*words):
            script = (f"source {self.prefix}/share/bash-completion/completions/surge-compare\n"
                      f"COMP_WORDS=({' '.join(words)}) COMP_CWORD={len(words) - 1}\n_surge_compare\n"
                      "printf '%s\\n' \"${COMPREPLY[@]}\"")
            return call("bash", "-c", script).stdout.split()
        self.assertEqual(complete("surge-compare", "che"), ["check"])
        self.assertEqual(complete("surge-compare", "check", "--junit"), ["--junit-xml"])
        self.assertIn("--max-rms", complete("surge-compare", "metrics", "--max"))

    def test_library_brings_none_of_our_flags(self):
        config = "".join(file.read_text() for file in (self.prefix / "lib").rglob("SurgeFront*.cmake"))
        self.assertIn("SurgeFront::compare", config)
        for word in ("-march", "-Wall", "-Werror", "-Wno"):
            self.assertNotIn(word, config)
        for folder in (SOURCE, BUILD):  # as a path of its own: a checkout may be in /surgefront
            self.assertNotRegex(config, r"(?<![\w}/.-])" + re.escape(str(folder)) + r"(?![\w.-])")

    def test_example_hands_its_frames_over(self):
        build = self.folder / "example"
        source = self.prefix / "share/doc/surgefront/examples/frames_from_memory"
        done = call("cmake", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
                    "-DCMAKE_CXX_FLAGS=-O1 -Wall -Wextra -Wconversion -Wshadow -Werror")
        self.assertEqual(done.returncode, 0, done.stdout)
        done = call("cmake", "--build", build)
        self.assertEqual(done.returncode, 0, done.stdout)
        solver, baseline = build / "solver", self.folder / "baseline.json"
        self.assertEqual(call(solver, baseline).returncode, 1)
        done = call(solver, baseline, "bless")
        self.assertEqual(done.returncode, 0, done.stdout)
        done = call(solver, baseline)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("front at 0.1 s: 0.15 m", done.stdout)


if __name__ == "__main__":
    unittest.main()
