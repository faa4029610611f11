"""Every block of commands in README, CONTRIBUTING and docs is run by a test, or says in its page why it is not.

Above a block stands one of
  <!-- run by FILE -->            a test that runs it with what it needs
  <!-- not run: REASON -->
or nothing: then this test runs it, block after block of a page, in a folder like the repository. Only the runs are made
shorter and coarser there. A block ```sh verdict``` may end with 0 or 2.

Usage: blocks_test.py BUILD_FOLDER (Marks | Commands); 77 without OpenFOAM for Commands.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv.pop(1)).resolve()
BLOCK = re.compile(r"(?P<mark><!--[^\n]*-->\n+)?^ *```(?P<kind>(?:sh|bash|console|shell)\b[^\n]*)\n(?P<text>.*?)^ *```",
                   re.DOTALL | re.MULTILINE)
RUN_BY = re.compile(r"<!-- run by (tests/[\w./-]+) -->")
NOT_RUN = re.compile(r"<!-- not run: (\S.{10,}) -->")
# What makes a run short: by case, on either side.
SHORTER = {"dam_break": ["time.end=0.3", "resolution.spacing=0.0145"], "lobovsky_2014": ["time.end=0.01"]}
PREPARED = """
build/release/bin/surge-particle run particle/cases/dam_break.toml --out runs/mine --set method.name=sph
build/release/bin/surge-foam make particle/cases/dam_break.toml --out runs/vof-20
runs/vof-20/Allrun
"""


def pages():
    return [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", *sorted((SOURCE / "docs").glob("*.md"))]


class Block:
    def __init__(self, page, match, text):
        self.place = f"{page.relative_to(SOURCE)}:{text[:match.start('kind')].count(chr(10)) + 1}"
        self.page, self.kind, self.text = page, match["kind"], match["text"]
        self.mark = (match["mark"] or "").strip()

    @property
    def marked(self):
        return bool(RUN_BY.fullmatch(self.mark) or NOT_RUN.fullmatch(self.mark))


def blocks(page):
    text = page.read_text(encoding="utf-8")
    return [Block(page, match, text) for match in BLOCK.finditer(text)]


class Marks(unittest.TestCase):
    def test_what_runs_a_block_is_there_and_names_its_page(self):
        counted = {"run here": 0, "run by another test": 0, "not run": []}
        for block in (block for page in pages() for block in blocks(page)):
            if runner := RUN_BY.fullmatch(block.mark):
                counted["run by another test"] += 1
                test = SOURCE / runner[1]
                self.assertTrue(test.is_file(), f"{block.place}: {runner[1]}")
                self.assertIn(block.page.stem.lower(), test.read_text(encoding="utf-8").lower(),
                              f"{block.place}: {runner[1]} does not name the page")
            elif reason := NOT_RUN.fullmatch(block.mark):
                counted["not run"].append(f"{block.place}: {reason[1]}")
            else:
                self.assertNotIn("run", block.mark, f"{block.place}: {block.mark}")
                counted["run here"] += 1
        self.assertGreater(counted["run here"], 5)
        self.assertLess(len(counted["not run"]), counted["run here"] + counted["run by another test"])
        print(f"blocks: {counted['run here']} run here, {counted['run by another test']} by other tests, "
              f"{len(counted['not run'])} not run:", *counted["not run"], sep="\n  ", file=sys.stderr)

    def test_finds_blocks_and_marks(self):
        text = "a\n```sh\nx\n```\n<!-- not run: needs an hour of time -->\n```sh verdict\ny\n```\n```toml\nz\n```\n"
        found = [Block(SOURCE / "README.md", match, text) for match in BLOCK.finditer(text)]
        self.assertEqual([(block.kind, block.text, block.marked) for block in found],
                         [("sh", "x\n", False), ("sh verdict", "y\n", True)])
        self.assertEqual(found[1].place, "README.md:6")


class Commands(unittest.TestCase):
    def setUp(self):
        if not shutil.which("interFoam"):
            self.skipTest("no OpenFOAM")
        place = tempfile.TemporaryDirectory(prefix="surgefront-")
        self.addCleanup(place.cleanup)
        self.root = Path(place.name)
        for name in ("Allrun", ".ci", "compare", "particle", "foam_cases", "docs"):
            (self.root / name).symlink_to(SOURCE / name)
        programs = self.root / "build/release/bin"
        programs.mkdir(parents=True)
        for name in ("surge-particle", "surge-compare", "surge-foam"):
            (programs / name).write_text(self.wrapper(name))
            (programs / name).chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}

    @staticmethod
    def wrapper(name):
        """The program, with a run made shorter after what its user has said."""
        cases = "".join(f"  */{case}.toml) set -- \"$@\" {' '.join('--set ' + s for s in settings)} ;;\n"
                        for case, settings in SHORTER.items())
        coarse = "  set -- \"$@\" --foam cellsPerL=10\n" if name == "surge-foam" else ""
        return (f"#!/bin/bash\nif [[ $1 == run || $1 == make ]]; then\n  case $2 in\n{cases}  esac\n{coarse}fi\n"
                f"exec '{BUILD}/bin/{name}' \"$@\"\n")

    def shell(self, commands, place, codes=(0,)):
        done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", commands], cwd=self.root, env=self.environment,
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.assertIn(done.returncode, codes, f"{place}\n{commands}\n{done.stdout[-3000:]}")

    def test_every_block_runs(self):
        self.shell(PREPARED, "what the pages take for granted")
        for page in pages():
            for block in blocks(page):
                if not block.marked:
                    with self.subTest(block.place):
                        self.shell(block.text.replace("--out runs/mine ", "--force --out runs/mine "), block.place,
                                   (0, 2) if "verdict" in block.kind else (0,))


if __name__ == "__main__":
    unittest.main()
