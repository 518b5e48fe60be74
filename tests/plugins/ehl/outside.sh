#!/bin/sh
# A discretisation that knows film.h alone: its films are those of ehl/finite-volume, the closer the
# more cells, and one that is spoiled is told to be bad.
# outside.sh FLANKFILM SOURCE_ROOT FOLDER: discretisations are FOLDER/discretisation/*.so
set -eu
flankfilm=$1 source=$2 folder=$3
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
case=$source/tests/third-party/penalty/penalty.yaml

# run NAME CELLS [--set ...]: the lowest film in um
run() {
    name=$1 cells=$2
    shift 2
    "$flankfilm" run --all "$case" --plugin-path "$folder" --set film.cells="$cells" "$@" -o "$lab/$name" >"$lab/$name.said" 2>&1
}
lowest() {
    sed -n 's/^ *h_min_lowest *\([0-9.]*\) um .*/\1/p' "$lab/$1.said"
}

sed '/discretisation: mine/s/ discretisation: mine,//; /discretisation\/penalty/d' "$case" >"$lab/own.yaml"
for cells in 96 192; do # with an inlet that is given both begin with p = 0
    run "outside-$cells" "$cells" --set film.inlet=6
    "$flankfilm" run --all "$lab/own.yaml" --set film.cells="$cells" --set film.inlet=6 -o "$lab/own-$cells" >"$lab/own-$cells.said" 2>&1
    echo "$cells $(lowest "outside-$cells") $(lowest "own-$cells")"
done >"$lab/films"
awk '{ print $1 " cells: " $2 " um by discretisation/penalty, " $3 " um by ehl/finite-volume" }' "$lab/films"
# both are of second order or better
awk '{ off[NR] = $2 / $3 - 1; if (off[NR] < 0) off[NR] = -off[NR] }
     END { exit !(off[1] < 0.08 && off[2] < 0.01 && 4 * off[2] < off[1]) }' "$lab/films"

cat >"$lab/wrong.yaml" <<EOF
format: 2
include: [$case]
pipeline:
  bad:  {use: discretisation/wrong, of: mine, fault: slow}
  film: {discretisation: bad}
EOF
for fault in slow no-squeeze thick soft light lazy suction nan stubborn talking; do
    status=0
    "$flankfilm" run "$lab/wrong.yaml" --plugin-path "$folder" --set bad.fault="$fault" -o "$lab/$fault" \
        >"$lab/$fault.said" 2>&1 || status=$?
    why=$(grep -m 1 -o 'film\.[a-z_]* = [^ ]*, limit [^ ]*: bad' "$lab/$fault.said" ||
        grep -m 1 -o 'returned an invalid film' "$lab/$fault.said" ||
        grep -m 1 -o 'had failed at more than a fifth of the instants' "$lab/$fault.said" ||
        grep -m 1 -o '(bad: the sweep 7 diverges)' "$lab/$fault.said" || true)
    echo "$fault: exit $status, $why"
    [ "$status" -eq 1 ] && [ -n "$why" ] || {
        cat "$lab/$fault.said"
        exit 1
    }
done
