#!/bin/sh
# One word on the command line swaps the film model of a whole pipeline, and every card whose laws say
# the oil serves it; those of an oil stage are tests/plugins/lubricant/cards.sh's.   swap.sh FLANKFILM SOURCE_ROOT
set -eu
flankfilm=$1
source=$2
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT

# lowest h_min of the gear pair of Li & Kahraman 2011 under its dynamic tooth force, um
lowest() {
    "$flankfilm" run "$source/configs/li-kahraman-2011.yaml" -o "$lab/out" --json \
        --set 'outputs=[film.h_min_lowest, film.h_central, film.film, film.pressure]' "$@" |
        sed 's/.*"film.h_min_lowest":{[^}]*"value": *\([-0-9.e]*\).*/\1/' |
        awk '{printf "%.4f\n", 1e6 * $1}'
}
full=$(lowest)
formula=$(lowest --set film.use=ehl/film-formula)
inlet=$(lowest --set film.use=ehl/inlet-analysis)
echo "lowest h_min: finite-volume $full, film-formula $formula, inlet-analysis $inlet um"
# an instantaneous formula misses what the squeeze does, up to a fourth
awk -v f="$full" -v a="$formula" -v b="$inlet" 'BEGIN {
    exit !(f > 0.05 && f < 0.5 && a > 0.75 * f && a < 1.25 * f && b > 0.88 * f && b < 1.12 * f)
}'

# the four laws of a card are one oil: their films differ by less than 6 %, and nothing warns
for card in $(grep -l 'Barus [0-9]' "$source"/configs/lubricants/*.yaml); do
    case $card in *mil-l* | *5p4e* | *cardiff*) temperature=100 ;; *) temperature=80 ;; esac
    cat >"$lab/card.yaml" <<END
format: 2
include: [$card]
pipeline:
  oil:   {temperature: $temperature degC}
  discs: {use: contact/constant, radius: 12.8 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0.1, load_per_width: 60 N/mm}
  film:  {use: ehl/inlet-analysis}
outputs: [film.h_central, film.friction_coefficient]
END
    "$flankfilm" check "$lab/card.yaml" --set viscosity.use=viscosity/isoviscous --set flow.use=rheology/newtonian >"$lab/log"
    for law in doolittle-tait roelands two-slope barus; do
        "$flankfilm" run "$lab/card.yaml" --set viscosity.use=viscosity/$law --set flow.use=rheology/carreau --json -o "$lab/$law" --replace \
            2>>"$lab/warnings" |
            sed 's/.*"film.h_central":{[^}]*"data": *\[\([-0-9.e]*\).*/\1/'
    done | awk -v card="$(basename "$card")" '
        {h[NR] = $1; low = NR == 1 || $1 < low ? $1 : low; high = $1 > high ? $1 : high}
        END {print card, h[1], h[2], h[3], h[4]; exit !(NR == 4 && low > 1e-8 && high < 1.06 * low)}'
done
cat "$lab/warnings"
[ ! -s "$lab/warnings" ]
