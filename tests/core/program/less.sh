#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Asking for less costs less: instructions of a run for one number of the motion, for the film as
# well, and for everything, counted by callgrind, which no load of the machine changes.
set -eu

flankfilm=$(realpath "$1")
source=$(realpath "$2")
command -v valgrind >/dev/null || { echo "needs valgrind" && exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/pair.yaml" <<END
format: 2
include: [$source/configs/gears/unity-50.yaml, $source/configs/lubricants/mil-l-23699.yaml]
pipeline:
  duty:        {use: operating/steady, torque: 250 N m, mesh_frequency: 1250 Hz, oil_temperature: 100 degC}
  mesh:        {use: stiffness/iso-6336}
  motion:      {use: dynamics/shooting, damping_ratio: 0.01, natural_frequency: 3242 Hz}
  static:      {use: contact/tooth-pair, load: mesh}
  tooth:       {use: contact/tooth-pair, load: motion}
  film_static: {use: ehl/finite-volume, contact: static, cells: 128, steps: 100}
  film:        {use: ehl/finite-volume, contact: tooth, cells: 128, steps: 100}
END

count()
{
    OPENBLAS_NUM_THREADS=1 valgrind --tool=callgrind --callgrind-out-file=/dev/null \
        "$flankfilm" run "$work/pair.yaml" --json --set outputs="$1" 2>"$work/said" >/dev/null ||
        { cat "$work/said"; exit 1; }
    sed -n 's/.*Collected : *\([0-9]*\).*/\1/p' "$work/said"
}

motion=$(count '[motion.dte_rms]')
film=$(count '[film.h_min]')
# all but the atlas of motions, which takes a hundred times as much as the rest
all=$(count '[gears.*, duty.*, mesh.*, motion.dte, motion.dte_rms, motion.mesh_force, motion.tooth_force,
              motion.multipliers, static.*, tooth.*, film_static.*, film_static.film,
              film_static.pressure, film.*, film.film, film.pressure]')
echo "motion.dte_rms $motion, film.h_min $film, everything $all instructions"
awk -v m="$motion" -v f="$film" -v a="$all" \
    'BEGIN { printf "1 : %.1f : %.1f\n", f / m, a / m; exit !(m > 0 && f > 1.5 * m && a > 1.5 * f) }'
