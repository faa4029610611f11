"""Short runs of every preset: 200 particles of the dam break for a tenth of a second.

What they must give stands in compare/reference/baselines/presets, one file for each preset.
"""

import json
import subprocess
import sys
from pathlib import Path

from project import BASELINES, SOURCE

CASE = SOURCE / "particle/cases/dam_break.toml"
FOLDER = BASELINES / "presets"
# Chaos has not begun at 0.1 s; what a compiler or a processor rounds differently stays far below these.
BLESS = ["--observable", "front", "--observable", "centre-of-mass", "--observable", "kinetic-energy",
         "--absolute", "0.0003", "--absolute", "kinetic-energy=0.1", "--time", "0.0002",
         "--until", "0.1", "--because", "before the front's drops make small differences large",
         "--strip-height", "0.0435"]


def presets(build: Path) -> list[str]:
    """method-preset, of all that the program has."""
    said = subprocess.run([build / "bin/surge-particle", "list"], capture_output=True, text=True,
                          check=True).stdout
    names = []
    for line in said.splitlines()[1:]:
        if not line.strip():
            break
        names.append(line.split()[0])
    return names


def compute(build: Path, preset: str, folder: Path) -> None:
    method, name = preset.split("-", 1)
    done = subprocess.run(
        [build / "bin/surge-particle", "run", CASE, "--out", folder, "--threads", "1",
         "--set", f"method.name={method}", "--set", f"method.preset={name}",
         "--set", "resolution.spacing=0.0145", "--set", "time.end=0.1", "--set", "output.interval=0.01"],
        text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{preset}\n{done.stdout}")


def check_command(build: Path, preset: str, folder: Path) -> list:
    return [build / "bin/surge-compare", "check", folder, "--baseline", FOLDER / f"{preset}.json"]


def bless(build: Path, reason: str, folder: Path) -> int:
    """Writes the baselines of all presets."""
    for preset in presets(build):
        compute(build, preset, folder / preset)
        command = [*check_command(build, preset, folder / preset), "--bless", "--reason", reason, *BLESS]
        if subprocess.run(command, check=False).returncode != 0:
            return 1
    return 0


def outcome(report: Path) -> dict:
    return json.loads(report.read_text(encoding="utf-8"))


if __name__ == "__main__":
    sys.exit("see tests/study/bless and presets_test.py")
