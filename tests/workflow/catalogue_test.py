"""Allrun --catalogue: every study of a list with a report of its own, and the page that sums them up.

Usage: catalogue_test.py BUILD_FOLDER PART
"""

import json
import math
import subprocess
import sys
import unittest

from project import COMPARE, REAL_COMPARE, SOURCE, STUDY, Project

sys.path.insert(0, str(SOURCE / "compare/studies"))
import catalogue  # noqa: E402
import catalogue_plots as plots  # noqa: E402


def measure(run, reference, tolerance, unit="Pa", verdict="not decidable"):
    return {"unit": unit, "run": run, "reference": reference, "E": run - reference, "U": None, "u_data": 0.1,
            "tolerance": tolerance, "verdict": verdict, "why": ""}


def metrics(values):
    """As a report has them: a peak of each run against one experiment, 2 Pa."""
    told = {run: {"program": "surge-particle", "settings": ["method.name=" + run, "method.preset=paper"]}
            for run in values}
    runs = {run: {"against": {"exp": {"label": "The <experiment>", "status": "passed", "shift_s": 0.0,
                                      "measures": {"peak": measure(value, 2.0, 0.1)}}}}
            for run, value in values.items()}
    return {"study": {"title": "T"}, "runs": told, "timing": {run: {"wall_s": 7.0} for run in values},
            "references": {"exp": {"kind": "experiment"}},
            "observables": {"p": {"title": "Pressure", "runs": runs}}}


