#!/bin/sh
# The page of a trade-off shows its figure, and names cases by what they set.
#   report.sh FLANKFILM TOY_ROOT
set -eu
flankfilm=$(realpath "$1")
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
mkdir -p "$lab/plugins/toy"
ln -s "$(realpath "$2")" "$lab/plugins/toy/root.so"
export FLANKFILM_PLUGIN_PATH="$lab/plugins"
cd "$lab"
cat >study.yaml <<YAML
format: 2
pipeline: {root: {use: toy/root}}
outputs: [root.value]
study:
  tradeoff:
    outputs: [root.value]
    accuracy: 1e-2
    reference: {root.n: 100, refine: [root.n], refinements: 5}
    candidates: [{root.n: [2, 4]}, {root.claim: 2}, {root.blind: 8}]
    repeats: 1
YAML
"$flankfilm" run study.yaml -o out >said
"$flankfilm" report out >said
grep -q 'error against cost' out/report.html
grep -q '<p class="judgement"><span class="badge good">good</span> Of 6 cases 6 are good, ' out/report.html # levels that were not needed are none
grep -q '"summary": "the front"' out/report.html
grep -q '"summary": "all candidates"' out/report.html
grep -q 'reference 1, n 200<' out/report.html
if grep ', ,\|, <' out/report.html; then exit 1; fi
if grep '"label":"case"' out/report.html; then exit 1; fi # no figure over the numbers of cases
[ "$(grep -c . out/table.csv)" -eq 7 ]
echo "ok: the page of a trade-off"
