"""The commands of docs/worked-examples.md and the steps of its workflow, as a reader types them.

Usage: worked_examples_test.py BUILD_FOLDER [TEST...]; 77 without OpenFOAM for those that compute VOF.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/study"))
from project import make_project  # noqa: E402

BUILD = Path(sys.argv.pop(1)).resolve()
PAGE = (SOURCE / "docs/worked-examples.md").read_text(encoding="utf-8")


def blocks(section):
    """(kind, commands) of a section of the page; kind is sh, sh allrun or sh fails."""
    text = PAGE.split(f"\n## {section}\n")[1].split("\n## ")[0]
    return re.findall(r"```(sh[ a-z]*)\n(.*?)```", text, re.DOTALL)


class Example(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copytree(SOURCE / "docs/examples", self.folder, dirs_exist_ok=True)

    def run_block(self, commands, code=0, folder=None):
        path = f"{BUILD}/bin:{os.environ['PATH']}"
        done = subprocess.run(["bash", "-e", "-c", commands], cwd=folder or self.folder, text=True,
                              env={**os.environ, "PATH": path}, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False)
        self.assertEqual(done.returncode, code, f"{commands}\n{done.stdout}")
        return done.stdout

    def run_section(self, section, kinds):
        """Blocks of the kinds, in their order; ./Allrun stands in a project of its own."""
        root = make_project(BUILD, "examples")
        said = []
        for kind, commands in blocks(section):
            if kind not in kinds:
                continue
            if kind == "sh allrun":
                commands = re.sub(r"(\w+\.toml)", rf"{self.folder}/\1", commands)
                commands = commands.replace("--study", "--no-install --no-build --study")
                commands = commands.replace(" out ", f" {self.folder}/out ")
                said.append(self.run_block(commands, folder=root))
            else:
                said.append(self.run_block(commands, 2 if kind == "sh fails" else 0))
        return said, root


class Quick(Example):
    def test_solver_against_vof_reads_the_files(self):
        said, _ = self.run_section("My solver's output against VOF, in one command", ("sh",))
        self.assertIn("time_s,T,Z_over_L\n0,0,1\n", said[0])
        self.assertIn("\n0.16,", said[0])

    def test_solver_in_continuous_integration(self):
        said, _ = self.run_section("My solver in continuous integration", ("sh", "sh fails"))
        self.assertEqual(len(said), 3)
        self.assertIn("passed (0 of", said[1])
        self.assertRegex(said[2], r"front +failed +0\.16 s")
        suite = xml.etree.ElementTree.parse(self.folder / "check.xml").getroot()[0]
        self.assertGreater(int(suite.get("tests")), 5)
        self.assertEqual((suite.get("failures"), suite.get("errors")), ("0", "0"))
        self.assertIs(json.loads((self.folder / "check.json").read_text())["passed"], True)

    def test_workflow_passes_and_fails_with_the_solver(self):
        import yaml
        workflow = yaml.safe_load((self.folder / "workflow.yml").read_text(encoding="utf-8"))
        steps = {step["name"]: step["run"] for step in workflow["jobs"]["dam-break"]["steps"] if "run" in step}
        self.run_block("".join(blocks("My solver in continuous integration")[0][1:]))
        self.run_block(steps["compute"])
        self.run_block(steps["check"])
        broken = steps["compute"].replace("out", "out 10.3")
        self.run_block(broken)
        said = self.run_block(steps["check"], 2)
        self.assertIn("failed (", said)
        self.assertIn("<failure", (self.folder / "check.xml").read_text())


class Studies(Example):
    def setUp(self):
        super().setUp()
        if not shutil.which("interFoam"):
            self.skipTest("no OpenFOAM")

    def test_solver_against_vof(self):
        said, root = self.run_section("My solver's output against VOF, in one command", ("sh", "sh allrun"))
        self.assertRegex(said[1], r"my-solver +complete +0\.\d")
        page = (root / "report/index.html").read_text(encoding="utf-8")
        self.assertIn("my-solver", page)
        self.assertIn("out: passed", said[2])

    def test_geometry_through_all_programs(self):
        said, root = self.run_section("My geometry through all programs", ("sh allrun",))
        for run in ("mps", "sph", "isph", "vof"):
            self.assertRegex(said[0], rf"{run} +complete")
        metrics = json.loads((root / "report/metrics.json").read_text(encoding="utf-8"))
        self.assertEqual(set(metrics["front"]), {"mps", "sph", "isph", "vof"})

    def test_wedge_in_its_path(self):
        said, root = self.run_section("A wedge in its path", ("sh allrun",))
        for run in ("mps", "sph", "isph", "vof"):
            self.assertRegex(said[0], rf"{run} +complete")
        metrics = json.loads((root / "report/metrics.json").read_text(encoding="utf-8"))
        self.assertEqual(set(metrics["front"]), {"mps", "sph", "isph", "vof"})
        vof = json.loads((root / "runs/vof/manifest.json").read_text(encoding="utf-8"))
        mps = json.loads((root / "runs/mps/manifest.json").read_text(encoding="utf-8"))
        self.assertEqual(vof["case"]["obstacles"], mps["case"]["obstacles"])
        self.assertEqual(mps["case"]["obstacles"][0]["polygon"], [[0.45, 0.0], [0.7, 0.0], [0.7, 0.15]])
        page = (root / "report/index.html").read_text(encoding="utf-8")
        self.assertIn('"outlines"', page)


if __name__ == "__main__":
    unittest.main()
