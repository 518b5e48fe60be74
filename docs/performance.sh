#!/bin/sh
# Writes docs/performance.md: what a film costs in instructions and counts, and how far the presets leave it from the
# solution of the same grid.
#   sh docs/performance.sh BUILD_DIRECTORY
# Needs valgrind and python3; some three minutes.
set -eu
build=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
export FLANKFILM_TEST_PLUGINS="$build/plugins"

# instructions CELLS STEPS: of the benchmark's film, start and record included, in 1e9.
instructions() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$build/tests/bench/bench-ehl" "$1" "$2" 2>&1 >/dev/null |
        sed -n 's/.*Collected : \([0-9]*\).*/\1/p' | awk '{ printf "%.3f", $1 / 1e9 }'
}
for cells in 256 512 1024; do
    echo "$cells $(instructions "$cells" 1000)"
done >"$lab/instructions"

python3 - "$build/flankfilm" "$lab/instructions" "$lab/results" >"$lab/page" <<'END'
import json, subprocess, sys

program, counted, results = sys.argv[1:]
OUTPUTS = "outputs=[film.h_min,film.p_max,film.newton_steps,film.convolutions]"


def film(model, cells, *sets):
    """Series, counts and stated errors of the film of the paper's point I."""
    words = [program, "run", "configs/li-kahraman-2011.yaml", "--json", "--set", OUTPUTS, "--set", "film.use=" + model,
             "--set", "film.cells=%d" % cells, "--set", "film.steps=1000", "-o", results]
    for word in sets:
        words += ["--set", word]
    told = json.loads(subprocess.run(words, capture_output=True, text=True, check=False).stdout)
    stage = next(s for s in told["stages"] if s["stage"] == "film")
    numbers = {name.split(".")[1]: output["data"] for name, output in told["outputs"].items() if output.get("dims")}
    numbers.update((name, scalar["value"]) for name, scalar in stage["scalars"].items())
    return numbers, {name: line["value"] for name, line in stage["quality"].items()}


def move(a, b):
    return max(abs(x / y - 1) for x, y in zip(a, b))


print("""# What a film costs

Made by `sh docs/performance.sh build`. Instructions are callgrind's and bind; times of shared machines do not. The film of the
benchmark (`build/tests/bench/bench-ehl CELLS 1000`, a smooth tooth, Doolittle-Tait and Eyring, with its start):

| cells | instructions, 1e9 | instructions a cell and step |
|---|---|---|""")
for line in open(counted):
    cells, giga = line.split()
    print("| %s | %s | %.0f |" % (cells, giga, float(giga) * 1e9 / int(cells) / 1000))
print("""
The same film of 512 cells took 1.212e9 before the loops were vectors, and 0.878e9 before a step was accepted on what is predicted
to be left.

## What the presets leave

The film of the paper's point I at 1000 steps, on its presets and with `tolerance: 1e-9`, which is the solution of the same
equations on the same grid. Largest relative change of `h_min` and `p_max` at any instant, beside the error that the run states for its cells.

| cells | Newton steps | convolutions | with 1e-9 | h_min moves by | p_max moves by | stated error by the cells |
|---|---|---|---|---|---|---|""")
for cells in (128, 256, 512, 1024, 2048):
    preset, quality = film("ehl/finite-volume", cells)
    tight, _ = film("ehl/finite-volume", cells, "film.tolerance=1e-9")
    print("| %d | %.0f | %.0f | %.0f | %.1e | %.1e | %.1e |" % (
        cells, preset["newton_steps"], preset["convolutions"], tight["convolutions"], move(preset["h_min"], tight["h_min"]),
        move(preset["p_max"], tight["p_max"]), quality["h_min_space_error"]))
print("""
## Against the slow twin

`ehl/dense-newton` solves the same equations by dense factorisation; both with `tolerance: 1e-9`, 256 cells.
""")
fast, _ = film("ehl/finite-volume", 256, "film.tolerance=1e-9")
slow, _ = film("ehl/dense-newton", 256, "film.tolerance=1e-9")
print("`h_min` differs by %.1e at most, `p_max` by %.1e." % (move(fast["h_min"], slow["h_min"]), move(fast["p_max"], slow["p_max"])))
END
mv "$lab/page" docs/performance.md
