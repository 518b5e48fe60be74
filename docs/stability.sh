#!/bin/sh
# Runs the shipped maps in full and writes docs/stability.md with its figures: nothing there is typed
# by hand. Ten minutes on two cores; run again, it goes on where it stopped.
#   sh docs/stability.sh build/flankfilm [DIRECTORY_OF_RESULTS]
set -eu
program=$(realpath "${1:-build/flankfilm}")
here=$(cd "$(dirname "$0")" && pwd)
results=${2:-results/stability}
mkdir -p "$results" "$here/stability"
results=$(realpath "$results")
page=$here/stability.md
limit='600 s'
cd "$here/.."

cat >"$page" <<PAGE
# Where the numbers can be trusted

Maps of \`configs/studies/stability-*.yaml\`, computed in full by \`docs/stability.sh\` on $(date -u +%Y-%m-%d), flankfilm $("$program" --version | sed 's/flankfilm //'),
$(uname -m). The [guide](guide/accuracy.md#where-can-it-be-trusted) explains the verdicts and says how to draw such a
map for your own pipeline. The table counts cells with each verdict; cells added by halving the distance between
cells of the grid ("between") count, too. In a *silent* cell all quality lines are good although a twin differs by
more than three times the printed estimate. The last column is the largest such difference, divided by the
estimate. A case could take $limit, more than the files allow, so that none failed because of other work on the
machine. Below each map stand the quality lines that decide its verdicts, with the number of cells and one value as
an example.

| map | cells | converged | outside | physical | unchecked | degraded | silent | failed | refused | worst difference over estimate |
|---|---|---|---|---|---|---|---|---|---|---|
PAGE
: >"$results/maps.md"

# map NAME TITLE STUDY [OPTION...]
map() {
    name=$1 title=$2 study=$3
    shift 3
    code=0
    "$program" run "configs/studies/$study.yaml" --set "study.time_limit=$limit" -o "$results/$name" "$@" >"$results/$name.txt" || code=$?
    if [ "$code" -ne 0 ] && [ "$code" -ne 4 ]; then
        echo "the map $name ended with $code" >&2
        exit 1
    fi
    sh "$here/draw.sh" "$program" "$results/$name/map.figure.json" "$here/stability/$name.svg"
    awk -F, -v title="[$title](#$name)" '
        NR == 1 { for (i = 1; i <= NF; i++) if (!($i in at)) at[$i] = i; next }
        { count[$at["verdict"]]++; cells++ }
        $at["verdict"] ~ /converged|outside|physical|silent/ && $at["estimate"] != "" {
            ratio = $at["difference"] / ($at["estimate"] + 1e-9); if (ratio > worst) worst = ratio }
        END { printf "| %s | %d |", title, cells
              n = split("converged outside physical unchecked degraded silent failed refused", word, " ")
              for (i = 1; i <= n; i++) printf " %d |", count[word[i]]
              printf " %.2g |\n", worst }' "$results/$name/map.csv" >>"$page"
    {
        printf '\n<a id="%s"></a>\n## %s\n\n`flankfilm run configs/studies/%s.yaml' "$name" "$title" "$study"
        for word; do
            printf ' %s' "$word"
        done
        printf '`\n\n![map](stability/%s.svg)\n\n```text\n' "$name"
        sed -e '/^boundaries/,$d' -e '/^[0-9]* cases done/d' -e '/^results in/d' -e '/^stages: /d' -e '/^as a page /d' -e '/^removed, /d' -e 's/ *$//' \
            -e '/^across: /d' -e '/ | [.odpF!?x]/d' -e '/^ *[^ ].* \.\.\. /d' -e '/^  [a-z_]*\.[a-z_]*: /d' \
            -e "s/^\\(  [.odpF'] [0-9][^:]*\\): .*/\\1/" -e '/^  no silent failure/d' -e '/^  \. /d' -e '/): at time /d' "$results/$name.txt" | sed '/./!d' |
            awk '/^      [^ ]+ [(]/ { key = $0; sub(/ at time.*/, "", key); if (seen[key]++) next } { print }'
        printf '```\n'
    } >>"$results/maps.md"
}

map film 'Film of a line contact, finite volumes' stability-film
map film-control-volume 'Film, control volumes' stability-film --set film.use=ehl/control-volume
map film-dense-newton 'Film, dense Newton' stability-film --set film.use=ehl/dense-newton --set film.cells=256
map film-inlet-analysis 'Film, inlet analysis' stability-film --set film.use=ehl/inlet-analysis
map film-formula 'Film, formula' stability-film --set film.use=ehl/film-formula
map rheology 'Four viscosity laws' stability-rheology
map alpha 'Pressure coefficient of Barus' stability-alpha
map motion 'Motion, time integration' stability-dynamics
map motion-shooting 'Motion, shooting' stability-dynamics --set motion.use=dynamics/shooting
map motion-harmonic-balance 'Motion, harmonic balance' stability-dynamics --set motion.use=dynamics/harmonic-balance
map cycle 'Cells and steps of a mesh cycle' stability-cycle
map gear 'From torque to film' stability-gear
map rough 'Roughness and speed' stability-rough

cat "$results/maps.md" >>"$page"
sh "$here/made.sh" "$page" plugins/ehl plugins/dynamics core/program/study/kinds/stability
