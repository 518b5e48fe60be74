#!/bin/sh
# Writes two-way.md: what the film does to the gears, where the power goes, and where oil ends a branch.
#   sh docs/validation/two-way.sh build
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
configs=$(realpath "$here/../../configs")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

run()
{
    file=$1
    shift
    "$build/flankfilm" run "$file" "$@" --json > "$work/run.json" 2> "$work/errors" || {
        cat "$work/errors" >&2
        exit 1
    }
}

# A scalar of the outputs of the last run, times a factor.
value()
{
    grep -o "\"$1\":{\"unit\":[^}]*}" "$work/run.json" | head -n 1 | sed -n 's/.*"value":\([^,}]*\).*/\1/p' |
        awk -v f="${2:-1}" -v as="${3:-%.4g}" '{ printf as, f * $1 }'
}

# A line of quality.
line()
{
    grep -o "\"$1\":{\"value\":[^,]*" "$work/run.json" | head -n 1 | sed 's/.*://'
}

off="--set motion.friction=false --set motion.rolling=false --set motion.compliance=false"

point()
{
    case $1 in
    I) echo 'duty.mesh_frequency=1250 Hz' ;;
    II) echo 'duty.mesh_frequency=2085 Hz' ;;
    III) echo 'duty.mesh_frequency=2375 Hz' ;;
    esac
}

branch()
{
    [ "$1" = III ] && echo upper || echo lower
}

row()
{
    name=$1
    at=$2
    shift 2
    run "$configs/two-way.yaml" --set "$(point "$at")" --set motion.branch="$(branch "$at")" "$@"
    echo "| $at | $name | $(value motion.dte_rms 1e6 %.4f) | $(value motion.contact_loss 1 %.4f) |" \
        "$(value motion.dynamic_factor_tooth 1 %.4f) | $(value film.h_min_lowest 1e6 %.4f) |" \
        "$(value film.p_max_highest 1e-6 %.1f) | $(value loss.power_loss_mean 1 %.2f) | $(line feedback_rounds | sed 's/\.0$//') |"
}

both()
{
    echo '| point | acts | dte rms, um | apart | largest tooth force over quasi-static | lowest film, um | highest pressure, MPa | loss, W | rounds |'
    echo '|---|---|---|---|---|---|---|---|---|'
    for at in I II III; do
        # shellcheck disable=SC2086
        row nothing $at $off
        row friction $at --set motion.rolling=false --set motion.compliance=false
        row rolling $at --set motion.friction=false --set motion.compliance=false
        row thickness $at --set motion.friction=false --set motion.rolling=false
        row 'all three' $at
        cp "$work/run.json" "$work/$at.json"
    done
    row 'all three and squeeze in flight' III --set motion.squeeze=series
    cp "$work/run.json" "$work/III, squeeze in flight.json"
}

books()
{
    echo '| point | torques | k(t) and e(t) | sliding | rolling | squeeze | vibration | damper | (input - output)/loss |'
    echo '|---|---|---|---|---|---|---|---|---|'
    for at in I II III 'III, squeeze in flight'; do
        cp "$work/$at.json" "$work/run.json"
        set -- "$(value motion.torque_power 1 %.6g)" "$(value motion.excitation_power 1 %.6g)" \
            "$(value loss.sliding_loss_mean 1 %.6g)" "$(value loss.rolling_loss_mean 1 %.6g)" \
            "$(value loss.squeeze_loss_mean 1 %.6g)" "$(value motion.friction_work 1 %.6g)" \
            "$(value motion.damper_loss 1 %.6g)"
        echo "$@" | awk -v at="$at" '{
            off = ($1 + $2 - $3 - $4 - $5 - $6 - $7) / ($3 + $4 + $5)
            printf "| %s | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.1e |\n", at, $1, $2, $3, $4, $5, $6, $7, off }'
    done
}

# The books at III with squeeze in flight, of finer films.
refined()
{
    echo '| domain in half widths | cells | steps | wedge in flight | squeeze, W | (input - output)/loss | rounds |'
    echo '|---|---|---|---|---|---|---|'
    while read -r domain cells steps wedge; do
        set -- --set film.cells="$cells" --set film.steps="$steps"
        [ "$domain" = fitted ] || set -- "$@" --set film.inlet="$domain" --set film.outlet="$domain"
        [ "$wedge" = no ] || set -- "$@" --set motion.squeeze_rolling=true
        run "$configs/two-way.yaml" --set "$(point III)" --set motion.branch=upper --set motion.squeeze=series "$@"
        echo "| $domain | $cells | $steps | $wedge | $(value loss.squeeze_loss_mean 1 %.3f) | $(line power_balance | awk '{ printf "%.1e", $1 }') |" \
            "$(line feedback_rounds | sed 's/\.0$//') |"
    done <<'FILMS'
fitted 512 1000 no
fitted 512 1000 yes
16 2048 1000 no
16 2048 1000 yes
16 4096 1000 yes
16 2048 2000 yes
32 4096 2000 yes
FILMS
}

