#!/bin/sh
# Writes every page of docs/validation anew, and README.md, the list of them with what each took.
#   sh docs/validation/all.sh build
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# page | verdict | one figure of it
cat > "$work/list" <<'LIST'
paper|most statements of the paper are reproduced; the others depend on numbers that the paper does not give|48 statements: 38 agree, 6 in part, 4 differ
benchmarks|the results agree with closed forms and another program|largest difference 0.053 %
measured|rolling losses agree with a published formula; without heat, no oil law reproduces the measured mesh loss|9 of 11 rolling losses within 15 %; 2 of 20 mesh losses within the measured interval
heat|heat changes the loss in the measured direction but not enough; formulas for inlet heating are right only in pure rolling up to 10 m/s|3 of 20 mesh losses within the measured interval
friction|with laws of measured oils, loss and friction are close to measurements except at the lowest and highest speeds|loss 11 to 16 % too low at 4000 to 8000 rpm; 9 of 12 FZG points within the limits
two-way|a film hardly changes the motion while flanks are in contact, and shortens the branch with contact loss|the film changes dte_rms at the paper's point I by 0.35 %
rattle|oil between separated flanks ends the branch with contact loss at a higher speed|end at 2304 Hz with oil of 27.7 mPa s, at 1936 Hz without oil
film-steady|steady films agree with exact and independent solutions|rigid cylinder within 0.03 % of the exact solution; central films for M 5 to 200 within 1.2 % on 1024 cells
waviness|amplitudes of waves agree with a published computation, except where the computation deviates from its own trend|14 of 18 waves within 3 % of Venner et al. 1997
mixed|with a fixed cut-off, the load on asperities converges with the cells|asperities carry 0.170, 0.160, 0.156 of the load with 512, 1024, 2048 cells
dynamics|all periodic motions found by another program are found|largest difference of states 4.5e-10 of half the backlash, of 13 folds 0.7 Hz
stiffness|four sources of mesh stiffness differ, for known reasons|mean stiffness from 2.96e8 to 3.83e8 N/m
LIST

while IFS='|' read -r page verdict figure; do
    echo "$page" >&2
    start=$(date +%s)
    sh "$here/$page.sh" "$build"
    took=$(($(date +%s) - start))
    first=$(sed -n '1s/^# //p' "$here/$page.md")
    echo "| [$first]($page.md) | $verdict | $figure |" >> "$work/rows"
    echo "| $page | \`sh docs/validation/$page.sh build\` | $took s |" >> "$work/commands"
done < "$work/list"

{
    cat <<'TEXT'
# Validation

These pages compare results of the program with exact solutions, other programs and measurements. The table gives a verdict
and one number from each page. Commands write the pages
([below](#commands)); the verdicts are written by hand.

| page | verdict | one number |
|---|---|---|
TEXT
    cat "$work/rows"
    cat <<'TEXT'
| [What relief does to resonance, jumps and the number of motions](relief.md) | a load-dependent mesh force shifts folds | 40 um of relief: largest motion at 2274 Hz with `force: shared`, at 2047 Hz with `frozen` |
| [Do the error bars hold?](error-bars.md) | yes | the bars of 669 of 671 scalars and 754 of 773 series hold |
| [What limits me, against brute force](uncertainty.md) | the reported effects of uncertain inputs agree with brute force | 42 of 44 checks hold, for oil laws of an earlier commit |
| [Errors once not reported](rows.md) | each error found by an audit is corrected or reported as doubtful | 27 rows |
| [Do films know their errors?](effectivity.md) | yes for h_min and h_central without heat; no for pressure peaks | for 62 random films, bars hold at 95.5 to 100 % of the instants |

**Not validated**: whether the oil laws are right at the pressures of gears, and how much load asperities really carry. Both have been
measured for only a few oils and flanks, and the results of this program depend on them.

## Commands

After `ninja -C build` one command writes every page, its figures, its tables and this list; `ninja -C build validation` does the same.

```sh
sh docs/validation/all.sh build
```

| page | command | time |
|---|---|---|
TEXT
    cat "$work/commands"
    cat <<'TEXT'
| relief | `python3 docs/validation/relief.py build` | 15 s of CPU |

`error-bars`, `uncertainty` and `rows` are [campaigns](../campaigns.md).

`meson test -C build validation` runs the scripts of the paper's figures (without the finer surface and the rough flanks at points II and III) and the benchmarks in a
separate folder and compares the results with the pages in this folder: words and verdicts must be identical, numbers must
agree within 2 % or 2 units of the last digit. Other tests check the numbers of the other pages: `tests/plugins/ehl` and
`tests/plugins/dynamics` those of films and motions (these tests also print the pages), `tests/plugins/stiffness` the numbers
in the text of the stiffness page.
TEXT
} > "$here/README.md.new"
mv "$here/README.md.new" "$here/README.md"
