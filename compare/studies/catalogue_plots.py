"""Drawings of the catalogue's page, as places in SVG that its template fills in. Standard library only.

Error over cost of each flow, and computed over measured as the validation guide of NIST's Fire Dynamics
Simulator draws it: logarithmic axes of one range, the diagonal, a bar of 95 % of the data, and a point for
each value of each method.
"""

import math

# Okabe & Ito (2008), those that have contrast on white, each with a marker of its own.
LOOKS = (("#0072b2", "circle"), ("#d55e00", "square"), ("#00664a", "up"), ("#a0447a", "down"), ("#7a5c00", "diamond"),
         ("#4b4b4b", "cross"))
VOF_LOOK = ("#000000", "plus")


def looks(methods) -> dict[str, tuple[str, str]]:
    """Colour and marker of each method; VOF's are black, as everywhere."""
    others = sorted(method for method in methods if method != "interFoam")
    found = {method: LOOKS[k % len(LOOKS)] for k, method in enumerate(others)}
    if "interFoam" in methods:
        found["interFoam"] = VOF_LOOK
    return found


def marker(kind: str, x: float, y: float, r: float = 4.2) -> str:
    """The path of a marker around a place."""
    def closed(*points):
        return "M" + "L".join(f"{x + r * a:.1f} {y + r * b:.1f}" for a, b in points) + "Z"
    if kind == "circle":
        return f"M{x - r:.1f} {y:.1f}a{r} {r} 0 1 0 {2 * r} 0a{r} {r} 0 1 0 {-2 * r} 0Z"
    if kind in ("cross", "plus"):
        a, b = ((1, 1), (1, -1)) if kind == "cross" else ((1.2, 0), (0, 1.2))
        return "".join(f"M{x - r * p:.1f} {y - r * q:.1f}L{x + r * p:.1f} {y + r * q:.1f}" for p, q in (a, b))
    return closed(*{"square": ((-.9, -.9), (.9, -.9), (.9, .9), (-.9, .9)), "up": ((-1, .8), (1, .8), (0, -1)),
                    "down": ((-1, -.8), (1, -.8), (0, 1)), "diamond": ((-1.2, 0), (0, -1.2), (1.2, 0), (0, 1.2))}[kind])


class LogAxis:
    """From numbers to places on a logarithmic axis that holds all of them."""

    def __init__(self, values, begin: float, end: float, widen: float = 1.35):
        low, high = min(values) / widen, max(values) * widen
        if high / low < 10.0:  # a decade at least, or there would be no number to read it by
            middle = math.sqrt(low * high)
            low, high = middle / math.sqrt(10.0), middle * math.sqrt(10.0)
        self.low, self.high, self.begin, self.end = low, high, begin, end

    def at(self, value: float) -> float:
        part = math.log(min(max(value, self.low), self.high) / self.low) / math.log(self.high / self.low)
        return self.begin + (self.end - self.begin) * part

    def ticks(self) -> list[tuple[float, str]]:
        """Decades; with 2 and 5 between them where there are few."""
        first, last = math.floor(math.log10(self.low)), math.ceil(math.log10(self.high))
        decades = [10.0 ** k for k in range(first, last + 1) if self.low <= 10.0 ** k <= self.high]
        numbers = decades[::2] if len(decades) > 5 else decades
        if len(decades) < 3:
            numbers = [k * 10.0 ** n for n in range(first, last + 1) for k in (1, 2, 5)]
        return [(self.at(value), tick_text(value)) for value in numbers if self.low <= value <= self.high]


def tick_text(value: float) -> str:
    if 1e-3 <= value < 1e5:
        return f"{value:g}"
    power = math.floor(math.log10(value) + 1e-9)
    raised = str(power).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    first = round(value / 10.0 ** power)
    return ("" if first == 1 else f"{first}·") + f"10{raised}"


WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 440, 300, 70, 24, 28, 46


