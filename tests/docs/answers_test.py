"""docs/answers: the table is what a report says, and one that is older than the physics is found."""

import contextlib
import importlib.machinery
import importlib.util
import io
import json
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
loader = importlib.machinery.SourceFileLoader("answers", str(SOURCE / "docs/answers"))
answers = importlib.util.module_from_spec(importlib.util.spec_from_loader("answers", loader))
loader.exec_module(answers)


def entry(label, run, rms):
    return {"label": label, "run": run, "rms": rms}


def front(impact, u):
    return {"impact_time_s": impact, "impact_u_s": u}


def verdict(e, u, outcome):
    return {"leading_edge": {"vof": {"E": e, "U": u, "verdict": outcome}}}


def provenance(commit, threads=1):
    return {"commit": commit, "cpu": "Some processor", "threads": threads, "started": "2026-03-04T05:06:07Z"}


def metrics(commit="0123456789ab"):
    return {
        "study": {"title": "Dam break", "reference": "vof"},
        "summary": {"asked": 3, "complete": 3, "reference_label": "VOF slip, 40 cells per L",
                    "methods": {"mps": entry("MPS paper", "a", 0.08), "sph": None},
                    "beyond": {"mps": entry("MPS improved", "b", 0.031)}},
        "front": {"a": front(0.2512, 0.00144), "b": front(None, None), "vof": front(0.25, 0.001)},
        "verdicts": {"runs": {"a": verdict(0.08, 0.012, "differs"), "b": verdict(0.031, None, "not decidable")}},
        "timing": {"a": {"wall_s": 12.34}, "b": {"wall_s": 150.0}, "vof": {"wall_s": 61.0}},
        "provenance": {"runs": {"a": provenance(commit), "b": provenance(commit, 2), "vof": provenance(None)}},
    }


README = f"# Title\n\n{answers.BEGIN}\nold\n{answers.END}\n\nmore\n"


class Table(unittest.TestCase):
    def test_rows_are_the_reports_nearest_first(self):
        lines = answers.table(metrics()).splitlines()
        self.assertEqual(lines[2:5], [
            "| MPS improved | 0.031, ± not known | not decidable | - | 2.5 min |",
            "| MPS paper | 0.080 ± 0.012 | differs | 0.251 ± 0.003 | 12.3 s |",
            "| VOF slip, 40 cells per L | 0 | the reference | 0.250 ± 0.002 | 1.0 min |"])
        for said in ("“Dam break”", "2026-03-04", "commit 0123456789ab", "Some processor", "1 or 2 threads a run"):
            self.assertIn(said, lines[-1])

    def test_it_goes_between_the_marks_and_nowhere_else(self):
        text = answers.written(README, "new")
        self.assertEqual(text, README.replace("old", "new"))
        for broken in ("# Title\n", README + README, f"{answers.END}\n{answers.BEGIN}"):
            with self.assertRaises(answers.AnswersError):
                answers.written(broken, "new")

    def test_what_is_not_of_a_clean_commit_or_not_complete_is_refused(self):
        for fault in (metrics("0123456789ab-dirty"), metrics("unknown")):
            with self.assertRaisesRegex(answers.AnswersError, "expected commits without changes"):
                answers.table(fault)
        unfinished = metrics()
        unfinished["summary"]["complete"] = 2
        with self.assertRaisesRegex(answers.AnswersError, "found 2 of 3 runs complete"):
            answers.table(unfinished)


class Age(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.root = Path(place.name)
        (self.root / "particle/sph").mkdir(parents=True)
        self.git("init", "--quiet")
        self.write("particle/sph/momentum.cpp", "a\n")
        self.write("README.md", README)
        self.commit()

    def git(self, *words):
        return subprocess.run(["git", "-C", str(self.root), "-c", "user.name=n", "-c", "user.email=e@x", *words],
                              text=True, capture_output=True, check=True).stdout.strip()

    def write(self, name, text):
        (self.root / name).write_text(text, encoding="utf-8")

    def commit(self):
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message=x")

    def check(self):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            status = answers.main(["--check"], self.root)
        return status, said.getvalue()

    def test_a_table_is_too_old_where_physics_has_changed_since(self):
        self.assertEqual(self.check()[0], 77)  # no table yet
        self.write("README.md", answers.written(README, answers.table(metrics(self.git("rev-parse", "HEAD")[:12]))))
        self.commit()
        self.assertEqual(self.check()[0], 0)
        self.write("other.cpp", "not physics\n")
        self.commit()
        self.assertEqual(self.check()[0], 0)
        self.write("particle/sph/momentum.cpp", "b\n")
        status, said = self.check()
        self.assertEqual(status, 1)
        self.assertIn("particle/sph/momentum.cpp", said)
        self.commit()
        self.assertEqual(self.check()[0], 1)

    def test_a_commit_that_is_not_there_cannot_be_told(self):
        self.write("README.md", answers.written(README, answers.table(metrics("0" * 12))))
        self.assertEqual(self.check()[0], 77)

    def test_an_error_is_a_line_and_leaves_the_readme(self):
        (self.root / "report").mkdir()
        self.write("report/metrics.json", json.dumps(metrics()))
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(answers.main([str(self.root / "report")], self.root), 1)
        self.assertIn("surge-compare: not there, and it makes the film", said.getvalue())
        self.assertEqual((self.root / "README.md").read_text(encoding="utf-8"), README)

    def program(self, size, status=0):
        """Stands for surge-compare: writes a file of that size to what follows --out."""
        program = self.root / "surge-compare"
        program.write_text(f"""#!/bin/bash
[[ $1 == movie && $2 == s.toml && $4 == r ]] || exit 9
while [[ $1 != --out ]]; do shift; done
head -c {size} /dev/zero >"$2"
echo went wrong >&2
exit {status}
""", encoding="utf-8")
        program.chmod(0o755)
        return program

    def test_the_film_is_what_surge_compare_makes_if_it_is_small(self):
        out = self.root / "images/film.gif"
        answers.film(Path("s.toml"), Path("r"), out, self.program(1000))
        self.assertEqual(out.stat().st_size, 1000)
        for program, said in ((self.program, "went wrong"), (None, "found 2000001 bytes, expected at most 2000000")):
            made = program(1, 1) if program else self.program(2_000_001)
            with self.assertRaisesRegex(answers.AnswersError, said):
                answers.film(Path("s.toml"), Path("r"), out, made)
            self.assertEqual(out.stat().st_size, 1000)

    def test_the_readmes_film_is_there_and_small(self):
        readme = (SOURCE / "README.md").read_text(encoding="utf-8")
        self.assertIn(f"]({answers.FILM})", readme)
        picture = (SOURCE / answers.FILM).read_bytes()
        self.assertEqual(picture[:6], b"GIF89a")
        self.assertLessEqual(len(picture), answers.MOST_BYTES)


class Folders(unittest.TestCase):
    def test_what_counts_as_physics_is_there(self):
        for name in answers.PHYSICS:
            self.assertTrue((SOURCE / name).exists(), name)


if __name__ == "__main__":
    unittest.main()
