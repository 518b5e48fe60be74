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
paper|most statements of the paper are reproduced; the others depend on numbers that it does not give|48 statements: 38 agree, 6 in part, 4 differ
benchmarks|the results agree with closed forms and another program|largest difference 0.053 %
measured|rolling forces agree; without heat, no oil law reproduces the measured mesh loss|9 of 11 rolling forces within 15 %; 2 of 20 losses within the measured interval
heat|heat changes the loss in the measured direction but not enough; formulas for inlet heating are right only in pure rolling|3 of 20 losses within the measured interval
friction|with laws of measured oils, loss and friction are close to measurements except at the lowest and highest speeds|loss 11 to 16 % low at 4000 to 8000 rpm; 9 of 12 points of FZG met
two-way|a film hardly changes the motion while flanks are in contact, and shortens the branch with contact loss|dte_rms at point I +0.35 %
rattle|oil between separated flanks ends the branch with contact loss at a higher speed|at 27.7 mPa s at 2304 Hz, without oil at 1936 Hz
film-steady|steady films agree with exact and independent solutions|Martin's cylinder to 0.03 %; central films for M 5 to 200 within 1.2 % on 1024 cells
waviness|computed waves agree with a published computation where that is smooth|14 of 18 waves within 3 % of Venner et al. 1997
mixed|with a fixed cut-off, the load on asperities converges with the cells|0.170, 0.160, 0.156 of the load with 512, 1024, 2048 cells
dynamics|all periodic motions found by another program are found|states to 4.5e-10 of half the backlash, 13 folds to 0.7 Hz
stiffness|four sources of mesh stiffness differ, for known reasons|means from 2.96e8 to 3.83e8 N/m
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

How far the numbers can be trusted: one verdict and one figure from each page. Commands write the pages
([below](#commands)); the verdicts are written by hand.

| page | verdict | one figure |
|---|---|---|
TEXT
    cat "$work/rows"
    cat <<'TEXT'
| [What relief does to resonance, jumps and the number of motions](relief.md) | a load-dependent mesh force moves folds | 40 um of relief: highest motion at 2274 Hz, not at 2047 Hz |
| [Do the error bars hold?](error-bars.md) | yes | 669 of 671 scalars, 754 of 773 series |
| [What limits me, against brute force](uncertainty.md) | the reported effects of uncertain inputs agree with brute force | for laws of an earlier commit, which the page names |
| [What was once wrong without a word](rows.md) | each error found by an audit is corrected or reported as doubtful | row by row |
| [Do films know their errors?](effectivity.md) | yes for h_min and h_central without heat; no for pressure peaks | of 62 drawn films, bars hold at 95.5 to 100 % of the instants of each sort |

**Not validated**: whether the oil laws are right at the pressures of gears, and how much load asperities really carry. Both have been
measured for only a few oils and flanks, and the results of this program depend on them.

## Commands

After `ninja -C build` one command writes every page, its figures, its tables and this list; `ninja -C build validation` does the same.

```sh
sh docs/validation/all.sh build
```

| page | command | took |
|---|---|---|
TEXT
    cat "$work/commands"
    cat <<'TEXT'
| relief | `python3 docs/validation/relief.py build` | 15 s of CPU |

`error-bars`, `uncertainty` and `rows` are [campaigns](../campaigns.md).

`meson test -C build validation` runs the scripts of the paper's figures (without the last section) and the benchmarks
in a separate folder and compares the results with the pages in this folder: words and verdicts must be identical,
numbers within 2 % or 2 of the last digit. Tests check the numbers of the other pages: `tests/plugins/ehl` and
`tests/plugins/dynamics` those of films and motions (these tests print the pages), `tests/plugins/stiffness` the
numbers in the text of its page.
TEXT
} > "$here/README.md.new"
mv "$here/README.md.new" "$here/README.md"
