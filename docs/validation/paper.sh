#!/bin/sh
# Writes paper.md and its figures: those of Li & Kahraman 2011 by this program, and what agrees.
#   sh docs/validation/paper.sh build [FOLDER [quick]]
# FOLDER, for another place than docs/validation; quick leaves out the finer surface and the last part,
# rough flanks at all points.
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
to=$(mkdir -p "${2:-$here}" && cd "${2:-$here}" && pwd)
quick=$([ "${3:-}" = quick ] && echo 1 || echo 0)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export FLANKFILM_TEST_PLUGINS="$build/plugins"
export FLANKFILM_TEST_SOURCE="$here/../.."

. "$here/field.sh"
run() { # NAME FILE [--set ...]
    name=$1 file=$2
    shift 2
    "$build/flankfilm" run "$file" -o "$work/$name" "$@" > "$work/$name.said" 2>&1 || {
        cat "$work/$name.said" >&2
        exit 1
    }
    python3 "$here/tables.py" "$work/$name"
}
at() { # POINT NAME FILE [--set ...]
    case $1 in
    I) speed='1250 Hz' branch=lower ;;
    II) speed='2085 Hz' branch=lower ;;
    III) speed='2375 Hz' branch=upper ;;
    esac
    shift
    run "$@" --set duty.mesh_frequency="$speed" --set motion.branch="$branch"
}
digest() { # AWK-FILE ...; with what all of them share
    for file; do shift; set -- "$@" -f "$here/$file"; done
    awk -v in_="$work" -v quick="$quick" -v seeds="$seeds" -v stage="$stage" -v parts_of_k="$parts" -f "$here/csv.awk" -f "$here/paper.awk" "$@" < /dev/null
}
fields() { # NAME POSITIONS: rows of its fields, at the angles that go by the name POSITIONS
    for npy in "$work/$1"/film*.film.npy "$work/$1"/film*.pressure.npy; do
        [ -e "$npy" ] || continue
        npy=${npy##*/}
        stage=${npy%%.*} output=${npy#*.}
        field "$work/$1" "$stage" "${output%.npy}" "$work/positions" "$2"
    done
}
seeds="2011 2012 2013 2014 2015 2016 2017 2018" # of the surfaces; the first one is drawn
fields="film.film, film.pressure, film.x, film.roll_angle"
static="film_static.film, film_static.pressure, film_static.x, film_static.roll_angle"
rough="film.h_min, film.p_max, film.contact_ratio, film.asperity_load_share, film.yield_share, film.lambda_ratio, film.friction_coefficient"

"$build/tests/plugins/viscosity/test-viscosity-card-fit" print mil-l-23699.yaml |
    sed -n '/^p \[/,$p' > "$work/laws.csv"
for point in I II III; do
    at $point $point "$here/paper.yaml"
    at $point $point-slope "$here/paper.yaml" --set mesh.definition=tangent --set 'outputs=[mesh.stiffness_mean, motion.dte_rms]'
    at $point $point-fields "$here/paper.yaml" --set "outputs=[$fields, $static]"
done
at I fine "$here/paper.yaml" --set film.cells=1024 --set film.steps=2000 --set 'outputs=[film.h_min, film.roll_angle]'
at I coarse "$here/paper.yaml" --set film_static.steps=125 --set 'outputs=[film_static.h_min, film_static.roll_angle]'
at I step "$here/paper.yaml" --set static.load_ramp='0 deg' --set tooth.load_ramp='0 deg' \
    --set "outputs=[film.pressure, film.x, film.roll_angle, film_static.pressure, film_static.x, film_static.roll_angle]"
run atlas "$here/dynamics.yaml" --set mesh.use=stiffness/load-distribution --set mesh.definition=secant --set motion.max_period=1
run atlas-slope "$here/dynamics.yaml" --set mesh.use=stiffness/load-distribution --set mesh.definition=tangent --set motion.max_period=1
# harmonics 1 to 3 of this k(t), whole and in parts of their size
parts="1 0.5 0.35 0.25 0.15"
for part in $parts; do
    awk -v part=$part -v in_="$work" -f "$here/csv.awk" -f "$here/paper-harmonics.awk" > "$work/k-$part.csv"
    run "k-$part" "$here/dynamics.yaml" --set motion.max_period=1 \
        --set "mesh={use: stiffness/table, file: $work/k-$part.csv}"
done
run flanks "$here/paper-rough.yaml" --set "outputs=[flanks.*]"

stage=smooth digest paper-positions.awk > "$work/positions"
for point in I II III; do fields $point-fields $point; done
fields step step
for point in I II III; do
    [ $quick = 0 ] || [ $point = I ] || continue
    for seed in $seeds; do
        name=rough-$point-$seed
        if [ $quick = 1 ]; then
            at $point "$name" "$here/paper-rough.yaml" --set flanks.seed="$seed" \
                --set "outputs=[$fields, $rough]"
        else
            at $point "$name" "$here/paper-rough.yaml" --set flanks.seed="$seed"
        fi
        fields "$name" $point
        rm -f "$work/$name"/*.npy
    done
done
[ $quick = 1 ] || at I finer "$here/paper-rough.yaml" --set flanks.shortest='5 um' --set film.cells=1024 \
    --set 'outputs=[film.roll_angle, film.contact_ratio, film.p_max]'

stage=all digest paper-figures.awk
set --
for script in "$work"/*.plot; do
    awk -f "$here/plot.awk" "$script" > "$script.json"
    set -- "$@" "$script.json" "$to/paper-$(basename "$script" .plot).svg"
done
sh "$here/../draw.sh" "$build/flankfilm" "$@"
stage=all digest paper-page.awk paper-rough.awk > "$to/paper.md.new"
mv "$to/paper.md.new" "$to/paper.md"
sh "$here/../made.sh" "$to/paper.md" plugins/stiffness plugins/dynamics plugins/contact plugins/ehl
