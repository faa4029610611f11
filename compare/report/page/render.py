"""Makes the page of a report from its numbers: render.py INPUT OUTPUT.

INPUT is JSON: `templates` (name: text), `files` (name: text of styles and scripts), `metrics` (what
metrics.json holds), `page` (runs, figures and the viewer's data, in the page's order). The templates
are Jinja2's; they escape all text by themselves. Numbers reach the page through Values alone.
"""

import base64
import csv
import io
import json
import math
import sys
import zipfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from jinja2 import DictLoader, Environment, StrictUndefined, TemplateError
from markupsafe import Markup

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"
DASH = "–"  # for what is not known


class PageError(Exception):
    """A mistake in templates or input, told in one line."""


def pointer_of(*parts):
    """"/front/vof-20/rms" from its parts: a JSON pointer (RFC 6901)."""
    return "".join("/" + str(part).replace("~", "~0").replace("/", "~1") for part in parts)


class Values:
    """Puts values of metrics.json on the page, and nothing else.

    Each is an element <data data-key="POINTER" value="FULL">SHOWN</data>, so that a reader, and a
    test, can find where it comes from. A pointer that leads nowhere is a mistake in a template; null
    is shown as a dash.
    """

    def __init__(self, metrics):
        self._metrics = metrics

    def _find(self, pointer):
        value = self._metrics
        for part in pointer.split("/")[1:]:
            name = part.replace("~1", "/").replace("~0", "~")
            value = value[int(name)] if isinstance(value, list) else value[name]
        return value

    def at(self, pointer):
        try:
            return self._find(pointer)
        except (KeyError, IndexError, TypeError, ValueError):
            raise PageError(f"the metrics have no {pointer}") from None

    def has(self, pointer):
        try:
            return self._find(pointer) is not None
        except (KeyError, IndexError, TypeError, ValueError):
            return False

    def _element(self, pointer, shown):
        value = self.at(pointer)
        full = value if isinstance(value, str) else json.dumps(value, separators=(",", ":"),
                                                                ensure_ascii=False)
        return Markup('<data data-key="{}" value="{}">{}</data>').format(pointer, full, shown)

    def number(self, pointer, decimals):
        value = self.at(pointer)
        if value is None:
            return self._element(pointer, DASH)
        size = f"{abs(value):.{decimals}f}"
        return self._element(pointer, ("−" if value < 0 and size.strip("0.") else "") + size)

    def integer(self, pointer):
        return self.number(pointer, 0)

    def magnitude(self, pointer):
        """To three significant digits, for quantities of any size."""
        value = self.at(pointer)
        if value is None:
            return self._element(pointer, DASH)
        before = math.floor(math.log10(abs(value))) + 1 if value else 1
        return self.number(pointer, min(max(3 - before, 0), 12))

    def with_uncertainty(self, pointer, uncertainty):
        """E ± U, both to the second significant digit of U, as the GUM (JCGM 100:2008, 7.2.6) has it."""
        size = self.at(uncertainty)
        if size is None:
            return Markup("{} ± not known").format(self.magnitude(pointer))
        if size == 0:
            return Markup("{} ± {}").format(self.magnitude(pointer), self.integer(uncertainty))
        decimals = min(max(1 - math.floor(math.log10(size)), 0), 12)
        return Markup("{} ± {}").format(self.number(pointer, decimals), self.number(uncertainty, decimals))

    def signed(self, pointer, decimals):
        """With its sign, + or −."""
        value = self.at(pointer)
        if value is None or value <= 0:
            return self.number(pointer, decimals)
        return self._element(pointer, f"+{value:.{decimals}f}")

    def text(self, pointer):
        """Words, or any other value as it is written in JSON."""
        value = self.at(pointer)
        if value is None or isinstance(value, bool):
            return self._element(pointer, {None: DASH, True: "yes", False: "no"}[value])
        return self._element(pointer, value if isinstance(value, str) else json.dumps(value))

    def named(self, pointer, names):
        """A word by another that readers know; itself where there is none."""
        value = self.at(pointer)
        return self._element(pointer, names.get(value, value))

    def shown(self, pointer, decimals):
        """A number that may be missing altogether."""
        return self.number(pointer, decimals) if self.has(pointer) else DASH

    def shown_magnitude(self, pointer):
        return self.magnitude(pointer) if self.has(pointer) else DASH


def inline_svg(file, name, label):
    """The drawing of an SVG file as an element of the page.

    Its ids get the figure's name in front, so that several drawings do not share one; `label` is for
    those who cannot see it.
    """
    try:
        root = ElementTree.parse(file).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise PageError(f"{file}: found no drawing ({error}), expected SVG") from error
    if root.tag != f"{{{SVG}}}svg" or not root.get("viewBox"):
        raise PageError(f"{file}: found no <svg> with a viewBox, expected one")
    for element in root.iter():
        for child in [c for c in element if c.tag in (f"{{{SVG}}}title", f"{{{SVG}}}desc")]:
            element.remove(child)
        for key, value in list(element.attrib.items()):
            if key == "id":
                element.set(key, f"{name}-{value}")
            elif key in ("href", f"{{{XLINK}}}href") and value.startswith("#"):
                element.set(key, f"#{name}-{value[1:]}")
            elif "url(#" in value:
                element.set(key, value.replace("url(#", f"url(#{name}-"))
    for size in ("width", "height"):
        root.attrib.pop(size, None)
    root.set("role", "img")
    root.set("aria-label", label)
    return Markup(ElementTree.tostring(root, encoding="unicode"))


