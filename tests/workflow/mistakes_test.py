"""What Allrun says to mistakes and to machines that lack something.

Usage: mistakes_test.py BUILD_FOLDER PART
"""

import json
import os
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

from project import ALL, CASE, SOURCE, STUDY, Project


class Mistakes(Project):
    def test_each_wrong_option_gets_one_line(self):
        for options, expected in [
            (["--fast"], "Allrun: unknown option '--fast'; ./Allrun --help lists them"),
            (["--jobs", "many"], "Allrun: --jobs: found 'many', expected a whole number of at least 1"),
            (["--jobs"], "Allrun: --jobs: expected a number"),
            (["--quick", "--full"], "Allrun: --full: only one of --quick, --full, --study and --catalogue can be chosen"),
            (["--study", "no.toml"], "Allrun: no.toml: there is no such study; "
                                     "there are: compare/studies/dam_break.toml"),
        ]:
            with self.subTest(options):
                done = self.allrun(*options)
                self.assertNotEqual(done.returncode, 0)
                self.assertEqual((done.stdout, done.stderr), ("", expected + "\n"))

    def test_each_mistake_in_a_study_names_file_line_and_key(self):
        where = "compare/studies/dam_break.toml"
        for wrong, right, expected in [
            ("threads = 2", "threads = 0", f"{where}:23: run.2.threads: found 0, expected a whole number"),
            ("threads = 2", "repeats = 0", f"{where}:23: run.2.repeats: found 0, expected a whole number"),
            ("threads = 2", "role = 'tming'", f'{where}:23: run.2.role: found "tming", expected one of'),
            ("threads = 2", "role = 'sensitivity'", f"{where}:18: run.2.group: found nothing, expected what"),
            ('title = "test"', 'title = "t"\ninclude = ["no.toml"]', f'{where}:2: include: found "no.toml"'),
            ("threads = 2", "treads = 2", f'{where}:23: run.2.treads: found unknown key "treads"'),
            ('name = "first"', 'name = "vof"', f'{where}:19: run.2.name: found "vof" a second time'),
            ('name = "second"', 'name = "../x"', f'{where}:13: run.1.name: found "../x", expected a name'),
            ('program = "interFoam"', 'program = "foam"', f'{where}:20: run.2.program: found "foam", expected'),
            ("foam_cases/tank", "foam_cases/pond", f'{where}:18: run.2.case: found "foam_cases/pond", expected'),
            ("cases/case.toml", "cases/no.toml", f'{where}:7: run.0.case: found "particle/cases/no.toml"'),
            ('"cellsPerL=7"', '"cellsPerL"', f'{where}:22: run.2.set: found "cellsPerL", expected'),
            ('"cellsPerL=7"', '"cellPerL=7"', f'{where}:18: run.2.set: found "cellPerL=7", expected an entry of '
             "foam_cases/tank/system/caseParameters (cellsPerL?)"),
            ('"cellsPerL=7"', '"cellsPerL=7;touch x"', f'{where}:22: run.2.set: found "cellsPerL=7;touch x"'),
            ('["measured"]', '["mesured"]', f'{where}:5: published: found "mesured", expected the name of'),
            ('title = "test"', "title = ", f"{where}:1"),
            (STUDY[STUDY.index("[[run]]"):], "", f"{where}:1: run: found no run"),
        ]:
            with self.subTest(right):
                self.study(STUDY.replace(wrong, right))
                done = self.allrun()
                self.assertNotEqual(done.returncode, 0)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertTrue(done.stderr.startswith(expected), done.stderr)
                self.assertEqual(self.calls(), [])

    def test_what_the_program_says_to_a_case_is_told_before_anything_runs(self):
        self.study(second='"method.preset=none"')
        done = self.allrun()
        self.assertNotEqual(done.returncode, 0)
        self.assertTrue(done.stderr.startswith("compare/studies/dam_break.toml:12: run.1: second: "), done.stderr)
        self.assertEqual(self.calls(), [])

    def test_more_than_the_disk_holds_is_refused(self):
        self.study(second='"disk=full"')
        done = self.allrun()
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"no space for the runs: found [0-9.]+ .?B free on its disk, "
                                      r"expected room for the 1000000000\.0 GB")
        self.assertEqual(self.calls(), [])

    def test_a_dry_run_before_the_build_says_so(self):
        (self.root / "build/release/bin/surge-compare").unlink()
        done = self.allrun("--dry-run")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("runs: build/release/bin/surge-compare: not there yet", done.stdout)
        done = self.allrun()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("surge-compare: not there yet", done.stderr)

    def test_help_names_every_option(self):
        done = self.allrun("--help")
        self.assertEqual(done.returncode, 0)
        for option in ("--quick", "--full", "--study", "--dry-run", "--force", "--jobs", "--no-install"):
            self.assertIn(option, done.stdout)


