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
paper|what the paper states comes out, but for what its lost numbers decide|48 statements: 38 agree, 6 in part, 4 differ
benchmarks|closed forms and another program are met|largest difference 0.053 %
measured|rolling forces are met; the measured loss of a mesh is not, by any law of an oil without heat|9 of 11 rolling forces within 15 %; 2 of 20 losses within the measured interval
heat|heat bends the loss as measured, and not far enough; formulas of inlet heating hold in pure rolling alone|3 of 20 losses within the measured interval
friction|laws of measured oils come near a measured loss, and near the friction of FZG gears except at the ends of their speeds|loss 11 to 16 % low at 4000 to 8000 rpm; 8 of 12 points of FZG met
two-way|a film changes the motion little while flanks are in contact, and shortens the branch on which they part|dte_rms at point I +0.35 %
rattle|oil between parted flanks ends their branch at higher speeds|at 27.7 mPa s at 2304 Hz, without oil at 1936 Hz
film-steady|exact and independent steady films are met|Martin's cylinder to 0.03 %; central films for M 5 to 200 within 1.2 % on 1024 cells
waviness|a computed wave in a transient contact is met where that computation is smooth|14 of 18 waves within 3 % of Venner et al. 1997
mixed|the load on asperities settles with the cells at one cut-off|0.170, 0.160, 0.156 of the load with 512, 1024, 2048 cells
dynamics|every periodic motion of another program is found|states to 4.5e-10 of half the backlash, 13 folds to 0.7 Hz
stiffness|four sources of mesh stiffness differ, and why is known|means from 2.96e8 to 3.83e8 N/m
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

How far the numbers can be trusted, with one figure of each page. The figures are those of the pages, which commands write
([below](#commands)); the verdicts are a reader's.

| page | verdict | one figure |
|---|---|---|
TEXT
    cat "$work/rows"
    cat <<'TEXT'
| [What relief does to resonance, jumps and the number of motions](relief.md) | a mesh force that knows its load moves folds | 40 um of relief: highest motion at 2274 Hz, not at 2047 Hz |
| [Do the error bars hold?](error-bars.md) | yes | 669 of 671 scalars, 754 of 773 series |
| [What limits me, against brute force](uncertainty.md) | the sentence about uncertain inputs holds | 42 of 44 lines, by 8000 samples each |
| [What was once wrong without a word](rows.md) | each finding of an audit is right now, or says that it is in doubt | row by row |

**What is not shown by any of this**: that the laws of an oil hold at the pressures of gears, and what asperities carry in truth. Both are
measured on few oils and flanks, and the films of this program follow what they are given.

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

`meson test -C build validation` runs the script of the paper's figures, but for its last section, and the
benchmarks into a folder of its own, and compares what they write with the pages kept here: words,
verdicts included, must be the same, numbers within 2 % or 2 of the last digit. Of the other pages the tests hold the numbers:
`tests/plugins/ehl` and `tests/plugins/dynamics` those of films and motions (the pages are their print),
`tests/plugins/stiffness` those that the text of its page gives beside its tables.
TEXT
} > "$here/README.md.new"
mv "$here/README.md.new" "$here/README.md"
