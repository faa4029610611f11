"""Short runs of cases that surge-foam has made, each held to a number that is known."""

import math

import foam_run
from foam_run import FoamTest, all_rows, box, case_text, fastest, internal, last_row, water

G, RHO, AIR = 9.81, 1000.0, 1.0


class MadeCases(FoamTest):
    # p is zero in air at the height of the floor: p(y) = (RHO - AIR) g H - RHO g y in water.

    def test_still_water_around_an_obstacle(self):
        text = case_text(
            fluid=water([0.0, -G]), tank={"lower": [0.0, 0.0], "upper": [0.4, 0.4], "open": ["y+"]},
            block=[box([0.0, 0.0], [0.1, 0.2]), box([0.2, 0.0], [0.4, 0.2]), box([0.1, 0.1], [0.2, 0.2])],
            obstacle=[{"lower": [0.1, 0.0], "upper": [0.2, 0.1]}],
            probe=[{"name": "floor", "position": [0.3, 0.0]}, {"name": "step_side", "position": [0.2, 0.05]}],
            gauge=[{"name": "middle", "position": [0.2, 0.0]}, {"name": "above", "position": [0.15, 0.0]}],
            force=[{"on": "x+"}, {"on": "obstacle.0", "name": "step"}])
        folder, manifest = self.run_case(text, "cellsPerL=10")
        self.assertLess(fastest(folder, "0.02"), 1e-4)
        floor = (RHO - AIR) * G * 0.2
        self.assertAlmostEqual(last_row(folder, "floor", "p")[1] / floor, 1.0, delta=1e-4)
        side = floor - RHO * G * 0.05
        self.assertAlmostEqual(last_row(folder, "stepSide", "p")[1] / side, 1.0, delta=1e-3)
        # Per area of the step; what presses on its two sides is in balance.
        force = last_row(folder, "stepForce", "force.dat")
        area = 0.1 * manifest["thickness"]
        self.assertAlmostEqual(force[2] / area / (RHO * G * 0.1 - floor), 1.0, delta=1e-4)
        self.assertAlmostEqual(force[1] / area, 0.0, delta=0.1)
        depth = {gauge["name"]: last_row(folder, gauge["name"], "volFieldValue.dat")[1] / gauge["area"]
                 for gauge in manifest["case"]["gauges"]}
        self.assertAlmostEqual(depth["middle"], 0.15, delta=1e-6)  # half of it over the step
        self.assertAlmostEqual(depth["above"], 0.1, delta=1e-6)
        case = manifest["case"]
        self.assertEqual(case["obstacles"], [{"lower": [0.1, 0, 0], "upper": [0.2, 0.1, 0]}])
        self.assertEqual([f["on"] for f in case["forces"]], ["x+", "obstacle.0"])
        self.assertEqual(manifest["cells"], 1500)

    def test_still_water_beside_a_wedge_of_cut_cells(self):
        wedge = [[0.2, 0.0], [0.4, 0.0], [0.4, 0.2]]
        text = case_text(
            fluid=water([0.0, -G]), tank={"lower": [0.0, 0.0], "upper": [0.4, 0.3], "open": ["y+"]},
            block=[box([0.0, 0.0], [0.4, 0.15])], obstacle=[{"polygon": wedge}],
            probe=[{"name": "face", "position": [0.25, 0.05]}], force=[{"on": "obstacle.0", "name": "wedge"}])
        folder, manifest = self.run_case(text, "cellsPerL=40")
        self.assertLess(fastest(folder, "0.02"), 1e-3)
        thickness = manifest["thickness"]
        # Of 20 x 20 cells beside each other 190 have their middles inside, and perhaps the 20 on the face.
        cut = manifest["solid_volume_cut_out"] / thickness / 1e-4
        self.assertEqual(manifest["cells"], 1200 - round(cut))
        self.assertIn(round(cut), range(190, 211))
        self.assertAlmostEqual(manifest["water_volume_stated"] / thickness, 0.4 * 0.15 - (0.2**2 - 0.05**2) / 2, delta=1e-9)
        self.assertAlmostEqual(manifest["water_volume_start"] / manifest["water_volume_stated"], 1.0, delta=0.03)
        force = last_row(folder, "wedgeForce", "force.dat")
        exact = RHO * G * 0.15**2 / 2 * thickness
        self.assertAlmostEqual(force[1] / exact, 1.0, delta=0.05)
        self.assertAlmostEqual(force[2] / exact, -1.0, delta=0.1)
        depth = 0.15 - 0.05
        self.assertAlmostEqual(last_row(folder, "face", "p")[1] / (RHO * G * depth), 1.0, delta=0.12)
        self.assertEqual(manifest["case"]["obstacles"],
                         [{"lower": [0.2, 0.0, 0.0], "upper": [0.4, 0.2, 0.0], "polygon": wedge}])

    def test_still_water_in_a_room_that_is_no_box(self):
        # A hexagon in the tank's box, which no cell that is left reaches.
        room = [[0.15, 0.05], [0.25, 0.05], [0.35, 0.15], [0.25, 0.25], [0.15, 0.25], [0.05, 0.15]]
        text = case_text(
            fluid=water([0.0, -G]),
            tank={"lower": [0.0, 0.0], "upper": [0.4, 0.3], "polygon": room},
            block=[box([0.0, 0.0], [0.4, 0.15])])
        folder, manifest = self.run_case(text, "cellsPerL=40")
        self.assertLess(fastest(folder, "0.02"), 1e-2)
        area, half = 0.1 * 0.2 + 0.1 * 0.2, 0.02
        self.assertAlmostEqual(manifest["cells"] * 1e-4 / area, 1.0, delta=0.06)
        self.assertAlmostEqual(manifest["water_volume_stated"] / manifest["thickness"], half, delta=1e-9)
        self.assertAlmostEqual(manifest["water_volume_start"] / manifest["water_volume_stated"], 1.0, delta=0.06)
        self.assertEqual(len(manifest["case"]["obstacles"]), 2)
        self.assertEqual(manifest["case"]["tank"]["upper"][:2], [0.4, 0.3])

    def test_still_water_around_a_body_from_an_stl_file(self):
        # A pyramid that stands on the floor, 0.2 m wide and 0.2 m high, all under water.
        corners = [(0.1, 0, 0.1), (0.3, 0, 0.1), (0.3, 0, 0.3), (0.1, 0, 0.3), (0.2, 0.2, 0.2)]
        lines = ["solid pyramid"]
        for triangle in [(0, 1, 2), (0, 2, 3), (1, 0, 4), (2, 1, 4), (3, 2, 4), (0, 3, 4)]:
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += ["vertex {} {} {}".format(*corners[k]) for k in triangle]
            lines += ["endloop", "endfacet"]
        (self.scratch / "body.stl").write_text("\n".join([*lines, "endsolid"]) + "\n")
        text = case_text(
            3, fluid=water([0.0, -G, 0.0]),
            tank={"lower": [0.0, 0.0, 0.0], "upper": [0.4, 0.4, 0.4], "open": ["y+"]},
            block=[box([0.0, 0.0, 0.0], [0.4, 0.3, 0.4])], obstacle=[{"stl": "body.stl"}],
            force=[{"on": "obstacle.0", "name": "body"}])
        folder, manifest = self.run_case(text, "cellsPerL=20")
        self.assertLess(fastest(folder, "0.02"), 1e-2)
        volume = 0.2**2 * 0.2 / 3
        self.assertAlmostEqual(manifest["solid_volume_cut_out"] / volume, 1.0, delta=0.1)
        self.assertAlmostEqual(manifest["water_volume_stated"], 0.4 * 0.4 * 0.3 - volume, delta=1e-4)
        # The weight of the water above it: what presses on its sides is in balance.
        force = last_row(folder, "bodyForce", "force.dat")
        weight = RHO * G * (0.2 * 0.2 * 0.3 - volume)
        self.assertAlmostEqual(force[2] / -weight, 1.0, delta=0.03)
        self.assertAlmostEqual(force[1] / weight, 0.0, delta=0.01)
        self.assertEqual(len(manifest["case"]["obstacles"][0]["triangles"]), 6)

    def test_still_water_in_three_dimensions_with_gravity_along_z(self):
        text = case_text(
            3, fluid=water([0.0, 0.0, -G]),
            tank={"lower": [-0.1, 0.0, 0.5], "upper": [0.1, 0.1, 0.8], "open": ["z+"], "wall": "no-slip"},
            block=[box([-0.1, 0.0, 0.5], [0.1, 0.1, 0.6])],
            probe=[{"name": "floor", "position": [0.0, 0.05, 0.5]}],
            gauge=[{"name": "level", "position": [0.0, 0.0, 0.0]}], force=[{"on": "y-"}])
        folder, manifest = self.run_case(text, "L=0.1", "cellsPerL=8")
        self.assertLess(fastest(folder, "0.02"), 1e-4)
        floor = (RHO - AIR) * G * 0.1
        self.assertAlmostEqual(last_row(folder, "floor", "p")[1] / floor, 1.0, delta=1e-4)
        gauge = manifest["case"]["gauges"][0]
        self.assertAlmostEqual(last_row(folder, "level", "volFieldValue.dat")[1] / gauge["area"], 0.1, delta=1e-7)
        # Water from 0 to h, air above it to H, both linear in height.
        h, H = 0.1, 0.3
        exact = -0.2 * ((RHO - AIR) * G * h * h - RHO * G * h * h / 2 - AIR * G * (H * H - h * h) / 2)
        self.assertAlmostEqual(last_row(folder, "backWallForce", "force.dat")[2] / exact, 1.0, delta=1e-4)
        self.assertEqual(manifest["case"]["tank"]["wall"], "no-slip")
        self.assertEqual(manifest["case"]["tank"]["open"], ["z+"])
        self.assertEqual(manifest["case"]["fluid"]["gravity"], [0, 0, -G])

    def test_still_water_with_gravity_along_plus_x(self):
        text = case_text(
            fluid=water([G, 0.0]), tank={"lower": [0.0, 0.0], "upper": [0.4, 0.2], "open": ["x-"]},
            block=[box([0.3, 0.0], [0.4, 0.2])], probe=[{"name": "floor", "position": [0.4, 0.1]}],
            gauge=[{"name": "level", "position": [0.0, 0.1]}])
        folder, manifest = self.run_case(text, "cellsPerL=10")
        self.assertLess(fastest(folder, "0.02"), 1e-4)
        self.assertAlmostEqual(last_row(folder, "floor", "p")[1] / ((RHO - AIR) * G * 0.1), 1.0, delta=1e-4)
        area = manifest["case"]["gauges"][0]["area"]
        self.assertAlmostEqual(last_row(folder, "level", "volFieldValue.dat")[1] / area, 0.1, delta=1e-7)
        self.assertEqual(manifest["case"]["tank"]["open"], ["x-"])

    def test_air_before_an_open_side_stays_at_rest(self):
        """Water up to the crest of a sill at the open side, seen by two processes."""
        text = case_text(
            fluid=water([0.0, -G]), tank={"lower": [0.0, 0.5], "upper": [0.4, 0.8], "open": ["y+", "x+"]},
            block=[box([0.0, 0.5], [0.3, 0.6])], obstacle=[{"lower": [0.3, 0.5], "upper": [0.4, 0.6]}])
        folder, manifest = self.run_case(text, "L=0.1", "cellsPerL=10", processes=2)
        self.assertLess(fastest(folder, "0.02"), 1e-4)
        self.assertEqual(manifest["case"]["tank"]["open"], ["x+", "y+"])
        self.assertEqual(manifest["threads"], 2)
        self.assertAlmostEqual(manifest["water_volume_change"], 0.0, delta=1e-9)

    def test_a_ball_falls(self):
        text = case_text(
            3, fluid=water([0.0, -G, 0.0]),
            tank={"lower": [-0.1, -0.1, -0.1], "upper": [0.1, 0.2, 0.1], "open": ["y+"]},
            block=[{"shape": "ball", "lower": [-0.05] * 3, "upper": [0.05] * 3, "velocity": [0.0, 1.0, 0.0]}],
            time={"end": 0.04}, output={"interval": 0.04})
        folder, manifest = self.run_case(text, "L=0.4", "cellsPerL=32")
        middles = [(i + 0.5) * 0.0125 - 0.05 for i in range(8)]
        cells = sum(x * x + y * y + z * z < 0.05**2 for x in middles for y in middles for z in middles)
        self.assertAlmostEqual(manifest["water_volume_start"], cells * 0.0125**3, delta=1e-11)
        self.assertAlmostEqual(manifest["water_volume_stated"], 4 / 3 * math.pi * 0.05**3, delta=1e-12)
        ball = manifest["case"]["blocks"][0]
        self.assertEqual((ball["shape"], ball["lower"], ball["velocity"]), ("ball", [-0.05] * 3, [0, 1, 0]))
        # One block of cells: x runs fastest.
        alpha = internal(folder, "0.04", "alpha.water")
        heights = [(k // 16 % 24 + 0.5) * 0.0125 - 0.1 for k in range(len(alpha))]
        centre = sum(a * y for a, y in zip(alpha, heights)) / sum(alpha)
        self.assertAlmostEqual(centre, 1.0 * 0.04 - 0.5 * G * 0.04**2, delta=0.15 * 0.0125)

    def test_a_flow_along_a_period_of_a_closed_tank(self):
        """Nothing stops it: each cell keeps its velocity. No side is open: p is zero at the top."""
        text = case_text(
            fluid=water([0.0, -G]),
            tank={"lower": [0.0, 0.0], "upper": [0.2, 0.1], "periodic": ["x"]},
            block=[box([0.0, 0.0], [0.2, 0.1], velocity=[0.5, 0.0])],
            probe=[{"name": "floor", "position": [0.1, 0.0]}])
        folder, manifest = self.run_case(text, "L=0.1", "cellsPerL=10")
        for u, v, _ in internal(folder, "0.02", "U"):
            self.assertAlmostEqual(u, 0.5, delta=1e-6)
            self.assertAlmostEqual(v, 0.0, delta=1e-6)
        top = 0.005  # the highest cell's middle
        self.assertAlmostEqual(last_row(folder, "floor", "p")[1] / (RHO * G * (0.1 - top)), 1.0, delta=1e-4)
        case = manifest["case"]
        self.assertEqual((case["tank"]["periodic"], case["tank"]["open"]), (["x"], []))
        self.assertEqual(case["blocks"][0]["velocity"], [0.5, 0, 0])

    def test_gravity_along_a_period_drives_the_water_that_fills_the_tank(self):
        text = case_text(
            3, fluid=water([0.8, 0.0, -G]), tank={"lower": [0.0, 0.0, 0.0], "upper": [0.1, 0.1, 0.1], "periodic": ["x", "y"]},
            block=[box([0.0, 0.0, 0.0], [0.1, 0.1, 0.1])])
        folder, manifest = self.run_case(text, "cellsPerL=6")
        for u, v, w in internal(folder, "0.02", "U"):
            self.assertAlmostEqual(u, 0.8 * 0.02, delta=1e-6)
            self.assertAlmostEqual(math.hypot(v, w), 0.0, delta=1e-6)
        self.assertEqual(manifest["case"]["fluid"]["gravity"], [0.8, 0, -G])
        self.assertEqual(manifest["case"]["tank"]["periodic"], ["x", "y"])

    def test_velocities_that_differ_within_a_block(self):
        text = case_text(
            fluid=water([0.0, -G]), tank={"lower": [0.0, 0.0], "upper": [1.0, 0.75], "open": ["y+"]},
            block=[box([0.0, 0.0], [1.0, 0.5], wave_amplitude=0.03,
                       velocity_gradient=[[-1.0, 2.0], [0.5, 1.0]])],
            resolution={"spacing": 0.05}, time={"end": 1e-3, "initial_step": 1e-3}, output={"interval": 1e-3})
        folder, manifest = self.run_case(text, "cellsPerL=20")
        velocity, alpha = internal(folder, "0", "U"), internal(folder, "0", "alpha.water")
        block = manifest["case"]["blocks"][0]
        self.assertEqual(block["velocity_gradient"], [[-1, 2, 0], [0.5, 1, 0], [0, 0, 0]])
        self.assertEqual(block["wave_amplitude"], 0.03)
        k, depth = math.pi, math.pi * 0.5
        scale = 0.03 * math.sqrt(G * k * math.tanh(depth)) / math.sinh(depth)
        self.assertEqual(len(velocity), 300)
        for i, (u, v, _) in enumerate(velocity):
            x, y = (i % 20 + 0.5) * 0.05, (i // 20 + 0.5) * 0.05
            self.assertEqual(alpha[i], 1.0 if y < 0.5 else 0.0)
            if y > 0.5:
                self.assertEqual((u, v), (0.0, 0.0))
                continue
            u_exact = -(x - 0.5) + 2 * (y - 0.25) - scale * math.sin(k * x) * math.cosh(k * y)
            v_exact = 0.5 * (x - 0.5) + (y - 0.25) + scale * math.cos(k * x) * math.sinh(k * y)
            self.assertAlmostEqual(u, u_exact, delta=1e-6)
            self.assertAlmostEqual(v, v_exact, delta=1e-6)

    # A column L x 2L in a tank 5L wide. Studies print four digits of Z/L.

    COLUMN = {"time": {"end": 0.12}, "output": {"interval": 0.03}}
    FINE = ["L=0.1", "cellsPerL=6", "pressureTolerance=1e-12", "pressureRelTol=0"]

    def column(self, lower, upper, dimension=2):
        """Rows of the front of a column between two places along x."""
        depth = [] if dimension == 2 else [0.1]
        back = [0.0] * len(depth)
        text = case_text(
            dimension, fluid=water([0.0, -G] + back),
            tank={"lower": [0.0, 0.0] + back, "upper": [0.5, 0.4] + depth, "open": ["y+"]},
            block=[box([lower, 0.0] + back, [upper, 0.2] + depth)], **self.COLUMN)
        folder, manifest = self.run_case(text, *self.FINE, name=f"column{dimension}{lower}")
        self.assertEqual(manifest["cells"], 20 * 6**dimension)
        header, rows = self.front(folder)
        self.assertEqual(len(rows), 5)
        return [[float(x) for x in row.split(",")] for row in rows]

    def assert_same(self, fronts, others, delta):
        self.assertGreater(fronts[-1][-1], 2.0)
        self.assertEqual(len(fronts), len(others))
        for a, b in zip(fronts, others):
            for x, y in zip(a, b):
                self.assertAlmostEqual(x, y, delta=delta)

    def test_a_column_at_the_right_wall_is_that_at_the_left_one_mirrored(self):
        self.assert_same(self.column(0.0, 0.1), self.column(0.4, 0.5), 2e-6)

    def test_a_column_in_three_dimensions_is_that_in_two(self):
        self.assert_same(self.column(0.0, 0.1), self.column(0.0, 0.1, 3), 1e-5)

    def test_a_wet_bed(self):
        text = case_text(
            fluid=water([0.0, -G]), tank={"lower": [0.0, 0.0], "upper": [0.5, 0.4], "open": ["y+"]},
            block=[box([0.0, 0.0], [0.1, 0.2]), box([0.1, 0.0], [0.5, 0.02])],
            gauge=[{"name": "far", "position": [0.45, 0.0]}])
        folder, manifest = self.run_case(text, "cellsPerL=10")
        self.assertEqual([b["upper"] for b in manifest["case"]["blocks"]], [[0.1, 0.2, 0], [0.5, 0.02, 0]])
        self.assertAlmostEqual(manifest["water_volume_start"], (0.02 + 0.008) * 0.1, delta=1e-9)
        area = manifest["case"]["gauges"][0]["area"]
        self.assertAlmostEqual(last_row(folder, "far", "volFieldValue.dat")[1] / area, 0.02, delta=1e-5)

    def gated(self, **law):
        """A column behind a gate, its run until 0.1 s: rows of pressure and of the level before the gate."""
        text = case_text(
            fluid=water([0.0, -G]), tank={"lower": [0.0, 0.0], "upper": [0.5, 0.4], "open": ["y+"]},
            block=[box([0.0, 0.0], [0.1, 0.2])],
            moving_wall=[{"name": "gate", "lower": [0.1, 0.0], "upper": [0.12, 0.3], "direction": [0.0, 1.0],
                          "law": "constant", "stop": 9.0, **law}],
            probe=[{"name": "behind", "position": [0.05, 0.0]}],
            gauge=[{"name": "before", "position": [0.135, 0.0]}], time={"end": 0.1}, output={"interval": 0.1})
        folder, manifest = self.run_case(text, "cellsPerL=10", name=f"gate{len(list(self.scratch.iterdir()))}")
        area = manifest["case"]["gauges"][0]["area"]
        pressures = all_rows(folder, "behind", "p")
        levels = [[t, v / area] for t, v in all_rows(folder, "before", "volFieldValue.dat")]
        return pressures, levels, manifest

    def test_a_gate_holds_the_water_until_it_is_lifted(self):
        pressures, levels, manifest = self.gated(speed=1.0, start=0.05)
        exact = (RHO - AIR) * G * 0.2
        for (t, p), (_, level) in zip(pressures, levels):
            if 0.01 < t < 0.05:
                self.assertAlmostEqual(p / exact, 1.0, delta=1e-3)
            if t < 0.05:
                self.assertAlmostEqual(level, 0.0, delta=1e-9)
        # Its lower edge is 50 mm up: the floor is free, and the water above it is still held.
        self.assertLess(pressures[-1][1], 0.6 * exact)
        self.assertGreater(levels[-1][1], 1e-3)
        stated = manifest["case"]["moving_walls"]
        self.assertEqual(stated, [{"name": "gate", "lower": [0.1, 0, 0], "upper": [0.12, 0.3, 0],
                                   "direction": [0, 1, 0], "law": "constant", "speed": 1, "start": 0.05, "stop": 9}])

    def test_a_gate_that_is_gone_at_once_is_none(self):
        """A column starts 20 mm before the place of a gate; the level beyond it is that without a gate."""
        _, lifted, _ = self.gated(speed=1e4)
        _, never, _ = self.gated(speed=1.0, start=5.0)
        free = case_text(
            fluid=water([0.0, -G]), tank={"lower": [0.0, 0.0], "upper": [0.5, 0.4], "open": ["y+"]},
            block=[box([0.0, 0.0], [0.1, 0.2])], gauge=[{"name": "before", "position": [0.135, 0.0]}],
            time={"end": 0.1}, output={"interval": 0.1})
        folder, manifest = self.run_case(free, "cellsPerL=10", name="free")
        level = last_row(folder, "before", "volFieldValue.dat")[1] / manifest["case"]["gauges"][0]["area"]
        self.assertGreater(level, 0.02)
        self.assertAlmostEqual(lifted[-1][1] / level, 1.0, delta=0.02)
        self.assertAlmostEqual(never[-1][1], 0.0, delta=1e-9)

    def test_both_sides_state_the_same_case(self):
        """The comparator finds no difference of physics, until there is one."""
        tables = dict(
            fluid=water([0.0, -G], kinematic_viscosity=1e-6),
            tank={"lower": [0.0, 0.0], "upper": [0.5, 0.5], "open": ["y+"], "wall": "no-slip"},
            block=[box([0.0, 0.0], [0.1, 0.2], velocity=[0.1, 0.0]),
                   {"shape": "ball", "lower": [0.2, 0.3], "upper": [0.3, 0.4]}],
            obstacle=[{"lower": [0.4, 0.0], "upper": [0.5, 0.1]}],
            method={"name": "mps", "preset": "paper"})
        file = self.scratch / "both.toml"
        file.write_text(case_text(**tables))
        particles = self.scratch / "particles"
        done = self.call("surge-particle", "run", file, "--out", particles)
        self.assertEqual(0, done.returncode, done.stderr)
        folder, _ = self.run_case(case_text(**tables), "cellsPerL=10", name="same")
        compared = ["--reference", folder, "--out", self.scratch / "metrics.json"]
        done = self.call("surge-compare", "metrics", particles, *compared)
        self.assertEqual(0, done.returncode, done.stderr)
        tables["obstacle"][0]["lower"] = [0.42, 0.0]
        folder, _ = self.run_case(case_text(**tables), "cellsPerL=10", name="other")
        compared[1] = folder
        done = self.call("surge-compare", "metrics", particles, *compared)
        self.assertNotEqual(0, done.returncode)
        self.assertIn("obstacles: 1, 1 of them not in other", done.stderr)


if __name__ == "__main__":
    foam_run.main()
