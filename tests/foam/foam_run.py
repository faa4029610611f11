"""What the tests of made cases share: a case file as a text, the case that surge-foam makes of it,
its run, and the numbers that the run leaves."""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BIN = Path()  # of the build, set by main()


def main():
    """Arguments: the folder of the programs, then what unittest takes. 77: skipped, no OpenFOAM."""
    global BIN
    BIN = Path(sys.argv.pop(1)).resolve()
    if shutil.which("interFoam") is None:
        print("skipped: interFoam not found")
        sys.exit(77)
    unittest.main(module="__main__")


def toml(value):
    return json.dumps(value)


def case_text(dimension=2, **tables):
    """A case file: tables by name, lists of them for arrays of tables."""
    lines = ['title = "Test"', f"dimension = {dimension}"]
    common = {"resolution": {"spacing": 0.01}, "time": {"end": 0.02}, "output": {"interval": 0.02}}
    for name, content in {**common, **tables}.items():
        for table in content if isinstance(content, list) else [content]:
            lines.append(f"[[{name}]]" if isinstance(content, list) else f"[{name}]")
            lines += [f"{key} = {toml(value)}" for key, value in table.items()]
    return "\n".join(lines) + "\n"


def box(lower, upper, **more):
    return {"shape": "box", "lower": lower, "upper": upper, **more}


def water(gravity, **more):
    return {"density": 1000.0, "gravity": gravity, **more}


class FoamTest(unittest.TestCase):
    """Makes cases in a folder that is gone afterwards."""

    def setUp(self):
        self.scratch = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.scratch)

    def call(self, program, *arguments):
        return subprocess.run([BIN / program, *arguments], capture_output=True, text=True)

    def make(self, text, *foam, name="case", sets=()):
        """The folder of the case."""
        file = self.scratch / f"{name}.toml"
        file.write_text(text)
        command = [BIN / "surge-foam", "make", file, "--out", self.scratch / name]
        for setting in ("writeFormat=ascii", *foam):
            command += ["--foam", setting]
        for setting in sets:
            command += ["--set", setting]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(0, done.returncode, done.stderr)
        return self.scratch / name

    def run_case(self, text, *foam, name="case", processes=1, sets=()):
        """The folder of the case after its Allrun, and its manifest."""
        folder = self.make(text, *foam, name=name, sets=sets)
        done = subprocess.run([folder / "Allrun", "--np", str(processes)], capture_output=True,
                              text=True)
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        return folder, json.loads((folder / "manifest.json").read_text())

    def front(self, folder, strip=0.02):
        """Rows of (T, Z/L) as the comparator measures them."""
        out = folder / "front.csv"
        done = subprocess.run([BIN / "surge-compare", "front", folder, "--out", out,
                               "--strip-height", str(strip)], capture_output=True, text=True)
        self.assertEqual(0, done.returncode, done.stderr)
        rows = out.read_text().splitlines()
        return rows[0], rows[1:]


def all_rows(folder, record, file):
    """Numbers of all lines that a function object has written."""
    lines = (folder / "postProcessing" / record / "0" / file).read_text().splitlines()
    return [[float(x) for x in re.findall(r"[-+]?[\d.]+(?:e[-+]?\d+)?", line)]
            for line in lines if not line.startswith("#")]


def last_row(folder, record, file):
    return all_rows(folder, record, file)[-1]


def internal(folder, time, field):
    """Values of a field that was written as text: numbers, or lists of three."""
    text = (folder / time / field).read_text()
    uniform = re.search(r"internalField\s+uniform\s+([^;]*);", text)
    if uniform:
        return [[float(x) for x in uniform[1].strip("()").split()]]
    values = re.search(r"internalField\s+nonuniform.*?\n\(\n(.*?)\n\)", text, re.S)[1].splitlines()
    if values[0].startswith("("):
        return [[float(x) for x in value.strip("()").split()] for value in values]
    return [float(value) for value in values]


def fastest(folder, time):
    return max(abs(x) for vector in internal(folder, time, "U") for x in vector)
