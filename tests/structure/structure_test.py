"""The rules of the layout that a compiler does not hold: includes go downwards, files stay short, types differ in name."""

import re
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LONGEST = 350  # lines of a source file

# A folder may include what stands in a row above its own, and itself.
PARTICLE = [["support"], ["case"], ["core"], ["kernel", "linear"], ["mps", "sph", "isph"], ["io"]]
COMPARE = [["read"], ["measure"], ["reference"], ["verification"], ["study"], ["figures"], ["report"],
           ["library", "commands"], ["movie"]]
# What the rebuild has still to mend. An entry that is no longer needed fails the test, so that the list
# can only shrink.
LEFT_UPWARDS: set[str] = set()
LEFT_LONG: set[str] = set()

# What lies at the top besides dot files.
TOP = {"particle", "foam_cases", "compare", "tests", "docs", "Allrun", "Alltest", "Allclean", "CMakeLists.txt",
       "CMakePresets.json", "README.md", "CHANGELOG.md", "CONTRIBUTING.md", "CODE_OF_CONDUCT.md", "CITATION.cff",
       "LICENSE"}

# The one file outside of a method's folder that names it.
METHODS = "particle/io/methods.cpp"

# What other programs may use of the particle library: it knows no method.
SHARED = ("particle/support", "particle/case")


def rank(part: str, rows: list[list[str]]) -> int:
    return next(number for number, row in enumerate(rows) if part in row)


def sources(*folders: str) -> list[Path]:
    listed = subprocess.run(["git", "ls-files", "--", *folders], cwd=ROOT, capture_output=True,
                            text=True, check=True).stdout.split("\n")
    return [Path(name) for name in listed if name and (ROOT / name).is_file()]


def includes(path: Path) -> list[str]:
    return re.findall(r'^#include "([^"]+)"', (ROOT / path).read_text(encoding="utf-8"), re.MULTILINE)


def violation(path: Path, included: str) -> str | None:
    """Why `path` must not include `included`; None where it may."""
    parts, other = path.parts, Path(included).parts
    here, there = "/".join(parts[:2]), "/".join(other[:2])
    if here == there or len(other) < 3:
        return None
    for top, rows in (("particle", PARTICLE), ("compare", COMPARE)):
        if parts[0] != top:
            continue
        if other[0] != top:
            return None if there in SHARED else f"{path} includes {included}, which is another program's"
        if len(parts) == 2:  # main.cpp stands above all of its folders
            return None
        if rank(other[1], rows) >= rank(parts[1], rows):
            return f"{path} includes {included}, which is not below it"
    if parts[0] == "foam_cases" and other[0] != "foam_cases" and there not in SHARED:
        return f"{path} includes {included}, which is another program's"
    return None


TOKENS = re.compile(r"namespace\s*([\w:]*)\s*\{|\{|\}|\b(?:struct|class)\s+(\w+)\s*(?:final\s*)?(?::(?!:)[^{;]*)?(?=\{)")


def types(text: str) -> set[str]:
    """Full names of the types that a source defines in a namespace with a name."""
    names, inside = set(), []
    for token in TOKENS.finditer(re.sub(r"//.*|\"(?:[^\"\\]|\\.)*\"", "", text)):
        if token[0].startswith("namespace"):
            inside.append(token[1])
        elif token[0] == "{":
            inside.append(None)
        elif token[0] == "}":
            if inside:
                inside.pop()
        elif all(inside):
            names.add("::".join([*inside, token[2]]))
    return names


class Structure(unittest.TestCase):
    def test_a_type_has_a_name_of_its_own(self):
        # Two of one name in one program: the linker keeps either's functions, in silence.
        places: dict[str, list[str]] = {}
        for path in sources("particle", "compare", "foam_cases"):
            if path.suffix in (".hpp", ".cpp"):
                for name in types((ROOT / path).read_text(encoding="utf-8")):
                    places.setdefault(name, []).append(str(path))
        self.assertGreater(len(places), 300)
        self.assertEqual({}, {name: files for name, files in places.items() if len(files) > 1})

    def test_the_rule_finds_types(self):
        self.assertEqual({"a::b::S", "a::b::C"}, types(
            "namespace a::b {\nstruct S : T {\n struct Inner {};\n};\nnamespace { struct Own {}; }\n"
            "class C {\n};\nstruct C::Hidden { int x; };\nstruct Declared;\n}"))

    def test_includes_go_downwards(self):
        found = {path: text for path in sources("particle", "compare", "foam_cases")
                 if path.suffix in (".cpp", ".hpp")
                 for included in includes(path) if (text := violation(path, included))}
        told = [text for path, text in found.items() if str(path) not in LEFT_UPWARDS]
        self.assertEqual([], told, "\n" + "\n".join(told))
        self.assertEqual(set(), LEFT_UPWARDS - {str(path) for path in found}, "mended: take it out")

    def test_the_rule_finds_what_is_upside_down(self):
        self.assertIsNone(violation(Path("particle/mps/a.cpp"), "particle/core/b.hpp"))
        self.assertIsNone(violation(Path("compare/read/a.cpp"), "particle/case/case.hpp"))
        self.assertIn("below", violation(Path("particle/case/a.cpp"), "particle/mps/params.hpp"))
        self.assertIn("below", violation(Path("particle/mps/a.cpp"), "particle/sph/params.hpp"))
        self.assertIn("below", violation(Path("compare/measure/a.cpp"), "compare/study/b.hpp"))
        self.assertIn("program", violation(Path("compare/read/a.cpp"), "particle/mps/b.hpp"))

    def test_a_method_is_its_folder_and_one_entry(self):
        methods = [path.parent.name for path in sources("particle") if path.name == "method.hpp"]
        self.assertIn("mps", methods)
        entry = (ROOT / METHODS).read_text(encoding="utf-8")
        for method in methods:
            entries = re.findall(rf"\b{method}::", entry)  # sph is not isph
            self.assertEqual(1, len(entries), f"{METHODS}: one entry of {method}")
            named = re.compile(rf'"{method}"|\b{method}::|"particle/{method}/')
            for path in sources("particle"):
                if path.suffix not in (".cpp", ".hpp", ".cmake", ".txt"):
                    continue
                if path.parts[1] == method or str(path) == METHODS:
                    continue
                lines = (re.sub(r"//.*", "", line)
                         for line in (ROOT / path).read_text(encoding="utf-8").splitlines())
                self.assertEqual([], [line for line in lines if named.search(line)], str(path))

    def test_nothing_else_lies_at_the_top(self):
        top = {path.parts[0] for path in sources(".")}
        self.assertEqual(TOP, {name for name in top if not name.startswith(".")})

    def test_files_are_short(self):
        found = {}
        for path in sources("particle", "compare", "foam_cases", "tests", ".ci"):
            if path.suffix not in (".cpp", ".hpp", ".py", ".js", ".css", ".sh", ".cmake", ".html"):
                continue
            lines = len((ROOT / path).read_text(encoding="utf-8").splitlines())
            if lines > LONGEST:
                found[str(path)] = f"{path}: {lines} lines, at most {LONGEST}"
        told = [text for path, text in found.items() if path not in LEFT_LONG]
        self.assertEqual([], told, "\n" + "\n".join(told))
        self.assertEqual(set(), LEFT_LONG - set(found), "mended: take it out")


if __name__ == "__main__":
    sys.exit(unittest.main())
