"""A report of a few seconds with three methods, made once for all tests of its page."""

import atexit
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import chromium

SOURCE = Path(__file__).resolve().parents[3]
BIN = Path(sys.argv.pop(1)).resolve() / "bin"
# Debian's OpenFOAM finds itself by this.
os.environ.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")


def call(*command, cwd=SOURCE):
    done = subprocess.run([str(word) for word in command], cwd=cwd, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}")


def write_report(folder):
    """A study of a few seconds with all three methods."""
    runs = folder / "runs"
    for method in ("mps", "sph"):
        call(BIN / "surge-particle", "run", "particle/cases/dam_break.toml", "--out", runs / method,
             "--set", f"method.name={method}", "--set", "resolution.spacing=0.0145", "--set", "time.end=0.3")
    shutil.copytree(SOURCE / "foam_cases/damBreak2D", runs / "vof")
    for key, value in {"cellsPerL": "10", "endTime": "0.3", "writeInterval": "0.01"}.items():
        call("foamDictionary", "system/caseParameters", "-entry", key, "-set", value, cwd=runs / "vof")
    call("./Allrun", cwd=runs / "vof")
    study = ('title = "Viewer"\nreference = "vof"\nstrip_height = 0.0435\nsnapshot_times = [0.1, 0.3]\n'
             'published = ["martin_moyce_1952_2.25in"]\n')
    for method in ("mps", "sph"):
        study += (f'[[run]]\nname = "{method}"\nprogram = "surge-particle"\ncase = "particle/cases/dam_break.toml"\n'
                  f'set = ["method.name={method}", "resolution.spacing=0.0145", "time.end=0.3"]\n')
    study += ('[[run]]\nname = "vof"\nprogram = "interFoam"\ncase = "foam_cases/damBreak2D"\n'
              'set = ["cellsPerL=10", "endTime=0.3", "writeInterval=0.01"]\n')
    (folder / "study.toml").write_text(study)
    call(BIN / "surge-compare", "report", "--study", folder / "study.toml", "--runs", runs, "--series",
         SOURCE / "compare/reference", "--out", folder / "report")


def write_space_report(folder):
    """A study in three dimensions: a tenth of a second, SPH and VOF."""
    runs, case = folder / "runs", "particle/cases/square_column_3d.toml"
    short = ["time.end=0.1", "resolution.spacing=0.0145"]
    settings = [word for setting in ["method.name=sph", "method.preset=delta-plus", *short] for word in ("--set", setting)]
    call(BIN / "surge-particle", "run", case, "--out", runs / "sph", *settings)
    call(BIN / "surge-foam", "make", case, "--out", runs / "vof", "--set", "time.end=0.1", "--foam", "cellsPerL=10")
    call("./Allrun", cwd=runs / "vof")
    (folder / "study.toml").write_text(
        'title = "In space"\nreference = "vof"\nstrip_height = 0.0435\nsnapshot_times = [0.05, 0.1]\n'
        f'[defaults]\ncase = "{SOURCE / case}"\n[[run]]\nname = "sph"\nprogram = "surge-particle"\n'
        f'set = {json.dumps(["method.name=sph", "method.preset=delta-plus", *short])}\n'
        '[[run]]\nname = "vof"\nprogram = "interFoam"\nset = ["foam.cellsPerL=10", "time.end=0.1"]\n'
        '[[observable]]\nname = "front"\nkind = "front"\n')
    call(BIN / "surge-compare", "report", "--quiet", "--study", folder / "study.toml", "--runs", runs, "--series",
         SOURCE / "compare/reference", "--out", folder / "report")


class Page(unittest.TestCase):
    """Opens the page before each test; what the browser complains of fails it. `write` makes its report, once."""

    made = {}
    write = staticmethod(write_report)
    flags = ()

    @classmethod
    def setUpClass(cls):
        if cls.write not in Page.made:
            folder = tempfile.TemporaryDirectory()
            atexit.register(folder.cleanup)
            cls.write(Path(folder.name))
            Page.made[cls.write] = Path(folder.name) / "report/index.html"
        cls.page = Page.made[cls.write]
        cls.metrics = json.loads((cls.page.parent / "metrics.json").read_text(encoding="utf-8"))
        cls.browser = chromium.Browser(flags=cls.flags)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.width(1200)
        self.browser.complaints.clear()
        self.open(self.page.as_uri())

    def open(self, address):
        """Until the viewer has unpacked its frames, where there is one; `seconds` is how long that took."""
        begin = time.monotonic()
        self.browser.open(address)
        self.browser.js("new Promise((done) => { const look = () => { const root = document.getElementById('viewer-root');"
                        " if (!root || root.dataset.ready) done(true); else setTimeout(look, 10); }; look(); })")
        self.seconds = time.monotonic() - begin

    def tearDown(self):
        self.browser.js("1")  # what was said until now has arrived
        self.assertEqual(self.browser.complaints, [])
