"""The page's own rules: values, drawings and what is escaped (compare/report/page/render.py)."""

import importlib.util
import tempfile
import unittest
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
