"""The page of a report as it is read: narrow, dark, printed, by keyboard; its figures, its curves, its data."""

import base64
import io
import re
import zipfile

from made_report import Page

# Pairs of texts of one drawing that lie over each other, and those that leave it. A text that stands twice at one
# place is gnuplot's way to draw a box behind it.
TEXTS = r"""
(() => {
  const found = [];
  for (const svg of document.querySelectorAll("figure svg")) {
    const whole = svg.getBoundingClientRect(), name = svg.closest("figure").id;
    const texts = [...svg.querySelectorAll("text")].filter((t) => t.textContent.trim()).map((t) => {
      const box = t.getBoundingClientRect();
      // The box of a text is higher than its letters.
      const inset = 0.18 * Math.min(box.width, box.height);
      return {text: t.textContent.trim(), box, left: box.left + inset / 3, right: box.right - inset / 3,
        top: box.top + inset, bottom: box.bottom - inset};
    });
    texts.forEach((a, i) => {
      if (a.box.left < whole.left - 1 || a.box.right > whole.right + 1 || a.top < whole.top - 1 || a.bottom > whole.bottom + 1)
        found.push([name, "clipped", a.text]);
      for (const b of texts.slice(0, i)) {
        const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
        const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        const same = a.text === b.text && Math.abs(a.left - b.left) < 1 && Math.abs(a.top - b.top) < 1;
        if (wide > 1 && high > 1 && !same) found.push([name, "overlap", a.text, b.text]);
      }
    });
  }
  return found;
})()
"""

# Contrast of each text with its ground, WCAG 2.1; the ground is the first colour that is not transparent.
CONTRAST = r"""
(() => {
  const parts = (colour) => (colour.match(/[\d.]+/g) || []).map(Number);
  const light = ([r, g, b]) => [r, g, b].map((c) => c / 255).map((s) => s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4)
    .reduce((sum, s, i) => sum + s * [0.2126, 0.7152, 0.0722][i], 0);
  const ground = (node) => {
    for (let at = node; at && at.nodeType === 1; at = at.parentElement) {
      const c = parts(getComputedStyle(at).backgroundColor);
      if (c.length === 3 || c[3] > 0) return c;
    }
    return [255, 255, 255];
  };
  const poor = [];
  for (const node of document.querySelectorAll("h1, h2, h3, p, td, th, a, caption, figcaption, summary, li, label, button, svg text")) {
    if (!node.getClientRects().length || !node.textContent.trim() || node.disabled) continue;
    const svg = node.closest("svg");
    const ink = parts(svg ? getComputedStyle(node).fill : getComputedStyle(node).color);
    const [a, b] = [light(ink), light(svg ? ground(svg) : ground(node))].sort((x, y) => y - x);
    if ((a + 0.05) / (b + 0.05) < 4.5) poor.push([node.localName, node.textContent.trim().slice(0, 40), ink.join(), ((a + 0.05) / (b + 0.05)).toFixed(2)]);
  }
  return poor.slice(0, 10);
})()
"""


