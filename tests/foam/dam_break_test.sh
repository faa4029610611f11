#!/usr/bin/env bash
# Tests of foam_cases/damBreak2D as its user meets it: dam_break_test.sh TEST, with one of the
# functions below. Exit status 77: skipped, because OpenFOAM is not installed.
set -euo pipefail
template=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../foam_cases/damBreak2D" && pwd)
scratch=$(mktemp -d)

finish() { # with nothing left behind, whatever has happened
  if [[ -f $scratch/case/.steps/process ]]; then
    kill -9 "$(cat "$scratch/case/.steps/process")" 2>/dev/null || true
  fi
  rm -rf "$scratch"
}
trap finish EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

make_case() { # FOLDER [KEY=VALUE]...: a clean copy, small and short
  local folder=$1 change key
  shift
  cp -r "$template" "$folder"
  "$folder/Allclean"
  for change in cellsPerL=10 endTime=0.02 writeInterval=0.01 writeFormat=ascii "$@"; do
    key=${change%%=*}
    grep -q "^$key " "$folder/system/caseParameters" || fail "caseParameters has no $key"
    sed -i "s/^$key .*/$key ${change#*=};/" "$folder/system/caseParameters"
  done
}

expect() { # FILE TEXT: a line with TEXT
  grep -qF -- "$2" "$1" || fail "$1: no line with '$2': $(cat "$1")"
}

refuse() { # TEXT COMMAND...: it must fail, with TEXT on a line
  local text=$1
  shift
  if "$@" >"$scratch/output" 2>&1; then fail "accepted: $*"; fi
  expect "$scratch/output" "$text"
}

await() { # FILE TEXT
  local tries
  for ((tries = 0; tries < 600; tries++)); do
    if grep -qs -- "$2" "$1"; then return; fi
    sleep 0.05
  done
  fail "waited in vain for '$2' in $1"
}

manifest_holds() { # FOLDER EXPRESSION...: conditions on the manifest m, in Python
  python3 - "$@" <<'TEXT' || fail "manifest of $1"
import json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
m = json.loads((folder / "manifest.json").read_text())
log = (folder / f"log.{m['program']}").read_text()
wrong = [e for e in sys.argv[2:] if not eval(e)]
sys.exit("\n".join(["false: " + e for e in wrong] + [json.dumps(m)]) if wrong else 0)
TEXT
}

# A run writes what it has done; a second call does nothing; a changed input repeats its step.
# The folder has white space in its name.
run() {
  local folder="$scratch/white space"
  make_case "$folder"
  "$folder/Allrun" >"$scratch/output"
  [[ -f $folder/0.01/alpha.water && -f $folder/0.02/alpha.water ]] || fail "no time directories"
  [[ -f $folder/vof.foam ]] || fail "nothing for ParaView to open"
  [[ $(ls "$folder/0.01") == $'U\nalpha.water\np\nuniform' ]] || fail "frame: $(ls "$folder/0.01")"
  [[ -f $folder/0.02/phi && -f $folder/0.02/p_rgh ]] || fail "last frame: $(ls "$folder/0.02")"
  manifest_holds "$folder" 'm["finished"] is True' 'm["program"] == "interFoam"' \
    'm["threads"] == 1' 'm["cells"] == 36 * 10**2' 'm["simulated_s"] == 0.02' \
    'm["steps"] == log.count("\nTime = ") > 20' 'abs(m["water_volume_change"]) < 1e-6' \
    '0.99 < m["alpha_max"] < 1.01' 'm["wall_s"]["total"] >= m["wall_s"]["solve"] > 0' \
    'm["case"]["tank"]["upper"] == [0.58, 2.32, 0]' 'm["case"]["tank"]["wall"] == "slip"' \
    'm["case"]["blocks"][0]["upper"] == [0.145, 0.29, 0]' 'm["case"]["dimension"] == 2' \
    'm["case"]["fluid"]["gravity"] == [0, -9.81, 0]' 'm["case"]["method"]["name"] == "vof"' \
    'm["case"]["fluid"]["density"] == 1000' 'm["case"]["time"]["end"] == 0.02' \
    'm["case"]["probes"][0]["name"] == "wall_pressure"' \
    'abs(m["case"]["probes"][0]["position"][0] - 0.58) < 1e-6' \
    'abs(m["case"]["probes"][0]["position"][1] - 0.0145) < 1e-9' \
    'len((folder / "postProcessing/wallPressure/0/p").read_text().splitlines()) > m["steps"]'
  cp -p "$folder/manifest.json" "$scratch/first.json"

  "$folder/Allrun" >"$scratch/output"
  [[ $(grep -c ': done before$' "$scratch/output") == 5 ]] || fail "repeated what was done"
  cmp "$folder/manifest.json" "$scratch/first.json"

  sed -i 's/nLimiterIter .*/nLimiterIter 3;/' "$folder/system/fvSolution"
  "$folder/Allrun" >"$scratch/output"
  expect "$scratch/output" "setFields: done before"
  grep -qx "solve: done" "$scratch/output" || fail "a changed fvSolution was not seen"
  if cmp -s "$folder/manifest.json" "$scratch/first.json"; then fail "old manifest kept"; fi

  rm -r "$folder/constant/polyMesh"
  "$folder/Allrun" >"$scratch/output"
  grep -qx "blockMesh: done" "$scratch/output" || fail "took a mesh for done that is not there"
}

