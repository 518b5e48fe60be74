#!/bin/sh
# A study that is killed again and again ends with the results of one that is left alone, bit for
# bit.   study-kill.sh ROUNDS FLANKFILM TOYS...
set -eu
rounds=$1
flankfilm=$(realpath "$2")
shift 2
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
mkdir -p "$lab/plugins/toy"
for toy; do
    name=${toy##*/cli-toy-}
    ln -s "$(realpath "$toy")" "$lab/plugins/toy/$name"
done
cd "$lab"
export FLANKFILM_PLUGIN_PATH="$lab/plugins"
points=$((rounds * 4)) # so many that the last round still finds work
cat >study.yaml <<YAML
format: 2
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm, work: 20 ms}
  sum: {use: toy/sum, wave: wave}
  slow: {use: toy/wave, amplitude: 1 mm, work: 30 ms}
outputs: [sum.*, wave.height, slow.total]
study:
  sweep:
    wave.amplitude: {from: 1 mm, to: 4 mm, points: $points}
    wave.count: [8, 16, 32]
YAML
cat >chains.yaml <<YAML
format: 2
pipeline:
  walk: {use: toy/walk, step: 1 m, work: 10 ms}
outputs: [walk.place]
study:
  sweep:
    walk.foot: [1, 2, 3]
    walk.step: {from: 0.1 m, to: 0.7 m, points: $((2 * points)), follow: both}
YAML

# kill STUDY CASES
seed=1
kill_again() {
    "$flankfilm" run "$1.yaml" -j 2 -o "calm-$1" >calm.out
    round=0
    kills=0
    while [ "$round" -lt "$rounds" ]; do
        "$flankfilm" run "$1.yaml" -j 2 -o "killed-$1" >killed.out 2>killed.err &
        run=$!
        seed=$(((seed * 1103515245 + 12345) % 2147483648))
        sleep "0.$(printf %03d $((seed / 65536 % 200)))"
        if kill -9 "$run" 2>/dev/null; then kills=$((kills + 1)); fi
        wait "$run" 2>/dev/null || true
        round=$((round + 1))
    done
    "$flankfilm" run "$1.yaml" -j 2 -o "killed-$1" | tee killed.out
    grep -q "^$2 of $2 cases done" killed.out
    echo "$1: $kills of $rounds runs were killed at work"
    [ "$kills" -gt 0 ]
    cmp "calm-$1/table.csv" "killed-$1/table.csv"
}
kill_again study $((3 * points))
diff -r calm-study/cases killed-study/cases
[ "$(ls killed-study/cases | wc -l)" -eq $((3 * points)) ]

kill_again chains $((12 * points))
states() {
    sed -n 's/.*"key":"\([^"]*\)".*"state":{\([^}]*\)}.*/\1 \2/p' "$1/journal.jsonl" | sort -u
}
states calm-chains >calm.states
states killed-chains >killed.states
cmp calm.states killed.states
[ "$(wc -l <killed.states)" -eq $((12 * points)) ]
