"""Short runs of tanks that move: the acceleration of the tank's frame, its sign and its place."""

import math

import foam_run
from foam_run import FoamTest, all_rows, box, case_text, fastest, last_row, water

G, RHO = 9.81, 1000.0


def still(acceleration):
    """A law that is constant in time: a table of two rows."""
    return {"law": "table", "quantity": "acceleration", "samples": [[0.0, acceleration], [9.0, acceleration]]}


class MovingTank(FoamTest):
    def full(self, motion, gravity, probes):
        """Pressures (Pa) at places of a closed tank full of water, which cannot move in it."""
        text = case_text(
            fluid=water(gravity), tank={"lower": [0.0, 0.0], "upper": [0.4, 0.2]},
            block=[box([0.0, 0.0], [0.4, 0.2])], motion=motion,
            probe=[{"name": f"p{i}", "position": place} for i, place in enumerate(probes)])
        folder, manifest = self.run_case(text, "L=0.1", "cellsPerL=10")
        if motion["kind"] == "translation":
            self.assertLess(fastest(folder, "0.02"), 1e-4)
        return [last_row(folder, f"p{i}", "p")[1] for i in range(len(probes))], manifest["case"]["motion"]

    def test_water_presses_on_the_wall_that_pushes_it(self):
        """p falls by rho a in the direction of the acceleration."""
        motion = {"kind": "translation", "direction": [1.0, 0.0], **still(2.0)}
        (left, right), stated = self.full(motion, [0.0, -G], [[0.05, 0.1], [0.35, 0.1]])
        self.assertAlmostEqual((left - right) / (RHO * 2.0 * 0.3), 1.0, delta=1e-4)
        self.assertEqual(stated["direction"], [1, 0, 0])
        self.assertEqual(stated["samples"], [[0, 2], [9, 2]])

    def test_gravity_turns_against_the_tank(self):
        """A tank that stands turned by q about any centre: g (sin q, -cos q) against the clock."""
        q = 0.3
        motion = {"kind": "rotation", "centre": [1.0, 2.0], "law": "harmonic", "amplitude": q,
                  "period": 1e7, "phase": math.pi / 2}
        (a, b, c), stated = self.full(motion, [0.0, -G], [[0.05, 0.05], [0.35, 0.05], [0.05, 0.15]])
        # The turned tank's x axis points up by q, so that gravity has the component -g sin q along it.
        self.assertAlmostEqual((b - a) / (-RHO * G * math.sin(q) * 0.3), 1.0, delta=1e-4)
        self.assertAlmostEqual((c - a) / (-RHO * G * math.cos(q) * 0.1), 1.0, delta=1e-4)
        self.assertEqual(stated["centre"], [1, 2, 0])
        self.assertEqual(stated["kind"], "rotation")

    def test_water_is_pressed_away_from_the_centre_of_rotation(self):
        """p = rho omega^2 r^2/2 about a centre that is not the origin."""
        omega, centre = 5.0, (0.3, 0.1)
        motion = {"kind": "rotation", "centre": list(centre), "law": "constant", "speed": omega, "stop": 9.0}
        places = [[0.05, 0.05], [0.3, 0.1], [0.35, 0.15]]
        pressures, _ = self.full(motion, [0.0, 0.0], places)
        exact = [RHO * omega**2 * math.dist(x, centre) ** 2 / 2 for x in places]
        for p, e in zip(pressures, exact):
            self.assertAlmostEqual(p - pressures[1], e, delta=0.005 * exact[0])

    def test_the_first_push_on_water_with_a_free_surface(self):
        """Net force at the start, as Housner's series has it: m a (1 - sum 8 tanh(n pi h/L)/(n^3 pi^3 h/L))."""
        a, width, depth = 1.0, 0.4, 0.15
        text = case_text(
            fluid=water([0.0, -G]), tank={"lower": [0.0, 0.0], "upper": [width, 0.3], "open": ["y+"]},
            block=[box([0.0, 0.0], [width, depth])], force=[{"on": "x-"}, {"on": "x+"}],
            motion={"kind": "translation", "direction": [1.0, 0.0], **still(a)},
            time={"end": 0.002}, output={"interval": 0.002})
        folder, manifest = self.run_case(text, "L=0.1", "cellsPerL=20")
        mass = RHO * width * depth * manifest["thickness"]
        ratio = depth / width
        moving = sum(8 * math.tanh(n * math.pi * ratio) / (n**3 * math.pi**3 * ratio) for n in range(1, 40, 2))
        net = sum(last_row(folder, name, "force.dat")[1] for name in ("leftWallForce", "rightWallForce"))
        self.assertAlmostEqual(net / (-mass * a * (1 - moving)), 1.0, delta=0.02)

    def test_the_surface_sways_with_the_period_of_linear_theory(self):
        """After a short push the level at the wall crosses its mean at half a period, omega^2 = g k tanh kh."""
        width, depth, push = 0.4, 0.2, 0.02
        k = math.pi / width
        period = 2 * math.pi / math.sqrt(G * k * math.tanh(k * depth))
        text = case_text(
            fluid=water([0.0, -G]), tank={"lower": [0.0, 0.0], "upper": [width, 0.3], "open": ["y+"]},
            block=[box([0.0, 0.0], [width, depth])], gauge=[{"name": "left", "position": [0.005, 0.0]}],
            motion={"kind": "translation", "direction": [1.0, 0.0], "law": "table", "quantity": "acceleration",
                    "samples": [[0.0, 0.0], [push / 2, 2.0], [push, 0.0], [9.0, 0.0]]},
            time={"end": round(0.6 * period, 3), "maximum_step": 2e-3}, output={"interval": 1.0})
        folder, manifest = self.run_case(text, "L=0.1", "cellsPerL=10")
        area = manifest["case"]["gauges"][0]["area"]
        lines = (folder / "postProcessing/left/0/volFieldValue.dat").read_text().splitlines()
        rows = [[float(x) for x in line.split()] for line in lines if not line.startswith("#")]
        level = [(t, v / area - depth) for t, v in rows]
        # The tank pushes at push/2, towards +x: the level rises at the left wall at first.
        self.assertGreater(max(height for t, height in level if t < 0.4 * period), 0.002)
        later = [(t, height) for t, height in level if t > 0.25 * period + push / 2]
        after = next(i for i, (_, height) in enumerate(later) if height < 0)
        (t0, h0), (t1, h1) = later[after - 1], later[after]
        crossing = t0 + (t1 - t0) * h0 / (h0 - h1)
        self.assertAlmostEqual((crossing - push / 2) / (period / 2), 1.0, delta=0.02)


