#!/bin/sh
# Maps of where a pipeline can be trusted, on a model whose verges are known: it warns above 2 m/s,
# fails above 3, is out of its range below 0.2, swings below 0.5 with more than 0.5 N, refuses less
# than 0.01 N, and above 5 N its error is ten times what it says.   stability.sh FLANKFILM VERGE ROOT
set -eu
flankfilm=$(realpath "$1")
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
mkdir -p "$lab/plugins/toy"
cp "$2" "$lab/plugins/toy/verge.so"
cp "$3" "$lab/plugins/toy/root.so"
export FLANKFILM_PLUGIN_PATH="$lab/plugins"
cd "$lab"

# map NAME LOADS SPEEDS REST
map() {
    cat >"$1.yaml" <<YAML
format: 2
pipeline: {verge: {use: toy/verge}}
outputs: [verge.answers]
study:
  stability:
    axes:
      verge.load: $2
      verge.speed: $3
    outputs: [verge.answer]
    estimates: {verge.answer: [verge.answer_error]}
    refine: [verge.cells]
    range: [verge.law]
    $4
YAML
}

# expect CODE WORDS COMMAND...: the program ends so and says so
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

# says WORDS: the last program did
says() {
    if ! grep -qF -- "$1" said; then
        echo "not ok: it did not say: $1"
        cat said
        exit 1
    fi
}

# verdict FILE LOAD SPEED WORD
verdict() {
    if ! grep -q "^$2 N,$3 m/s,$4," "$1/map.csv"; then
        echo "not ok: $2 N, $3 m/s is not $4"
        cat "$1/map.csv"
        exit 1
    fi
    echo "ok: $2 N, $3 m/s is $4"
}

# The verge between warning and failing lies at 3 m/s, that between good and warning at 2.
map verges '[1 N, 2 N]' '{from: 1 m/s, to: 4 m/s, points: 4}' 'bisect: 6'
expect 0 'no silent failure' "$flankfilm" run verges.yaml -j 2 -o verges
says 'd 2 degraded and 12 between'
says '14: verge.residual'
verdict verges 1 1 converged
verdict verges 1 2 converged
verdict verges 1 3 degraded
verdict verges 1 4 failed
grep -q '"step 7 of 9: 4 m/s is above 3\|step 7 of 9: 4 m/s is above 3"' verges/map.csv
awk -F'"' '
    /"axis"/ { pair = "" }
    /"between"/ { getline; low = $2; getline; high = $2; sub(/ m.s/, "", low); sub(/ m.s/, "", high)
        n++
        verge = low < 2.5 ? 2 : 3
        if (!(low <= verge && verge < high && high - low < 1.0001 / 64)) {
            print "not ok: a verge between " low " and " high
            bad = 1
        } }
    END { print (n == 4 && !bad ? "" : "not ") "ok: " n " boundaries within 1/64 m/s"; exit n != 4 || bad }
' verges/map.json

# Nothing is run twice, and what was lost is run again.
expect 0 'cases done' "$flankfilm" run verges.yaml -o verges
total=$(sed -n 's/ cases done.*//p' said)
says "$total cases done, $total of them earlier"
if grep removed said; then exit 1; fi # what is written again is not gone
cp verges/map.csv before.csv
head -n 5 verges/journal.jsonl >short
mv short verges/journal.jsonl
expect 0 "$total cases done, 5 of them earlier" "$flankfilm" run verges.yaml -o verges
cmp before.csv verges/map.csv
[ "$(grep -c . verges/table.csv)" -eq $((total + 1)) ]
python3 -m json.tool verges/map.figure.json >/dev/null

# An estimate that is ten times too small is found; elsewhere the same error is as it was said.
map silent '{from: 0.001 N, to: 10 N, points: 5, spacing: log}' '[1 m/s, 0.1 m/s]' \
    'bisect: {verge.load: 5}'
expect 4 '! ' "$flankfilm" run silent.yaml -o silent
says 'with finer settings, it differs by'
says 'the estimate is 1 %'
verdict silent 10 1 silent
verdict silent 1 1 converged
verdict silent 1 0.1 outside
verdict silent 0.001 1 refused
grep -q '"between": \[' silent/map.json

