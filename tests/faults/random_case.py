"""Seeded cases that anybody might write: all kinds of bodies, walls, motions, sizes and methods."""

import random

METHODS = [("mps", "paper"), ("mps", "improved"), ("sph", "paper"), ("sph", "paper-bare"),
           ("sph", "delta-plus"), ("isph", "shifted")]
AXES = "xyz"


def text(value) -> str:
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(text(v) for v in value) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)


class RandomCase:
    """On a lattice of its spacing, so that it divides all sizes. `fastest` bounds the speeds that
    the flow can reach by falling and being pushed, m/s."""

    def __init__(self, seed: int):
        self.random = random.Random(seed)
        choice, rand = self.random.choice, self.random.randint
        self.method, self.preset = METHODS[seed % len(METHODS)]
        self.dimension = 3 if seed // len(METHODS) % 3 == 2 else 2
        # From a spoonful to a harbour.
        self.spacing = float(f"{10 ** self.random.uniform(-3.0, 0.0):.2g}")
        flat = self.dimension == 2
        self.size = [rand(12, 24), rand(10, 18)] if flat else [rand(7, 10), rand(7, 9), rand(5, 7)]
        self.gravity = choice([9.81, 9.81, 9.81, 1.62])
        self.tables: list[tuple[str, dict]] = []
        self.boxes: list[tuple[list, list]] = []  # of lattice cells that are taken
        self.floor = [0] * self.dimension
        self.pushed = 0.0
        self._tank()
        self._water()
        if self.random.random() < 0.3:
            self._obstacle()
        if self.random.random() < 0.25:
            self._motion()
        if self.random.random() < 0.3:
            self.tables.append(("[[probe]]", {"name": "foot", "position": [0.5 * self.spacing] * self.dimension}))
        if self.random.random() < 0.2:
            self.tables.append(("[[force]]", {"on": "x+"}))
        height = self.size[1] * self.spacing
        self.fastest = (2 * self.gravity * height) ** 0.5 + self.pushed
        fall = (2 * height / self.gravity) ** 0.5
        self.end = float(f"{fall * self.random.uniform(0.1, 0.6 if flat else 0.3):.3g}")

    def _metres(self, cells):
        return [float(f"{c * self.spacing:.12g}") for c in cells]

    def _free(self, lower, upper) -> bool:
        return all(any(u <= a or b <= l for l, u, a, b in zip(lower, upper, low, high))
                   for low, high in self.boxes)

    def _tank(self):
        table = {"lower": self._metres(self.floor), "upper": self._metres(self.size)}
        if self.random.random() < 0.5:
            table["open"] = ["y+"]
        self.periodic = ""
        if self.random.random() < 0.15:
            self.periodic = "z" if self.dimension == 3 else "x"
            table["periodic"] = [self.periodic]
        self.viscous = self.random.random() < 0.4
        if self.viscous and self.random.random() < 0.5:
            table["wall"] = "no-slip"
        self.tables.append(("[tank]", table))

    def _body(self, lower, upper, shape="box"):
        table = {"shape": shape, "lower": self._metres(lower), "upper": self._metres(upper)}
        if self.random.random() < 0.25:
            speed = 0.5 * (self.gravity * self.size[1] * self.spacing) ** 0.5
            table["velocity"] = [float(f"{self.random.uniform(-speed, speed):.3g}")
                                 for _ in range(self.dimension)]
            self.pushed += 2 * speed
        self.tables.append(("[[block]]", table))
        self.boxes.append((lower, upper))

    def _water(self):
        rand = self.random.randint
        width = self.size[0] if self.periodic == "x" or self.random.random() < 0.2 else rand(4, self.size[0] // 2 + 1)
        height = rand(3, self.size[1] - 2)
        deep = self.size[2:]
        begin = self.random.choice([0, 0, self.size[0] - width])
        self._body([begin, 0] + [0] * len(deep), [begin + width, height] + deep)
        if self.random.random() < 0.3:  # another body, wherever there is room
            for _ in range(20):
                side = rand(3, 4)
                at = [rand(0, n - side) for n in self.size]
                up = [a + side for a in at]
                gap = [a - 2 for a in at], [u + 2 for u in up]
                if self._free(*gap):
                    self._body(at, up, self.random.choice(["box", "ball"]))
                    break

    def _obstacle(self):
        rand = self.random.randint
        for _ in range(20):
            size = [rand(3, 5) for _ in self.size]
            at = [rand(0, max(0, n - s)) for n, s in zip(self.size, size)]
            at[1] = 0  # on the floor
            upper = [a + s for a, s in zip(at, size)]
            if self._free(at, upper) and upper[1] < self.size[1]:
                self.tables.append(("[[obstacle]]", {"lower": self._metres(at), "upper": self._metres(upper)}))
                self.boxes.append((at, upper))
                return

    def _motion(self):
        period = float(f"{(self.size[0] * self.spacing / self.gravity) ** 0.5 * self.random.uniform(1, 4):.3g}")
        if self.random.random() < 0.5:
            amplitude = self.spacing * self.random.uniform(0.5, 2.0)
            table = {"kind": "translation", "direction": [1.0] + [0.0] * (self.dimension - 1)}
        else:
            amplitude = self.random.uniform(0.02, 0.15)
            table = {"kind": "rotation", "centre": [0.0] * self.dimension}
            if self.dimension == 3:
                table["direction"] = [0.0, 0.0, 1.0]
        reach = 1.0 if table["kind"] == "translation" else sum(n * self.spacing for n in self.size)
        self.pushed += 2 * 6.3 * amplitude * reach / period
        table |= {"law": "harmonic", "amplitude": float(f"{amplitude:.4g}"), "period": period}
        self.tables.append(("[motion]", table))

    def toml(self) -> str:
        down = [0.0] * self.dimension
        down[1] = -self.gravity
        fluid = {"density": self.random.choice([1000.0, 1000.0, 13600.0, 1.2]), "gravity": down}
        if self.viscous:
            scale = (self.gravity * (self.size[1] * self.spacing) ** 3) ** 0.5
            fluid["kinematic_viscosity"] = float(f"{scale * 10 ** self.random.uniform(-5, -1.5):.3g}")
        # A tenth of the time in which a particle falls by its own size.
        longest = float(f"{0.1 * (self.spacing / self.gravity) ** 0.5:.3g}")
        tables = [("[fluid]", fluid), *self.tables, ("[resolution]", {"spacing": self.spacing}),
                  ("[time]", {"end": self.end, "maximum_step": longest, "initial_step": 0.1 * longest}),
                  ("[output]", {"interval": self.end / 4}),
                  ("[method]", {"name": self.method, "preset": self.preset})]
        lines = ['title = "Seeded"', f"dimension = {self.dimension}"]
        for head, entries in tables:
            lines += [head, *(f"{key} = {text(value)}" for key, value in entries.items())]
        return "\n".join(lines) + "\n"
