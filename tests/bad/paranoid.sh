#!/bin/sh
# `flankfilm run --paranoid` finds a plugin's breach in a real run and names the plugin; a healthy run
# gives the same numbers with it.   paranoid.sh FLANKFILM BAD_PLUGINS SOURCE_ROOT
set -u
flankfilm=$1 plugins=$2 source=$3
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
failed=0
export ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0" # what a faulty plugin holds is left alone

cat >"$lab/film.yaml" <<'END'
format: 1
pipeline:
  oil: {use: viscosity/none, alpha: 11 1/GPa}
  rho: {use: density/none}
  discs: {use: contact/constant, radius: 12.8 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0.1, load_per_width: 17 N/mm}
  film: {use: ehl/finite-volume, cells: 128}
outputs: [film.h_min]
END
cat >"$lab/stage.yaml" <<'END'
format: 1
pipeline:
  front: {use: faulty/none}
  stage: {use: faulty/none, source: front}
outputs: [stage.*]
END

# FILE STAGE MODEL REASON
finds() {
    said=$("$flankfilm" run "$lab/$1.yaml" --plugin-path "$plugins" --set "$2.use=$3" --paranoid --json 2>&1)
    code=$?
    case $code:$said in "3:"*"$3.so "*"$4"*) return ;; esac
    echo "$3: wanted \"$4\", exit code $code: $said" | cut -c1-600
    failed=$((failed + 1))
}
finds film oil viscosity/derivative 'but differences of ln_eta give'
finds film oil viscosity/nan 'gave ln_eta = nan in eval at p = 0'
finds film oil viscosity/past 'wrote outside the array \"ln_eta\"'
finds film oil viscosity/input 'changed the argument \"p\" of eval'
finds film oil viscosity/status 'gave the status 2 in eval'
finds film oil viscosity/locale 'changed the locale during create'
finds film oil viscosity/signal 'changed a signal handler during create'
finds film oil viscosity/folder 'changed the working directory during create'
finds film rho density/slope 'but differences of rho give'
finds stage stage faulty/rounding 'changed the rounding mode during evaluate'
finds stage stage faulty/locale 'changed the locale during evaluate'
finds stage stage faulty/past 'wrote outside the array of the output \"series\"'
finds stage stage faulty/input 'changed its input \"source.series\"'
finds stage stage faulty/nan 'gave no number (NaN)'
finds stage stage faulty/missing 'did not give the output'

for option in --json --paranoid; do
    "$flankfilm" run "$source/configs/line-contact.yaml" --set film.cells=128 --set 'outputs=[film.*]' \
        --json $option | sed 's/"seconds":[^,]*,//g' >"$lab/result$option"
    grep -q '"status": *"ok"' "$lab/result$option" || failed=$((failed + 1))
done
cmp "$lab/result--json" "$lab/result--paranoid" || failed=$((failed + 1))
# a model and laws that are chosen are opened anew
"$flankfilm" run "$source/configs/auto.yaml" --set accuracy='25 %' --set mesh.use=stiffness/iso-6336 \
    --paranoid --json >"$lab/chosen" || failed=$((failed + 1))
echo "$failed failed"
[ $failed -eq 0 ]
