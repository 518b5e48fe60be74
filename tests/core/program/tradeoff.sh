#!/bin/sh
# A trade-off of a model whose errors are known: 1/n^2 at a cost that grows with n.
#   tradeoff.sh FLANKFILM TOYS...
set -eu
flankfilm=$(realpath "$1")
records=$(dirname "$(realpath "$0")")/records.py
shift
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
  root: {use: toy/root, blind: 64}
  slow: {use: toy/wave, amplitude: 1 mm, work: 200 ms}
outputs: [root.rounds]
study:
  tradeoff:
    outputs: [root.value, root.curve, slow.total]
    counts: [root.rounds]
    accuracy: 1e-3
    reference: {root.n: 100, refine: [root.n], refinements: 5}
    candidates:
      - {root.n: [2, 4, 8, 16, 64]}
      - {root.n: 8, root.blind: [1, 100]}
    repeats: 3
YAML
fail() {
    echo "$1" >&2
    exit 1
}

# Refined until a change of 1e-4: 100, 200; a candidate that fails is a row with its reason.
code=0
"$flankfilm" run study.yaml -o out >out.txt || code=$?
cat out.txt
[ "$code" -eq 4 ] || fail "expected exit code 4, found $code"
grep -q '^reference 1: n 200,' out.txt || fail "the reference was not refined to 200"
grep -q '^reference 2' out.txt && fail "the reference was refined further than needed"
grep -q '^23 of 23 cases done: 20 good, 3 failed' out.txt || fail "cases"
grep -q '^it changes' out.txt && fail "the reference stands"

# column NAME: its number in tradeoff.csv
column() {
    head -1 out/tradeoff.csv | tr , '\n' | grep -nxF "$1" | cut -d: -f1
}
awk -F, -v v="$(column 'root.value error')" -v c="$(column 'root.curve error')" \
    -v count="$(column root.rounds)" -v front="$(column 'root.value front')" \
    -v s="$(column 'slow.total error')" -v cost="$(column 'cost [s]')" '
    function near(a, b) { return a - b < 2e-6 * b && b - a < 2e-6 * b }
    function bad(what) { print what ": " $0; wrong = 1 }
    NR > 1 && !/failed/ {
        # commas of labels: no candidate here has more than one
        shift = /blind/ ? 1 : 0
        n = $1; gsub(/[^0-9.]/, "", n)
        error = (1 + 1 / n ^ 2) / (1 + 1 / 200 ^ 2) - 1
        if (!near($(v + shift), error)) bad("error of value, not " error)
        if (!near($(c + shift), error)) bad("error of curve, not " error)
        if ($(s + shift) != 0) bad("error of what no knob touches")
        if ($(count + shift) != n) bad("count")
        if (!($(cost + shift) > 0)) bad("cost")
        if (!shift) { last = n; ends = $(front) }
        rows++
    }
    /failed/ { if (!/nothing was found/ || !/^"n 64"/) bad("failure"); failed++ }
    END { exit wrong || rows != 6 || failed != 1 || last != 16 || ends != 1 }' out/tradeoff.csv ||
    fail "tradeoff.csv"
grep -q '"sort": "front"' out/tradeoff.figure.json || fail "figure"

# A point of a front, run again alone, has the error and the cost that it was told to have.
python3 - "$flankfilm" <<'END' || fail "a point run again"
import json, subprocess, sys
told = json.load(open("out/tradeoff.json"))
names = [name for name in told["outputs"] if name != "slow.total"]

def run(*sets):
    words = [word for one in ("study=", f"outputs=[{', '.join(names)}]", *sets) for word in ("--set", one)]
    answer = json.loads(subprocess.run([sys.argv[1], "run", "study.yaml", "--json", "--arrays", *words], stdout=subprocess.PIPE, check=True).stdout)
    return {name: output.get("data", [output.get("value")]) for name, output in answer["outputs"].items()}