def rounded(text):
    """A number of a table to seven digits; None where it is none."""
    try:
        value = float(text)
    except ValueError:
        return None
    return float(f"{value:.7g}") if math.isfinite(value) else None


def plotted(figure):
    """The curves of a figure for a plot that can be zoomed: its words and, per curve, x and y."""
    tables = {}
    curves = []
    for curve in figure["curves"]:
        if curve["table"] not in tables:
            file = Path(figure["svg"]).with_name(curve["table"] + ".csv")
            with open(file, encoding="utf-8", newline="") as lines:
                tables[curve["table"]] = list(csv.reader(lines))
        header, *rows = tables[curve["table"]]
        x, y = header.index(curve["x"]), header.index(curve["y"])
        points = [(rounded(row[x]), rounded(row[y])) for row in rows if row[0] == curve["key"]]
        points = sorted(((a, b) for a, b in points if a is not None), key=lambda point: point[0])
        if points:
            curves.append({"label": curve["label"], "colour": curve["colour"], "points": curve["points"],
                           "x": [a for a, _ in points], "y": [b for _, b in points]})
    return {"x": figure["x_label"], "y": figure["y_label"], "curves": curves} if curves else None


def archive(figures, metrics):
    """All numbers in one archive, as a data: address: metrics.json and the tables of the figures."""
    stored = io.BytesIO()
    with zipfile.ZipFile(stored, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as out:
        def add(name, content):
            # Without the time of day, so that the same numbers make the same archive.
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            out.writestr(entry, content)
        add("metrics.json", json.dumps(metrics, indent=1, ensure_ascii=False) + "\n")
        for figure in figures:
            for table in figure["tables"]:
                file = Path(figure["svg"]).with_name(table + ".csv")
                if file.is_file():
                    add(f"figures/{table}.csv", file.read_bytes())
    return "data:application/zip;base64," + base64.b64encode(stored.getvalue()).decode("ascii")


def told(metrics, figure):
    """What a figure shows, in words with its numbers, for those who cannot see it."""
    text = figure["title"]
    reference = metrics.get("study", {}).get("reference")
    results = []
    if figure["name"].startswith("fig8"):
        against = metrics["summary"]["against"]
        for run, front in metrics["front"].items():
            rms = front.get(f"rms_vs_{against}")
            if run != reference and rms is not None:
                results.append(f"{metrics['runs'][run]['label']} {rms:.3f}")
        if results:
            return f"{text}. RMS of Z/L to the reference: {'; '.join(results)}."
    for key, quantity in metrics.get("observables", {}).items():
        name = "observable_" + "".join(c if c.isascii() and c.isalnum() else "_" * len(c.encode()) for c in key)
        if name != figure["name"]:
            continue
        for run in quantity["runs"].values():
            if run["least"] is not None:
                results.append(f"{run['label']} from {run['least']:.3g} to {run['most']:.3g}")
        if results:
            unit = "" if quantity["unit"] == "1" else ", in " + quantity["unit"]
            return f"{text}{unit}. Range: {'; '.join(results)}."
    return f"{text}. {figure['caption']}"


def script_json(value):
    """JSON whose strings neither end a script element nor trouble an XML reader."""
    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False)
    for sign in "<>&":
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return Markup(text)


def render(source):
    ElementTree.register_namespace("", SVG)
    ElementTree.register_namespace("xlink", XLINK)
    environment = Environment(loader=DictLoader(source["templates"]), autoescape=True,
                              undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
                              extensions=["jinja2.ext.do"])
    page = source["page"]
    figures = {figure["name"]: figure for figure in page["figures"]}
    environment.globals.update(
        v=Values(source["metrics"]), m=source["metrics"], page=page, figures=figures,
        plotted=plotted, told=lambda figure: told(source["metrics"], figure),
        archive=lambda: archive(page["figures"], source["metrics"]),
        key=pointer_of, inline_svg=inline_svg, script_json=script_json, dash=DASH,
        file=lambda name: Markup(source["files"][name]))
    return environment.get_template("page.html").render()


def main(arguments):
    try:
        with open(arguments[0], encoding="utf-8") as file:
            text = render(json.load(file))
        with open(arguments[1], "w", encoding="utf-8") as out:
            out.write(text)
        return 0
    except TemplateError as error:
        where = f"{getattr(error, 'name', None) or 'template'}:{getattr(error, 'lineno', '?')}"
        print(f"{where}: {error}", file=sys.stderr)
    except (PageError, OSError) as error:
        print(error, file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
