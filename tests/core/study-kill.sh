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
format: 1
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
"$flankfilm" run study.yaml -j 2 -o calm >calm.out

seed=$$
round=0
kills=0
while [ "$round" -lt "$rounds" ]; do
    "$flankfilm" run study.yaml -j 2 -o killed >killed.out 2>killed.err &
    run=$!
    seed=$(((seed * 1103515245 + 12345) % 2147483648))
    sleep "0.$(printf %03d $((seed / 65536 % 200)))"
    if kill -9 "$run" 2>/dev/null; then kills=$((kills + 1)); fi
    wait "$run" 2>/dev/null || true
    round=$((round + 1))
done
"$flankfilm" run study.yaml -j 2 -o killed | tee killed.out
grep -q "^$((3 * points)) of $((3 * points)) cases done" killed.out
echo "$kills of $rounds runs were killed at work"

cmp calm/table.csv killed/table.csv
diff -r calm/cases killed/cases
[ "$(ls killed/cases | wc -l)" -eq $((3 * points)) ]
