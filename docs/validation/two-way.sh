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
    echo '| point | acts | dte rms, um | apart | largest tooth force over static | lowest film, um | highest pressure, MPa | loss, W | films |'
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
    echo '| point | torques | k(t) and e(t) | sliding | rolling | squeeze | vibration | damper | in less out, over the loss |'
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
    echo '| domain in half widths | cells | steps | wedge in flight | squeeze, W | in less out, over the loss | rounds |'
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
    echo '| oil between parted flanks | film at hand-over | in series | noted | side by side | noted |'
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
    echo '| oil between parted flanks | small-step model, swept down | one way, the fold | both ways, lowest speed with parted flanks |'
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

The pair of Li & Kahraman 2011 at its three points (`configs/two-way.yaml`, 512 cells, 1000 steps): friction as
torques on both gears, rolling resistance likewise, the thickness of the loaded film in series with the teeth
([theory](../theory.md#motion-and-film-both-ways)). "films" counts the rounds until what comes back changes by less than 1e-4; of the two without any effect the second is not computed.

TEXT
    both
    cat <<'TEXT'

All three together change the vibration by less than 1 % at these points, and the film by less: that the motion is
computed without its film was right for them. Oil squeezed in flight adds a little at point III.

## Where the power goes

In W. What the torques put in at the mean speeds of the gears, and what the prescribed changes of stiffness and transmission
error put in, against what the films take, what friction takes from the vibration, and the damper:

TEXT
    books
    cat <<'TEXT'

Where contact is kept the books close to less than 5e-4 of the loss, which is the film's own error (its `energy_balance`
and `power_loss_space_error`). Where flanks part, a motion that knows no film in flight gives the film less than it takes, and
`power_balance` says so. With `squeeze: series` film and motion land together: the same force squeezes both, and what
of the film the motion squeezes itself is not counted again. What is left there misses 1e-3. Most of it is the domain of the film, which is
fitted to loaded flanks and too short to squeeze all the oil in a gap of some micrometres, and the wedge of the rolling flanks, which the film has
in flight and `squeeze` has with `squeeze_rolling` alone:

TEXT
    refined
    cat <<'TEXT'

What is left with the finest of them, 1.1e-3 to 1.3e-3, is known term by term (16 half widths, 1000 steps, the wedge in flight). A film begins loaded at
the start of active profile, where k(t) steps: with less elastic energy than the contact of Hertz by which `separation` measures it, which is given
as the pair enters and never taken, and with compressed oil, which gives back what nobody put in. The error of the cells falls with their square:

TEXT
    python3 "$here/two-way-books.py" "$build/flankfilm" "$configs/two-way.yaml"
    cat <<'TEXT'

The loop takes two to four films at I and II, and at III up to six to 1e-4: from the third round on `separation` of the flanks that land falls to a
seventh in each. Anderson's method with one past round, tried in the engine, saves none of them, with or without squeeze in flight; with the wedge in flight it takes
five for seven. What keeps it from saving more was not measured; that the instant at which flanks part changes from the second round to the third may be why. It was left out.

## Where oil ends the branch of parted flanks

A mesh of small modulation, k1/k = 0.049, in which the branch with parted flanks runs down to a fold. A small-step
model of it, one pair of constant radius followed by fixed steps of time and swept down in steps of 10 Hz, found how much oil moves that
end, in series with the tooth and side by side with it (the teeth rigid until the film is `handover_film` thick). It is repeated as a
test (`build/tests/plugins/dynamics/test-dynamics-branch-ends 400 2000`): the first speed at which flanks no longer part, beside what was noted.

TEXT
    small
    cat <<'TEXT'

Rigid teeth overrate the oil, since the tooth bends where the gap would have to close: side by side is not built. In series
half the `handover_film` moves the end by less than a step of 10 Hz. The return map of `dynamics/shooting` with the same one pair has its folds at 1935.9, 2007.8 and
2292.2 Hz, 2 to 4 Hz from where the sweep loses the branch, and the model of fixed steps comes back to its motions to 1e-5 (`meson test branch-ends`).

TEXT
    ends
    cat <<'TEXT'

One way the folds are 2 and 11 Hz above those of one pair: here the radii run along the path of contact and two pairs share the oil. Both ways the thickness of the loaded film, which falls as it is squeezed and
costs work, takes power from the vibration, at point III 7 % of what the damper takes, 9 % with squeeze in flight (`film_power` beside `damper_loss`), and
the branch ends at a higher speed for it. Near its end the frozen films of an atlas do not tell (`atlas_films`), so
that this column is by runs at speeds 25 to 100 Hz apart, each from the branch `upper` on its own, with 256 cells, 500 steps and at most 30 rounds.

The end over viscosity, load and backlash, and loads that oil keeps apart for good: [oil between parted flanks](rattle.md).
TEXT
} > "$here/two-way.md.new"
mv "$here/two-way.md.new" "$here/two-way.md"
sh "$here/../made.sh" "$here/two-way.md" plugins/dynamics plugins/ehl
