"""What Allrun repeats, how long it says that it takes, in which order it works, and what it bears.

Usage: allrun_test.py BUILD_FOLDER PART
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


class Repetition(Project):
    def test_a_second_call_repeats_only_what_changed(self):
        self.succeed(ran=ALL)
        engine = self.root / ".snakemake/allrun.log"
        started = engine.stat().st_mtime_ns
        self.succeed(ran=[])
        self.assertEqual(engine.stat().st_mtime_ns, started, "nothing to do starts no engine")

        with self.subTest("comments and times of files decide nothing"):
            self.write("particle/cases/case.toml", "# another comment\n" + CASE)
            self.write("compare/studies/dam_break.toml", "# note\n" + STUDY.replace("{second}", ""))
            (self.root / "build/release/bin/surge-particle").touch()
            self.write("build/release/particle/version.cpp.o", "another commit")
            self.write("particle/cases/presets/mps-new.toml", "[mps]\nbeta = 0.9\n")
            self.succeed(ran=[])
        with self.subTest("a change of the report repeats no run"):
            self.series("1,1.3")
            self.succeed(ran=["report"])
            self.write("build/release/compare/main.cpp.o", "better figures")
            self.succeed(ran=["report"])
        with self.subTest("case file"):
            self.write("particle/cases/case.toml", CASE + "tolerance = 1\n")
            self.succeed(ran=["first", "second", "report"])
        with self.subTest("preset"):
            self.write("particle/cases/presets/mps-paper.toml", "[mps]\nbeta = 0.95\n")
            self.succeed(ran=["first", "second", "report"])
        with self.subTest("program"):
            self.write("build/release/particle/main.cpp.o", "another step")
            self.succeed(ran=["first", "second", "report"])
        with self.subTest("overrides"):
            self.study(second='"resolution.spacing=0.02"')
            self.succeed(ran=["second", "report"])
        with self.subTest("foam case"):
            self.write("foam_cases/tank/0.orig/U", "another field")
            self.succeed(ran=["vof", "report"])

    def test_the_preset_of_an_override_counts_and_so_does_what_it_extends(self):
        self.write("particle/cases/presets/sph-bare.toml", "[sph]\ngamma = 7\n")
        self.write("particle/cases/presets/sph-paper.toml", 'extends = "bare"\n[sph]\n')
        self.study(second='"method.name=sph"')
        self.succeed(ran=ALL)
        self.write("particle/cases/presets/sph-bare.toml", "[sph]\ngamma = 1\n")
        self.succeed(ran=["second", "report"])

    def test_an_included_study_is_part_of_it(self):
        part = STUDY[STUDY.index("[[run]]"):].replace("{second}", "")
        self.write("compare/studies/part.toml", part)
        twice = part.replace('name = "first"', 'name = "first"\nrole = "convergence"\ngroup = "x"')
        more = twice.split("[[run]]")[1].replace('"first"', '"third"')
        self.study(STUDY[:STUDY.index("[[run]]")] + 'include = ["part.toml"]\n\n'
                   + twice + "[[run]]" + more)
        self.succeed(ran=[*ALL, "third"])
        self.succeed(ran=[])
        self.write("compare/studies/part.toml", "# a word\n" + part)
        self.succeed(ran=[])
        self.write("compare/studies/part.toml", part + 'role = "verification"\ngroup = "y"\n')
        self.succeed(ran=["report"])

    def test_force_repeats_everything(self):
        self.succeed(ran=ALL)
        self.succeed("--force", ran=ALL)

    def test_a_folder_that_somebody_wrote_to_is_not_taken_for_the_run(self):
        self.succeed(ran=ALL)
        future = time.time() + 5
        os.utime(self.root / "runs/first/manifest.json", (future, future))
        (self.root / "runs/second/manifest.json").write_text('{"finished": false}')
        self.succeed(ran=["first", "second", "report"])

    def test_what_was_cut_is_made_again(self):
        self.succeed(ran=ALL)
        (self.root / "runs/first/notes.txt").write_text("somebody's own")
        self.succeed(ran=[])
        stamp = next((self.root / "runs/first").glob(".finished-*")).stat()
        manifest = self.root / "runs/first/manifest.json"
        manifest.write_text(manifest.read_text() + " ")
        os.utime(manifest, ns=(stamp.st_mtime_ns, stamp.st_mtime_ns))  # as a copy that was cut
        self.succeed(ran=["first", "report"])
        (self.root / "report/summary.txt").write_text("")
        self.succeed(ran=["report"])

    def test_what_was_removed_is_made_again(self):
        self.succeed(ran=ALL)
        shutil.rmtree(self.root / "runs/vof")
        shutil.rmtree(self.root / ".snakemake")
        self.succeed(ran=["vof", "report"])
        shutil.rmtree(self.root / "report")
        self.succeed(ran=["report"])

    def test_dry_run_says_what_would_be_done_and_writes_nothing(self):
        before = sorted(self.root.rglob("*"))
        done = self.allrun("--dry-run")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"first +run +not there yet")
        self.assertRegex(done.stdout, r"report +make")
        self.assertRegex(done.stdout, r"\nnotice: first, second, vof: found one, expected three resolutions of each")
        self.assertEqual(sorted(self.root.rglob("*")), before)
        self.succeed(ran=ALL)
        self.study(second='"resolution.spacing=0.02"')
        done = self.allrun("--dry-run")
        self.assertRegex(done.stdout, r"first +keep +up to date")
        self.assertRegex(done.stdout, r"second +run +changed: case\n")
        self.assertEqual(self.calls(), [])


class Estimate(Project):
    def estimated(self, *options):
        done = self.allrun("--dry-run", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [line for line in done.stdout.splitlines() if line.startswith("estimate: ")]

    def setUp(self):
        super().setUp()
        # Each particle run: 1000 particles, 60000 steps, a microsecond each: a minute. ICCG grows a
        # little with their number; 0.3 s to start.
        self.write("foam_cases/tank/system/caseParameters",
                   "FoamFile { version 2.0; format ascii; class dictionary; object caseParameters; }\n"
                   "cellsPerL 20;\nendTime 1;\nmaxCo 0.5;\nwall slip;\n")
        self.write("particle/cases/case.toml",
                   CASE + "[resolution]\nspacing = 5e-4\n[time]\nend = 1.0\ncourant = 0.2\n")
        preset = "[mps]\nbeta = 0.97\nppe_solver = \"iccg\"\n"
        self.write("particle/cases/presets/mps-paper.toml", preset)

    def test_new_runs_are_estimated_by_a_calibration(self):
        # 2 x 63 s; 36 x 49 cells, 420 steps: half a second, two to start; 21 s for the report
        expected = r"estimate: about [23] min on 1 core \(0 of 3 runs as long as last time, the others by"
        self.assertRegex(self.estimated("--jobs", "1")[0], expected)
        self.assertEqual(self.calls(), [])

    def test_runs_beside_each_other_share_the_cores(self):
        text = STUDY.replace("[[run]]", "[[run]]\ntimed = false")
        self.study(text)
        self.assertIn("about 90 s on 2 cores", self.estimated("--jobs", "2")[0])

    def test_what_was_made_before_is_expected_to_take_as_long(self):
        self.succeed(ran=ALL)
        self.assertEqual(self.estimated(), [])
        for name in ("first", "second", "vof"):
            stamp = next((self.root / "runs" / name).glob(".finished-*"))
            manifest = self.root / "runs" / name / "manifest.json"
            manifest.write_text('{"finished": true, "wall_s": {"total": 1800}}')
            inputs = json.loads(stamp.read_text())
            del inputs["files"]  # as an earlier version wrote them
            stamp.write_text(json.dumps(inputs))
        self.write("build/release/particle/main.cpp.o", "another step")
        self.assertRegex(self.estimated()[0], "about 60 min on .* \\(2 of 2 runs as long as last time")
        self.study(second='"title=another"')
        self.assertRegex(self.estimated()[0], "about 31 min on .* \\(1 of 2 runs as long as last time")

    def test_a_short_fall_from_rest_takes_fewer_steps(self):
        # A tenth of a second of what is told as 60000 steps of 60 m/s: never as fast as that.
        self.study(STUDY.replace('"first"\n', '"first"\nset = ["time.end=0.1"]\n'),
                   second='"time.end=0.1"')
        self.assertRegex(self.estimated("--jobs", "1")[0], "about 30 s on 1 core")

    def test_without_programs_nothing_is_claimed(self):
        self.write("broken_machine", "")
        self.assertEqual(self.estimated(), ["estimate: not possible before the programs are built"])

    def test_those_of_several_threads_begin_and_the_longest_of_the_others_follow(self):
        text = STUDY.replace("[[run]]", "[[run]]\ntimed = false")
        self.study(text.replace('"first"\n', '"first"\nset = ["time.end=0.1"]\n'))
        done = self.allrun("--jobs", "1")
        started = [line.split()[1] for line in done.stdout.splitlines() if ": started" in line]
        self.assertEqual(started, ["vof:", "second:", "first:", "report:"], done.stdout + done.stderr)

    def test_each_run_tells_what_is_left(self):
        done = self.succeed("--jobs", "1", ran=ALL)
        finished = [line for line in done.stdout.splitlines() if ": finished in " in line]
        self.assertEqual(sum("left" in line for line in finished), 2, done.stdout)
        self.assertRegex(done.stdout, r"finished in [0-9.]+ s, about (60|70|10) s left")


class Failure(Project):
    def failure(self, message, repeated=("second", "report")):
        done = self.allrun()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("second: FAILED", done.stdout)
        self.assertIn("runs/second.log", done.stdout)
        self.assertIn(message, done.stdout)
        self.assertIn("Allrun: the study is not complete", done.stderr)
        self.assertRegex(done.stderr, rf"  second: .*{message}.* \(log runs/second.log\)")
        self.assertNotIn("the short table", done.stdout)
        self.assertEqual(sorted(self.calls()), ["first", "second", "vof"])
        self.assertRegex(self.allrun("--dry-run").stdout, r"second +run +failed or stopped last time")
        self.study(STUDY)
        self.succeed(ran=repeated)

    def test_a_failed_run_shows_its_log_and_is_repeated(self):
        self.study(second='"behave=fail"')
        self.failure("case.toml:3: spacing: found 7, expected a divisor")

    def test_a_program_that_succeeds_without_finishing_has_failed(self):
        self.study(second='"behave=unfinished"')
        self.failure("")

    def test_an_end_before_time_is_a_result_only_where_the_study_says_so(self):
        self.study(second='"behave=break"')
        self.assertNotEqual(self.allrun().returncode, 0)
        self.calls()
        self.study(second='"behave=break"]\nmay_break = true #')
        done = self.succeed(ran=["second", "report"])
        self.assertIn("second: broke up", done.stdout)
        self.succeed(ran=[])

    def test_after_kill_all_the_interrupted_run_is_repeated(self):
        self.study(second='"behave=hang"')
        started = self.allrun(start=True)
        self.wait_for(lambda: "runs/second" in (self.root / "calls").read_text()
                      if (self.root / "calls").exists() else False)
        self.assertTrue(list((self.root / ".snakemake/locks").iterdir()), "no lock to be left behind")
        # first the scripts and the engine alone: the program that computes goes on
        for process in self.processes():
            command = (process / "cmdline").read_text()
            if any(name in command for name in ("Allrun", "snakemake", "work.py")):
                os.kill(int(process.name), signal.SIGKILL)
        started.wait()
        time.sleep(0.5)
        done = self.allrun()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("second: a program of an earlier study is still at work", done.stdout)
        self.end_what_is_left()
        started.communicate()
        self.calls()
        self.study(STUDY)
        self.succeed(ran=["second", "report"])

    def processes(self):
        """Those that work in this project, and no others."""
        found = []
        for process in Path("/proc").glob("[0-9]*"):
            try:
                if Path(os.readlink(process / "cwd")) == self.root:
                    found.append(process)
            except OSError:
                pass  # it has ended, or is not ours
        return found

    def end_what_is_left(self):
        for process in self.processes():
            try:
                os.kill(int(process.name), signal.SIGKILL)
            except ProcessLookupError:
                pass

    def test_a_run_of_no_steps_is_not_finished(self):
        self.study(second='"behave=nothing"')
        self.failure("")

    def test_what_a_killed_allrun_left_behind_is_not_disturbed(self):
        self.study(second='"behave=hang"')
        started = self.allrun(start=True)
        self.addCleanup(self.end_what_is_left)
        self.wait_for(lambda: (self.root / "calls").exists()
                      and "runs/second" in (self.root / "calls").read_text())
        started.kill()
        done = self.allrun()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("still at work in this folder", done.stderr)
        self.end_what_is_left()
        started.communicate()


class Schedule(Project):
    SLOW = STUDY.replace('case = "particle', 'set = ["behave=slow"]\ncase = "particle', 1)

    def most_at_once(self):
        running = most = 0
        for line in (self.root / "calls").read_text().splitlines():
            if "surge" not in line and line.startswith(("start", "end")):
                running += 1 if line.startswith("start") else -1
                most = max(most, running)
        return most

    def test_a_timed_run_is_alone_on_the_machine(self):
        self.study(self.SLOW, second='"behave=slow"')
        self.assertEqual(self.allrun("--jobs", "3").returncode, 0)
        self.assertEqual(self.most_at_once(), 1)

    def test_runs_that_are_not_timed_share_it(self):
        study = self.SLOW.replace("[[run]]", "[[run]]\ntimed = false")
        self.study(study, second='"behave=slow"')
        self.assertEqual(self.allrun("--jobs", "3").returncode, 0)
        self.assertEqual(self.most_at_once(), 2)

    def test_overrides_arrive_as_they_were_written(self):
        words = ["title=it's \\\"$HOME\\\" & {more} *", "fluid.gravity=[0.0, -9.81]"]
        self.study(STUDY.replace("{second}", ", ".join(f'"{word}"' for word in words)))
        self.assertEqual(self.allrun().returncode, 0)
        calls = (self.root / "calls").read_text()
        self.assertIn("""--set title=it's "$HOME" & {more} * --set fluid.gravity=[0.0, -9.81]""", calls)

    def test_a_foam_case_is_copied_clean_and_set_up_there(self):
        for left in ("log.interFoam", "processor0/0/U", "0.25/U", "constant/polyMesh/faces"):
            self.write(f"foam_cases/tank/{left}", "left by a run in place")
        self.assertEqual(self.allrun().returncode, 0)
        copy = self.root / "runs/vof"
        files = {str(f.relative_to(copy)) for f in copy.rglob("*")
                 if f.is_file() and not f.name.startswith(".finished")}
        self.assertEqual(files, {"Allrun", "0.orig/U", "system/caseParameters", "manifest.json"})
        self.assertRegex((copy / "system/caseParameters").read_text(), r"cellsPerL\s+7;")
        template = (self.root / "foam_cases/tank/system/caseParameters").read_text()
        self.assertIn("cellsPerL 20;", template)
        calls = (self.root / "calls").read_text()
        self.assertIn(f"foam --np 2 in {copy} with /usr/share/openfoam", calls)


if __name__ == "__main__":
    unittest.main()
