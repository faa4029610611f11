"""Tests of tests/benchmark/run on small documents of Google Benchmark's format."""

import importlib.machinery
import importlib.util
import io
import json
import tempfile
import unittest
from pathlib import Path

loader = importlib.machinery.SourceFileLoader("run", str(Path(__file__).with_name("run")))
run = importlib.util.module_from_spec(importlib.util.spec_from_loader("run", loader))
loader.exec_module(run)

HERE = {"cpu": "Some CPU @ 3 GHz", "host": "here", "cores": 2}
THERE = {"cpu": "Other CPU", "host": "there", "cores": 8}


def entry(name, time, kind="median", **counters):
    return {"name": f"{name}_{kind}", "run_name": name, "run_type": "aggregate",
            "aggregate_name": kind, "real_time": time, "cpu_time": time, "time_unit": "ms", **counters}


def step(rate):
    return entry("sph_step/fluid:2000/threads:1/iterations:9/repeats:3/real_time", 2.0,
                 **{"particle_steps/s": rate, "flops/particle": 2000.0,
                    "bytes_moved/particle": 500.0, "pairs/s": 1e8})


def machine_limits(flops, width):
    return [entry("multiply_add/threads:1/repeats:5/real_time", 1.0, **{"flops/s": flops}),
            entry("triad/threads:1/repeats:5/real_time", 1.0, **{"bytes/s": width})]


def store_result(store, machine, rate, date="2026-01-01T00:00:00Z"):
    folder = store / run.folder_name(machine)
    folder.mkdir(parents=True, exist_ok=True)
    results = run.results_of({"benchmarks": [step(rate)]})
    (folder / f"{date}.json").write_text(json.dumps(
        {"machine": machine, "date": date, "commit": "abc", "results": results}))


def table(results, before=None, others=0):
    out = io.StringIO()
    run.print_table(results, before, others, out)
    return out.getvalue()


class RunTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.store = Path(folder.name)

    def test_takes_medians_and_strips_what_changes(self):
        results = run.results_of({"benchmarks": [entry("a/2/repeats:3/real_time", 9.0, "mean"),
                                                 entry("a/2/repeats:3/real_time", 5.0)]})
        self.assertEqual(results["a/2"]["real_time"], 5.0)
        self.assertEqual(list(results), ["a/2"])

    def test_a_failed_benchmark_is_no_result(self):
        with self.assertRaisesRegex(SystemExit, "not converged"):
            run.results_of({"benchmarks": [{"name": "a", "run_name": "a", "run_type": "iteration",
                                            "error_occurred": True,
                                            "error_message": "not converged"}]})

    def test_the_tighter_limit_bounds(self):
        for flops, width, word, share in ((1e10, 1e10, "arithmetic", "40 %"),
                                          (1e12, 1e9, "memory", "100 %")):
            results = run.results_of({"benchmarks": [*machine_limits(flops, width), step(2e6)]})
            self.assertIn(f"{share} of {word}", table(results))

    def test_no_bound_without_the_limits_of_as_many_threads(self):
        two = step(2e6)
        two["run_name"] = two["run_name"].replace("threads:1", "threads:2")
        results = run.results_of({"benchmarks": [*machine_limits(1e10, 1e10), two]})
        self.assertNotIn("% of", table(results))

    def test_compares_with_the_last_result_of_this_machine(self):
        store_result(self.store, HERE, 1e6, "2026-01-01T00:00:00Z")
        store_result(self.store, HERE, 2e6, "2026-01-02T00:00:00Z")
        before, others = run.previous_results(self.store, HERE)
        text = table(run.results_of({"benchmarks": [step(3e6)]}), before, others)
        self.assertIn("x 1.50", text)
        self.assertIn("2026-01-02", text)
        self.assertNotIn("not comparable", text)

    def test_other_machines_are_not_comparable(self):
        store_result(self.store, THERE, 1e6)
        before, others = run.previous_results(self.store, HERE)
        self.assertIsNone(before)
        text = table(run.results_of({"benchmarks": [step(3e6)]}), before, others)
        self.assertIn("1 stored results of other machines: not comparable", text)
        self.assertNotIn("x 3", text)

    def test_a_result_copied_from_elsewhere_is_not_taken_for_ours(self):
        store_result(self.store, THERE, 1e6)
        (self.store / run.folder_name(THERE)).rename(self.store / run.folder_name(HERE))
        self.assertEqual(run.previous_results(self.store, HERE), (None, 1))

    def test_prints_what_is_serial_and_how_a_busy_neighbour_is_borne(self):
        results = run.results_of({"benchmarks": [
            entry("preset_step/m/3D/threads:2", 1.0, neighbours=112.4, serial_fraction=0.05,
                  efficiency=0.952, efficiency_at_16=0.571),
            entry("busy_neighbour/m", 1.0, threads_over_one=1.234)]})
        step_row, busy_row = table(results).splitlines()[1:3]
        self.assertEqual(step_row.split()[-4:], ["112", "0.95", "0.050", "0.57"])
        self.assertEqual(busy_row.split()[-1], "1.23")

    def test_warns_of_a_shared_processor(self):
        busy = step(1e6)
        busy["cpu_time"] = 1.0
        self.assertIn("processor was shared", table(run.results_of({"benchmarks": [busy]})))
        self.assertNotIn("shared", table(run.results_of({"benchmarks": [step(1e6)]})))


if __name__ == "__main__":
    unittest.main()
