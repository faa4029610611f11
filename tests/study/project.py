"""A project folder of its own, in which a study runs with the programs of one build.

It is the repository seen through links, so that a test neither uses nor disturbs the user's own runs
and report; what is up to date there is kept from one call to the next.
"""

import json
import subprocess
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
STUDY = Path("compare/studies/dam_break_quick.toml")
BASELINES = SOURCE / "compare/reference/baselines"


def study(build: Path) -> dict:
    """The study as the program reads it."""
    command = [str(build.resolve() / "bin/surge-compare"), "study", str(STUDY), "--json", "-"]
    return json.loads(subprocess.run(command, cwd=SOURCE, capture_output=True, text=True, check=True).stdout)


def make_project(build: Path, name: str = "project") -> Path:
    """Below the build folder, whose programs stand there as build/release."""
    root = build.resolve() / "tests/study" / name
    (root / "build").mkdir(parents=True, exist_ok=True)
    links = {name: SOURCE / name for name in ("Allrun", ".ci", "compare", "particle", "foam_cases")}
    links["build/release"] = build.resolve()
    for name, target in links.items():
        link = root / name
        if not link.is_symlink() or link.readlink() != target:
            link.unlink(missing_ok=True)
            link.symlink_to(target)
    return root


def run_study(root: Path) -> subprocess.CompletedProcess:
    """The command of the README, but for what the caller has done already."""
    return subprocess.run(["./Allrun", "--quick", "--no-install", "--no-build"], cwd=root, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)


def check_command(root: Path, run: str) -> list[str]:
    return [str(root / "build/release/bin/surge-compare"), "check", str(root / "runs" / run),
            "--baseline", str(BASELINES / f"{run}.json")]
