#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What `explain` says of each choice, and by which number.   choices.sh FLANKFILM SOURCE_ROOT
set -eu
flankfilm=$(realpath "$1") source=$(realpath "$2")
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
failed=0

# tells STAGE CHOSEN PHRASE FILE [--set ...]: the stage's model, and words beside one of its candidates
tells() {
    stage=$1 chosen=$2 phrase=$3
    shift 3
    COLUMNS=100 "$flankfilm" explain "$@" 2>&1 |
        awk -v stage="$stage:" '/^[a-z_]+: /{on = $1 == stage} on' | tr '\n' ' ' | tr -s ' ' >"$lab/said"
    if grep -qF "$stage: $chosen" "$lab/said" && grep -qF -e "$phrase" "$lab/said"; then
        echo "ok   $stage is $chosen: $phrase"
    else
        echo "FAIL $stage is not $chosen, or without: $phrase"
        cut -c1-1500 "$lab/said"
        failed=$((failed + 1))
    fi
}

cat >"$lab/discs.yaml" <<EOF
format: 2
include: [$source/configs/lubricants/mil-l-23699.yaml]
pipeline:
  oil: {temperature: 100 degC}
  discs: {use: contact/constant, radius: 20 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0.01, load_per_width: 100 N/mm}
  viscosity:   {use: viscosity/auto}
  density:   {use: density/auto}
  flow:  {use: rheology/auto}
  film:  {use: ehl/auto, accuracy: 5 %}
outputs: [film.h_min_lowest]
EOF
discs="$lab/discs.yaml"
soft="--set discs.reduced_modulus=0.05GPa --set discs.load_per_width=0.5N/mm"
gears="$source/configs/auto.yaml --set mesh.use=stiffness/iso-6336"

# isoviscous or piezoviscous
tells viscosity viscosity/doolittle-tait "L 5.7: elastic, piezoviscous; eta up to exp(0) of eta0" "$discs"
# shellcheck disable=SC2086
tells viscosity viscosity/isoviscous "elastic, isoviscous; eta up to exp(0) of eta0" "$discs" $soft
# incompressible or not
tells density density/dowson-higginson "denser by 0 % at 0.4" "$discs" --set 'outputs=[film.h_central]'
# shellcheck disable=SC2086
tells density density/incompressible "moves the film by" "$discs" $soft
# Newtonian or Eyring: by the shear stress, and by what is asked for
tells flow rheology/newtonian "by the reference" "$discs"
tells flow rheology/ree-eyring "MPa, by the reference" "$discs" --set 'outputs=[film.friction_coefficient]' \
    --set discs.slide_roll_ratio=0.3 --set film.accuracy='30 %'
# rigid or elastic
tells film ehl/film-formula "rigid, isoviscous; steady" "$discs" --set viscosity.use=viscosity/isoviscous \
    --set discs.load_per_width=0.5N/mm
tells film ehl/finite-volume "elastic, isoviscous; steady" "$discs" --set viscosity.use=viscosity/isoviscous
# steady or transient
# shellcheck disable=SC2086
tells film ehl/finite-volume "a film that is steady at every instant misses" $gears
# smooth or mixed
rough="--set rough.use=surface/synthetic --set film.accuracy=60%"
# shellcheck disable=SC2086
tells film ehl/film-formula "smooth enough but for the roughness" $gears $rough --set 'rough.rq=[10 nm, 10 nm]'
# shellcheck disable=SC2086
tells film ehl/finite-volume "roughness ignored proposed" $gears $rough --set film.use=ehl/finite-volume \
    --set 'rough.rq=[10 nm, 10 nm]'
# shellcheck disable=SC2086
tells film ehl/auto "lambda 0.2: mixed" $gears $rough --set 'rough.rq=[0.5 um, 0.5 um]'
# quasi-static or dynamic
tells motion dynamics/quasi-static "of the natural frequency: a linear pair leaves" "$source/configs/auto.yaml" \
    --set mesh.use=stiffness/table --set 'mesh.phase=[0, 0.25, 0.5, 0.75, 1]' --set mesh.interpolation=cubic \
    --set 'mesh.stiffness=[300 MN/m, 310 MN/m, 300 MN/m, 290 MN/m, 300 MN/m]' \
    --set duty.mesh_frequency='20 Hz' --set 'outputs=[motion.dte_rms]'
# of what frequency: the one that the motion then has
sed -e 's/, natural_frequency: [^,}]*//' -e "s|^include: \[|&$source/configs/|; s|, lubricants/|, $source/configs/lubricants/|" \
    "$source/configs/auto.yaml" >"$lab/gears.yaml"
frequency=$("$flankfilm" run "$lab/gears.yaml" --json --set mesh.use=stiffness/iso-6336 --set motion.use=dynamics/quasi-static \
    --set 'outputs=[motion.natural_frequency]' | sed 's/.*natural_frequency[^}]*"value":\([^,]*\),.*/\1/')
tells motion dynamics/ "mesh at $(awk -v f="$frequency" 'BEGIN { printf "%.3g", 1250 / f }') of the natural" \
    "$lab/gears.yaml" --set mesh.use=stiffness/iso-6336
# linear or with contact loss
# shellcheck disable=SC2086
tells motion dynamics/shooting "linear: the flanks never part" $gears
# shellcheck disable=SC2086
tells motion dynamics/shooting "non-linear: the flanks part" $gears --set duty.mesh_frequency='3000 Hz'

echo "$failed failed"
[ $failed -eq 0 ]