class Piston(FoamTest):
    """A piston at the left, 40 mm thick, before water 0.4 m long and 0.15 m deep."""

    def pushed(self, name, end, interval, *foam, **law):
        text = case_text(
            fluid=water([0.0, -G]), tank={"lower": [0.0, 0.0], "upper": [0.5, 0.3], "open": ["y+"]},
            block=[box([0.1, 0.0], [0.5, 0.15])],
            moving_wall=[{"name": "piston", "lower": [0.06, 0.0], "upper": [0.1, 0.2], "direction": [1.0, 0.0], **law}],
            force=[{"on": "piston"}], gauge=[{"name": "middle", "position": [0.3, 0.0]}],
            time={"end": end}, output={"interval": interval})
        return self.run_case(text, *foam, name=name)

    def test_the_added_mass_of_water_before_a_wall(self):
        """Force at the start beyond that at rest: rho a sum 2 coth(k l)/(k^3 h), k = (2n - 1) pi/(2h) (Westergaard)."""
        foam = ["L=0.1", "cellsPerL=20"]
        push, manifest = self.pushed("push", 0.002, 0.002, *foam, **still(1.0))
        rest, _ = self.pushed("rest", 0.002, 0.002, *foam, **still(0.0))
        force = [last_row(folder, "leftWallForce", "force.dat")[1] for folder in (push, rest)]
        h, length = 0.15, 0.4
        modes = [(2 * n - 1) * math.pi / (2 * h) for n in range(1, 40)]
        exact = -RHO * manifest["thickness"] * sum(2 / (k**3 * h * math.tanh(k * length)) for k in modes)
        self.assertAlmostEqual((force[0] - force[1]) / exact, 1.0, delta=0.05)

    def test_water_gives_way_to_a_piston(self):
        """Nothing is lost, and the mesh ends at the piston's face."""
        folder, manifest = self.pushed("case", 0.2, 0.1, "L=0.1", "cellsPerL=10", law="table",
                                       quantity="displacement", samples=[[0.0, 0.0], [0.2, 0.02], [9.0, 0.02]])
        points = (folder / "0.2/polyMesh/points").read_text()
        xs = [float(line.split()[0].strip("(")) for line in points.splitlines() if line.count(" ") == 2 and line[0] == "("]
        self.assertAlmostEqual(min(xs), 0.12, delta=1e-6)
        self.assertAlmostEqual(max(xs), 0.5, delta=1e-9)
        self.assertAlmostEqual(manifest["water_volume_change"], 0.0, delta=1e-6)
        case = manifest["case"]
        self.assertEqual((case["tank"]["lower"], case["tank"]["upper"]), ([0, 0, 0], [0.5, 0.3, 0]))
        self.assertEqual(case["moving_walls"], [
            {"name": "piston", "lower": [0.06, 0, 0], "upper": [0.1, 0.2, 0], "direction": [1, 0, 0], "law": "table",
             "quantity": "displacement", "samples": [[0, 0], [0.2, 0.02], [9, 0.02]]}])
        self.assertEqual(case["forces"][0]["on"], "piston")
        first = all_rows(folder, "middle", "volFieldValue.dat")[0][1] * case["gauges"][0]["height"]
        self.assertAlmostEqual(first, 0.15, delta=1e-4)


if __name__ == "__main__":
    foam_run.main()