class Reading(Page):
    def tearDown(self):
        super().tearDown()
        self.browser.call("Emulation.setEmulatedMedia", features=[])

    def test_the_answer_comes_first_and_needs_no_scrolling(self):
        bottom = self.browser.js("document.querySelector('.answer').getBoundingClientRect().bottom")
        self.assertLess(bottom, 900)
        rows = self.browser.js("document.querySelectorAll('#summary tbody tr').length")
        self.assertEqual(rows, 3)

    def test_a_narrow_window_has_no_endless_table(self):
        self.browser.width(400)
        self.open(self.page.as_uri())
        self.browser.js("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
        high = self.browser.js("[...document.querySelectorAll('table')].map((t) => [t.caption.textContent,"
                               " t.getBoundingClientRect().height / t.rows.length])")
        for caption, height in high:
            self.assertLess(height, 420, caption)  # of a row

    def test_a_narrow_window_shows_the_whole_answer(self):
        self.browser.width(400)
        self.open(self.page.as_uri())
        beyond = self.browser.js("""(() => {
          const cell = document.querySelector('.rows tbody td:last-child'), text = document.createRange();
          cell.append(' on two threads, with other runs beside it');
          text.selectNodeContents(cell);
          return text.getBoundingClientRect().right - window.innerWidth;
        })()""")
        self.assertLessEqual(beyond, 0)

    def test_texts_have_contrast_in_light_and_dark(self):
        for scheme in ("light", "dark"):
            with self.subTest(scheme):
                self.browser.call("Emulation.setEmulatedMedia",
                                  features=[{"name": "prefers-color-scheme", "value": scheme}])
                self.assertEqual(self.browser.js(CONTRAST), [])

    def test_print_is_short_and_leaves_out_what_is_folded(self):
        pdf = base64.b64decode(self.browser.call("Page.printToPDF", printBackground=True)["data"])
        self.assertLessEqual(len(re.findall(rb"/Type\s*/Page\b", pdf)), 12)
        self.browser.call("Emulation.setEmulatedMedia", media="print")
        try:
            folded = self.browser.js("document.querySelector('#provenance').getClientRects().length")
        finally:
            self.browser.call("Emulation.setEmulatedMedia", media="")
        self.assertEqual(folded, 0)

    def test_landmarks_headings_and_names(self):
        state = self.browser.js(
            "({main: document.querySelectorAll('main').length, nav: document.querySelectorAll('nav[aria-label]').length,"
            " unnamed: [...document.querySelectorAll('main > section')].filter((s) => !s.getAttribute('aria-label') &&"
            "   !document.getElementById(s.getAttribute('aria-labelledby'))).map((s) => s.id),"
            " silent: [...document.querySelectorAll('[role=img]')].filter((i) => (i.getAttribute('aria-label') || '').length < 12)"
            "   .map((i) => i.closest('figure, .viewer').id),"
            " nameless: [...document.querySelectorAll('button, select, input')].filter((c) => !c.textContent.trim() &&"
            "   !c.getAttribute('aria-label') && !c.labels.length).length})")
        self.assertEqual(state, {"main": 1, "nav": 1, "unnamed": [], "silent": [], "nameless": 0})

    def test_the_alternative_text_of_a_figure_gives_its_result(self):
        said = self.browser.js("document.querySelector('#fig8 svg').getAttribute('aria-label')")
        for run in ("mps", "sph"):
            self.assertIn(f"{self.metrics['front'][run]['rms_vs_vof']:.3f}", said)

    def test_tab_reaches_the_answer_the_viewer_and_the_folded_parts(self):
        seen = set()
        for _ in range(300):
            self.browser.press("Tab", 9)
            seen.add(self.browser.js("(() => { const a = document.activeElement; return a.className || a.localName; })()"))
        for name in ("skip", "viewer-play", "viewer-slider", "viewer-mode", "summary"):
            self.assertIn(name, seen)

    def test_a_link_opens_what_is_folded(self):
        self.browser.js("document.querySelector('nav a[href=\"#verdicts\"]').click()")
        self.assertTrue(self.browser.js("new Promise((done) => setTimeout(() => done("
                                        "document.querySelector('#verdicts details').open), 100))"))
        self.open(self.page.as_uri() + "?again#verdicts")
        self.assertTrue(self.browser.js("document.querySelector('#verdicts details').open"))

    def test_all_data_come_as_one_archive(self):
        address = self.browser.js("document.querySelector('a.download').href")
        kind, data = address.split(",", 1)
        self.assertEqual(kind, "data:application/zip;base64")
        with zipfile.ZipFile(io.BytesIO(base64.b64decode(data))) as stored:
            self.assertIsNone(stored.testzip())
            self.assertEqual(stored.read("figures/fig8.csv"), (self.page.parent / "figures/fig8.csv").read_bytes())
            self.assertIn("metrics.json", stored.namelist())


class Figures(Page):
    def test_no_text_lies_over_another_or_leaves_its_drawing(self):
        # 85 mm and 170 mm, a journal's columns; a drawing has one layout, so that a size changes its letters too.
        for width in (321, 643):
            with self.subTest(width):
                self.browser.js("{const s = document.createElement('style'); s.textContent ="
                                f"'figure svg {{ width: {width}px !important; min-width: 0 !important; }}';"
                                "document.head.append(s)}")
                self.assertEqual(self.browser.js(TEXTS), [])

    def test_no_file_is_empty_and_what_is_not_drawn_says_why(self):
        missing = self.browser.js("[...document.querySelectorAll('figure.elsewhere')].map((f) => [f.id, f.textContent])")
        self.assertIn("fig9", [name for name, _ in missing])
        for name, text in missing:
            self.assertFalse((self.page.parent / f"figures/{name}.svg").exists(), name)
            self.assertGreater(len(text), 40)
        self.assertIn("./Allrun --study compare/studies/timing.toml", dict(missing)["fig9"])

    def test_curves_can_be_looked_at_closely(self):
        self.browser.js("document.querySelector('#fig8 .closer button').click()")
        self.assertEqual(self.browser.js("document.querySelectorAll('#fig8 .uplot canvas').length"), 1)
        series = self.browser.js("[...document.querySelectorAll('#fig8 .u-series .u-label')].map((l) => l.textContent)")
        self.assertEqual(len(series), 1 + 3 + 1)  # T, three runs, one published series
        self.browser.js("{const o = document.querySelector('#fig8 .u-over'), b = o.getBoundingClientRect();"
                        "o.dispatchEvent(new MouseEvent('mousemove', {bubbles: true, clientX: b.left + b.width / 2,"
                        " clientY: b.top + b.height / 2}));}")
        values = self.browser.js("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done("
                                 "[...document.querySelectorAll('#fig8 .u-value')].map((l) => l.textContent)))))")
        self.assertTrue(any(re.fullmatch(r"[\d.]+", value) for value in values[1:4]), values)
        self.browser.js("document.querySelector('#fig8 .closer button').click()")
        self.assertFalse(self.browser.js("document.querySelector('#fig8 .still').hidden"))