# Every choice arrives in what the solver has read.
choices() {
  make_case "$scratch/case" wall=noSlip nuWater=1e-6 nuAir=1.48e-5 sigma=0.072 cellsPerL=5 \
    rhoAir=1.2 maxCo=0.3 cAlpha=1.5 alphaScheme=MUSCL 'timeScheme=CrankNicolson 0.9'
  "$scratch/case/Allrun" >"$scratch/output"
  manifest_holds "$scratch/case" 'm["case"]["tank"]["wall"] == "no-slip"' 'm["cells"] == 900' \
    'm["case"]["fluid"]["kinematic_viscosity"] == 1e-6' 'm["case"]["gas"]["density"] == 1.2' \
    'm["case"]["gas"]["kinematic_viscosity"] == 1.48e-5' 'm["case"]["surface_tension"] == 0.072' \
    'm["case"]["time"]["courant"] == 0.3' 'm["case"]["method"]["parameters"]["c_alpha"] == 1.5' \
    'm["case"]["method"]["parameters"]["div_alpha"] == "Gauss MUSCL"' \
    'm["case"]["method"]["parameters"]["ddt"] == "CrankNicolson 0.9"'
}

# All water that was in the case is in the manifest: a layer besides the column, which overlap.
regions() {
  make_case "$scratch/case" cellsPerL=10
  local layer='boxToCell { box (-1 -1 -1) (10 0.029 1); fieldValues ( volScalarFieldValue alpha.water 1 ); }'
  sed -i "s/^regions\$/&/; /^regions/,/^(/ s/^(\$/(\n    $layer/" "$scratch/case/system/setFieldsDict"
  "$scratch/case/Allrun" >"$scratch/output"
  manifest_holds "$scratch/case" 'len(m["case"]["blocks"]) == 2' \
    'm["case"]["blocks"][0]["upper"] == [0.58, 0.029, 0]' \
    'm["case"]["blocks"][1]["upper"] == [0.145, 0.29, 0]' 'abs(m["water_volume_change"]) < 1e-6'
  # What it cannot state is no manifest.
  sed -i 's/boxToCell { box (-1 -1 -1) (10 0.029 1);/boxToFace { box (-1 -1 -1) (10 0.029 1);/' \
    "$scratch/case/system/setFieldsDict"
  refuse "boxToFace: found a region of this kind, expected boxToCell, sphereToCell or cylinderToCell" \
    env -C "$scratch/case" WM_PROJECT_DIR=/usr/share/openfoam ./manifest.py
  sed -i 's/boxToFace { box (-1 -1 -1) (10 0.029 1);/sphereToCell { centre (0.4 0.1 0); radius 0.05;/' \
    "$scratch/case/system/setFieldsDict"
  refuse "expected a sphere in 3D, a cylinder across the mesh in 2D" \
    env -C "$scratch/case" WM_PROJECT_DIR=/usr/share/openfoam ./manifest.py
}