class Shipped(unittest.TestCase):
    """What comes with the project: every study is read and held against its cases, and the catalogue is planned."""

    def test_every_study_is_read(self):
        studies = sorted((SOURCE / "compare/studies").glob("*.toml"))
        self.assertGreater(len(studies), 15)
        for study in studies:
            done = subprocess.run([REAL_COMPARE, "study", study], cwd=SOURCE, text=True, check=False,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            self.assertEqual(done.returncode, 0, f"{study.name}: {done.stdout}")

    def test_the_levels_of_a_plane_flow_give_what_is_compared_an_uncertainty(self):
        for name in catalogue.names(SOURCE / "compare/studies/catalogue.txt"):
            done = subprocess.run([REAL_COMPARE, "study", f"compare/studies/{name}.toml", "--json", "-"], cwd=SOURCE,
                                  capture_output=True, text=True, check=True)
            told = json.loads(done.stdout)
            if any(run["resolved"]["case"].get("dimension", 2) == 3 for run in told["runs"]):
                continue  # of one resolution, as its page says
            settings = {run["name"]: run["settings"] for run in told["runs"]}
            for notice in told["notices"]:
                for run in notice.split(": ")[0].split(", "):
                    self.assertIn("method.preset=paper", settings[run], f"{name}: {notice}")


class Sums(unittest.TestCase):
    def rows(self, values):
        return catalogue._rows("flow", metrics(values), set(values))

    def test_bias_and_scatter_are_those_of_the_logarithm_of_computed_over_measured(self):
        rows = self.rows({"mps": 4.0}) + self.rows({"mps": 2.0}) + self.rows({"sph": 1.0})
        found = catalogue.statistics(rows)
        self.assertEqual(set(found), {"mps paper", "sph paper"})
        self.assertEqual(found["mps paper"]["points"], 2)
        self.assertAlmostEqual(found["mps paper"]["bias"], math.sqrt(2.0), places=14)
        self.assertAlmostEqual(found["mps paper"]["scatter"], math.log(2.0) / math.sqrt(2.0), places=14)
        self.assertAlmostEqual(found["sph paper"]["bias"], 0.5, places=14)
        self.assertIsNone(found["sph paper"]["scatter"])

    def test_what_is_no_value_against_an_experiment_has_no_ratio(self):
        row = self.rows({"mps": 4.0})[0]
        self.assertEqual(catalogue._ratio(row), 2.0)
        for change in ({"kind": "theory"}, {"measure": "rms"}, {"measured": 0.0}, {"computed": None},
                       {"computed": -1.0}):
            self.assertIsNone(catalogue._ratio(row | change), change)

    def test_what_all_methods_miss_is_told_and_what_one_of_them_hits_is_not(self):
        missed = catalogue.missed_by_all(self.rows({"mps": 2.5, "sph": 1.7}))
        self.assertEqual(len(missed), 1)
        self.assertAlmostEqual(missed[0]["least"], 0.15)  # of the measured value, 2
        self.assertAlmostEqual(missed[0]["most"], 0.25)
        self.assertAlmostEqual(missed[0]["tolerance"], 0.05)
        self.assertEqual((missed[0]["side"], missed[0]["part"]), ("both", True))
        self.assertEqual(catalogue.missed_by_all(self.rows({"mps": 2.5, "sph": 2.7}))[0]["side"], "high")
        self.assertEqual(catalogue.missed_by_all(self.rows({"mps": 1.5, "sph": 1.7}))[0]["side"], "low")
        self.assertEqual(catalogue.missed_by_all(self.rows({"mps": 2.5, "sph": 2.05})), [])
        self.assertEqual(catalogue.missed_by_all(self.rows({"mps": 2.5})), [])

    def test_cpu_time_is_that_of_all_threads(self):
        self.assertIsNone(catalogue._cpu_seconds(None))
        self.assertIsNone(catalogue._cpu_seconds({"threads": 2}))
        self.assertEqual(catalogue._cpu_seconds({"wall_s": 3.0, "threads": 2}), 6.0)
        self.assertEqual(catalogue._cpu_seconds({"wall_s": 3.0, "threads": 2, "cpu_s": 5.0}), 5.0)
        # The log of interFoam has the time of its first process.
        self.assertEqual(catalogue._cpu_seconds({"wall_s": 3.0, "threads": 2, "cpu_s": 2.5, "cells": 9}), 5.0)

    def test_errors_of_a_flow_are_those_against_data_before_those_against_a_run(self):
        def row(run, kind, error, measure="rms"):
            return {"run": run, "method": "m", "kind": kind, "quantity": "h", "title": "Level", "against": kind,
                    "label": kind, "unit": "m", "tolerance": 0.1, "measure": measure, "E": error, "U": None}
        rows = [row("a", "run", 0.3), row("a", "experiment", 9.0, "peak"), row("a", "experiment", 0.2),
                row("b", "experiment", 0.1), row("b", "experiment", None)]
        found = catalogue.errors(rows, {"a": 5.0})
        self.assertEqual([(one["run"], one["E"], one["cpu_s"]) for one in found["points"]], [("a", 0.2, 5.0), ("b", 0.1, None)])
        self.assertEqual(catalogue.errors(rows[:2], {})["label"], "run")
        self.assertIsNone(catalogue.errors(rows[1:2], {}))

    def test_runs_that_are_not_compared_are_left_out(self):
        self.assertEqual(len(catalogue._rows("flow", metrics({"mps": 1.0, "sph": 2.0}), {"sph"})), 1)


class Plots(unittest.TestCase):
    def test_an_axis_is_logarithmic_and_holds_its_numbers(self):
        axis = plots.LogAxis([1.0, 100.0], 0.0, 100.0, widen=1.0)
        self.assertAlmostEqual(axis.at(10.0), 50.0)
        self.assertAlmostEqual(axis.at(1.0), 0.0)
        self.assertEqual(axis.at(1e9), 100.0)  # at the edge, not beyond
        self.assertEqual([text for _, text in axis.ticks()], ["1", "10", "100"])
        narrow = plots.LogAxis([3.0], 0.0, 1.0)
        self.assertAlmostEqual(narrow.high / narrow.low, 10.0)
        self.assertGreaterEqual(len(narrow.ticks()), 2)
        self.assertEqual([plots.tick_text(value) for value in (0.002, 1e6, 2e-5)], ["0.002", "10⁶", "2·10⁻⁵"])

    def test_every_method_has_a_look_of_its_own_and_that_of_vof_is_black(self):
        look = plots.looks({"mps improved", "sph paper", "isph shifted", "interFoam"})
        self.assertEqual(len(set(look.values())), 4)
        self.assertEqual(look["interFoam"][0], "#000000")

    def test_points_and_bars_lie_where_their_numbers_say(self):
        look = {"m": ("#000000", "circle")}
        flow = {"title": "T", "errors": {"title": "Level", "label": "data", "unit": "m", "tolerance": 0.1, "points": [
            {"run": "a", "method": "m", "E": -1.0, "U": 0.5, "cpu_s": 10.0},
            {"run": "b", "method": "m", "E": 0.01, "U": 0.5, "cpu_s": 1000.0},
            {"run": "c", "method": "m", "E": 0.01, "U": None, "cpu_s": None}]}}
        made = plots.error_over_cost(flow, look)
        self.assertEqual((len(made["points"]), len(made["bars"])), (2, 2))
        low, high = (sorted((bar["y0"], bar["y1"])) for bar in made["bars"])
        self.assertLess(low[1] - low[0], high[1] - high[0])  # of 0.01 it reaches the foot
        self.assertAlmostEqual(high[1], plots.HEIGHT - plots.BOTTOM)
        self.assertIsNone(plots.error_over_cost({"title": "T", "errors": None}, look))
        one = {"method": "m", "measured": 2.0, "computed": 2.0, "bar": 0.0, "unit": "Pa", "label": "l"}
        panels = plots.computed_over_measured([one, one | {"unit": "s", "computed": 4.0}], look)
        self.assertEqual([p["title"] for p in panels], ["Pressures", "Times"])
        self.assertEqual(panels[0]["bars"], [])


class Catalogue(Project):
    def setUp(self):
        super().setUp()
        for name in ("compare/studies/catalogue.py", "compare/studies/catalogue_plots.py", "compare/report/page/templates/catalogue.html",
                     "compare/report/page/style.css"):
            self.write(name, (SOURCE / name).read_text())
        self.write("compare/studies/catalogue.txt", "# two flows\none  # the first\n\ntwo\n")
        for name in ("one", "two"):
            self.flow(name)
        self.write("metrics.json", json.dumps(metrics({"a": 2.5, "b": 1.5})))
        self.write("build/release/bin/surge-compare", COMPARE.replace(
            'echo page >', 'sed "s/\\"a\\":/\\"$(basename "$7")-a\\":/g; s/\\"b\\":/\\"$(basename "$7")-b\\":/g" metrics.json '
            '>"$7/metrics.json"\necho page >'), executable=True)

    def flow(self, name, behave=""):
        text = STUDY.replace("{second}", behave)
        for run, its in (("first", "a"), ("second", "b"), ("vof", "vof")):
            text = text.replace(f'"{run}"', f'"{name}-{its}"')
        self.write(f"compare/studies/{name}.toml", text)

    def test_every_study_has_its_report_and_nothing_is_made_twice(self):
        done = self.allrun("--catalogue")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(sorted(self.calls()), ["one-a", "one-b", "report", "report", "two-a", "two-b", "vof", "vof"])
        self.assertLess(done.stdout.index("estimate of the catalogue: about"), done.stdout.index("one-a: started"))
        self.assertLess(done.stdout.index("one-b: finished"), done.stdout.index("two-a: started"))
        for name in ("one", "two"):
            self.assertTrue((self.root / f"catalogue/{name}/index.html").is_file())
        self.assertFalse((self.root / "report").exists())
        page = (self.root / "catalogue/index.html").read_text()
        self.assertIn('href="two/index.html"', page)
        self.assertIn("The &lt;experiment&gt;", page)
        numbers = json.loads((self.root / "catalogue/metrics.json").read_text())
        self.assertEqual(len(numbers["rows"]), 4)
        self.assertEqual([one["flow"] for one in numbers["missed_by_all"]], ["one", "two"])

        again = self.allrun("--catalogue")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(self.calls(), [])

    def test_a_study_that_fails_keeps_none_of_the_others_back(self):
        self.flow("one", '"behave=fail"')
        done = self.allrun("--catalogue")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("Allrun: not complete: one\n", done.stderr)
        self.assertEqual(sorted(self.calls()), ["one-a", "one-b", "report", "two-a", "two-b", "vof", "vof"])
        self.assertIn("not made yet", (self.root / "catalogue/index.html").read_text())
        self.flow("one")
        self.assertEqual(self.allrun("--catalogue").returncode, 0)
        self.assertEqual(sorted(self.calls()), ["one-b", "report"])

    def test_a_name_without_a_study_is_told(self):
        self.write("compare/studies/catalogue.txt", "one\nthree\n")
        done = self.allrun("--catalogue", "--dry-run")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn('found "three", expected the name of a study beside it', done.stderr)
        self.assertEqual(self.calls(), [])


if __name__ == "__main__":
    unittest.main()
