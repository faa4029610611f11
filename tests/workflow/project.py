"""A project of its own for the tests of Allrun and its workflow.

The programs that compute are stand-ins here, so that failures, hangs and kills can be arranged; what
is tested is all that lies around them: the scripts, Snakemake and foamDictionary are the real ones, and
so is the reader of studies in surge-compare.
"""

import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
REAL_COMPARE = Path(sys.argv.pop(1)).resolve() / "bin/surge-compare"

PARTICLE = """#!/bin/bash
# surge-particle check CASE --json [--set KEY=VALUE]...
if [[ $1 == check ]]; then
  exec /usr/bin/python3 build/release/bin/check.py "${@:2}"
fi
# surge-particle run CASE --out DIR --threads N [--set KEY=VALUE]...
if [[ $* == *calibration-* ]]; then # a microsecond for a step of a particle
  [[ ! -e broken_machine ]] || exit 1
  mkdir "$6"
  echo '{"wall_s": {"total": 1.2, "setup": 0.1, "output": 0.1}, "steps": 1000, "fluid_particles": 1000}' \\
    >"$6/manifest.json"
  exit
fi
echo "start $*" >>calls
case $* in
  *behave=fail*) echo "case.toml:3: spacing: found 7, expected a divisor"; exit 1 ;;
  *behave=slow*) sleep 1 ;;
  *behave=hang*) sleep 600 ;;
esac
finished=true
[[ $* != *behave=unfinished* && $* != *behave=break* ]] || finished=false
mkdir -p "$4"
steps=7
[[ $* != *behave=nothing* ]] || steps=0
printf '{"finished": %s, "steps": %s}' $finished $steps >"$4/manifest.json"
echo "end $*" >>calls
[[ $* != *behave=break* ]]
"""

CHECK = """
import json, sys, tomllib
from pathlib import Path

def merged(table, more):
    for key, value in more.items():
        table[key] = merged(table.get(key, {}), value) if isinstance(value, dict) else value
    return table

case = {"spacing": 0.01, "time": {"end": 1.0, "courant": 0.2}, "search": {"neighbours": "cell_grid"},
        "method": {"name": "mps", "preset": "paper"}, "resolution": {}}
merged(case, tomllib.loads(Path(sys.argv[1]).read_text()))
for setting in sys.argv[4::2]:
    key, value = setting.split("=", 1)
    *tables, last = key.split(".")
    table = case
    for name in tables:
        table = table.setdefault(name, {})
    try:
        table[last] = float(value)
    except ValueError:
        table[last] = value
case["spacing"] = case["resolution"].pop("spacing", case["spacing"])
parameters, preset = {}, case["method"]["preset"]
while preset:
    name = f"particle/cases/presets/{case['method']['name']}-{preset}.toml"
    values = tomllib.loads(Path(name).read_text())
    parameters = values.get(case["method"]["name"], {}) | parameters
    preset = values.get("extends")
case["method"]["parameters"] = parameters
size = {"fluid_particles": 1000, "wall_particles": 500, "steps": 60000, "disk_bytes": 1000.0}
if case.get("disk") == "full":
    size["disk_bytes"] = 1e18
print(json.dumps({"case": case, "size": size}))
"""

COMPARE = """#!/bin/bash
# surge-compare study FILE ..., as it is
if [[ $1 == study ]]; then
  exec REAL "$@"
fi
# surge-compare report --study FILE --runs DIR --out DIR --programs DIR
echo "$*" >>calls
if [[ -e broken_report ]]; then
  echo "surge-compare: report: is a link to elsewhere, expected a folder" >&2
  exit 1
fi
mkdir -p "$7"
echo page >"$7/index.html"
echo "the short table" | tee "$7/summary.txt"
""".replace("REAL", shlex.quote(str(REAL_COMPARE)))

FOAM = """#!/bin/bash
# Allrun --np N
echo "foam $* in $PWD with $WM_PROJECT_DIR" >>"$SURGE_CALLS"
printf '{"finished": true}' >manifest.json
"""

BUILD_NINJA = """rule none
  command = true
build bin/surge-particle: none particle/main.cpp.o particle/version.cpp.o
build bin/surge-compare: none compare/main.cpp.o particle/version.cpp.o
"""

CASE = """# a comment
title = "case"
[method]
name = "mps"
preset = "paper"
"""