# What swings is told apart from what is not solved.
map swing '[0.1 N, 1 N, 10 N]' '[0.4 m/s, 1 m/s, 2.5 m/s]' 'physical: ["verge.swing > 0"]'
expect 4 'p 1 physical' "$flankfilm" run swing.yaml -o swing
verdict swing 1 0.4 physical
verdict swing 10 0.4 silent
verdict swing 0.1 0.4 converged
verdict swing 1 2.5 degraded
map motion '[1 N]' '[1 m/s, 2.5 m/s]' 'physical: [verge.residual]'
expect 0 'p 1 physical' "$flankfilm" run motion.yaml -o motion
verdict motion 1 2.5 physical

# A line without a number says that the error is not known, and promises none.
expect 0 '1: verge.answer_error, for example not known, limit 0.1' "$flankfilm" run motion.yaml -o unknown \
    --set verge.cells=1 --set 'study.stability.axes.verge.speed=[1 m/s]'
grep -q '1 N,1 m/s,degraded,grid,verge.answer_error,,0.1,verge.answer,0.6,,' unknown/map.csv

# A line that may warn for either reason is physics only where the condition says so.
map calm '[1 N]' '[1 m/s, 2.5 m/s]' 'physical: {"verge.swing > 0": verge.residual}'
expect 0 'd 1 degraded' "$flankfilm" run calm.yaml -o calm
expect 0 'p 1 physical' "$flankfilm" run calm.yaml -o still \
    --set 'study.stability.physical={"verge.swing < 1": verge.residual, verge.law: []}' \
    --set 'study.stability.axes.verge.speed=[2.5 m/s]'

# What is good to know leaves the verdict alone, as long as the refined case agrees.
map notes '[1 N, 10 N]' '[0.4 m/s, 2.5 m/s]' 'notes: {"verge.swing > 0": motions swing, verge.residual: fast}'
expect 4 ". 2 converged" "$flankfilm" run notes.yaml -o notes
says ".'!'"
says "' 4 with a note"
says '2: 1 motions swing'
# a twin, which has cells, computes no output of a condition
python3 - <<'END'
import csv
rows = list(csv.DictReader(open("notes/table.csv")))
assert {bool(row["verge.cells"]): row["verge.swing [1]"] != "" for row in rows} == {False: True, True: False}, rows
END
says '2: 2.5 fast'
verdict notes 1 0.4 converged
verdict notes 1 2.5 converged
verdict notes 10 0.4 silent
verdict notes 10 2.5 degraded
grep -q '^1 N,0.4 m/s,converged.*,"1 motions swing"$' notes/map.csv
grep -q '"note": "2.5 fast"' notes/map.json
grep -q '"2.5 fast"' notes/map.figure.json
expect 4 '"noted":[4,0]' "$flankfilm" run notes.yaml -o notes --json
expect 2 'must be a map from quality lines' "$flankfilm" check notes.yaml \
    --set 'study.stability.notes=[verge.residual]'
expect 2 'the pipeline has no stage "vergo"' "$flankfilm" check notes.yaml \
    --set 'study.stability.notes={vergo.law: fast}'
expect 2 'must be a list of names such as' "$flankfilm" check notes.yaml \
    --set 'study.stability.physical={verge.law: fast}'

# Programs, other ways to run it, and what is wrong with a file.
expect 4 '"silent":[2,0]' "$flankfilm" run swing.yaml -o swing --json
# What came of it is planned, told, and exported as the run made it.
expect 0 'stability: 8 grid cells' "$flankfilm" explain verges.yaml
expect 0 ' failed, 4 to run' "$flankfilm" plan verges.yaml -o verges --set study.stability.bisect=7
says '8 grid cells'
[ "$(awk '/ done, /{print $1 + $3}' said)" -eq "$total" ]
expect 0 'verges/results-csv' "$flankfilm" export verges --to csv
cmp verges/map.csv verges/results-csv/map.csv
expect 0 'these are grid cells' "$flankfilm" run motion.yaml -o shard --shard 1/2
expect 2 'verge.answers is a series or a field' "$flankfilm" check verges.yaml \
    --set 'study.stability.outputs=[verge.answer, verge.answers]'
expect 2 'the pipeline has no stage "vergo"' "$flankfilm" check verges.yaml \
    --set 'study.stability.refine=[vergo.cells]'