# The stiffness of the small-step model: three harmonics, scaled by 0.214.
awk 'BEGIN {
    print "phase; stiffness [N/m]"
    for (i = 0; i <= 200; i++) {
        x = 2 * atan2(0, -1) * i / 200
        printf "%.4f; %.9g\n", i / 200, 3.2581e8 * (1 - 0.214 * (0.2287 * cos(x) + 0.1427 * cos(2 * x) + 0.0672 * cos(3 * x)))
    } }' > "$work/stiffness.csv"

# The end of the branch one way: the fold of the atlas.
fold()
{
    # shellcheck disable=SC2086
    run "$here/two-way.yaml" --set mesh.file="$work/stiffness.csv" $off --set outputs=[motion.fold_frequency] "$@"
    grep -o '"motion.fold_frequency":{[^}]*}' "$work/run.json" | sed -n 's/.*"data":\[\([^]]*\)\].*/\1/p' | tr ',' '\n' |
        sort -g | tail -n 1 | awk '{ printf "%.1f", $1 }'
}

# The end both ways: the lowest of the speeds $1 at which flanks still part.
last()
{
    speeds=$1
    shift
    end="not found"
    for speed in $speeds; do
        "$build/flankfilm" run "$here/two-way.yaml" --set mesh.file="$work/stiffness.csv" \
            --set duty.mesh_frequency="$speed Hz" --set film.cells=256 --set film.steps=500 \
            --set feedback.rounds=30 --set outputs=[motion.contact_loss] "$@" --json > "$work/run.json" 2> "$work/errors" || {
            end="$end; the loop does not settle at $speed"
            break
        }
        [ "$(value motion.contact_loss 1 %.3f)" = 0.000 ] && break
        end="$speed Hz"
    done
    echo "$end"
}

# The small-step model and its repetition, a test: speeds at which the sweep loses the branch.
small()
{
    echo '| oil between parted flanks | film at hand-over | in series, test | in series, original | parallel, test | parallel, original |'
    echo '|---|---|---|---|---|---|'
    "$build/tests/plugins/dynamics/test-dynamics-branch-ends" 400 2000 | awk '/lost at/ {
            key = $2 " mPa s | " ($0 ~ /side by side/ ? $9 : $8) " um"
            match($0, /Hz: [0-9]+, expected [0-9]+/)
            split(substr($0, RSTART + 4, RLENGTH - 4), n, ", expected ")
            if (!(key in seen)) order[++count] = key
            seen[key]
            cell[key, $0 ~ /side by side/] = n[1] " Hz | " n[2] " Hz"
        }
        END {
            for (i = 1; i <= count; i++)
                print "| " order[i] " | " cell[order[i], 0] " | " ((order[i], 1) in cell ? cell[order[i], 1] : "the same |") " |"
        }' | sed 's/| 0 mPa s | 0.2 um |/| none | |/'
}

ends()
{
    echo '| oil between parted flanks | small-step model, swept down | no film wired back: fold | both ways: lowest speed with parted flanks |'
    echo '|---|---|---|---|'
    echo "| none | 1930 Hz | $(fold --set motion.squeeze=none) Hz | $(last "2200 2150 2125 2100 2050" --set motion.squeeze=none) |"
    echo "| 5.006 mPa s, in series | 2000 Hz | $(fold --set motion.squeeze=series) Hz | $(last "2200 2150 2125 2100 2050" --set motion.squeeze=series) |"
    set -- --set oil.file= --set oil.eta0='27.7 mPa s' --set oil.at='100 degC' --set oil.density='917.75 kg/m3'
    echo "| 27.7 mPa s, in series | 2290 Hz | $(fold --set motion.squeeze=series --set duty.mesh_frequency="2500 Hz" --set motion.atlas.to="2600 Hz" "$@") Hz | $(last "2900 2800 2700 2650 2600 2550" --set motion.squeeze=series "$@") |"
}

