#!/bin/sh
# Writes benchmarks.md: numbers that are known from elsewhere, and those of the program beside them.
#   sh docs/validation/benchmarks.sh build [FOLDER]
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
to=$(mkdir -p "${2:-$here}" && cd "${2:-$here}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export FLANKFILM_TEST_PLUGINS="$build/plugins"
export FLANKFILM_TEST_SOURCE="$here/../.."

run() { # NAME [--set ...]
    name=$1
    shift
    "$build/flankfilm" run "$here/benchmarks.yaml" -o "$work/$name" "$@" > "$work/said" 2>&1 || {
        cat "$work/said" >&2
        exit 1
    }
    python3 "$here/tables.py" "$work/$name"
}

"$build/tests/plugins/viscosity/test-viscosity-card-fit" print mil-l-23699.yaml |
    sed -n '/^p \[/,$p' > "$work/laws.csv"
for speed in 1250 2085 2375; do
    for formula in moes dowson-higginson dowson-toyoda pan-hamrock; do
        run "$formula-$speed" --set duty.mesh_frequency="$speed Hz" --set film.formula="$formula"
    done
done
run iso --set 'gears.root_diameter=[142.8 mm, 142.8 mm]' --set 'outputs=[mesh.stiffness_mean]'
awk 'BEGIN {
    print "phase,stiffness [N/m]"
    for (i = 0; i <= 800; i++) {
        a = i / 400 * atan2(0, -1)
        printf "%.9g,%.12g\n", i / 800, 3.2581e8 - 7.45e7 * cos(a) - 4.65e7 * cos(2 * a) - 2.19e7 * cos(3 * a)
    }
}' > "$work/harmonics.csv"
for point in "1250 lower" "2085 lower" "2375 lower" "2375 upper" "3600 lower" "4000 lower"; do
    run "motion-${point% *}-${point#* }" --set duty.mesh_frequency="${point% *} Hz" \
        --set motion.branch="${point#* }" --set motion.max_period=1 --set mesh.use=stiffness/table \
        --set mesh.file="$work/harmonics.csv" --set mesh.interpolation=cubic --set motion.search_starts=0 \
        --set 'outputs=[motion.dte_rms, motion.dte_peak_to_peak, motion.dynamic_factor_mesh]'
done
for taken in all 0 1; do
    run "momentum-$taken" --set duty.mesh_frequency='6484 Hz' --set motion.damping=contact \
        --set mesh.use=stiffness/table --set mesh.file="$work/harmonics.csv" --set mesh.interpolation=cubic \
        --set static.load=motion --set static.engagement="$taken" \
        --set 'outputs=[motion.period, static.mesh_load_mean, duty.line_force]'
done
awk -v in_="$work" -f "$here/csv.awk" -f "$here/benchmarks.awk" < /dev/null > "$to/benchmarks.md.new"
mv "$to/benchmarks.md.new" "$to/benchmarks.md"
sh "$here/../made.sh" "$to/benchmarks.md" plugins/gear plugins/stiffness plugins/dynamics plugins/ehl
