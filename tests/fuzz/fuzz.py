"""Runs one fuzz target for a while from its corpus; fails where it finds something, and shows the input.

    fuzz.py PROGRAMS TARGET [--seconds N] [--keep DIR] [--seed N]
"""

import argparse
import base64
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
LONGEST_INPUT = 1 << 15  # bytes; the readers' limits are tested by themselves
LONGEST_S = 120  # for one input: what hangs, not what is slow beside other work
MEMORY_MIB = 1024  # of the whole process
ONE_BLOCK_MIB = 256  # no input of 32 KiB needs more at once
SEED = 20100503

# Leaks: libraries keep what they found on first use. Containers: the libraries are not instrumented.
SANITIZER = "detect_leaks=0:detect_container_overflow=0:allocator_may_return_null=0"


def command(program: Path, target: str, work: Path, options: argparse.Namespace) -> list[str]:
    corpus = HERE / "corpus" / target
    words = [str(program), str(work / "found"), *([str(corpus)] if corpus.is_dir() else [])]
    for key, value in {"detect_leaks": 0, "max_total_time": options.seconds, "timeout": LONGEST_S, "seed": options.seed,
                       "rss_limit_mb": MEMORY_MIB, "malloc_limit_mb": ONE_BLOCK_MIB,
                       "max_len": LONGEST_INPUT, "artifact_prefix": f"{work}/",
                       "print_final_stats": 1}.items():
        words.append(f"-{key}={value}")
    dictionary = HERE / "dictionaries" / target
    if dictionary.is_file():
        words.append(f"-dict={dictionary}")
    return words


def refused(program: Path, target: str) -> list[str]:
    """Inputs of the corpus that the reader does not take, and why: from those nothing gets far into it.
    Names that begin with `refused` are of inputs that are to be refused."""
    corpus = HERE / "corpus" / target
    files = [file for file in sorted(corpus.iterdir()) if not file.name.startswith("refused")]
    done = subprocess.run([str(program), "-detect_leaks=0", *map(str, files)], capture_output=True, text=True, errors="replace",
                          check=False, stdin=subprocess.DEVNULL,
                          env={**os.environ, "ASAN_OPTIONS": SANITIZER, "OMP_NUM_THREADS": "1",
                               "SURGE_FUZZ_TELL": "1"})
    verdicts = re.findall(r"^verdict: (.*)", done.stderr, re.MULTILINE)
    if done.returncode != 0 or len(verdicts) != len(files):
        return [f"{target}: the corpus ends it:\n{done.stderr[-6000:]}"]
    return [f"{file}: not taken: {verdict}" for file, verdict in zip(files, verdicts) if verdict != "taken"]


def run(target: str, options: argparse.Namespace, work: Path) -> int:
    program = options.programs / f"{target}_fuzz"
    if not program.is_file():
        print(f"{program}: found none, expected it built: cmake --preset fuzz && "
              "cmake --build --preset fuzz (./Alltest -L fuzz does both)")
        return 1
    if stale := refused(program, target):
        print("\n".join(stale))
        return 1
    (work / "found").mkdir(parents=True, exist_ok=True)
    done = subprocess.run(command(program, target, work, options), capture_output=True, text=True,
                          errors="replace", check=False, stdin=subprocess.DEVNULL, cwd=work,
                          timeout=options.seconds + 5 * LONGEST_S,
                          env={**os.environ, "ASAN_OPTIONS": SANITIZER, "OMP_NUM_THREADS": "1"})
    count = re.search(r"stat::number_of_executed_units: *(\d+)", done.stderr)
    cover = re.findall(r"cov: (\d+)", done.stderr) or ["?"]
    print(f"{target}: {count[1] if count else '?'} inputs in {options.seconds} s, "
          f"{cover[-1]} edges covered (at first {cover[0]}), "
          f"{'nothing found' if done.returncode == 0 else 'FOUND (see below)'}")
    if done.returncode == 0:
        return 0 if count else 1
    print(done.stderr[-6000:])
    for found in sorted(work.glob("*-*")):
        if found.is_file():
            print(f"{found.name}:\n{base64.b64encode(found.read_bytes()).decode()}")
    return 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=Path)
    parser.add_argument("target")
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--keep", type=Path, help="folder for what is found; else a temporary one")
    options = parser.parse_args()
    options.programs = options.programs.resolve()
    if options.keep:
        return run(options.target, options, options.keep.resolve())
    with tempfile.TemporaryDirectory(prefix="surge_fuzz_") as folder:
        return run(options.target, options, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
