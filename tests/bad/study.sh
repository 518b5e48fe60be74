#!/bin/sh
# Models that drive a study and do it wrongly: the program says whose fault it is, and loses nothing.
#   study.sh FLANKFILM BAD_PLUGINS TOY_ROOT
set -eu
flankfilm=$(realpath "$1") bad=$(realpath "$2")
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
mkdir -p "$lab/plugins/toy"
ln -s "$(realpath "$3")" "$lab/plugins/toy/root.so"
export FLANKFILM_PLUGIN_PATH="$lab/plugins:$bad"
cd "$lab"

# expect CODE WORDS COMMAND...: it ends so and says so
expect() {
    code=$1 words=$2 got=0
    shift 2
    "$@" >said 2>&1 || got=$?
    if [ "$got" -ne "$code" ] || ! grep -qF -- "$words" said; then
        echo "not ok: $* ended with $got, not $code, or did not say: $words"
        cat said
        exit 1
    fi
    echo "ok: $words"
}

# study MODEL: a file that it drives
study() {
    cat >"$1.yaml" <<YAML
format: 1
pipeline: {root: {use: toy/root}}
outputs: [root.value]
study:
  $1: {outputs: [root.value], axes: {root.n: [1, 2]}}
YAML
    echo "$1.yaml"
}

# drive CODE WORDS MODEL
drive() {
    expect "$1" "$2" "$flankfilm" run "$(study "$3")" -o "$3"
}

drive 0 'it was done' well
[ "$(grep -c . well/table.csv)" -eq 3 ]
expect 0 '"best":1' "$flankfilm" run well.yaml -o well --json
expect 0 'first of 2 cases' "$flankfilm" check well.yaml
expect 0 '2 cases' "$flankfilm" plan well.yaml -o well

# A case that cannot be, and one of no number, are rows of the table, with their reasons.
drive 4 '1 failed' impossible
grep -q 'invalid.*nowhere' impossible/table.csv
drive 4 '1 failed' nan
grep -q '^3,[^,]*,invalid,nan,' nan/table.csv

drive 3 'cases that it has not described' beyond
drive 3 'more than 1000000 cases' greedy
drive 3 'cases that the sweep does not have' astray
drive 3 'cases that it has not described' rerun
drive 3 'crash-check.so' crash-check
drive 3 'plans no cases' nothing
drive 3 'found a fault of its own' early
drive 3 'found a fault of its own' no-run
drive 3 'facts that are no JSON object' facts
drive 3 'gives a file the name "../escaped.txt"' folder
[ ! -e escaped.txt ]
drive 3 'gives a file the name "table.csv"' journal
drive 3 'status 77' status
drive 3 'crash.so' crash
drive 3 'crash-plan.so' crash-plan
expect 2 'study: unknown key "wel"; did you mean "well"?' "$flankfilm" run well.yaml \
    --set 'study={wel: {}}'
expect 2 'well: expected a map' "$flankfilm" run well.yaml --set 'study={well: 3}'
expect 2 '"axes" is a map from one path' "$flankfilm" run well.yaml --set study.well.axes=3
expect 2 'a study either sweeps or tries' "$flankfilm" run well.yaml \
    --set 'study.sweep={root.n: [1]}'
expect 2 'exclude each other' "$flankfilm" run well.yaml --set 'study.deaf={axes: 1}'

# One that never ends is stopped like any other study, and what it did is kept.
"$flankfilm" run "$(study endless)" -o endless >said 2>&1 &
run=$!
while [ "$(grep -c . endless/journal.jsonl 2>/dev/null || true)" != 1 ]; do sleep 0.05; done
kill -TERM "$run"
wait "$run" || true
[ "$(grep -c . endless/journal.jsonl)" -eq 1 ]
echo "ok: one that never ends was stopped"

# A case whose model complains about a table says where in the table.
printf 'level [mm]\n1\n2\n' >good.csv
printf 'level [mm]\n1\n-2\n' >below.csv
cat >tables.yaml <<YAML
format: 1
pipeline: {reader: {use: toy/reader, file: good.csv}}
outputs: [reader.sum]
study:
  sweep:
    reader.file: [good.csv, below.csv]
    reader.how: [used, cell]
YAML
expect 4 '3 failed' "$flankfilm" run tables.yaml -o tables
grep -q 'below.csv:3:1: reader.file .*level' tables/table.csv
grep -q 'good.csv:3:1: reader.file (toy/reader): the level of row 2 is wrong' tables/table.csv