exact = run("root.n=200")
for name in names:
    for point in told["outputs"][name]["front"]:
        candidate = told["candidates"][point["candidate"]]
        again = run(*candidate["assignments"])[name]
        off = abs(again[0] - exact[name][0]) / abs(exact[name][0])
        assert abs(off / candidate["errors"][name]["error"] - 1) < 1e-6, (name, candidate, off)
        assert abs(off / point["error"] - 1) < 1e-6 or point["error"] == told["outputs"][name]["reference_error"], point
        assert point["seconds"] == candidate["seconds"]["median"], point
        alone = f"study.tradeoff.candidates=[{{{', '.join(': '.join(one) for one in candidate['set'].items())}}}]"
        subprocess.run([sys.argv[1], "run", "study.yaml", "-o", "alone", "--replace", "--set", alone], stdout=subprocess.DEVNULL, check=True)
        cost = json.load(open("alone/tradeoff.json"))["candidates"][0]["seconds"]["median"]
        assert 1 / 3 < cost / point["seconds"] < 3, (candidate, cost)
END

# What no knob touches is computed once.
[ "$(python3 "$records" out/journal.jsonl | grep -c '"stages":{[^}]*"slow"')" -eq 1 ] || fail "slow ran more than once"

# Killed again and again, it ends with the same errors, and nothing is done twice.
round=0
while [ "$round" -lt 5 ]; do
    "$flankfilm" run study.yaml -o killed >/dev/null 2>&1 &
    run=$!
    sleep 0.0$((1 + round))
    kill -9 "$run" 2>/dev/null || true
    wait "$run" 2>/dev/null || true
    round=$((round + 1))
done
"$flankfilm" run study.yaml -o killed >killed.txt || true
grep -q '^23 of 23 cases done' killed.txt || fail "resume"
errors() {
    sed -n 's/.*"\(largest\|reference_error\)": \([^,}]*\).*/\1 \2/p' "$1/tradeoff.json"
}
errors out >out.errors
errors killed >killed.errors
[ -s out.errors ] || fail "no errors in tradeoff.json"
cmp out.errors killed.errors
"$flankfilm" run study.yaml -o killed | grep -q '^23 of 23 cases done, 23 of them earlier' ||
    fail "done twice"

# One that is told to end does so, and what it did is kept; each case takes 0.2 s.
"$flankfilm" run study.yaml -o ended --set 'study.tradeoff.stages=[slow]' >ended.txt 2>&1 &
run=$!
while [ ! -s ended/journal.jsonl ] && kill -0 "$run"; do sleep 0.05; done
kill -TERM "$run"
code=0
wait "$run" || code=$?
[ "$code" -eq 1 ] || fail "told to end: exit code $code"
grep -q 'the study was stopped' ended.txt || fail "it does not say that it was stopped"
[ -s ended/journal.jsonl ] && [ ! -e ended/tradeoff.csv ] || fail "what it did was not kept"

# One object on stdout.
"$flankfilm" run study.yaml -o out --json >out.json || true
[ "$(wc -l <out.json)" -eq 1 ] || fail "--json: not one line"
[ "$(head -c 1 out.json)" = "{" ] || fail "--json: no object"
grep -q '"tradeoff"' out.json || fail "--json has no tradeoff"

# refused TEXT SET...
file=study.yaml
refused() {
    text=$1
    shift
    code=0
    "$flankfilm" run $file -o none "$@" >refused.txt 2>&1 || code=$?
    cat refused.txt
    [ "$code" -eq 2 ] || fail "exit code $code instead of 2"
    grep -q "$text" refused.txt || fail "expected: $text"
    [ ! -e none/tradeoff.csv ] || fail "something ran"
}
refused 'has no output "valve"; did you mean "value"' --set 'study.tradeoff.outputs=[root.valve]'
refused 'root.field is a field' --set 'study.tradeoff.outputs=[root.field]'
sed 's/root.blind: \[/root.blend: [/' study.yaml >blend.yaml
file=blend.yaml
refused 'blend.yaml:14:9: error: tradeoff: n 8, blend 1: root: unknown key "blend"'
file=study.yaml
refused 'no "root.m" to refine' --set 'study.tradeoff.reference={root.n: 1, refine: [root.m]}'
refused 'the reference is one answer' --set 'study.tradeoff.reference={root.n: [1, 2]}'
refused 'unknown key "estimates"' --set 'study.tradeoff.estimates=none'
refused 'unknown key "candidate"' --set 'study.tradeoff.candidate=[]'
refused 'tradeoff.repeats: 0 is too small; it must be at least 1' --set study.tradeoff.repeats=0
refused 'tradeoff.accuracy: -0.01 is too small; it must be above 0' --set 'study.tradeoff.accuracy=-1 %'
refused 'either sweeps or measures' --set 'study.sweep={root.n: [1, 2]}'
refused 'cannot be distributed' --shard 1/2
code=0
sed 's/n: 100/n: 32/' study.yaml >blind.yaml
"$flankfilm" run blind.yaml -o blind >blind.txt 2>&1 || code=$?
cat blind.txt
[ "$code" -eq 1 ] || fail "a reference that fails: exit code $code"
grep -q 'blind.yaml:11:16: error: tradeoff: the reference failed (n 64): .*nothing was found' blind.txt ||
    fail "a reference that fails: why"

