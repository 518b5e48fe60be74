#!/bin/sh
# The studies of configs/: every case succeeds, and no load distribution is computed twice.
#   study-speeds.sh FLANKFILM SOURCE_ROOT
set -eu
flankfilm=$1
studies=$2/configs/studies
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT

# run NAME CASES DISTRIBUTIONS
run() {
    "$flankfilm" run "$studies/$1.yaml" -j 2 -o "$lab/$1"
    [ "$(grep -c ',ok,' "$lab/$1/table.csv")" -eq "$2" ]
    computed=$(sed 's/.*"stages":{\([^}]*\)}.*/\1/' "$lab/$1/journal.jsonl" | grep -c '"mesh"')
    echo "$1: $computed load distributions for $2 cases"
    [ "$computed" -eq "$3" ]
}
run speed-sweep 362 1
run film-map 512 8