def panel(title: str, x: LogAxis, y: LogAxis, x_label: str, y_label: str) -> dict:
    return {"title": title, "x_label": x_label, "y_label": y_label, "x_ticks": x.ticks(), "y_ticks": y.ticks(),
            "points": [], "bars": [], "lines": []}


def _axes(xs, ys) -> tuple[LogAxis, LogAxis]:
    return LogAxis(xs, LEFT, WIDTH - RIGHT), LogAxis(ys, HEIGHT - BOTTOM, TOP)


def error_over_cost(flow: dict, look: dict) -> dict | None:
    """A point for each run of `flow["errors"]`: {"run", "method", "E", "U", "cpu_s"}; the bar is E ± U."""
    known = [one for one in flow["errors"]["points"] if one["E"] and one["cpu_s"]] if flow.get("errors") else []
    if not known:
        return None
    errors = flow["errors"]
    sizes = [abs(one["E"]) for one in known]
    tops = [abs(one["E"]) + (one["U"] or 0.0) for one in known]
    tolerance = [errors["tolerance"]] if errors["tolerance"] else []
    x, y = _axes([one["cpu_s"] for one in known], [*sizes, *(min(top, 10.0 * max(sizes)) for top in tops), *tolerance])
    unit = "" if errors["unit"] == "1" else f", {errors['unit']}"
    made = panel(flow["title"], x, y, "CPU time of the run, s", f"RMS error{unit}")
    made["told"] = f"{errors['title']}, against {errors['label']}"
    for one in known:
        colour, kind = look[one["method"]]
        place = x.at(one["cpu_s"]), y.at(abs(one["E"]))
        if one["U"]:
            made["bars"].append({"x0": place[0], "x1": place[0], "y0": y.at(max(abs(one["E"]) - one["U"], y.low)),
                                 "y1": y.at(abs(one["E"]) + one["U"]), "colour": colour})
        made["points"].append({"path": marker(kind, *place), "colour": colour, "open": kind in ("cross", "plus"),
                               "told": f"{one['run']}: {abs(one['E']):.3g}{unit[1:]}, {one['cpu_s']:.3g} s"})
    if tolerance:
        at = y.at(tolerance[0])
        made["lines"].append({"x0": LEFT, "x1": WIDTH - RIGHT, "y0": at, "y1": at, "dash": "6 4", "text": "tolerance"})
    return made


def computed_over_measured(points: list[dict], look: dict) -> list[dict]:
    """A panel for each unit of `points`: {"method", "measured", "computed", "bar", "unit", "label"}."""
    panels = []
    for unit in sorted({one["unit"] for one in points}):
        chosen = [one for one in points if one["unit"] == unit]
        values = [one[key] for one in chosen for key in ("measured", "computed")]
        x, y = _axes(values, values)
        made = panel({"s": "Times", "m": "Lengths", "Pa": "Pressures", "Pa s": "Impulses of pressures", "N": "Forces",
                      "N s": "Impulses of forces"}.get(unit, f"In {unit}"), x, y, f"measured, {unit}", f"computed, {unit}")
        made["lines"].append({"x0": x.at(x.low), "y0": y.at(y.low), "x1": x.at(x.high), "y1": y.at(y.high), "dash": "",
                              "text": ""})
        for one in chosen:
            colour, kind = look[one["method"]]
            place = x.at(one["measured"]), y.at(one["computed"])
            if one["bar"]:
                made["bars"].append({"y0": place[1], "y1": place[1], "x0": x.at(max(one["measured"] - one["bar"], x.low)),
                                     "x1": x.at(one["measured"] + one["bar"]), "colour": colour})
            made["points"].append({"path": marker(kind, *place), "colour": colour, "open": kind in ("cross", "plus"),
                                   "told": f"{one['label']}, {one['method']}: {one['computed']:.3g} computed, "
                                           f"{one['measured']:.3g} {unit} measured"})
        panels.append(made)
    return panels
