"""The page's own rules: values, drawings and what is escaped (compare/report/page/render.py)."""

import base64
import importlib.util
import io
import json
import re
import tempfile
import unittest
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2] / "compare/report/page/render.py"
SPEC = importlib.util.spec_from_file_location("render", SOURCE)
render = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(render)

SVG = """<?xml version="1.0"?>
<svg width="100" height="50" viewBox="0 0 100 50" xmlns="http://www.w3.org/2000/svg"
 xmlns:xlink="http://www.w3.org/1999/xlink"><title>t</title><desc>d</desc>
<defs><g id="mark"/></defs><use xlink:href="#mark" style="fill:red"/>
<path clip-path="url(#mark)" d="M0 0"/><text>a &lt; b</text></svg>"""


class Values(unittest.TestCase):
    def setUp(self):
        self.values = render.Values({"a": None, "b": -0.0004, "c": {"x/y": 12345.678}, "t": "<b>",
                                     "yes": True, "list": [1, 2.5]})

    def test_null_is_a_dash_and_a_missing_value_a_mistake(self):
        self.assertIn(">–<", self.values.number("/a", 1))
        with self.assertRaisesRegex(render.PageError, "/nothing"):
            self.values.number("/nothing", 1)

    def test_numbers(self):
        self.assertIn(">0.00<", self.values.number("/b", 2))
        self.assertIn(">−0.0004<", self.values.signed("/b", 4))
        self.assertIn(">12346<", self.values.magnitude("/c/x~1y"))
        self.assertIn(">+2.5<", self.values.signed("/list/1", 1))
        self.assertEqual(render.pointer_of("c", "x/y"), "/c/x~1y")

    def test_text_is_escaped_and_full_values_are_kept(self):
        self.assertEqual(self.values.text("/t"),
                         '<data data-key="/t" value="&lt;b&gt;">&lt;b&gt;</data>')
        self.assertIn('value="[1,2.5]"', self.values.text("/list"))
        self.assertIn(">yes<", self.values.text("/yes"))


class Page(unittest.TestCase):
    def test_templates_escape_what_they_are_given(self):
        source = {"templates": {"page.html": "{{ page.title }}{{ v.text('/t') }}"}, "files": {},
                  "metrics": {"t": "&"}, "page": {"title": "<script>", "figures": []}}
        self.assertTrue(render.render(source).startswith("&lt;script&gt;<data"))

    def test_a_name_that_is_not_there_is_an_error(self):
        source = {"templates": {"page.html": "{{ page.nothing }}"}, "files": {}, "metrics": {},
                  "page": {"figures": []}}
        with self.assertRaises(render.TemplateError):
            render.render(source)

    def test_a_measure_is_named_and_its_element_stays_what_it_is(self):
        values = render.Values({"m": "rms", "n": "other"})
        self.assertEqual(values.named("/m", {"rms": "RMS"}), '<data data-key="/m" value="rms">RMS</data>')
        self.assertIn(">other<", values.named("/n", {"rms": "RMS"}))

    def test_a_difference_has_the_digits_that_its_uncertainty_leaves(self):
        def shown(e, u):
            return re.sub("<[^>]*>", "", render.Values({"E": e, "U": u}).with_uncertainty("/E", "/U"))
        self.assertEqual(shown(-0.0012345, 0.0234), "−0.001 ± 0.023")
        self.assertEqual(shown(0.0000950, 0.0202), "0.000 ± 0.020")
        self.assertEqual(shown(83370.4, 103110.0), "83370 ± 103110")
        self.assertEqual(shown(0.123456, 0.0), "0.123 ± 0")
        self.assertEqual(shown(0.0235, None), "0.0235 ± not known")

    def test_curves_are_the_rows_of_their_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "f.csv").write_text('series,T,Z\n"a ""b""",1,2.5\nother,5,6\n"a ""b""",0,nan\n', encoding="utf-8")
            curve = {"table": "f", "key": 'a "b"', "x": "T", "y": "Z", "label": "A", "colour": "#000000", "points": False}
            figure = {"svg": f"{folder}/f.svg", "curves": [curve, {**curve, "key": "nobody"}], "x_label": "T", "y_label": "Z"}
            found = render.plotted(figure)
            self.assertEqual(len(found["curves"]), 1)
            self.assertEqual((found["curves"][0]["x"], found["curves"][0]["y"]), ([0.0, 1.0], [None, 2.5]))
            self.assertIsNone(render.plotted({**figure, "curves": []}))

    def test_the_archive_is_the_same_for_the_same_numbers(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "f.csv").write_text("x\n1\n", encoding="utf-8")
            figures = [{"svg": f"{folder}/f.svg", "tables": ["f", "not_written"]}]
            address = render.archive(figures, {"a": "Lobovský"})
            self.assertEqual(address, render.archive(figures, {"a": "Lobovský"}))
            data = base64.b64decode(address.removeprefix("data:application/zip;base64,"))
            with zipfile.ZipFile(io.BytesIO(data)) as stored:
                self.assertEqual(stored.namelist(), ["metrics.json", "figures/f.csv"])
                self.assertEqual(json.loads(stored.read("metrics.json")), {"a": "Lobovský"})

    def test_an_alternative_text_has_the_numbers(self):
        metrics = {"study": {"reference": "v"}, "summary": {"against": "vof"},
                   "runs": {"m": {"label": "MPS"}, "v": {"label": "VOF"}},
                   "front": {"m": {"rms_vs_vof": 0.12345}, "v": {"rms_vs_vof": 0.0}},
                   "observables": {"h@1": {"unit": "m", "runs": {"m": {"label": "MPS", "least": 0.5, "most": 2.0}}}}}
        figure = {"name": "fig8", "title": "Front", "caption": "Words."}
        self.assertEqual(render.told(metrics, figure), "Front. RMS of Z/L to the reference: MPS 0.123.")
        self.assertEqual(render.told(metrics, {**figure, "name": "observable_h_1"}),
                         "Front, in m. Range: MPS from 0.5 to 2.")
        self.assertEqual(render.told(metrics, {**figure, "name": "fig1"}), "Front. Words.")

    def test_script_data_cannot_end_the_script(self):
        self.assertEqual(render.script_json({"a": "</script>&"}),
                         '{"a":"\\u003c/script\\u003e\\u0026"}')


class Drawing(unittest.TestCase):
    def setUp(self):
        render.ElementTree.register_namespace("", render.SVG)
        render.ElementTree.register_namespace("xlink", render.XLINK)

    def drawing(self, text, label="a \"b\" & c"):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "f.svg"
            file.write_text(text, encoding="utf-8")
            return render.inline_svg(file, "fig1", label)

    def test_ids_carry_the_figures_name(self):
        svg = self.drawing(SVG)
        for part in ('id="fig1-mark"', 'href="#fig1-mark"', "url(#fig1-mark)", "a &lt; b",
                     'viewBox="0 0 100 50"', 'role="img"', "&quot;b&quot; &amp; c"):
            self.assertIn(part, svg)
        for part in ("<title", "<desc", "width=", "<?xml"):
            self.assertNotIn(part, svg)

    def test_what_is_no_drawing_is_an_error(self):
        for text in ("nonsense", "<html/>", SVG.replace('viewBox="0 0 100 50"', "")):
            with self.assertRaisesRegex(render.PageError, "f.svg"):
                self.drawing(text)


if __name__ == "__main__":
    unittest.main()
