"""The report's viewer in a headless Chromium. Usage: viewer_test.py BUILD_FOLDER; 77 without Chromium."""

import sys
import time
import unittest

import chromium
from made_report import Page
from page_checks import Figures, Reading  # noqa: F401  its tests run here too, on the same report
from space_checks import Blind, Space  # noqa: F401

ARROW_RIGHT, END, SPACE = ("ArrowRight", 39), ("End", 35), (" ", 32, " ")


class Viewer(Page):
    def cursor(self):
        return float(self.browser.js("document.querySelector('.viewer-cursor').getAttribute('x1')"))

    def frame(self):
        return int(self.browser.js("document.querySelector('.viewer-slider').value"))

    def panels(self):
        return self.browser.js("[...document.querySelectorAll('.viewer-panel canvas')].map(c => c.toDataURL())")

    def drag(self, frame):
        self.browser.js("{const s = document.querySelector('.viewer-slider');"
                        f"s.value = {frame}; s.dispatchEvent(new Event('input'))}}")

    def test_it_is_not_large(self):
        self.assertLess(self.page.stat().st_size, 5e6)

    def test_places_come_back_within_a_128th_of_the_spacing(self):
        # At the start the column is a lattice, of which every place is known.
        spacing = 0.0145 / 0.145
        self.assertEqual(self.metrics["viewer"]["position_error_over_spacing"], 1 / 128)
        for run in (0, 1):
            x, y = self.browser.js(f"['x', 'y'].map((a) => Array.from(surgeViewer.runs[{run}].whole[a].slice(0,"
                                   f" surgeViewer.runs[{run}].whole.starts[1])))")
            self.assertEqual(len(x), 200)
            wanted = sorted(((i + 0.5) * spacing, (j + 0.5) * spacing) for i in range(10) for j in range(20))
            found = sorted(zip((round(a / spacing - 0.5) for a in x), (round(b / spacing - 0.5) for b in y), x, y))
            for (right, up), (_, _, a, b) in zip(wanted, found):
                self.assertLessEqual(max(abs(a - right), abs(b - up)), spacing / 128 + 1e-6)
        # The mesh's water is as much as the column.
        water = self.browser.js("{const w = surgeViewer.runs[2].whole; let sum = 0;"
                                " for (let i = 0; i < w.starts[1]; ++i) sum += w.fraction[i] / 255 * (2 * w.half) ** 2; sum}")
        self.assertAlmostEqual(water, 2.0, delta=0.01)

    def test_without_decompression_the_still_figures_stay(self):
        script = self.browser.call("Page.addScriptToEvaluateOnNewDocument", source="delete window.DecompressionStream")
        try:
            self.browser.open(self.page.as_uri() + "?old")
            root, still = self.browser.js("[document.getElementById('viewer-root').hidden,"
                                          " document.querySelector('.viewer-still').textContent]")
        finally:
            self.browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script["identifier"])
        self.assertTrue(root)
        self.assertIn("DecompressionStream", still)

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
        # It is there at first, on the mesh always.
        self.assertEqual([a != b for a, b in zip(pressure, line)], [True, True, False])
        self.browser.js("{const f = document.querySelector('.viewer-field');"
                        "f.value = 'speed'; f.dispatchEvent(new Event('change'))}")
        self.assertTrue(all(a != b for a, b in zip(line, self.panels())))

    def choose(self, name, value):
        self.browser.js(f"{{const s = document.querySelector('.viewer-{name}'); s.value = '{value}';"
                        "s.dispatchEvent(new Event('change'))}")

    def test_all_frames_from_the_first(self):
        self.assertEqual(self.frame(), 0)
        self.assertEqual(self.metrics["viewer"]["times_s"][0], 0.0)
        self.assertEqual(len(self.metrics["viewer"]["times_s"]), self.metrics["viewer"]["frames_of_the_runs"])
        self.assertTrue(self.browser.js("document.querySelector('.viewer-surface').checked"))

    def test_space_plays_wherever_the_focus_is_but_in_a_control_that_needs_it(self):
        playing = "document.querySelector('.viewer-play').textContent"
        self.browser.js("document.querySelector('nav a').focus()")
        self.browser.press(*SPACE)
        self.assertEqual(self.browser.js(playing), "Pause")
        self.browser.press(*SPACE)
        self.assertEqual(self.browser.js(playing), "Play")
        self.browser.js("document.querySelector('.viewer-field').focus()")
        self.browser.press(*SPACE)
        self.assertEqual(self.browser.js(playing), "Play")

    def test_plays_at_the_speed_that_it_states(self):
        self.choose("speed", "0.05")
        self.browser.js("document.querySelector('.viewer-play').click()")
        begin = time.monotonic()
        time.sleep(2.0)
        frame = self.frame()
        seconds = time.monotonic() - begin
        self.browser.js("document.querySelector('.viewer-play').click()")
        # A loaded machine may draw late, but never ahead.
        self.assertLessEqual(self.metrics["viewer"]["times_s"][frame], 0.05 * seconds + 0.011)
        self.assertGreater(frame, 2)

    def test_two_runs_side_by_side_and_over_each_other(self):
        self.drag(15)
        self.choose("mode", "two")
        self.assertEqual(len(self.panels()), 2)
        self.choose("mode", "over")
        over = self.panels()
        self.assertEqual(len(over), 1)
        self.choose("second", "1")
        self.assertNotEqual(over, self.panels())
        label = self.browser.js("document.querySelector('.viewer-panel canvas').getAttribute('aria-label')")
        self.assertIn("under the surface of", label)
        self.assertIn("Z/L = ", label)

    def test_zoom(self):
        self.drag(15)
        whole = self.panels()
        self.browser.js("document.querySelector('.viewer-closer').click()")
        self.assertNotEqual(whole, self.panels())
        self.browser.js("document.querySelector('.viewer-whole').click()")
        self.assertEqual(whole, self.panels())

    def test_a_frame_becomes_a_picture(self):
        self.drag(10)
        saved = self.browser.js("{const p = surgeViewer.picture(); p.toDataURL('image/png').slice(0, 22)"
                                " + ' ' + p.width + ' ' + p.height}").split()
        self.assertEqual(saved[0], "data:image/png;base64,")
        self.assertGreater(int(saved[1]), 400)
        self.assertGreater(int(saved[2]), 150)

    def test_the_page_is_no_wider_than_its_window(self):
        for width in (1200, 400):
            with self.subTest(width):
                self.browser.width(width)
                self.open(self.page.as_uri())
                page, inside, window = self.browser.js(
                    "[document.documentElement.scrollWidth, document.documentElement.clientWidth,"
                    " window.innerWidth]")
                self.assertEqual(window, width)
                self.assertLessEqual(page, inside)  # the window less its scroll bar

    def test_a_narrow_window_stacks_the_panels(self):
        self.browser.width(400)
        self.open(self.page.as_uri())
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
