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

# instructions CELLS STEPS [RPM]: of the benchmark's film, start and record included, in 1e9.
instructions() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$build/tests/bench/bench-ehl" "$@" 2>&1 >/dev/null |
        sed -n 's/.*Collected : \([0-9]*\).*/\1/p' | awk '{ printf "%.3f", $1 / 1e9 }'
}
counts() { # CELLS STEPS [RPM]: Newton steps and convolutions, by output step.
    "$build/tests/bench/bench-ehl" "$@" | sed -n 's/.*Newton \([0-9.]*\) and convolutions \([0-9.]*\) .*/\1 \2/p'
}
for size in '256 1000' '512 1000' '1024 1000' '1024 2000'; do
    # shellcheck disable=SC2086
    echo "$size $(instructions $size) $(counts $size)"
done >"$lab/instructions"
for cells in 256; do
    echo "$cells $(counts "$cells" 1000 150) $(instructions "$cells" 1000 150)"
done >"$lab/rough"

python3 - "$build/flankfilm" "$lab/instructions" "$lab/rough" "$lab/results" >"$lab/page" <<'END'
import json, math, subprocess, sys

program, counted, rough, results = sys.argv[1:]
OUTPUTS = "outputs=[film.h_min,film.h_central,film.p_max,film.newton_steps,film.convolutions]"


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
benchmark (`build/tests/bench/bench-ehl CELLS STEPS`, a smooth tooth, Doolittle-Tait and Eyring, with its start). Beside them what its
counts need at least: additions and multiplications (10 n log2 2n of a convolution of n cells, 52 n of the band with each convolution
and Newton step, 62 n of a Krylov vector, 254 n of an evaluation of laws and balances), and the factors of the band, 28 numbers a
cell, which each of its solutions reads once.

| cells | steps | instructions, 1e9 | instructions a cell and step | flops a cell and step | flops an instruction | band read in a step, MB |
|---|---|---|---|---|---|---|""")
for line in open(counted):
    cells, steps, giga, newton, convolutions = (float(x) for x in line.split())
    each = giga * 1e9 / cells / steps
    flops = convolutions * (10 * math.log2(2 * cells) + 62) + 52 * (convolutions + newton) + 254 * newton
    print("| %.0f | %.0f | %.3f | %.0f | %.0f | %.2f | %.2f |" % (
        cells, steps, giga, each, flops, flops / each, 28 * 8 * cells * (convolutions + newton) / 1e6))
print("""
0.426e9 of the film on 256 cells measure its errors on finer ones (`ehl_results_measure`). What the lines of its quality cost
besides: `docs/lines.sh`, a row of [campaigns.md](campaigns.md).

| film | instructions |
|---|---|
| 512 cells, `thermal: inlet` over `none` (`valgrind --tool=callgrind flankfilm run configs/li-kahraman-2011.yaml --set mesh.use=stiffness/iso-6336 --set film.cells=512 --set film.thermal=inlet --set "outputs=[film.h_min]"`, `ehl_evaluate`) | 1.047 times |
| 512 cells, 1000 steps, `thermal: full` | 3.33e9 |
| rough, 150 rpm, 512 cells, by output step (`valgrind --tool=callgrind build/tests/bench/bench-ehl 512 1000 150`) | 11.9e6 |

## The film of a vibrating gear pair

The dynamic tooth of the seed's configuration, whose load vibrates, errors not wanted:
`valgrind --tool=callgrind --trace-children=yes build/flankfilm run configs/li-kahraman-2011.yaml --set mesh.use=stiffness/iso-6336
--set film.cells=512 --set "outputs=[film.h_min]"`, `ehl_evaluate`; counts by `"outputs=[film.h_min,film.newton_steps,film.convolutions]"`.

| cells | steps | Newton steps by step | convolutions by step | instructions, 1e9 |
|---|---|---|---|---|
| 512 | 1000 | 1.16 | 3.56 | 0.599 |

Beside the same equations solved to 1e-9 `h_min` is within 7.9e-5 everywhere, `p_max` within 3.1e-5.

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
## A tenth of a per cent

The same film with steps as many as its cells ask for, against 4096 cells and 8000 steps at 251 instants: the largest error of `h_min(t)` and of `h_central(t)`
along the path, what Richardson's extrapolation from two levels leaves of it (second order), and what the run states for cells and steps together.

