#!/bin/sh
# Each oil of configs/lubricants runs within the range of its data, without a doubt or a warning.
# cards.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
set -eu
flankfilm=$1 plugins=$2 source=$3
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
count=0
for card in $(grep -l 'use: lubricant/' "$source"/configs/lubricants/*.yaml); do
    at=$(sed -n 's/^    at: //p' "$card")
    printf 'format: 1\ninclude: [%s]\npipeline: {oil: {temperature: %s}}\noutputs: ["oil.*"]\n' \
        "$card" "${at:-60 degC}" >"$lab/oil.yaml"
    said=$("$flankfilm" run "$lab/oil.yaml" --plugin-path "$plugins" -o "$lab/results" 2>&1)
    if ! echo "$said" | grep -q 'lubricant/.* good$' || echo "$said" | grep 'warning'; then
        echo "$card: $said"
        exit 1
    fi
    for value in temperature eta0 rho0 expansion; do
        echo "$said" | grep -q "^  $value " || { echo "$card: no $value" && exit 1; }
    done
    count=$((count + 1))
done
echo "$count oils"
[ $count -ge 15 ]
