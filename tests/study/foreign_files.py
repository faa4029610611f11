"""Small writers of particle files as other programs lay them out, of one flow: a column that stays a box.

The flow is that of docs/examples/my_solver.py, so that its leading edge is known.
"""

import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/examples"))
import my_solver  # noqa: E402

INTERVAL = my_solver.INTERVAL
WIDTHS = my_solver.widths(9.81)


def fluid(number):
    """x, z and their velocities of each particle."""
    s, rate = WIDTHS[number]
    l0 = my_solver.SPACING
    for j in range(round(my_solver.H / l0)):
        for i in range(round(my_solver.L / l0)):
            x, z = (i + 0.5) * l0 * s, (j + 0.5) * l0 / s
            yield x, z, rate / s * x, -rate / s * z


def front(number):
    """Z/L: half a spacing beyond the foremost particles."""
    half = 0.5 * my_solver.SPACING / my_solver.L
    return (1 - half) * WIDTHS[number][0] + half


def walls():
    """A floor and two walls, one layer."""
    l0, n = my_solver.SPACING, 40
    yield from (((i + 0.5) * l0, -0.5 * l0) for i in range(-1, n + 1))
    yield from ((x, (j + 0.5) * l0) for x in (-0.5 * l0, (n + 0.5) * l0) for j in range(25))


def write_openmps(folder: Path, frames):
    """OpenMps (2014): CSV, x-z plane, types 0 fluid, 1 wall; no times."""
    folder.mkdir(parents=True)
    for number in range(frames):
        lines = ["Type, x, z, u, w, p, n"]
        lines += [f"0, {x:.8g}, {z:.8g}, {u:.8g}, {w:.8g}, 0, 6" for x, z, u, w in fluid(number)]
        lines += [f"1, {x:.8g}, {z:.8g}, 0, 0, 0, 6" for x, z in walls()]
        (folder / f"particles_{number}.csv").write_text("\n".join(lines) + "\n")


def write_dualsphysics(folder: Path, frames):
    """DualSPHysics 5.4, solver's own -sv:vtk: legacy binary, x-z plane, Type 3 fluid; beside it what the
    solver tells of the run."""
    (folder / "vtks").mkdir(parents=True)
    for number in range(frames):
        rows = [(x, z, 3, u, w) for x, z, u, w in fluid(number)] + [(x, z, 0, 0, 0) for x, z in walls()]
        n = len(rows)
        with open(folder / f"vtks/PartVtk_{number:04d}.vtk", "wb") as out:
            out.write(b"# vtk DataFile Version 3.0\nvtk output\nBINARY\nDATASET POLYDATA\n")
            out.write(f"POINTS {n} float\n".encode())
            out.write(b"".join(struct.pack(">3f", x, 0, z) for x, z, *_ in rows))
            out.write(f"\nVERTICES {n} {2 * n}\n".encode())
            out.write(b"".join(struct.pack(">2i", 1, k) for k in range(n)))
            out.write(f"\nPOINT_DATA {n}\nSCALARS Idp int\nLOOKUP_TABLE default\n".encode())
            out.write(b"".join(struct.pack(">i", k) for k in range(n)))
            out.write(f"\nFIELD FieldData 2\nVel 3 {n} float\n".encode())
            out.write(b"".join(struct.pack(">3f", u, 0, w) for *_, u, w in rows))
            out.write(f"\nType 1 {n} short\n".encode())
            out.write(b"".join(struct.pack(">h", kind) for _, _, kind, *_ in rows))
            out.write(b"\n")
    times = "".join(f"{number};{INTERVAL * number:.6f}\n" for number in range(frames))
    (folder / "Run.csv").write_text(
        f"#RunName;Np;Hardware;Nbound;Dp;H\nCase;290;CPU;90;{my_solver.SPACING};0.02\n")
    (folder / "Run.out").write_text('Kernel="Wendland"\nGravity=(0,0,-9.81)\n')
    (folder / "RunPARTs.csv").write_text("Part;TimeStep [s]\n" + times)


def write_lammps(folder: Path, frames):
    """LAMMPS (2 August 2023) `dump custom`: one text file, units si, time in the head; type 1 fluid."""
    folder.mkdir(parents=True)
    lines = []
    for number in range(frames):
        rows = [(1, *row) for row in fluid(number)] + [(2, x, z, 0, 0) for x, z in walls()]
        lines += ["ITEM: UNITS", "si", "ITEM: TIME", f"{INTERVAL * number:.6f}", "ITEM: TIMESTEP",
                  f"{100 * number}", "ITEM: NUMBER OF ATOMS", f"{len(rows)}", "ITEM: BOX BOUNDS ff ff pp",
                  "-0.1 0.7", "-0.1 1.0", "-0.01 0.01", "ITEM: ATOMS id type x y z vx vy vz"]
        lines += [f"{k + 1} {kind} {x:.8g} {y:.8g} 0 {u:.8g} {v:.8g} 0"
                  for k, (kind, x, y, u, v) in enumerate(rows)]
    (folder / "dump.lammpstrj").write_text("\n".join(lines) + "\n")
