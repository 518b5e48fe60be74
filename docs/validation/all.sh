#!/bin/sh
# Writes every page of docs/validation anew, and README.md, the list of them with what each took.
#   sh docs/validation/all.sh build
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# page | what it proves
cat > "$work/list" <<'LIST'
paper|figures 2 to 11 of Li & Kahraman 2011: what the paper states, what comes out, a rule, a verdict; rough flanks at all points
benchmarks|geometry, contact, film formulas, oil, ISO stiffness and forced response against closed forms and another program
measured|rolling force, loss of a mesh and pressure that others computed or measured, with what differs
heat|films with heat by each step of the ladder, formulas of the inlet, traction over slip, a measured mesh loss at two temperatures of the teeth
friction|a measured mesh loss by laws of oils that were measured elsewhere, laid down before the first run
two-way|what the film does to the gears, where the power goes, and where oil ends a branch, beside a small-step model
rattle|where oil between parted flanks ends their branch, over viscosity, load and backlash, and what loads it keeps apart for good
film-steady|five film models against Martin's exact cylinder, an independent program's films and each other; what the inlet leaves out
waviness|what a transient contact leaves of a wave, against Venner et al. 1997, and how it depends on the cells
mixed|shares of the load between oil and asperities at four speeds, over cells and surfaces
dynamics|every periodic motion and its stability; closed forms, another program, extremes
stiffness|k(t) of four sources, and why they differ
LIST

while IFS='|' read -r page proves; do
    echo "$page" >&2
    start=$(date +%s)
    sh "$here/$page.sh" "$build"
    took=$(($(date +%s) - start))
    first=$(sed -n '1s/^# //p' "$here/$page.md")
    echo "| [$first]($page.md) | \`sh docs/validation/$page.sh build\` | $took s | $proves |" >> "$work/rows"
done < "$work/list"

{
    cat <<'TEXT'
# Validation

Every page, its figures and its tables are written by one command, after `ninja -C build`:

```sh
sh docs/validation/all.sh build
```

`ninja -C build validation` does the same. Each script also stands alone:

| page | command | took | shows |
|---|---|---|---|
TEXT
    cat "$work/rows"
    cat <<'TEXT'

[What relief does to resonance, jumps and the number of motions](relief.md), when the mesh force knows its load, is written by
`python3 docs/validation/relief.py build` in 15 s of CPU.

Not written by these, since they take 30 and 20 minutes: [do the error bars hold?](error-bars.md) and
[what limits me, against brute force](uncertainty.md), [campaigns](../campaigns.md).

[What was once wrong without a word](rows.md), row by row, before and now, is a [campaign](../campaigns.md) as well.

`meson test -C build validation` runs the script of the paper's figures, but for its last section, and the
benchmarks into a folder of its own and compares what they write with the pages kept here: words,
verdicts included, must be the same, numbers within 2 % or 2 of the last digit. Of the other pages the tests hold the numbers:
`tests/plugins/ehl` and `tests/plugins/dynamics` those of films and motions (the pages are their print),
`tests/plugins/stiffness` those that the text of the last page gives beside its tables.
TEXT
} > "$here/README.md.new"
mv "$here/README.md.new" "$here/README.md"
