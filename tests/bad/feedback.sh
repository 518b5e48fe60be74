#!/bin/sh
# A study of a loop: cases share it where its inputs agree, a killed one ends with the bits of one
# that is left alone, and a loop that does not settle is a failed case.
# feedback.sh FLANKFILM PLUGINS
set -eu
flankfilm=$(realpath "$1")
FLANKFILM_PLUGIN_PATH=$(realpath "$2")
export FLANKFILM_PLUGIN_PATH
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
cd "$lab"
cat >loop.yaml <<'YAML'
format: 2
feedback: {tolerance: 1e-9, rounds: 40}
pipeline:
  a: {use: loop/linear, base: 1 m, factor: 0.5, back: b, work: 1 ms}
  b: {use: loop/linear, base: 0 m, before: a}
  c: {use: loop/linear, base: 0 m, before: b}
outputs: [a.level, c.level]
YAML

# an axis behind the loop: it is computed once
{ cat loop.yaml; printf 'study: {sweep: {c.gain: [1, 2, 3, 4, 5, 6]}}\n'; } >shared.yaml
"$flankfilm" run shared.yaml -j 1 -o shared >shared.out
grep -q '^6 of 6 cases done' shared.out
grep -q '^stages: 8 computed .*, 10 reused' shared.out || { cat shared.out; exit 1; }

# other rounds are another case
"$flankfilm" run shared.yaml -j 1 -o shared --set feedback.rounds=50 >more.out
grep -q '^6 of 6 cases done: ' more.out
grep -q '^stages: 8 computed' more.out || { cat more.out; exit 1; }

# an axis in the loop, killed again and again
{ cat loop.yaml; printf 'study: {sweep: {a.factor: {from: 0.1, to: 0.5, points: 24}}}\n'; } >inner.yaml
"$flankfilm" run inner.yaml -j 2 -o calm >calm.out
kills=0
for pause in 0.10 0.05 0.15 0.08; do
    "$flankfilm" run inner.yaml -j 2 -o killed >killed.out 2>killed.err &
    run=$!
    sleep "$pause"
    if kill -9 "$run" 2>/dev/null; then kills=$((kills + 1)); fi
    wait "$run" 2>/dev/null || true
done
"$flankfilm" run inner.yaml -j 2 -o killed >killed.out
grep -q '^24 of 24 cases done' killed.out
[ "$kills" -gt 0 ]
cmp calm/table.csv killed/table.csv

# two of these do not settle
{ cat loop.yaml; printf 'study: {sweep: {a.factor: [0.2, 2, 0.4, -1]}}\n'; } >bad.yaml
code=0
"$flankfilm" run bad.yaml -j 1 -o bad >bad.out 2>&1 || code=$?
[ "$code" -eq 4 ] || { cat bad.out; exit 1; }
grep -q 'feedback_residual' bad/table.csv || { cat bad/table.csv; exit 1; }

# check and explain
"$flankfilm" check loop.yaml | grep -q 'ok (3 stages)'
"$flankfilm" explain loop.yaml >explain.out
grep -q '^loop: a, b; in at most 40 rounds' explain.out
grep -q '  b ~> a.back' explain.out
"$flankfilm" explain loop.yaml --json | tr -d ' \n' >explain.json
grep -q '"loops":\[{"stages":\["a","b"\]' explain.json || { cat explain.json; exit 1; }
