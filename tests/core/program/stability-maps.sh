#!/bin/sh
# The shipped maps of where models can be trusted, with few points: no cell fails in silence, and what
# was converged when stability-maps.csv was written is so today.
#   stability-maps.sh FLANKFILM SOURCE_ROOT            tests the corners, the edges' middles and the middle
#   stability-maps.sh FLANKFILM SOURCE_ROOT whole      a campaign: tests all five by five cells
#   stability-maps.sh FLANKFILM SOURCE_ROOT write      writes the verdicts of today
set -eu
flankfilm=$1
root=$2
expected=$root/tests/core/program/stability-maps.csv
points=$([ $# -eq 3 ] && echo 5 || echo 3) # three of five are every other one
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT

# map NAME STUDY [OPTION...]: the study with so many points along each range, nothing halved. A cell has
# the time that it takes, however busy the machine is.
map() {
    name=$1
    sed -e "s|\.\./|$root/configs/|g" -e 's/points: [0-9]*/points: '$points'/' -e '/^ *bisect:/d' -e '/^ *time_limit:/d' \
        "$root/configs/studies/$2.yaml" >"$lab/$name.yaml"
    shift 2
    code=0
    "$flankfilm" run "$lab/$name.yaml" -j 2 -o "$lab/$name" "$@" >"$lab/said" 2>&1 || code=$?
    if [ "$code" -ne 0 ]; then
        echo "not ok: the map $name ended with $code"
        cat "$lab/said"
        exit 1
    fi
    awk -F, -v name="$name" 'NR == 1 { while ($(n + 1) != "verdict") n++; next }
        { line = name; for (i = 1; i <= n + 1; i++) line = line "," $i; print line }' \
        "$lab/$name/map.csv" >>"$lab/all.csv"
}

for model in finite-volume dense-newton control-volume inlet-analysis film-formula; do
    map "$model" stability-film --set film.use="ehl/$model" --set film.cells=256
done
for model in time-integration shooting harmonic-balance; do
    map "$model" stability-dynamics --set motion.use="dynamics/$model"
done
map alpha stability-alpha --set film.cells=512
map rheology stability-rheology

if [ "${3:-}" = write ]; then
    cp "$lab/all.csv" "$expected"
    exit
fi
awk -F, '
    { cell = $0; sub(/,[a-z]*$/, "", cell) }
    NR == FNR { once[cell] = $NF; next }
    $NF != once[cell] { print cell ": " (cell in once ? once[cell] : "absent") " once, " $NF " now" }
    once[cell] == "converged" { good++; bad += $NF != "converged" }
    END { print good " of " FNR " cells were converged; of these " bad + 0 " are not"; exit bad > 0 || good == 0 }
' "$expected" "$lab/all.csv"
