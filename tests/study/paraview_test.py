"""What ParaView opens of a run, by the readers that it is made of (VTK's), and the script that shows runs side by side.

Usage: paraview_test.py BUILD_FOLDER; 77 where VTK for Python or OpenFOAM is not there.
"""

import io
import contextlib
import re
import shutil
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
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
except ImportError:
    vtkOpenFOAMReader = None

TIMES = ["time.end=0.02", "output.interval=0.01"]


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

    def test_what_is_no_run_is_told(self):
        (self.folder / "empty").mkdir()
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(in_paraview.main([str(self.folder / "empty"), "--png", "x.png"]), 1)
        self.assertEqual(said.getvalue().count("\n"), 1)
        self.assertIn("found neither particles.pvd nor vof.foam", said.getvalue())


if __name__ == "__main__":
    if vtkOpenFOAMReader is None or not shutil.which("interFoam"):
        print("skipped: no VTK for Python (libvtk9-dev brings it) or no OpenFOAM")
        sys.exit(77)
    unittest.main()
