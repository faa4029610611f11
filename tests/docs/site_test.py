"""The documentation builds without a warning, and no link between its pages leads nowhere.

Usage: site_test.py PROGRAM_FOLDER [TEST...]; 77 without Sphinx, MyST, Breathe, Doxygen or the theme.
"""

import html
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

SOURCE = Path(__file__).resolve().parents[2]
PROGRAMS = Path(sys.argv.pop(1)).resolve()


class Page(HTMLParser):
    """Links and anchors of a page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if attrs.get("id"):
            self.anchors.add(attrs["id"])
        name = {"a": "href", "link": "href", "img": "src", "script": "src"}.get(tag)
        if attrs.get(name):
            self.links.append(attrs[name])


def broken(site):
    """(page, link) of every link within the site without a target."""
    pages = {path.resolve(): Page(path.read_text(encoding="utf-8")) for path in site.rglob("*.html")}
    found = []
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            there = target.is_file() and (not parts.fragment or target not in pages
                                          or parts.fragment in pages[target].anchors)
            if not there:
                found.append((path.relative_to(site.resolve()).as_posix(), link))
    return found


def build(out, programs=PROGRAMS, root=SOURCE):
    return subprocess.run([root / "docs/build", "--bin", programs, "--out", out], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)


class Links(unittest.TestCase):
    def test_finds_what_is_broken(self):
        with tempfile.TemporaryDirectory() as folder:
            site = Path(folder)
            (site / "a.html").write_text('<p id="here"><a href="b.html">b</a><a href="a.html#here">a</a>'
                                         '<a href="a.html#gone">x</a><a href="https://x.org/y">y</a>')
            self.assertEqual(broken(site), [("a.html", "b.html"), ("a.html", "a.html#gone")])


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.site = Path(folder.name) / "html"
        done = build(cls.site)
        assert done.returncode == 0, done.stdout

    def test_no_link_is_broken(self):
        self.assertEqual(broken(self.site), [])

    def test_nothing_is_loaded_from_elsewhere(self):
        for path in self.site.rglob("*.html"):
            text = path.read_text(encoding="utf-8")
            self.assertEqual(re.findall(r"""<(?:script|img|link)[^>]*(?:src|href)=["']https?://[^>]*>""", text),
                             [], path.name)
        self.assertIn("<math", (self.site / "theory.html").read_text(encoding="utf-8"))

    def test_every_page_is_there(self):
        for path in (SOURCE / "docs").glob("*.md"):
            self.assertTrue((self.site / f"{path.stem}.html").is_file(), path.name)

    def test_reference_is_what_the_programs_say(self):
        for page, command in (("case-file", ("surge-particle", "list", "--options")),
                              ("observables", ("surge-compare", "measure", "--list")),
                              ("foam-settings", ("surge-foam", "list"))):
            said = subprocess.run([PROGRAMS / command[0], *command[1:]], text=True, check=True,
                                  capture_output=True).stdout
            text = (self.site / "reference" / f"{page}.html").read_text(encoding="utf-8")
            text = html.unescape(re.sub(r"<[^>]*>", "", text))
            for line in said.splitlines():
                self.assertIn(line.rstrip(), text, page)


    def test_the_public_header_has_its_page(self):
        text = re.sub(r"<[^>]*>", "", (self.site / "reference/library.html").read_text(encoding="utf-8"))
        header = (SOURCE / "compare/library/surgefront.hpp").read_text(encoding="utf-8")
        names = re.findall(r"^(?:class|struct) \w+", header, re.MULTILINE)
        self.assertIn("class Frames", names)
        for name in names:
            self.assertIn(name, text)
        self.assertIn("Against a baseline that bless() wrote", text)


class Mistakes(unittest.TestCase):
    def test_programs_that_are_not_there(self):
        with tempfile.TemporaryDirectory() as folder:
            done = build(Path(folder) / "html", Path(folder))
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stdout, "surge-particle: not there; build the programs first")

    def test_a_link_to_no_page_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "docs").mkdir()
            for name in ("docs/build", "docs/conf.py", "CMakeLists.txt"):
                (root / name).write_bytes((SOURCE / name).read_bytes())
            (root / "docs/build").chmod(0o755)
            (root / "compare/library").mkdir(parents=True)
            header = "compare/library/surgefront.hpp"
            (root / header).write_bytes((SOURCE / header).read_bytes())
            for name in ("CHANGELOG.md", "CONTRIBUTING.md", "CODE_OF_CONDUCT.md"):
                (root / name).write_text("---\norphan: true\n---\n# Title\n")
            pages = ("case-file", "foam-settings", "observables", "map-file", "surge-particle",
                     "surge-compare", "surge-foam", "library")
            index = "# Index\n\n```{toctree}\n" + "".join(f"reference/{page}\n" for page in pages) + "```\n"
            for name in ("worked-examples", "cases", "vof", "measuring", "studies", "foreign-codes"):
                (root / f"docs/{name}.md").write_text("---\norphan: true\n---\n# Title\n")
            (root / "docs/index.md").write_text(index)
            self.assertEqual((done := build(root / "html", root=root)).returncode, 0, done.stdout)
            (root / "docs/index.md").write_text(f"{index}\n[gone](gone.md)\n")
            done = build(root / "html", root=root)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("gone.md", done.stdout)
            (root / "docs/index.md").write_text(index)
            with open(root / header, "a", encoding="utf-8") as more:
                more.write("namespace surgefront {\nvoid untold();\n}\n")
            done = build(root / "html", root=root)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertRegex(done.stdout, r"surgefront\.hpp:\d+: .*untold")


if __name__ == "__main__":
    if subprocess.run(["/usr/bin/python3", "-c", "import sphinx, myst_parser, breathe, furo"],
                      stderr=subprocess.DEVNULL, check=False).returncode != 0 or not shutil.which("doxygen"):
        print("skipped: Sphinx, MyST, Breathe, the theme furo or Doxygen is not installed (.ci/packages.txt)")
        sys.exit(77)
    unittest.main()
