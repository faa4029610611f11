"""What ParaView opens of a run, by the readers that it is made of (VTK's), and the script of docs/results.md that
shows runs side by side (drawn where ParaView itself is there: Debian has it, and it takes the place of the VTK that we
build with).

Usage: paraview_test.py BUILD_FOLDER; 77 where VTK for Python or OpenFOAM is not there.
"""

import contextlib
import io
import json
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv.pop(1)).resolve()
CASE = SOURCE / "particle/cases/dam_break.toml"
sys.path.insert(0, str(SOURCE / "compare/studies"))
import in_paraview  # noqa: E402

try:
    from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader
    from vtkmodules.vtkIOImage import vtkPNGReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
except ImportError:
    vtkOpenFOAMReader = None

TIMES = ["time.end=0.02", "output.interval=0.01"]


OPEN = """
from paraview import simple
simple._DisableFirstRenderCameraReset()
simple.LoadState({state!r})
simple.SaveScreenshot({picture!r}, simple.GetLayout(), ImageResolution={size})
simple.Disconnect()
"""


def png_size(file):
    return struct.unpack(">II", file.read_bytes()[16:24])


def colours_by_half(file):
    """Part of the left and of the right half of a picture that is neither white nor grey."""
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    values = reader.GetOutput().GetPointData().GetScalars()
    found = [0, 0]
    for i in range(width * height):
        pixel = values.GetTuple(i)
        if max(pixel[:3]) - min(pixel[:3]) > 20:
            found[i % width >= width // 2] += 1
    return [2 * count / (width * height) for count in found]


def names(arrays):
    return {arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())}


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = Path(place.name)
        settings = [word for setting in TIMES for word in ("--set", setting)]
        cls.call(BUILD / "bin/surge-particle", "run", CASE, "--out", cls.folder / "mps", *settings,
                 "--set", "resolution.spacing=0.0145")
        cls.call(BUILD / "bin/surge-foam", "make", CASE, "--out", cls.folder / "vof", *settings,
                 "--foam", "cellsPerL=10")
        cls.call(cls.folder / "vof/Allrun")

    @staticmethod
    def call(*words):
        done = subprocess.run([str(word) for word in words], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False)
        assert done.returncode == 0, done.stdout

    def test_vof_foam_has_the_arrays_that_the_script_takes(self):
        reader = vtkOpenFOAMReader()
        reader.SetFileName(str(in_paraview.opened(self.folder / "vof")))
        reader.UpdateInformation()
        times = reader.GetTimeValues()
        self.assertEqual([round(times.GetValue(i), 6) for i in range(times.GetNumberOfTuples())], [0.0, 0.01, 0.02])
        reader.SetTimeValue(0.01)
        reader.EnableAllCellArrays()
        reader.Update()
        mesh = reader.GetOutput().GetBlock(0)
        self.assertEqual(mesh.GetNumberOfCells(), 3600)
        self.assertEqual(names(mesh.GetCellData()), {in_paraview.FRACTION, *in_paraview.ARRAYS.values()})

    def test_particles_have_the_names_that_the_script_gives_the_others(self):
        collection = in_paraview.opened(self.folder / "mps")
        found = re.findall(r'timestep="([^"]+)" file="([^"]+)"', collection.read_text(encoding="utf-8"))
        self.assertEqual([float(time) for time, _ in found], [0.0, 0.01, 0.02])
        for _, file in found:
            reader = vtkXMLUnstructuredGridReader() if file.endswith(".vtu") else vtkXMLPolyDataReader()
            reader.SetFileName(str(collection.parent / file))
            reader.Update()
            self.assertLessEqual({*in_paraview.ARRAYS, "type"}, names(reader.GetOutput().GetPointData()))

    def test_both_state_the_pressure_of_the_resting_water(self):
        for run in ("mps", "vof"):
            case = in_paraview.manifest(self.folder / run)["case"]
            self.assertAlmostEqual(in_paraview.highest_pressure(case), 1000 * 9.81 * 0.29)

    def test_both_are_shown_in_one_plane(self):
        planes = [in_paraview.shown_plane(in_paraview.manifest(self.folder / run)["case"]) for run in ("mps", "vof")]
        self.assertEqual(*planes)
        (x0, y0, _), (x1, y1, _) = planes[0]
        self.assertEqual((x0, y0, x1), (0, 0, 0.58))
        self.assertAlmostEqual(y1, 1.5 * 0.29)  # the tank is higher
        width, height = in_paraview.picture_size(in_paraview.manifest(self.folder / "mps")["case"])
        metre = (width - 2 * in_paraview.SIDE) / 0.58
        self.assertEqual(height, round(in_paraview.HEAD + in_paraview.FOOT + 1.5 * 0.29 * metre))

    def test_a_side_that_is_not_known_is_the_waters(self):
        case = json.loads(json.dumps(in_paraview.manifest(self.folder / "mps")["case"]))
        case["tank"]["upper"] = [None, 0.3, None]
        self.assertEqual(in_paraview.shown_plane(case), ([0, 0, 0], [0.145, 0.3, 0]))
        case["tank"] = None
        self.assertEqual(in_paraview.shown_plane(case)[1][0], 0.145)

    @unittest.skipUnless(shutil.which("pvpython") and shutil.which("xvfb-run"), "no ParaView (pvpython) or no xvfb-run")
    def test_paraview_draws_both_and_opens_the_state_again(self):
        # Without -noreset the server may be starting anew when the next window asks for it.
        paraview = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", "pvpython"]
        picture, state, again = (self.folder / name for name in ("side.png", "side.pvsm", "again.png"))
        self.call(*paraview, SOURCE / "compare/studies/in_paraview.py", self.folder / "mps", self.folder / "vof",
                  "--time", "0.01", "--png", picture, "--state", state)
        width, height = in_paraview.picture_size(in_paraview.manifest(self.folder / "mps")["case"])
        self.assertEqual(png_size(picture), (2 * width, height))
        opener = self.folder / "open.py"
        opener.write_text(OPEN.format(state=str(state), picture=str(again), size=[2 * width, height]), encoding="utf-8")
        self.call(*paraview, opener)
        self.assertEqual(png_size(again), (2 * width, height))
        # Water of both: the left and the right half hold colours, and the state shows what the script showed.
        self.assertEqual(again.read_bytes(), picture.read_bytes())
        for side in colours_by_half(picture):
            self.assertGreater(side, 0.02)

    def test_what_is_no_run_is_told(self):
        (self.folder / "empty").mkdir()
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(in_paraview.main([str(self.folder / "empty"), "--png", "x.png"]), 1)
        self.assertEqual(said.getvalue().count("\n"), 1)
        self.assertIn("found neither particles.pvd nor vof.foam", said.getvalue())
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(in_paraview.main([str(self.folder / "mps")]), 1)
        self.assertIn("found neither --png nor --state, expected one of them", said.getvalue())


if __name__ == "__main__":
    if vtkOpenFOAMReader is None or not shutil.which("interFoam"):
        print("skipped: no VTK for Python (libvtk9-dev brings it) or no OpenFOAM")
        sys.exit(77)
    unittest.main()
