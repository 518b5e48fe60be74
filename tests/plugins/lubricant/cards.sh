#!/bin/sh
# Each oil of configs/lubricants runs within the range of its data, without a doubt or a warning, and
# each of its laws makes a film of it.
# cards.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
set -eu
flankfilm=$1 plugins=$2 source=$3
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
oils=0 films=0

fail() { # CARD TEXT
    echo "$1: $2"
    exit 1
}

for card in $(ls "$source"/configs/lubricants/*.yaml); do
    at=$(sed -n '/lubricant\/measured/s/.*[{ ]at: \([^,}]*\).*/\1/p' "$card")
    cat >"$lab/oil.yaml" <<EOF
format: 2
include: [$card]
pipeline:
  oil: {temperature: ${at:-80 degC}}
  discs: {use: contact/constant, radius: 12.8 mm, entrainment_speed: 4 m/s, load_per_width: 177 N/mm}
  film: {use: ehl/film-formula, formula: moes}
outputs: ["oil.*", film.h_central]
EOF
    said=$("$flankfilm" run --all "$lab/oil.yaml" --plugin-path "$plugins" -o "$lab/results" 2>&1)
    echo "$said" | grep -q 'lubricant/.* good$' || fail "$card" "$said"
    ! echo "$said" | grep -q warning || fail "$card" "$said"
    for value in temperature eta0 rho0 alpha expansion; do
        echo "$said" | grep -q "^  $value " || fail "$card" "no $value"
    done
    for law in $(sed -n 's/^      \(viscosity\/[a-z-]*\):.*/\1/p' "$card"); do
        said=$("$flankfilm" run --all "$lab/oil.yaml" --plugin-path "$plugins" -o "$lab/results" \
            --set viscosity.use="$law" --set outputs=film.h_central 2>&1)
        echo "$said" | grep -q '^  h_central ' || fail "$card, $law" "$said"
        films=$((films + 1))
    done
    oils=$((oils + 1))
done
echo "$oils oils, $films films"
[ $oils -ge 15 ] && [ $films -ge 60 ]