# A mesh that leaves out more than the case states is no manifest either.
cut_by_hand() {
  make_case "$scratch/case" cellsPerL=5
  sed -i '/hex (3 4 9 8 /d; s/^    floor$/    cut { type wall; faces ((3 8 58 53) (9 8 58 59)); }\n&/
    s/(3 4 54 53)//; s/ *(4 9 59 54)//' "$scratch/case/system/blockMeshDict"
  sed -i 's/|floor)/|floor|cut)/' "$scratch/case"/0.orig/*
  refuse "obstacles: found 0 m3, expected the 0.00304863 m3 that the mesh leaves out" "$scratch/case/Allrun"
  sed -i 's/^vertices$/obstacles ( ((0.435 0 0) (0.58 0.145 0.145)) );\n&/' "$scratch/case/system/blockMeshDict"
  "$scratch/case/Allrun" >"$scratch/output"
  manifest_holds "$scratch/case" 'm["case"]["obstacles"] == [{"lower": [0.435, 0, 0], "upper": [0.58, 0.145, 0]}]' \
    'm["cells"] == 35 * 25'
}

# Edges of the column on cell faces at every resolution of the studies: no cell is cut.
resolutions() {
  local n cells
  make_case "$scratch/case"
  export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}
  for n in 10 20 29 40 58; do
    sed -i "s/^cellsPerL .*/cellsPerL $n;/" "$scratch/case/system/caseParameters"
    rm -rf "$scratch/case/0" && cp -r "$scratch/case/0.orig" "$scratch/case/0"
    blockMesh -case "$scratch/case" >/dev/null
    setFields -case "$scratch/case" >/dev/null
    cells=$(sed -n '/^internalField/,/^)/p' "$scratch/case/0/alpha.water" | grep -cx 1)
    ((cells == 2 * n * n)) || fail "$n cells per L: $cells cells of water"
  done
}

# A killed run leaves no manifest and is repeated from the start.
killed() {
  local folder=$scratch/case allrun solver status
  make_case "$folder" endTime=0.3
  "$folder/Allrun" >"$scratch/output" 2>&1 &
  allrun=$!
  await "$folder/log.interFoam" '^Time = 0.0'
  kill -9 "$(cat "$folder/.steps/process")"
  if wait $allrun; then fail "took a killed solver for a success"; fi
  expect "$scratch/output" "failed, see log.interFoam"
  [[ ! -e $folder/manifest.json ]] || fail "manifest of a killed solver"

  rm "$folder/log.interFoam"
  "$folder/Allrun" >"$scratch/output" 2>&1 &
  allrun=$!
  await "$folder/log.interFoam" '^Time = 0.0'
  expect "$scratch/output" "setFields: done before"
  solver=$(cat "$folder/.steps/process")
  kill -TERM $allrun
  wait $allrun && status=0 || status=$?
  ((status == 128 + 15)) || fail "exit status $status of a terminated Allrun"
  if kill -0 "$solver" 2>/dev/null; then fail "Allrun left its solver behind"; fi

  # Nothing can be done against SIGKILL, but the next call must not work beside the old solver.
  rm "$folder/log.interFoam"
  "$folder/Allrun" >"$scratch/output" 2>&1 &
  allrun=$!
  await "$folder/log.interFoam" '^Time = 0.0'
  solver=$(cat "$folder/.steps/process")
  kill -STOP "$solver"
  kill -9 $allrun
  wait $allrun 2>/dev/null || true
  sleep 1.2 # the nap of the killed Allrun
  refuse "a run is at work in this folder (process $solver)" "$folder/Allrun"
  refuse "a run is at work in this folder (process $solver)" "$folder/Allclean"
  kill -9 "$solver"
  await_end "$solver"

  mkdir "$folder/0.7" # as if left by a longer run
  "$folder/Allrun" >"$scratch/output"
  grep -qx "solve: done" "$scratch/output" || fail "a killed run was taken for done"
  [[ ! -e $folder/0.7 && -d $folder/0.3 ]] || fail "time directories of the killed run are left"
  manifest_holds "$folder" 'm["finished"] is True' 'm["simulated_s"] == 0.3'

  # Killed after a change that is then taken back: the old success is gone.
  sed -i 's/nLimiterIter .*/nLimiterIter 3;/' "$folder/system/fvSolution"
  rm "$folder/log.interFoam"
  "$folder/Allrun" >"$scratch/output" 2>&1 &
  allrun=$!
  await "$folder/log.interFoam" '^Time = 0.0'
  kill -TERM $allrun
  wait $allrun || true
  [[ ! -e $folder/manifest.json ]] || fail "the manifest of an earlier run is left"
  cp "$template/system/fvSolution" "$folder/system/fvSolution"
  "$folder/Allrun" >"$scratch/output"
  grep -qx "solve: done" "$scratch/output" || fail "a killed run was taken for the one before"
}

