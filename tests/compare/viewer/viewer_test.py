"""The report's viewer in a headless Chromium. Usage: viewer_test.py BUILD_FOLDER; 77 without Chromium."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import chromium

SOURCE = Path(__file__).resolve().parents[3]
BIN = Path(sys.argv.pop(1)).resolve() / "bin"
# Debian's OpenFOAM finds itself by this.
os.environ.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
ARROW_RIGHT, END, SPACE = ("ArrowRight", 39), ("End", 35), (" ", 32, " ")


def call(*command, cwd=SOURCE):
    done = subprocess.run([str(word) for word in command], cwd=cwd, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}")


def write_report(folder):
    """A study of a few seconds with all three methods."""
    runs = folder / "runs"
    for method in ("mps", "sph"):
        call(BIN / "surge-particle", "run", "particle/cases/dam_break.toml", "--out", runs / method,
             "--set", f"method.name={method}", "--set", "resolution.spacing=0.0145", "--set", "time.end=0.3")
    shutil.copytree(SOURCE / "foam_cases/damBreak2D", runs / "vof")
    for key, value in {"cellsPerL": "10", "endTime": "0.3", "writeInterval": "0.01"}.items():
        call("foamDictionary", "system/caseParameters", "-entry", key, "-set", value, cwd=runs / "vof")
    call("./Allrun", cwd=runs / "vof")
    study = ('title = "Viewer"\nreference = "vof"\nstrip_height = 0.0435\nsnapshot_times = [0.1, 0.3]\n'
             'published = ["martin_moyce_1952_2.25in"]\n')
    for method in ("mps", "sph"):
        study += (f'[[run]]\nname = "{method}"\nprogram = "surge-particle"\ncase = "particle/cases/dam_break.toml"\n'
                  f'set = ["method.name={method}", "resolution.spacing=0.0145", "time.end=0.3"]\n')
    study += ('[[run]]\nname = "vof"\nprogram = "interFoam"\ncase = "foam_cases/damBreak2D"\n'
              'set = ["cellsPerL=10", "endTime=0.3", "writeInterval=0.01"]\n')
    (folder / "study.toml").write_text(study)
    call(BIN / "surge-compare", "report", "--study", folder / "study.toml", "--runs", runs, "--series",
         SOURCE / "compare/reference", "--out", folder / "report")


class Viewer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        write_report(Path(folder.name))
        cls.page = Path(folder.name) / "report/index.html"
        cls.metrics = json.loads((cls.page.parent / "metrics.json").read_text(encoding="utf-8"))
        cls.browser = chromium.Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.width(1200)
        self.browser.complaints.clear()
        self.seconds = self.browser.open(self.page.as_uri())

    def tearDown(self):
        self.browser.js("1")  # what was said until now has arrived
        self.assertEqual(self.browser.complaints, [])

    def cursor(self):
        return float(self.browser.js("document.querySelector('.viewer-cursor').getAttribute('x1')"))

    def frame(self):
        return int(self.browser.js("document.querySelector('.viewer-slider').value"))

    def panels(self):
        return self.browser.js("[...document.querySelectorAll('.viewer-panel canvas')].map(c => c.toDataURL())")

    def drag(self, frame):
        self.browser.js("{const s = document.querySelector('.viewer-slider');"
                        f"s.value = {frame}; s.dispatchEvent(new Event('input'))}}")

    def test_it_opens_quickly_and_is_not_large(self):
        self.assertLess(self.page.stat().st_size, 15e6)
        self.assertLess(self.seconds, 2.0)

    def test_the_slider_moves_all_panels_and_the_cursor(self):
        before, cursor = self.panels(), self.cursor()
        self.assertEqual(len(before), 3)
        self.drag(20)
        for old, new in zip(before, self.panels()):
            self.assertNotEqual(old, new)
        self.assertGreater(self.cursor(), cursor + 50)
        time = self.metrics["viewer"]["times_s"][20]
        self.assertIn(f"t = {time:.3f} s", self.browser.js(
            "document.querySelector('.viewer-slider').getAttribute('aria-valuetext')"))

    def test_numbers_shown_are_those_of_the_metrics(self):
        self.drag(12)
        shown = self.browser.js("[...document.querySelectorAll('#viewer-root data')]"
                                ".map(d => [d.dataset.key, d.textContent])")
        self.assertGreaterEqual(len(shown), 7)
        for key, text in shown:
            value = self.metrics
            for part in key.strip("/").split("/"):
                value = value[int(part)] if isinstance(value, list) else value[part]
            decimals = len(text.split(".")[1]) if "." in text else 0
            self.assertAlmostEqual(float(text), value, delta=0.5001 * 10**-decimals, msg=key)

    def test_keys(self):
        self.browser.js("document.querySelector('.viewer-slider').focus()")
        self.browser.press(*ARROW_RIGHT)
        self.browser.press(*ARROW_RIGHT)
        self.assertEqual(self.frame(), 2)
        self.browser.press(*SPACE)
        playing = "document.querySelector('.viewer-play').textContent"
        self.assertEqual(self.browser.js(playing), "Pause")
        self.browser.press(*SPACE)
        self.assertEqual(self.browser.js(playing), "Play")
        self.browser.press(*END)
        self.assertEqual(self.frame(), len(self.metrics["viewer"]["times_s"]) - 1)

    def test_colour_and_interface_change_what_is_drawn(self):
        self.drag(15)
        pressure = self.panels()
        self.browser.js("document.querySelector('.viewer-surface').click()")
        line = self.panels()
        # Over the particles on demand; on the mesh it is always there.
        self.assertEqual([a != b for a, b in zip(pressure, line)], [True, True, False])
        self.browser.js("{const f = document.querySelector('.viewer-field');"
                        "f.value = 'speed'; f.dispatchEvent(new Event('change'))}")
        self.assertTrue(all(a != b for a, b in zip(line, self.panels())))

    def test_the_page_is_no_wider_than_its_window(self):
        for width in (1200, 400):
            with self.subTest(width):
                self.browser.width(width)
                self.browser.open(self.page.as_uri())
                page, inside, window = self.browser.js(
                    "[document.documentElement.scrollWidth, document.documentElement.clientWidth,"
                    " window.innerWidth]")
                self.assertEqual(window, width)
                self.assertLessEqual(page, inside)  # the window less its scroll bar

    def test_a_narrow_window_stacks_the_panels(self):
        self.browser.width(400)
        self.browser.open(self.page.as_uri())
        lefts = self.browser.js("[...document.querySelectorAll('.viewer-panel')]"
                                ".map(p => p.getBoundingClientRect().left)")
        self.assertEqual(len(set(lefts)), 1)

    def test_without_script_there_are_the_still_figures(self):
        self.browser.call("Emulation.setScriptExecutionDisabled", value=True)
        try:
            self.browser.open(self.page.as_uri() + "?still")
            state = self.browser.js("[document.getElementById('viewer-root').hidden,"
                                    "document.querySelector('.viewer-still').hidden,"
                                    "!!document.querySelector('#fig7 svg')]")
        finally:
            self.browser.call("Emulation.setScriptExecutionDisabled", value=False)
        self.assertEqual(state, [True, False, True])


if __name__ == "__main__":
    if chromium.PROGRAM is None:
        print("skipped: chromium is not installed")
        sys.exit(77)
    unittest.main()
