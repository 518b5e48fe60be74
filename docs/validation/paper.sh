#!/bin/sh
# Writes paper.md and its figures: those of Li & Kahraman 2011 by this program, and what agrees.
#   sh docs/validation/paper.sh build [FOLDER]
# FOLDER, for another place than docs/validation.
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
to=$(mkdir -p "${2:-$here}" && cd "${2:-$here}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export FLANKFILM_TEST_PLUGINS="$build/plugins"
export FLANKFILM_TEST_SOURCE="$here/../.."

run() { # NAME FILE [--set ...]
    name=$1 file=$2
    shift 2
    "$build/flankfilm" run "$file" -o "$work/$name" "$@" > "$work/$name.said" 2>&1 || {
        cat "$work/$name.said" >&2
        exit 1
    }
}

fields="film.film, film.pressure, film.x, film.roll_angle"
"$build/tests/plugins/viscosity/test-viscosity-card-fit" print mil-l-23699-100C.yaml |
    sed -n '/^p \[/,$p' > "$work/laws.csv"
run I "$here/paper.yaml"
run I-fields "$here/paper.yaml" --set "outputs=[$fields, film_static.film, film_static.pressure, film_static.x, film_static.roll_angle]"
run fine "$here/paper.yaml" --set film.cells=1024 --set film.steps=2000 --set 'outputs=[film.h_min, film.roll_angle]'
run II "$here/paper.yaml" --set duty.mesh_frequency='2085 Hz'
run III "$here/paper.yaml" --set duty.mesh_frequency='2375 Hz' --set motion.branch=upper
run III-fields "$here/paper.yaml" --set duty.mesh_frequency='2375 Hz' --set motion.branch=upper --set "outputs=[$fields]"
run atlas "$here/dynamics.yaml" --set mesh.use=stiffness/load-distribution --set motion.max_period=1
run flanks "$here/paper-rough.yaml" --set "outputs=[flanks.*]"
rough=0
"$build/flankfilm" models ehl/finite-volume > "$work/model"
if grep -q 'surface\.height_1' "$work/model"; then
    rough=1
    run rough "$here/paper-rough.yaml"
fi

awk -v in_="$work" -v fields=1 -v rough="$rough" -f "$here/csv.awk" -f "$here/paper.awk" -f "$here/paper-figures.awk" < /dev/null
for script in "$work"/*.plot; do
    awk -f "$here/plot.awk" "$script" > "$to/paper-$(basename "$script" .plot).svg"
done
awk -v in_="$work" -v fields=1 -v rough="$rough" -f "$here/csv.awk" -f "$here/paper.awk" -f "$here/paper-page.awk" < /dev/null > "$to/paper.md.new"
mv "$to/paper.md.new" "$to/paper.md"
