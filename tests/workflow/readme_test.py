"""What the README and the pages of docs say about the sources is true."""

import re
import subprocess
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
README = (SOURCE / "README.md").read_text(encoding="utf-8")
PAGES = {path: path.read_text(encoding="utf-8")
         for path in (SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", SOURCE / "CODE_OF_CONDUCT.md",
                      *sorted((SOURCE / "docs").glob("*.md")))}
TEXT = "\n".join(PAGES.values())
PAPER = range(3, 27)  # its discretised equations


def section(title):
    text = PAGES[SOURCE / "docs/paper.md"]
    return text.split(f"\n## {title}\n")[1].split("\n## ")[0]


def blocks(text):
    """Shell blocks, each as its commands: continued lines are one, and the folder of the examples goes unsaid."""
    found = re.findall(r"```sh[ a-z]*\n(.*?)```", text, re.DOTALL)
    return [[" ".join(command.split()).replace("docs/examples/", "")
             for command in block.replace("\\\n", " ").strip().splitlines()] for block in found]


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
        paths = re.findall(r"(?<![\w/.-])(?:particle|compare|foam_cases|tests|docs)/[\w./-]*\w", TEXT)
        self.assertTrue(paths)
        for path in set(paths) - {"docs/examples/out"}:  # what the example's solver writes
            self.assertTrue((SOURCE / path).exists(), path)

    def test_every_link_leads_to_a_file(self):
        for page, text in PAGES.items():
            for target in re.findall(r"\]\(([^)#:\s]+)\)", text):
                self.assertTrue((page.parent / target).exists(), f"{page.name}: {target}")

    def test_every_option_of_allrun_exists(self):
        usage = subprocess.run([SOURCE / "Allrun", "--help"], capture_output=True, text=True,
                               check=True).stdout
        found = re.findall(r"\./Allrun (--[\w-]+)", TEXT)
        found += re.findall(r"`(--[\w-]+)` (?:prints|says|runs|lists)", README)
        self.assertTrue(found)
        for option in found:
            self.assertIn(option, usage)

    def test_every_preset_exists(self):
        names = [path.stem for path in (SOURCE / "particle/cases/presets").glob("*.toml")]
        names += [name.split("-", 1)[1] for name in names]  # without their method's name
        presets = re.findall(r"\b[Pp]reset\s+`([\w-]+)`", TEXT)
        presets += re.findall(r"method\.preset ?= ?\"?([\w-]+)", TEXT)
        self.assertTrue(presets)
        for preset in presets:
            self.assertIn(preset, names)

    def test_every_reference_is_listed_and_cited(self):
        references = PAGES[SOURCE / "docs/references.md"]
        listed = {int(number) for number in re.findall(r"^(\d+)\. ", references, re.MULTILINE)}
        self.assertEqual(listed, set(range(1, len(listed) + 1)))
        cited = {int(number) for page, text in PAGES.items() if page.stem != "references"
                 for found in re.findall(r"\[(\d+(?:, \d+)*)\](?!\()",
                                         re.sub(r"```.*?```", "", text, flags=re.DOTALL))
                 for number in found.split(", ")}
        self.assertEqual(cited - listed, set())
        self.assertTrue(cited)


class Readme(unittest.TestCase):
    def test_it_is_short(self):
        prose = re.sub(r"<!-- answers.*?<!-- end of answers -->|<!--.*?-->", "", README, flags=re.DOTALL)
        self.assertLess(len(prose.split()), 700)

    def test_its_recipes_are_those_that_the_tests_run(self):
        """tests/docs/worked_examples_test.py runs every block of the page."""
        recipes = blocks(README.split("\n## Three recipes\n")[1].split("\n## ")[0])
        self.assertEqual(len(recipes), 3)
        run = [line for block in blocks(PAGES[SOURCE / "docs/worked-examples.md"]) for line in block]
        for line in (line for block in recipes for line in block):
            self.assertIn(line, run)

    def test_every_page_is_in_the_site(self):
        index = PAGES[SOURCE / "docs/index.md"]
        for page in (SOURCE / "docs").glob("*.md"):
            if page.stem != "index":
                self.assertRegex(index, rf"(?m)^{page.stem}$")

    def test_public_ci_runs_what_ci_runs(self):
        text = (SOURCE / ".github/workflows/ci.yml").read_text(encoding="utf-8")
        self.assertIn("run: .ci/run ${{ matrix.options }}", text)
        found = {tuple(pair) for pair in re.findall(r'cxx: ([\w+]+), options: "([^"]*)"', text)}
        self.assertEqual(found, {(compiler, option) for compiler in ("g++", "clang++")
                                 for option in ("", "--sanitize")})

    def test_version_is_one(self):
        cmake = (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")
        version = re.search(r"project\(SurgeFront VERSION ([\d.]+)", cmake)[1]
        citation = (SOURCE / "CITATION.cff").read_text(encoding="utf-8")
        self.assertIn(f"\nversion: {version}\n", citation)
        changes = (SOURCE / "CHANGELOG.md").read_text(encoding="utf-8")
        released = re.search(r"(?m)^date-released: (\S+)$", citation)[1]
        self.assertIn(f"\n## [{version}] - {released}\n", changes)

    def test_citation_is_complete(self):
        import yaml
        citation = yaml.safe_load((SOURCE / "CITATION.cff").read_text(encoding="utf-8"))
        for key in ("cff-version", "message", "type", "title", "version", "date-released", "license", "abstract",
                    "authors", "keywords", "references"):
            self.assertTrue(citation.get(key), key)
        for reference in citation["references"]:
            for key in ("type", "title", "authors"):
                self.assertTrue(reference.get(key), (key, reference))
            if reference["type"] == "article":
                for key in ("journal", "volume", "year", "start", "end"):
                    self.assertTrue(reference.get(key), (key, reference))


if __name__ == "__main__":
    unittest.main()