STUDY = """title = "test"
reference = "vof"
strip_height = 0.015
snapshot_times = [0.1]
published = ["measured"]

[[run]]
name = "first"
program = "surge-particle"
case = "particle/cases/case.toml"

[[run]]
name = "second"
program = "surge-particle"
case = "particle/cases/case.toml"
set = [{second}]

[[run]]
name = "vof"
program = "interFoam"
case = "foam_cases/tank"
set = ["cellsPerL=7"]
threads = 2
"""


class Project(unittest.TestCase):
    """A folder with the scripts of this repository and stand-ins for the rest."""

    FOLDER = "project"

    def setUp(self):
        outside = Path(tempfile.mkdtemp(prefix="surgefront-"))
        self.addCleanup(shutil.rmtree, outside, ignore_errors=True)
        self.root = outside / self.FOLDER
        self.root.mkdir()
        shutil.copy(SOURCE / "Allrun", self.root)
        shutil.copytree(SOURCE / ".ci", self.root / ".ci")
        for name in ("Snakefile", "estimate.py", "study.py", "work.py"):
            self.write(f"compare/studies/{name}", (SOURCE / "compare/studies" / name).read_text())
        self.series("1,1.2")
        self.write("particle/cases/case.toml", CASE)
        self.write("particle/cases/presets/mps-paper.toml", "[mps]\nbeta = 0.97\n")
        self.write("build/release/build.ninja", BUILD_NINJA)
        for name in ("particle/main.cpp.o", "compare/main.cpp.o", "particle/version.cpp.o"):
            self.write(f"build/release/{name}", name)
        self.write("build/release/bin/surge-particle", PARTICLE, executable=True)
        self.write("build/release/bin/check.py", CHECK)
        self.write("build/release/bin/surge-compare", COMPARE, executable=True)
        self.write("foam_cases/tank/Allrun", FOAM, executable=True)
        self.write("foam_cases/tank/0.orig/U", "field")
        header = "FoamFile { version 2.0; format ascii; class dictionary; object caseParameters; }\n"
        self.write("foam_cases/tank/system/caseParameters", header + "cellsPerL 20;\nwall slip;\n")
        self.study()

    def write(self, name, text, executable=False):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        if executable:
            path.chmod(0o755)

    def series(self, last):
        header = "".join(f"# {key}: {value}\n" for key, value in {
            "label": "Measured", "citation": "Nobody 1900", "column": "none", "kind": "experiment",
            "column_height": "2", "tank_width": "4", "bed_depth": "0", "gate": "none", "axes": "Z/L over T",
            "time_uncertainty": "0.1", "position_uncertainty": "0.1"}.items())
        self.write("compare/reference/measured.csv", f"{header}T,Z_over_L\n0,1\n{last}\n")

    def study(self, text=STUDY, second=""):
        self.write("compare/studies/dam_break.toml", text.replace("{second}", second))

    def allrun(self, *options, start=False, **environment):
        """Runs Allrun to its end, or starts it as the leader of its own process group."""
        command = ["./Allrun", "--no-install", "--no-build", *options]
        settings = {"cwd": self.root, "env": {**os.environ, "SURGE_CALLS": f"{self.root}/calls", **environment}, "text": True,
                    "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        if start:
            return subprocess.Popen(command, start_new_session=True, **settings)
        return subprocess.run(command, timeout=120, check=False, **settings)

    def calls(self):
        """What ran since the last question: names of the runs, in order."""
        file = self.root / "calls"
        lines = file.read_text().splitlines() if file.exists() else []
        file.unlink(missing_ok=True)
        names = []
        for line in lines:
            if line.startswith("start "):
                names.append(line.split("--out runs/")[1].split()[0])
            elif line.startswith("foam "):
                names.append("vof")
            elif line.startswith("report "):
                names.append("report")
        return names

    def succeed(self, *options, ran):
        """Allrun must succeed and run just this, in any order but for the report."""
        done = self.allrun(*options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("the short table", done.stdout)
        last = done.stdout.rstrip().splitlines()[-1]
        self.assertEqual(last, f"report: {self.root}/report/index.html")
        calls = self.calls()
        self.assertEqual(sorted(calls), sorted(ran))
        if ran:
            self.assertEqual(calls[-1], "report")
        return done

    def wait_for(self, condition):
        deadline = time.monotonic() + 60
        while not condition():
            self.assertLess(time.monotonic(), deadline, "waited in vain")
            time.sleep(0.05)


ALL = ["first", "second", "vof", "report"]