{
    cat <<'TEXT'
# Motion and film, both ways

Written by

```sh
sh docs/validation/two-way.sh build
```

## What the film does to the gears

The pair of Li & Kahraman 2011 at the paper's three operating points (`configs/two-way.yaml`, 512 cells, 1000 steps).
The film acts on the motion by friction and rolling resistance, which are torques on both gears, and by the thickness of
the loaded film in series with the teeth
([theory](../theory.md#motion-and-film-both-ways)). "films" counts the rounds until the feedback changes by less than 1e-4; without any effect, the second round is not computed.

TEXT
    both
    cat <<'TEXT'

All three together change the vibration by less than 1 % at these points, and the film by less, so the motion may be
computed without its film there. "Squeeze in flight" is oil between separated flanks (`squeeze: series`); it adds a
little at point III.

## Where the power goes

Powers in W. Input are the torques at the mean speeds of the gears, and the prescribed changes of stiffness k(t) and
transmission error e(t). Output are sliding, rolling and squeeze losses of the films, the power that friction takes from the
vibration, and the damper. The last column is the difference, divided by the loss of the films:

TEXT
    books
    cat <<'TEXT'

If contact is kept, the balance closes to less than 5e-4 of the loss, which is the film's own error (its `energy_balance`
and `power_loss_space_error`). If flanks separate, a motion without a film during contact loss supplies less power than the
film takes; the quality line `power_balance` shows this. With `squeeze: series` the flanks land at the same time in the film and in the motion, since both squeeze the oil with the same force;
the squeeze loss that the motion already contains is not counted twice. At point III the remaining difference is above 1e-3.
This difference has two main causes: the computed domain suits loaded flanks and is too short for all the oil that is
squeezed in a gap of some micrometres; and during contact loss the film includes the wedge of the rolling flanks, which the
motion includes only with `squeeze_rolling` ("wedge in flight"). The table varies both at point III:

TEXT
    refined
    cat <<'TEXT'

The remainder with the finest cells, 1.1e-3 to 1.3e-3, is known term by term (16 half widths, 1000 steps, the wedge during contact loss). At
the start of active profile, where k(t) jumps, the film begins loaded. The film then has less elastic energy than the
Hertzian contact that `separation` assumes, and its compressed oil releases energy that was never put in. The error due to the cells falls with the square of their number:

TEXT
    python3 "$here/two-way-books.py" "$build/flankfilm" "$configs/two-way.yaml"
    cat <<'TEXT'

For a tolerance of 1e-4, the loop takes two to four rounds at I and II, and up to six at III: from the third round on,
the change of `separation` of landing flanks falls to a seventh in each round. Anderson's method with one past round was
tried and left out: it saves two of seven rounds with the wedge in flight, otherwise none.

## Where oil ends the branch of parted flanks

If the stiffness varies little over the mesh cycle (first harmonic over mean k1/k = 0.049), the branch with separated flanks
ends at a fold when the speed falls. An earlier study used a model with small fixed time steps, one pair of constant radius
and a sweep down in steps of 10 Hz to find how far oil shifts this end, for oil in series with the tooth and for oil parallel
to it (the teeth are rigid until the film is `handover_film` thick). A test repeats the study
(`build/tests/plugins/dynamics/test-dynamics-branch-ends 400 2000`). The table gives the first speed at which flanks no
longer separate, by the test and by the original study:

TEXT
    small
    cat <<'TEXT'

Rigid teeth overestimate the effect of the oil, since a real tooth bends before the gap closes; the program therefore does
not offer the parallel arrangement. In series, half the `handover_film` shifts the end by less than a step of 10 Hz. With the
same single pair, `dynamics/shooting` finds the folds at 1935.9, 2007.8 and 2292.2 Hz, 2 to 4 Hz from the speeds at which the
sweep loses the branch, and the model with fixed steps reproduces its motions to 1e-5 (`meson test branch-ends`). With two
pairs:

TEXT
    ends
    cat <<'TEXT'

Without a film wired back, the folds are 2 and 11 Hz above those of the single pair, since here the radii vary along the path of contact and two pairs share the oil. With the film wired back,
squeezing the loaded film takes power from the vibration: at point III 7 % of the power of the damper, 9 % with squeeze in flight (`film_power` and `damper_loss`).
The branch therefore ends at a higher speed. Near this end the fixed films of an atlas are not reliable (`atlas_films`), so
the last column comes from separate runs at speeds 25 to 100 Hz apart, each starting on the branch `upper`, with 256 cells, 500 steps and at most 30 rounds.

[Oil between parted flanks](rattle.md) shows this end over viscosity, load and backlash, and loads that oil carries permanently.
TEXT
} > "$here/two-way.md.new"
mv "$here/two-way.md.new" "$here/two-way.md"
sh "$here/../made.sh" "$here/two-way.md" plugins/dynamics plugins/ehl
