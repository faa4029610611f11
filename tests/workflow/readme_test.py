"""What the README says about the sources is true."""

import re
import subprocess
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
README = (SOURCE / "README.md").read_text(encoding="utf-8")
PAPER = range(3, 27)  # its discretised equations


def section(title):
    return README.split(f"\n## {title}\n")[1].split("\n## ")[0]


def numbers(text):
    return [int(number) for number in re.findall(r"\((\d+)\)", text)]


class EquationMap(unittest.TestCase):
    def setUp(self):
        rows = re.findall(r"^\| (\([^|]*\)) \| [^|]+ \| `([^`|]+)` \|$",
                          section("From the equation to the file"), re.MULTILINE)
        self.map = {(number, file) for cell, file in rows for number in numbers(cell)}

    def test_every_equation_is_found_where_the_map_says(self):
        self.assertTrue(self.map)
        for number, file in sorted(self.map):
            with self.subTest(equation=number, file=file):
                text = (SOURCE / "particle" / file).read_text(encoding="utf-8")
                self.assertIn(f"Eq. ({number})", text)

    def test_every_heading_in_the_sources_is_in_the_map(self):
        headings = set()
        for path in (SOURCE / "particle").rglob("*.[ch]pp"):
            for line in path.read_text(encoding="utf-8").splitlines():
                heading = re.fullmatch(r"\s*// Eqs?\. (\(\d+\)(?:(?:, | and )\(\d+\))*).*", line)
                for number in numbers(heading[1]) if heading else []:
                    headings.add((number, str(path.relative_to(SOURCE / "particle"))))
        self.assertTrue(headings)
        self.assertEqual(headings - self.map, set())

    def test_no_equation_of_the_paper_is_passed_over(self):
        mapped = {number for number, _ in self.map}
        prose = section("From the equation to the file").split("Not computed by themselves:")[1]
        self.assertEqual(set(PAPER) - mapped - set(numbers(prose)), set())


class Names(unittest.TestCase):
    def test_every_path_exists(self):
        paths = re.findall(r"\b(?:particle|compare|foam_cases|tests)/[\w./-]*\w", README)
        self.assertTrue(paths)
        for path in paths:
            self.assertTrue((SOURCE / path).exists(), path)
        for target in re.findall(r"\]\(([^)#:]+)\)", README):
            self.assertTrue((SOURCE / target).exists(), target)

    def test_every_option_of_allrun_exists(self):
        usage = subprocess.run([SOURCE / "Allrun", "--help"], capture_output=True, text=True,
                               check=True).stdout
        for option in re.findall(r"`\./Allrun (--[\w-]+)|`(--[\w-]+)` (?:prints|says|runs|lists)", README):
            self.assertIn(option[0] or option[1], usage)

    def test_every_preset_exists(self):
        presets = re.findall(r"\b[Pp]reset\s+`([\w-]+)`", README)
        presets += re.findall(r"is preset `([\w-]+)`", README)
        self.assertTrue(presets)
        for preset in presets:
            self.assertTrue((SOURCE / f"particle/cases/presets/{preset}.toml").exists(), preset)

    def test_every_reference_is_listed_and_cited(self):
        listed = {int(number) for number in re.findall(r"^(\d+)\. ", section("References"), re.MULTILINE)}
        text = README.split("\n## References\n")[0]
        cited = {int(number) for number in re.findall(r"\[(\d+)\](?!\()", text)}
        self.assertEqual(cited - listed, set())

    def test_version_is_one(self):
        cmake = (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")
        version = re.search(r"project\(SurgeFront VERSION ([\d.]+)", cmake)[1]
        citation = (SOURCE / "CITATION.cff").read_text(encoding="utf-8")
        self.assertIn(f"\nversion: {version}\n", citation)


if __name__ == "__main__":
    unittest.main()