# What is 0 in the reference has no shares: its errors are absolute. A name of the file stands before the rest.
sed 's/    repeats: 3/    repeats: 1/; s/outputs: \[root.value, root.curve, slow.total\]/outputs: [root.value, root.curve, slow.height]/; s/- {root.n: \[2, 4, 8, 16, 64\]/- {name: quick, root.n: [2, 8]/; s/{root.n: 8, root.blind/{name: slow, root.n: 8, root.blind/' study.yaml >sign.yaml
"$flankfilm" run sign.yaml -o sign >sign.txt || true
grep -q '^slow.height, uncertain by .* %$' sign.txt || fail "one measure of all series"
grep -q 'slow, n 8, blind 100' sign.txt || fail "the name of the file"
"$flankfilm" run sign.yaml -o sign1 --set 'study.tradeoff.candidates=[{name: alone, root.n: 4}]' >sign1.txt
grep -q ' alone *$' sign1.txt || fail "a name stands alone for one point"
"$flankfilm" run sign.yaml -o none --set 'study.tradeoff.outputs=[root.value, root.trace]' >none.txt || true
grep -q '^root.trace, 0 in the reference: errors in SI, uncertain by 0$' none.txt || fail "0 in the reference"
grep -q '^[* ] *0.0156 *0.0156 .* quick, n 8$' none.txt || fail "0 in the reference: 1/64 itself"

# Where it becomes 0, the change has no share either, and it has not settled.
"$flankfilm" run sign.yaml -o zero --set 'study.tradeoff.outputs=[root.value, root.trace]' \
    --set 'study.tradeoff.reference={root.n: 60, refine: [root.n], refinements: 1}' >zero.txt || true
grep -q '^reference 1: .*; root.trace changed by 0.00028 in SI' zero.txt || fail "a change to 0"
grep -q '0.1 %: root.value, root.trace' zero.txt || fail "a change to 0 has not settled"

# An estimate that is not known somewhere states nothing.
head -1 sign/tradeoff.csv | grep -q 'root.curve stated' || fail "no column of what is stated"
python3 - <<'END' || fail "an estimate that is not known"
import csv
rows = {row["candidate"]: row["root.curve stated"] for row in csv.DictReader(open("sign/tradeoff.csv"))}
assert rows["quick, n 2"] == "", rows
assert abs(float(rows["quick, n 8"]) - 1 / 64) < 1e-3, rows
END

# A change that falls no more ends the refinement, and the output that keeps it is named.
sed 's/n: 100, refine: \[root.n\]/n: 100, refine: {root.n: 0.5}/' study.yaml >stall.yaml
"$flankfilm" run stall.yaml -o stall >stall.txt || true
grep -q '^reference 2' stall.txt && ! grep -q '^reference 3' stall.txt || fail "it was refined in vain"
tr -s '\n ' ' ' <stall.txt | grep -q '0.1 %: root.value, root.curve; refinement does not' || fail "it does not say what keeps it"

# The figure names the points of the front, and shows how well each number is known.
python3 - <<'END' || fail "the figure"
import json
figure = json.load(open("sign/tradeoff.figure.json"))[0]
candidates, front = figure["tables"]
rows = front["rows"]
assert len(candidates["rows"]) == 4, candidates
named = [row[1] for row in rows]  # the front by its names, cheapest first
assert named and set(named) <= {"quick, n 2", "quick, n 8", "slow, n 8, blind 1", "slow, n 8, blind 100"}, rows
assert [row[0] for row in rows] == list(range(1, len(rows) + 1)), rows
assert [row[2] for row in rows] == sorted(row[2] for row in rows), rows
assert [figure["candidates"][one["candidate"]]["label"] for one in figure["output"]["front"]] == named, figure
assert sum(one["error"]["error"] >= 0 and one["seconds"]["max"] >= one["seconds"]["min"] for one in figure["candidates"]) >= 4
assert figure["output"]["reference_error"] >= 0  # the bars of the points
END
