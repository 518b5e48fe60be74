#!/bin/sh
# The audit of studies whose models are chosen, on models whose errors are known, then on the file
# that ships.   audit.sh FLANKFILM SOURCE COARSE FINE LIAR PLAIN SHY
set -eu
flankfilm=$(realpath "$1")
source=$(realpath "$2")
shift 2
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
for model; do
    name=$(basename "$model" .so)
    mkdir -p "$lab/all/gauge"
    cp "$model" "$lab/all/gauge/${name#cli-toy-gauge-}.so"
done
cd "$lab"

# models NAME...: those that are installed
models() {
    rm -rf plugins
    mkdir -p plugins/gauge
    for name; do cp "all/gauge/$name.so" plugins/gauge; done
    export FLANKFILM_PLUGIN_PATH="$lab/plugins"
}

# study NAME STAGE SWEEP AUDIT
study() {
    cat >"$1.yaml" <<YAML
format: 1
pipeline: {g: {$2}}
outputs: [g.answer, g.answers, g.t]
study: {$3 audit: $4}
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

says() {
    if ! grep -qF -- "$1" said; then
        echo "not ok: it did not say: $1"
        cat said
        exit 1
    fi
}

# number DIRECTORY OUTPUT FROM COLUMN VALUE: to 5 digits, in the first such row
number() {
    awk -F, -v output="$2" -v from="$3" -v column="$4" -v want="$5" '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == column) at = i; next }
        $2 == output && $3 == from && !done { done = 1; got = $at }
        END {
            off = got - want; off = off < 0 ? -off : off
            good = done && (want == "" ? got == "" : got != "" && off <= 1e-5 * want)
            print (good ? "ok: " : "not ok: ") output " from " from ": " column " " got ", not " want
            exit !good
        }' "$1/audit.csv"
}

# The same model, four times the cells: (1/13 - 1/52) / (1 + 1/52). The series has other points.
models fine
study fine 'use: gauge/auto, accuracy: 8 %' \
    'sweep: {g.level: {from: 1 mm, to: 4 mm, points: 41}},' '{every: 20}'
expect 0 'audit: 3 of 41 cases' "$flankfilm" run fine.yaml -j 1 -o fine
says '6 of 6 outputs within their promise'
says '41 of 41 cases done, 0 of them before'
number fine g.answer g promised 0.0769231
number fine g.answer g 'observed mean' 0.0566038
number fine g.answer g 'numerical mean' 0.0566038
number fine g.answers g 'numerical largest' 0.0566038
number fine g.answer g 'model form mean' ''
test "$(wc -l <fine/table.csv)" -eq 42
expect 0 '41 of 41 cases done, 41 of them before' "$flankfilm" run fine.yaml -j 2 -o fine
says '6 of 6 outputs within their promise'
expect 0 'audit: 3 of 41 cases' "$flankfilm" run fine.yaml -j 2 -o two
cmp fine/audit.csv two/audit.csv
cmp fine/audit.json two/audit.json
expect 0 '"times_promised"' "$flankfilm" run fine.yaml -o fine --json
first=$(cut -d, -f1 fine/audit.csv | sort -nu | tr '\n' ' ')
expect 0 'seed 2' "$flankfilm" run fine.yaml -o fine --set study.audit.seed=2
other=$(cut -d, -f1 fine/audit.csv | sort -nu | tr '\n' ' ')
test "$first" != "$other" || { echo "not ok: a seed changes nothing"; exit 1; }
expect 0 'the audit is made by a run in one process' \
    "$flankfilm" run fine.yaml -o parts --shard 1/2

# What the file says of the numerics gives way, too.
study held 'use: gauge/auto, accuracy: 8 %, cells: 13' '' '{}'
expect 0 'audit: 1 of 1 cases' "$flankfilm" run held.yaml -o held
number held g.answer g 'numerical mean' 0.0566038

# A model that is tuned and not chosen.
study tuned 'use: gauge/fine, accuracy: 8 %' '' '{}'
expect 0 '2 of 2 outputs within' "$flankfilm" run tuned.yaml -o tuned
number tuned g.answer g 'numerical mean' 0.0566038

# A model that is off for what it is, not for its cells: 1.05 against 1 + 1/67.
models fine coarse
study coarse 'use: gauge/auto, accuracy: 8 %' '' '{}'
expect 0 'gauge/coarse promises 6 %; finer: its counts twice as large' \
    "$flankfilm" run coarse.yaml -o coarse
says 'most exact: gauge/fine'
says '2 of 2 outputs within their promise'
number coarse g.answer g 'numerical mean' 0
number coarse g.answer g 'model form mean' 0.0345588
number coarse g.answer g 'observed mean' 0.0345588

# The choice is that of the study, which asks for more than is audited.
models fine shy
study narrow 'use: gauge/auto, accuracy: 8 %' '' '{outputs: [g.answer]}'
expect 0 'gauge/fine promises 7.69 %' "$flankfilm" run narrow.yaml -o narrow
says '1 of 1 outputs within their promise'

# A lie: 1.1 against 1 + 1/400. It is told, and is no failure.
models fine liar
study liar 'use: gauge/auto, accuracy: 2 %' '' '{}'
expect 0 'a defect of the model' "$flankfilm" run liar.yaml -o liar
says '0 of 2 outputs within their promise, 2 broken; the worst is g.answer'
number liar g.answer g promised 0.01
number liar g.answer g 'observed mean' 0.0972569

# Counts are doubled where a model proposes none: (1/10 - 1/20) / (1 + 1/20).
models plain
study plain 'use: gauge/auto, accuracy: 30 %' '' '{}'
expect 0 'twice as large, cells 20' "$flankfilm" run plain.yaml -o plain
number plain g.answer g 'numerical mean' 0.0476190

# Inputs: 3 % and twice 2 %, by the root of the sum of squares 5 %; 0.03 mm of 1 mm is the same.
models fine
study inputs 'use: gauge/auto, accuracy: 8 %, level: 1 mm, width: 1' '' \
    '{outputs: [g.answer], inputs: {g.level: 3 %, g.width: 0.02}}'
expect 0 'of inputs: g.level 36 %, g.width 64 %' "$flankfilm" run inputs.yaml -o inputs
number inputs g.answer g 'input uncertainty' 0.05
number inputs g.answer g.width 'input uncertainty' 0.04
expect 0 'g.level 36 %, g.width 64 %' "$flankfilm" run inputs.yaml -o inputs \
    --set 'study.audit.inputs={g.level: 0.03 mm, g.width: 2 %}'

# A case of a chain starts from where it did: of 1 mm after 4, 3 and 2 mm with half of what was there
# 3.25 mm are known, so that 3 % of 1 mm are 0.92 %. Alone it would differ from what the study has.
study chain 'use: gauge/auto, accuracy: 8 %, level: 1 mm, memory: 0.5' \
    'sweep: {g.level: {from: 1 mm, to: 4 mm, points: 4, follow: down}},' \
    '{every: 1, outputs: [g.answer], inputs: {g.level: 3 %}}'
expect 0 '4 of 4 outputs within their promise' "$flankfilm" run chain.yaml -j 2 -o chain
number chain g.answer g 'numerical mean' 0.0566038
number chain g.answer g.level 'input uncertainty' 0.00923077
expect 0 '4 of 4 cases done, 4 of them before' "$flankfilm" run chain.yaml -j 1 -o chain
says '4 of 4 outputs within their promise'

# An input of a stage that chooses nothing, and that the first case does not need.
cat >other.yaml <<YAML
format: 1
pipeline: {g: {use: gauge/auto, accuracy: 8 %}, h: {use: gauge/fine, level: 2 mm}}
study:
  sweep: {outputs: [[g.answer], [g.answer, h.answer]]}
  audit: {every: 1, inputs: {h.level: 2 %}}
YAML
expect 0 '2 of 2 outputs within their promise' "$flankfilm" run other.yaml -o other
number other h.answer h.level 'input uncertainty' 0.02
expect 0 'h.level: no audited case was varied in it' "$flankfilm" run other.yaml -o other \
    --set 'study.sweep.outputs=[[g.answer], [g.answers]]'

# An input that the chosen model has, and the stage does not say: (1 + 3 %)^2 - (1 - 3 %)^2 is 12 %.
study chosen 'use: gauge/auto, accuracy: 8 %, with: {gauge/fine: {width: 2}}' '' \
    '{outputs: [g.answer], inputs: {g.width: 3 %, g.spare: 1 m}}'
expect 0 'g.spare: no audited case was varied in it' "$flankfilm" run chosen.yaml -o chosen
number chosen g.answer g.width 'input uncertainty' 0.06

# An audited case that fails makes the study one with failed cases; one that failed before is told.
study fails 'use: gauge/auto, accuracy: 8 %, most: 40' '' '{}'
expect 4 'finer: ' "$flankfilm" run fails.yaml -o fails
says '52 cells are too many'
study failed 'use: gauge/auto, accuracy: 8 %, most: 5' '' '{}'
expect 4 'as it stands' "$flankfilm" run failed.yaml -o failed
says '1 of 1 cases done, 0 of them before; 1 failed'

# What is wrong is said before anything runs.
refuse() { # WORDS ASSIGNMENT
    expect 2 "$1" "$flankfilm" run fine.yaml -o none --set "$2"
    test ! -e none || { echo "not ok: it ran"; exit 1; }
}
study fixed 'use: gauge/fine' '' '{}'
expect 2 'no stage of this file chooses its model' "$flankfilm" run fixed.yaml
refuse 'audit.every: 0 is too small' study.audit.every=0
refuse 'unknown key "evry"; did you mean "every"?' study.audit.evry=3
refuse 'expected a map' study.audit=yes
refuse 'there is no such stage' 'study.audit.outputs=[h.answer]'
refuse 'wants names such as STAGE.OUTPUT' 'study.audit.outputs=[g.*]'
refuse 'did you mean "level"?' 'study.audit.inputs={g.levle: 2 %}'
refuse 'there is no stage "q"' 'study.audit.inputs={q.level: 2 %}'
refuse 'is a time; expected a length' 'study.audit.inputs={g.level: 2 s}'
refuse 'above 0' 'study.audit.inputs={g.level: -2 %}'
expect 2 'h.spare: it is not given as a number' "$flankfilm" run other.yaml \
    --set 'study.audit.inputs={h.spare: 2 %}' --set 'study.sweep.outputs=[[g.answer, h.answer]]'
refuse 'one real number' 'study.audit.inputs={g.cells: 2 %}'
refuse 'no parameter' 'study.audit.inputs={g: 2 %}'
refuse 'cannot choose "gauge/fien"; did you mean "gauge/fine"?' g.only=gauge/fien
refuse 'write two files' \
    'study={audit: {}, stability: {axes: {g.level: [1 mm, 2 mm]}, outputs: [g.answer]}}'
refuse 'no such output; did you mean "answer"?' 'study.audit.outputs=[g.anser]'
study star 'use: gauge/auto, accuracy: 8 %' '' '{}'
expect 4 'say which ones matter' "$flankfilm" run star.yaml -o star --set 'outputs=[g.*]'

# The file that ships, at a rough accuracy.
unset FLANKFILM_PLUGIN_PATH
expect 0 '4 of 4 outputs within their promise' "$flankfilm" run "$source/configs/auto.yaml" -o auto \
    --set 'study={audit: {inputs: {oil.eta0: 5 %}}}' --set 'accuracy=25 %'
says 'most exact: ehl/finite-volume'
