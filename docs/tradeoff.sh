#!/bin/sh
# Runs the trade-off studies of configs/studies and writes tradeoff.md and tradeoff.svg: every number
# in them comes from here. The film is measured twice, to say how well its front repeats. With a
# folder for the results, a second run takes over what is measured there.
#   sh docs/tradeoff.sh build/flankfilm [FOLDER]
set -eu

program=$(realpath "${1:-build/flankfilm}")
here=$(cd "$(dirname "$0")" && pwd)
studies=$here/../configs/studies
load=$(cut -d' ' -f1 /proc/loadavg)
if [ -n "${2:-}" ]; then
    mkdir -p "$2"
    work=$(realpath "$2")
else
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
fi

measure() { # STUDY DIRECTORY
    "$program" run "$studies/$1.yaml" -o "$work/$2" >"$work/$2.txt"
    # a comma with a space behind it stands within a text
    sed 's/, /; /g' "$work/$2/tradeoff.csv" >"$work/$2.csv"
}
measure tradeoff-film film
measure tradeoff-film again
for study in stiffness dynamics laws scene rough; do measure "tradeoff-$study" "$study"; done

reference() { # STUDY
    echo
    sed -n 's/^reference \([0-9]*\): /- reference \1: /p' "$work/$1.txt" | sed 's/_/\\_/g'
    echo
}

# Candidates by rising cost; an error on the front in bold.
table() { # STUDY
    { head -1 "$work/$1.csv" && tail -n +2 "$work/$1.csv" | sort -t, -k3,3g; } | awk -F, '
        function percent(x) { return x == "" ? "" : sprintf("%.3g", 100 * x) }
        NR == 1 {
            head = "| candidate | cost ms | spread % | run ms |"
            for (i = 8; i <= NF; i++) {
                if ($i ~ / error$/) { errors[++outputs] = i; head = head " " $i " % |" }
                else if (!outputs) { counts[++work] = i; head = head " " $i " |" }
            }
            print head
            gsub(/[^|]+/, "---", head)
            print head
            next
        }
        {
            gsub(/"/, "", $1)
            gsub(/;/, ",", $1)
            row = sprintf("| %s | %.3g | %.0f | %.3g |", $1, 1e3 * $3, 100 * ($5 - $4) / $3, 1e3 * $7)
            for (k = 1; k <= work; k++) row = row " " $(counts[k]) " |"
            for (k = 1; k <= outputs; k++) {
                i = errors[k]
                mark = $(i + 3) == 1 ? "**" : ""
                row = row " " mark percent($i) mark " |"
            }
            print row
        }' | drop_empty | keep "$1"
}

# All rows as CSV into validation/; the page keeps those of a front, of a table without fronts all, and not the spread.
keep() { # STUDY
    cat >"$work/$1.rows"
    sed -n 's/\*\*//g; s/^| \(.*\) |$/\1/; s/^\([^|]*\) |/"\1" |/; s/ *| */,/g; 2!p' "$work/$1.rows" >"$here/validation/tradeoff-$1.csv"
    if grep -q '\*\*' "$work/$1.rows"; then sed -n '1,2p; /\*\*/p' "$work/$1.rows"; else cat "$work/$1.rows"; fi |
        sed 's/^\(|[^|]*|[^|]*\)|[^|]*|/\1|/'
    echo
    echo "[All candidates](validation/tradeoff-$1.csv)"
}

# Columns without an entry say nothing.
drop_empty() {
    awk -F'|' '
        { for (i = 2; i < NF; i++) { cell[NR, i] = $i; if (NR > 2 && $i ~ /[^ ]/) used[i] = 1 } width = NF }
        END {
            for (r = 1; r <= NR; r++) {
                line = "|"
                for (i = 2; i < width; i++) if (used[i]) line = line cell[r, i] "|"
                print line
            }
        }'
}

# Cost over that of the front for a candidate of the film, by h_min and by friction.
over_front() { # LABEL
    awk -F, -v label="\"$1\"" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /cost_over_front$/) at[++n] = i }
        $1 == label { printf "%.2f and %.2f", $at[1], $at[2] }' "$work/film.csv"
}

