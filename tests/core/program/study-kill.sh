#!/bin/sh
# A study that is killed again and again, evenly over its cases, ends with the results of one that is
# left alone, bit for bit.   study-kill.sh ROUNDS CASES FLANKFILM TOYS...
set -eu
rounds=$1 cases=$2
flankfilm=$(realpath "$3")
records=$(dirname "$(realpath "$0")")/records.py
shift 3
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
mkdir -p "$lab/plugins/toy"
for toy; do
    name=${toy##*/cli-toy-}
    ln -s "$(realpath "$toy")" "$lab/plugins/toy/$name"
done
cd "$lab"
export FLANKFILM_PLUGIN_PATH="$lab/plugins"
cat >study.yaml <<YAML
format: 2
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm}
  sum: {use: toy/sum, wave: wave}
  slow: {use: toy/wave, amplitude: 1 mm, work: 30 ms}
outputs: [sum.*, wave.height, wave.field, slow.total]
study:
  sweep:
    wave.amplitude: {from: 1 mm, to: 4 mm, points: $((cases / 4))}
    wave.count: [1, 8, 16, 32]
YAML
cat >chains.yaml <<YAML
format: 2
pipeline:
  walk: {use: toy/walk, step: 1 m, work: 1 ms}
outputs: [walk.place]
study:
  sweep:
    walk.foot: [1, 2, 3]
    walk.step: {from: 0.1 m, to: 0.7 m, points: $((rounds * 8)), follow: both}
YAML

finished() { cat "killed-$1/journal.jsonl" 2>/dev/null | wc -l; }

# kill STUDY CASES: in round k when k of ROUNDS + 1 parts are done, and some milliseconds later
seed=1
kill_again() {
    "$flankfilm" run "$1.yaml" -j 2 -o "calm-$1" >calm.out
    round=0
    kills=0
    while [ "$round" -lt "$rounds" ]; do
        round=$((round + 1))
        "$flankfilm" run "$1.yaml" -j 2 -o "killed-$1" >killed.out 2>killed.err &
        run=$!
        while kill -0 "$run" 2>/dev/null && [ "$(finished "$1")" -lt $(($2 * round / (rounds + 1))) ]; do
            sleep 0.005
        done
        seed=$(((seed * 1103515245 + 12345) % 2147483648))
        sleep "0.0$(printf %02d $((seed / 65536 % 20)))"
        if kill -9 "$run" 2>/dev/null; then kills=$((kills + 1)); fi
        wait "$run" 2>/dev/null || true
    done
    "$flankfilm" run "$1.yaml" -j 2 -o "killed-$1" | tee killed.out
    grep -q "^$2 of $2 cases done" killed.out
    echo "$1: $kills of $rounds runs were killed at work"
    [ "$kills" -gt 0 ]
    cmp "calm-$1/table.csv" "killed-$1/table.csv"
}
kill_again study "$cases"
for run in calm killed; do "$flankfilm" export $run-study --to csv -o $run-csv; done
for file in wave-t.csv wave-t-x.csv sum-t.csv; do cmp calm-csv/$file killed-csv/$file; done
ls killed-study
[ "$(ls killed-study | wc -l)" -eq 6 ] # two logs among them

kill_again chains $((6 * rounds * 8))
states() {
    python3 "$records" "$1/journal.jsonl" | sed -n 's/.*"key":"\([^"]*\)".*"state":{\([^}]*\)}.*/\1 \2/p' | sort -u
}
states calm-chains >calm.states
states killed-chains >killed.states
cmp calm.states killed.states
[ "$(wc -l <killed.states)" -eq $((6 * rounds * 8)) ]