| cells | steps | h_min | extrapolated | h_central | extrapolated | stated for h_min |
|---|---|---|---|---|---|---|""")
levels = []
for cells in (128, 256, 512, 1024, 4096):
    numbers, quality = film("ehl/finite-volume", cells, "film.steps=%d" % (cells * 1000 // 512))
    every = cells // 128
    levels.append((cells, {name: numbers[name][::every] for name in ("h_min", "h_central")},
                   quality["h_min_space_error"] + quality["h_min_time_error"]))
for (_, coarse, _), (cells, fine, stated) in zip(levels, levels[1:-1]):
    row = []
    for name, exact in levels[-1][1].items():
        row += [move(fine[name], exact), move([f + (f - c) / 3 for f, c in zip(fine[name], coarse[name])], exact)]
    print("| %d | %d | %.3f %% | %.3f %% | %.3f %% | %.3f %% | %.2f %% |" % ((cells, cells * 1000 // 512) + tuple(100 * x for x in row + [stated])))
print("""
1024 cells and 2000 steps are within 0.1 % everywhere; extrapolated, 512 and 256 cells are not. On random scenes `h_min` is hardly ever in the range where its
order can be trusted ([error bars](validation/error-bars.md#extrapolated-answers)), so that answers are not extrapolated.

## Rough flanks

`build/tests/bench/bench-ehl CELLS 1000 150`: both flanks with Rq 0.5 um at 150 rpm, by output step.

| cells | Newton steps | convolutions | 1e6 instructions |
|---|---|---|---|""")
for line in open(rough):
    cells, newton, convolutions, giga = line.split()
    print("| %s | %s | %s | %.1f |" % (cells, newton, convolutions, float(giga)))
print("""
At 512 cells it is 20.4, 53.2 and 11.9. Waves that the cells do not resolve are taken off since then (`roughness_cutoff`), which left 32.3 Newton
steps and 90.8 convolutions of 40.4 and 112 (28.5e6 instructions); steps as long as the share of the asperities allows left
22.4 and 62.0 (14.3e6), `tolerance: auto` of 1e-4 in place of 1e-5 and leaner loops the rest; no law is asked again where
only the state of a node has turned. At d11ebff9 the asperities carried 0.034 of the load at 512 cells and half as much
at 1024; with one cut-off the share moves by 6 % from 512 to 1024 ([mixed](validation/mixed.md)).

What did not help, on flanks with all of their waves: extrapolated by parabolas instead of lines, the
first step was as large. Of the first 400 output steps, 52.5 Newton steps each, were left 52.5 by contacts predicted from the extrapolated gap, 52.1 with nodes
without pressure predicted as well (137 convolutions for 126), 52.1 and 54.2 where p may fall to 0 or to 0.8 of itself (0.5 is kept), 61.7 and 67.2
with half and without the extrapolation, 57.1 (150 convolutions) where a step is solved so far that what it leaves is predicted to be
small and no node turns after it, which then needs no further step. Newton steps that may change p by 0.3 of the Hertz pressure in place of 0.1: 4 % more of
them. With one cut-off the work still grows as the cells to some 1.7: from 512 to 2048 cells the steps grow by 1.2, the Newton
steps of one from 3.0 to 5.1, as more nodes turn between film, cavity and contact, and the convolutions of a Newton step from 3.3 to 4.2.
Factors take 18 % of the instructions, so that keeping them gains less than that.

Held once step by step against the solver of 441d7a7, both in one program that is not kept, with `tolerance: 1e-8`, each from the same film (256 cells, 6920 steps): p is within
1e-5 of the largest Hertz pressure but for 2, at most 1.8e-5, and 9 have another set of full nodes or contacts, each by nodes whose oil is within
0.3 % of filling the gap. That solver with its own 1e-5: 12, at most 7.4e-5, and 22.

## Against the release before

The smooth film of 256 cells, 1000 steps, 1500 rpm with `tolerance: 1e-9`: `h_min` and `p_max` differ from those of c93fe0c by
5.4e-10 at most, with either `cavitation`, from those of 441d7a7 by 1.6e-10.

## Against the slow twin

`ehl/dense-newton` solves the same equations by dense factorisation; both with `tolerance: 1e-9`, 256 cells.
""")
fast, _ = film("ehl/finite-volume", 256, "film.tolerance=1e-9")
slow, _ = film("ehl/dense-newton", 256, "film.tolerance=1e-9")
print("`h_min` differs by %.1e at most, `p_max` by %.1e." % (move(fast["h_min"], slow["h_min"]), move(fast["p_max"], slow["p_max"])))
END
mv "$lab/page" docs/performance.md