expect 0 'no parameter is refined' "$flankfilm" check verges.yaml \
    --set 'study.stability.refine=[verge.sells]'
expect 2 'unknown key "refines"; did you mean "refine"' "$flankfilm" check verges.yaml \
    --set 'study.stability.refines=[verge.cells]'
expect 2 '"axes" must be a map' "$flankfilm" check verges.yaml --set study.stability.axes=
expect 2 '"bisect" must name an axis that has' "$flankfilm" check verges.yaml \
    --set 'study.stability.bisect={verge.load: 3}'
expect 2 'whole numbers from 0 to 40' "$flankfilm" check verges.yaml --set study.stability.bisect=-1
expect 2 'conditions in SI' "$flankfilm" check verges.yaml \
    --set 'study.stability.physical=["verge.swing > much"]'
expect 2 'stability.tolerance: "x" does not begin with a decimal number' "$flankfilm" check verges.yaml --set study.stability.tolerance=x
expect 2 'must be a map from outputs of this study' "$flankfilm" check verges.yaml \
    --set 'study.stability.estimates={verge.swing: [verge.law]}'
expect 2 'doubl' "$flankfilm" check verges.yaml --set 'study.stability.refine={verge.cells: 0}'
expect 2 'a study either sweeps or maps' "$flankfilm" check verges.yaml \
    --set 'study.sweep={verge.load: [1 N]}'
expect 2 'study: unknown key "stabilty"; did you mean "stability"?' "$flankfilm" check verges.yaml \
    --set 'study={stabilty: {}}'
expect 2 'stability: expected a map' "$flankfilm" check verges.yaml --set 'study={stability: 3}'
sed '/axes:/,/speed:/d' verges.yaml >axes.yaml
expect 2 'stability: "axes" is missing' "$flankfilm" check axes.yaml
expect 2 '"stability" and "tradeoff" exclude each other' "$flankfilm" check verges.yaml \
    --set 'study.tradeoff={}'
expect 0 '4 cases done, 1 of them earlier' "$flankfilm" run motion.yaml -o shard

# A cell is confirmed by a coarser case alone where that is as near as the answer says; a finer one decides the rest,
# and what cannot be coarser has the finer one at once.
map cost '[1 N, 10 N]' '[1 m/s]' 'bisect: 0'
expect 4 '5 cases done' "$flankfilm" run cost.yaml -o cost
verdict cost 1 1 converged
verdict cost 10 1 silent
grep -q ',1 N,1 m/s,5,' cost/table.csv
grep -q ',10 N,1 m/s,20,' cost/table.csv
expect 0 '2 cases done' "$flankfilm" run cost.yaml -o one --set verge.cells=1 --set 'study.stability.axes.verge.load=[1 N]'
grep -q ',1 N,1 m/s,2,' one/table.csv

# A finer case of few cells has one more.
expect 0 '3 cases done' "$flankfilm" run cost.yaml -o few --set verge.cells=4 \
    --set 'study.stability.axes.verge.load=[10 N]' --set 'study.stability.refine={verge.cells: 1.1}'
grep -q ',10 N,1 m/s,5,' few/table.csv

# Limits may forbid the finer case, or both.
expect 4 'with coarser settings, it differs by 8.9 %' "$flankfilm" run cost.yaml -o coarser \
    --set 'study.stability.axes.verge.load=[10 N]' --set 'study.stability.refine={verge.load: 20}'
expect 0 'no coarser and no finer settings' "$flankfilm" run cost.yaml -o limits \
    --set 'study.stability.axes.verge.load=[1 N]' --set 'study.stability.refine={verge.load: 1e5}'
verdict limits 1 1 unchecked

# A number that is 0 in the finer case has no share by which it differs.
cat >zero.yaml <<YAML
format: 2
pipeline: {root: {use: toy/root}}
outputs: [root.value]
study: {stability: {axes: {root.n: [60, 200]}, outputs: [root.trace], refine: [root.n], bisect: 0}}
YAML
expect 4 'it is 0 or not finite' "$flankfilm" run zero.yaml -o zero
grep -q '^60,silent,' zero/map.csv
grep -q '^200,converged,' zero/map.csv