repeats() {
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ / front$/) at[++n] = i; next }
        FNR == 1 { next }
        FNR == NR { cost[$1] = $3; front[$1] = $at[1] || $at[2]; next }
        { ratio = $3 / cost[$1]; ratio = ratio < 1 ? 1 / ratio : ratio
          if (ratio > all) all = ratio
          if ((front[$1] || $at[1] || $at[2]) && ratio > most) most = ratio }
        END { printf "%.0f %% on the fronts, %.0f %% anywhere", 100 * (most - 1), 100 * (all - 1) }' \
        "$work/film.csv" "$work/again.csv"
}

changes() {
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ / error$/) at[++n] = i; next }
        FNR == 1 { next }
        FNR == NR { for (k = 1; k <= n; k++) error[$1, k] = $at[k]; next }
        { for (k = 1; k <= n; k++) { d = $at[k] - error[$1, k]; d = d < 0 ? -d : d; if (d > most) most = d } }
        END { printf "%.2g %%", 100 * most }' "$work/film.csv" "$work/again.csv"
}

decades() {
    awk -F, 'NR > 1 && $3 > 0 { low = !low || $3 < low ? $3 : low; high = $3 > high ? $3 : high }
        END { printf "%.1f", log(high / low) / log(10) }' "$work/film.csv"
}

field() { sed -n "s/^ \"$1\": \"\(.*\)\",*$/\1/p" "$work/film/tradeoff.json"; }

sh "$here/draw.sh" "$program" "$work/film/tradeoff.figure.json" "$here/tradeoff.svg"
{
    cat <<TEXT
# Speed against accuracy, measured

Written by \`docs/tradeoff.sh\` on $(field date). Processor: $(field processor), one of $(nproc) cores; load of the
machine at the beginning and at the end: $load and $(cut -d' ' -f1 /proc/loadavg).

Each table compares candidates (models and settings) with a reference, a finer run. *Cost* is the CPU time of the
stages that the candidates change, the median of the repeats; *run* is that of all stages. *Error* is the relative difference from the reference that
is not exceeded on 95 % of the mesh cycle. An error is **bold** if the candidate is on the front: no cheaper candidate has as
small an error. "reference 1" is the refinement of "reference 0", and the changes between them show the uncertainty of
the reference. The [guide](guide/accuracy.md#speed-against-accuracy) says how to measure your own trade-off.

## Film: models, cells and steps

\`configs/studies/tradeoff-film.yaml\`, the mesh cycle of Li & Kahraman 2011 with dynamic tooth force.

![error against cost of the film](tradeoff.svg)
TEXT
    reference film
    echo "- The largest cost is 10^$(decades) times the smallest."
    echo "- In a second run of the study, costs differ by at most $(repeats);"
    echo "  errors by at most $(changes)."
    echo "- Cost of a candidate, divided by the cost of the cheapest candidate with no larger error in h_min, and in friction:"
    echo "  $(over_front 'finite-volume') for the presets (\`film.use: ehl/finite-volume\` alone);"
    echo "  $(over_front 'finite-volume; cells 512; steps 1000') for cells 512, steps 1000."
    echo
    table film
    cat <<TEXT

## Mesh stiffness

\`configs/studies/tradeoff-stiffness.yaml\`: models of the mesh stiffness, and the errors of the motion that they cause.
TEXT
    reference stiffness
    table stiffness
    cat <<TEXT

## Motion

\`configs/studies/tradeoff-dynamics.yaml\`: methods at a speed with contact loss, on the upper branch.
TEXT
    reference dynamics
    table dynamics
    cat <<TEXT

## Laws of the oil

\`configs/studies/tradeoff-laws.yaml\`: the laws of one lubricant card; the reference uses Doolittle-Tait.
TEXT
    reference laws
    table laws
    cat <<TEXT

## Which effects are needed

\`configs/studies/tradeoff-scene.yaml\`: static tooth force (\`load: mesh\`) or dynamic (\`load: motion\`), Newtonian or
shear-thinning oil, film by inlet analysis or finite volumes. The cost includes that of the motion.
TEXT
    reference scene
    table scene
    cat <<TEXT

## Smooth or rough flanks

\`configs/studies/tradeoff-rough.yaml\`: ground flanks. An asperity passes within a few time steps.
TEXT
    reference rough
    table rough
} >"$work/tradeoff.md"
mv "$work/tradeoff.md" "$here/tradeoff.md"
sh "$here/made.sh" "$here/tradeoff.md" plugins/ehl plugins/dynamics plugins/stiffness core/program/study/kinds/tradeoff
