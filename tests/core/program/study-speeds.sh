#!/bin/sh
# The studies of configs/: every case succeeds, and a load distribution that takes long is not computed twice.
#   study-speeds.sh FLANKFILM SOURCE_ROOT
set -eu
flankfilm=$1
studies=$2/configs/studies
records=$(dirname "$0")/records.py
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT

# run NAME CASES
run() {
    "$flankfilm" run "$studies/$1.yaml" -j 2 -o "$lab/$1"
    [ "$(grep -c ',ok,' "$lab/$1/table.csv")" -eq "$2" ]
}

# once NAME: all cases share one load distribution.
once() {
    computed=$(python3 "$records" "$lab/$1/journal.jsonl" | sed 's/.*"stages":{\([^}]*\)}.*/\1/' | grep -c '"mesh"')
    echo "$1: $computed load distributions"
    [ "$computed" -eq 1 ]
}
run speed-sweep 362
once speed-sweep
run lubricants-by-laws 12
once lubricants-by-laws
run film-map 512 # its torques share the compliance; the rest is quicker than a file that keeps it

# The two ways of the speed sweep part between the folds of the atlas, at 1494.52 and 2858.10 Hz, and
# are there what the branches give that are sought at one speed alone.
alone() {
    "$flankfilm" run "$studies/speed-sweep.yaml" --set study= --set outputs=motion.dte_rms \
        --set motion.branch="$1" --set duty.mesh_frequency="2000 Hz" --json |
        sed 's/.*"motion.dte_rms":{[^}]*"value":\([^,}]*\).*/\1/'
}
awk -F, -v lower="$(alone lower)" -v upper="$(alone upper)" '
    $4 == "up" { up[$5] = $6 }
    $4 == "down" { down[$5] = $6 }
    function same(a, b) { return a - b < 1e-6 * b && b - a < 1e-6 * b }
    END {
        for (f = 1200; f <= 4000; f += 20)
            if (f > 1494 && f < 2858 ? down[f] < 1.5 * up[f] : f > 2858 && !same(down[f], up[f])) {
                print "at " f " Hz: " up[f] " up, " down[f] " down"
                exit 1
            }
        print "2000 Hz: " up[2000] " up, " lower " alone; " down[2000] " down, " upper " alone"
        exit !(same(up[2000], lower) && same(down[2000], upper) && down[1460] < 0.5 * down[1480])
    }' "$lab/speed-sweep/table.csv"