class Causes(Project):
    """What stands in the way is named, and no other thing."""

    def test_a_report_that_cannot_be_written_tells_why(self):
        self.write("broken_report", "")
        done = self.allrun()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("  report: surge-compare: report: is a link to elsewhere, expected a folder", done.stderr)

    def test_a_folder_that_cannot_be_written_to_is_no_other_allrun(self):
        self.write(".snakemake", "no folder")
        done = self.allrun()
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr, f"Allrun: {self.root}: cannot be written to, and the runs and the report "
                                      "go there\n")

    def test_runs_that_are_no_folder_are_named(self):
        self.write("runs", "a file")
        done = self.allrun()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("runs", done.stderr)
        self.assertNotIn("Traceback", done.stdout + done.stderr)

    def test_a_link_in_the_place_of_a_run_is_replaced_and_not_followed(self):
        elsewhere = self.root / "elsewhere"
        self.write("elsewhere/precious", "mine")
        (self.root / "runs").mkdir()
        (self.root / "runs/first").symlink_to(elsewhere)
        self.succeed(ran=ALL)
        self.assertEqual((elsewhere / "precious").read_text(), "mine")
        self.assertEqual(sorted(p.name for p in elsewhere.iterdir()), ["precious"])


class Elsewhere(Project):
    """A study may lie anywhere, and its path and the checkout's may be written with any letters."""

    FOLDER = "it's a \"test\" of $HOME; & (more) {x} größe"

    def outside(self, name):
        """The study in a folder beside the project, with a case of its own."""
        text = STUDY.replace("{second}", "")
        text = text.replace('"particle/cases/case.toml"', '"my case.toml"', 1)
        folder = self.root.parent / name
        folder.mkdir()
        (folder / "my study; touch x.toml").write_text(text)
        (folder / "my case.toml").write_text(CASE)
        return folder / "my study; touch x.toml"

    def test_a_study_outside_of_the_project(self):
        study = self.outside("ma étude $(touch y)")
        self.succeed("--study", str(study), ran=ALL)
        self.succeed("--study", str(study), ran=[])
        (study.parent / "my case.toml").write_text(CASE + "tolerance = 1\n")
        self.succeed("--study", str(study), ran=["first", "report"])
        self.assertEqual(sorted(p.name for p in self.root.parent.iterdir()), sorted([self.FOLDER, study.parent.name]))

    def test_a_study_is_named_as_its_caller_sees_it(self):
        study = self.outside("there")
        done = subprocess.run([str(self.root / "Allrun"), "--no-install", "--no-build", "--dry-run", "--study",
                               study.name], cwd=study.parent, text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"first +run +not there yet")


class Packages(Project):
    def machine(self, installed, user=0):
        """PATH of a machine on which just these packages are installed."""
        self.write("tools/dpkg-query", "#!/bin/bash\nfor package in \"${@:3}\"; do\n  [[ ' " + " ".join(installed)
                   + " ' != *\" $package \"* ]] || echo \"$package installed\"\ndone\n", executable=True)
        self.write("tools/id", f"#!/bin/bash\necho {user}\n", executable=True)
        for name in ("apt-get", "sudo"):
            self.write(f"tools/{name}", f'#!/bin/bash\necho "{name} $*" >>{self.root}/installed\n'
                       f'[[ {name} != apt-get || $* != *broken* ]]\n', executable=True)
        return f"{self.root}/tools:{os.environ['PATH']}"

    def ensure(self, mode, **machine):
        path = self.machine(**machine)
        self.write(".ci/packages.txt", "# what for\ng++\ncmake  # builds\n\nopenfoam\n")
        return subprocess.run(
            ["bash", "-c", f"program=Allrun; . .ci/functions; ensure_packages {mode}"],
            cwd=self.root, env={**os.environ, "PATH": path}, text=True, capture_output=True, check=False)

    def installed(self):
        file = self.root / "installed"
        return file.read_text().splitlines() if file.exists() else []

    def test_nothing_is_done_where_all_is_there(self):
        done = self.ensure("install", installed=["g++", "cmake", "openfoam"])
        self.assertEqual((done.returncode, done.stdout), (0, "packages: all 3 are installed\n"))
        self.assertEqual(self.installed(), [])

    def test_no_install_prints_the_command_and_stops(self):
        done = self.ensure("ask", installed=["cmake"])
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("packages missing: g++ openfoam\n", done.stdout)
        self.assertIn("apt-get install --yes --no-install-recommends --no-remove g++ openfoam\n", done.stdout)
        self.assertEqual(self.installed(), [])

    def test_root_installs_just_what_is_missing(self):
        done = self.ensure("install", installed=["cmake"])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.installed(), [
            "apt-get update --quiet", "apt-get install --yes --no-install-recommends --no-remove g++ openfoam"])

    def test_others_use_sudo(self):
        done = self.ensure("install", installed=["cmake"], user=1000)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.installed(), [
            "sudo apt-get update --quiet",
            "sudo apt-get install --yes --no-install-recommends --no-remove g++ openfoam"])

    def test_the_list_names_packages_once_each(self):
        lines = (SOURCE / ".ci/packages.txt").read_text().splitlines()
        names = [line.split("#")[0].strip() for line in lines if line.split("#")[0].strip()]
        self.assertEqual(len(names), len(set(names)))
        for name in names:
            self.assertRegex(name, r"^[a-z0-9][a-z0-9+.-]+$")


if __name__ == "__main__":
    unittest.main()