await_end() { # PROCESS
  local tries
  for ((tries = 0; tries < 100; tries++)); do
    if ! kill -0 "$1" 2>/dev/null; then return; fi
    sleep 0.1
  done
  fail "process $1 does not end"
}

# Two processes compute what one does, and leave one set of time directories.
parallel() {
  make_case "$scratch/case"
  "$scratch/case/Allrun" >"$scratch/output"
  cp "$scratch/case/0.02/alpha.water" "$scratch/serial"
  "$scratch/case/Allrun" --np 2 >"$scratch/output"
  expect "$scratch/output" "setFields: done before"
  manifest_holds "$scratch/case" 'm["finished"] is True' 'm["threads"] == 2' 'm["cells"] == 3600'
  [[ ! -e $scratch/case/processor0/0.02 ]] || fail "decomposed times are left"
  python3 - "$scratch/serial" "$scratch/case/0.02/alpha.water" <<'TEXT' || fail "fields differ"
import re, sys
serial, parallel = (
    [float(x) for x in re.search(r"nonuniform.*?\(\n(.*?)\)", open(f).read(), re.S)[1].split()]
    for f in sys.argv[1:]
)
assert len(serial) == len(parallel) == 3600
worst = max(abs(a - b) for a, b in zip(serial, parallel))
print("largest difference of alpha:", worst)
assert worst < 1e-4
TEXT
  "$scratch/case/Allrun" >"$scratch/output"
  [[ ! -e $scratch/case/processor0 ]] || fail "a serial run keeps the decomposed case"
  manifest_holds "$scratch/case" 'm["threads"] == 1'
}

# Where lscpu does not work (no /sys), a parallel run does.
no_sys() {
  make_case "$scratch/case" cellsPerL=5 endTime=0.01
  mkdir "$scratch/bin"
  printf '#!/bin/sh\necho "lscpu: no /sys" >&2\nexit 1\n' >"$scratch/bin/lscpu"
  chmod +x "$scratch/bin/lscpu"
  PATH=$scratch/bin:$PATH "$scratch/case/Allrun" --np 2 >"$scratch/output"
  manifest_holds "$scratch/case" 'm["finished"] is True' 'm["threads"] == 2'
}

# Allclean brings the template back, after a good run and after a failed one.
clean() {
  make_case "$scratch/case"
  cp -r "$scratch/case" "$scratch/before"
  "$scratch/case/Allrun" --np 2 >"$scratch/output"
  "$scratch/case/Allclean"
  diff -r "$scratch/before" "$scratch/case"
  rm "$scratch/case/constant/g"
  refuse "failed, see log.interFoam" "$scratch/case/Allrun"
  "$scratch/case/Allclean"
  cp "$template/constant/g" "$scratch/case/constant/g"
  diff -r "$scratch/before" "$scratch/case"
}

# Bad input gets one line and a non-zero exit.
bad_input() {
  make_case "$scratch/case"
  refuse "unknown option '--frobnicate'" "$scratch/case/Allrun" --frobnicate
  refuse "found '0', expected a whole number" "$scratch/case/Allrun" --np 0
  refuse "found 'missing', expected a whole number" "$scratch/case/Allrun" --np
  "$scratch/case/Allrun" --help >"$scratch/output"
  expect "$scratch/output" "Usage: ./Allrun"
  sed -i 's/^cellsPerL .*/cellsPerL 9.5;/' "$scratch/case/system/caseParameters"
  refuse "failed, see log.blockMesh" "$scratch/case/Allrun"
  sed -i 's/^solver .*/solver icoFoam;/' "$scratch/case/system/caseParameters"
  refuse "found 'icoFoam', expected interFoam or interIsoFoam" "$scratch/case/Allrun"
}

# Without OpenFOAM: one line that names the package.
missing_openfoam() {
  local tool
  make_case "$scratch/case"
  cp -r "$scratch/case" "$scratch/before"
  mkdir "$scratch/bin"
  for tool in bash dirname cat python3; do ln -s "$(command -v $tool)" "$scratch/bin/$tool"; done
  refuse "apt-get install openfoam" env -i PATH="$scratch/bin" "$scratch/case/Allrun"
  [[ $(wc -l <"$scratch/output") == 1 ]] || fail "more than one line: $(cat "$scratch/output")"
  diff -r "$scratch/before" "$scratch/case"
}

if [[ $1 != missing_openfoam ]] && ! command -v interFoam >/dev/null; then
  echo "skipped: interFoam not found"
  exit 77
fi
"$1"
