#!/usr/bin/python3
"""A solver as small as one can be: a column of water that stays a box while it collapses.

u = (s'/s) x, v = -(s'/s) y keeps the volume; the width L s(t) follows from the energy per density and area,
  E = s'^2 (L^2 + H^2/s^4)/6 + g H/(2 s),   s(0) = 1, s'(0) = 0.
It stands for your solver. Usage: my_solver.py FOLDER [GRAVITY]
"""

import sys
from pathlib import Path

L, H, SPACING, END, INTERVAL = 0.145, 0.29, 0.0145, 0.16, 0.01


def acceleration(s, rate, g):
    """From dE/dt = 0."""
    return (3 * g * H / (2 * s**2) + 2 * rate**2 * H**2 / s**5) / (L**2 + H**2 / s**4)


def widths(g):
    """s and s' at each interval, by the classical Runge-Kutta method."""
    s, rate, steps = 1.0, 0.0, 100
    found = [(s, rate)]
    for _ in range(round(END / INTERVAL)):
        for _ in range(steps):
            h = INTERVAL / steps
            k1 = (rate, acceleration(s, rate, g))
            k2 = (rate + h / 2 * k1[1], acceleration(s + h / 2 * k1[0], rate + h / 2 * k1[1], g))
            k3 = (rate + h / 2 * k2[1], acceleration(s + h / 2 * k2[0], rate + h / 2 * k2[1], g))
            k4 = (rate + h * k3[1], acceleration(s + h * k3[0], rate + h * k3[1], g))
            s += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
            rate += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
        found.append((s, rate))
    return found


def main(folder, g):
    folder.mkdir(parents=True, exist_ok=True)
    columns, rows = round(L / SPACING), round(H / SPACING)
    for number, (s, rate) in enumerate(widths(g)):
        lines = ["px,py,vx,vy,kind"]
        for j in range(rows):
            for i in range(columns):
                x, y = (i + 0.5) * SPACING * s, (j + 0.5) * SPACING / s
                lines.append(f"{x:.7g},{y:.7g},{rate / s * x:.7g},{-rate / s * y:.7g},1")
        (folder / f"particles_{number:04d}.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 9.81)
