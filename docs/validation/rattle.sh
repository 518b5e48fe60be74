#!/bin/sh
# Writes rattle.md and rattle.svg: where oil between parted flanks ends their branch, and what loads it keeps apart.
#   sh docs/validation/rattle.sh build
set -eu

build=$(realpath "${1:-build}")
program=$build/flankfilm
here=$(cd "$(dirname "$0")" && pwd)
configs=$(realpath "$here/../../configs")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

run()
{
    file=$1
    shift
    "$program" run "$file" "$@" --json > "$work/run.json" 2> "$work/errors" || {
        cat "$work/errors" >&2
        exit 1
    }
}

# A scalar of the outputs of the last run, times a factor.
value()
{
    grep -o "\"motion.$1\":{\"unit\":[^}]*}" "$work/run.json" | sed -n 's/.*"value":\([^,}]*\).*/\1/p' |
        awk -v f="${2:-1}" -v as="${3:-%.4g}" '{ printf as, f * $1 }'
}

# The mesh of small modulation of two-way.sh.
awk 'BEGIN {
    print "phase; stiffness [N/m]"
    for (i = 0; i <= 200; i++) {
        x = 2 * atan2(0, -1) * i / 200
        printf "%.4f; %.9g\n", i / 200, 3.2581e8 * (1 - 0.214 * (0.2287 * cos(x) + 0.1427 * cos(2 * x) + 0.0672 * cos(3 * x)))
    } }' > "$work/stiffness.csv"

# Speed, Hz, at which the branch of parted flanks ends: the lowest fold above the resonances of higher order, which end
# at 1600 Hz. Settings follow.
end()
{
    run "$here/two-way.yaml" --set mesh.file="$work/stiffness.csv" --set motion.film= --set outputs=[motion.fold_frequency] \
        --set motion.atlas.from="1700 Hz" --set motion.atlas.to="3300 Hz" "$@"
    grep -o '"motion.fold_frequency":{[^}]*}' "$work/run.json" | sed -n 's/.*"data":\[\([^]]*\)\].*/\1/p' | tr ',' '\n' |
        sort -g | head -n 1 | awk '{ printf "%.1f", $1 }'
}

# $1 mPa s, then settings
oily()
{
    eta=$1
    shift
    end --set motion.squeeze=series --set oil.file= --set oil.at="100 degC" --set oil.density="917.75 kg/m3" --set oil.eta0="$eta mPa s" "$@"
}

# PANEL-LINE... of one curve: colour, name, then points by a command over a list
curve()
{
    colour=$1 name=$2 command=$3 list=$4
    echo "curve $colour none 2 y $name"
    for x in $list; do
        hertz=$($command "$x")
        echo "$x $hertz"
    done
}

by_viscosity() { oily "$1"; }
by_load_thin() { oily 5.006 --set duty.torque="$1 N m"; }
by_load_thick() { oily 27.7 --set duty.torque="$1 N m"; }
by_gap_thin() { oily 5.006 --set gears.backlash="$(awk -v x="$1" 'BEGIN { print x / 1000 }') mm"; }
by_gap_thick() { oily 27.7 --set gears.backlash="$(awk -v x="$1" 'BEGIN { print x / 1000 }') mm"; }
dry_load() { end --set duty.torque="$1 N m"; }
dry_gap() { end --set gears.backlash="$(awk -v x="$1" 'BEGIN { print x / 1000 }') mm"; }

viscosities="0.5 2 5.006 10 15 20 27.7 40 60"
loads="25 50 75 100 150 200 250 400 600"
gaps="20 40 60 80 100 140 200"

{
    echo "panel 70 30 330 300"
    echo "x 0 60 10 viscosity, mPa s"
    echo "y 1800 3200 200 end of the branch, Hz"
    echo "title 250 N m, backlash 140 um"
    curve "#0072b2" "in series" by_viscosity "$viscosities"
    echo "panel 490 30 330 300"
    echo "x 0 600 100 torque, N m"
    echo "y 1800 3200 200 end of the branch, Hz"
    echo "title backlash 140 um"
    curve "#999999" "no oil" dry_load "$loads"
    curve "#0072b2" "5.006 mPa s" by_load_thin "$loads"
    curve "#d55e00" "27.7 mPa s" by_load_thick "$loads"
    echo "panel 910 30 330 300"
    echo "x 0 200 50 backlash, um"
    echo "y 1800 3200 200 end of the branch, Hz"
    echo "title 250 N m"
    curve "#999999" "no oil" dry_gap "$gaps"
    curve "#0072b2" "5.006 mPa s" by_gap_thin "$gaps"
    curve "#d55e00" "27.7 mPa s" by_gap_thick "$gaps"
} > "$work/lines"

# The points of the curves of panel $1 as a table: a row for each x.
table()
{
    awk -v wanted="$1" '
        $1 == "panel" { panel++ }
        panel != wanted { next }
        $1 == "x" { x = $0; sub(/^x [^ ]* [^ ]* [^ ]* /, "", x) }
        $1 == "curve" { n++; name[n] = $0; sub(/^curve [^ ]* [^ ]* [^ ]* [^ ]* /, "", name[n]); next }
        n && NF == 2 && $1 + 0 == $1 { if (!($1 in seen)) order[++count] = $1; seen[$1]; cell[$1, n] = $2 }
        END {
            printf "| %s |", x
            for (i = 1; i <= n; i++) printf " %s, Hz |", name[i]
            printf "\n|---|"
            for (i = 1; i <= n; i++) printf "---|"
            print ""
            for (k = 1; k <= count; k++) {
                printf "| %s |", order[k]
                for (i = 1; i <= n; i++) printf " %s |", cell[order[k], i]
                print ""
            }
        }' "$work/lines"
}

# What the pair of rattle.yaml does: in words.
motion()
{
    run "$configs/rattle.yaml" --set "outputs=[motion.contact_loss, motion.period, motion.dte_peak_to_peak]" "$@"
    parted=$(value contact_loss 1 %.4f)
    swing=$(value dte_peak_to_peak 1e6 %.2g)
    case $(value period 1 %d) in
    0) says="rattles, never twice alike, by some $swing um" ;;
    1) says="period 1, $swing um" ;;
    *) says="period $(value period 1 %d), $swing um" ;;
    esac
    [ "$parted" = 1.0000 ] && echo "borne by oil, $says" || echo "touches $(awk -v x="$parted" 'BEGIN { printf "%.0f %%", 100 * (1 - x) }'), $says"
}

light()
{
    echo '| torque, N m | no oil in flight | squeeze alone | squeeze and wedge |'
    echo '|---|---|---|---|'
    for torque in 0.3 1 3 10 30; do
        none=$(motion --set duty.torque="$torque N m" --set motion.squeeze=none)
        squeeze=$(motion --set duty.torque="$torque N m" --set motion.squeeze_rolling=false)
        both=$(motion --set duty.torque="$torque N m")
        echo "| $torque | $none | $squeeze | $both |"
    done
}

# The largest of some torques that is borne, by tip relief and viscosity.
borne()
{
    last="none"
    for torque in 0.5 1 2 4 6 8 12; do
        run "$configs/rattle.yaml" --set "outputs=[motion.contact_loss]" --set duty.torque="$torque N m" "$@"
        [ "$(value contact_loss 1 %.4f)" = 1.0000 ] || break
        last=$torque
    done
    echo "$last"
}

errors()
{
    echo '| tip relief, um | largest torque borne at 5.006 mPa s, N m | at 27.7 mPa s, N m |'
    echo '|---|---|---|'
    for relief in 0 2 5 10 20; do
        thin=$(borne --set gears.tip_relief="$relief um")
        thick=$(borne --set gears.tip_relief="$relief um" --set oil.file= --set oil.at="100 degC" \
            --set oil.density="917.75 kg/m3" --set oil.eta0="27.7 mPa s")
        echo "| $relief | $thin | $thick |"
    done
}

# The pair of the paper itself, one way.
paper()
{
    echo '| | I, 1250 Hz | II, 2085 Hz | III, 2375 Hz, upper | end of the upper branch |'
    echo '|---|---|---|---|---|'
    for oil in none 5.006 27.7; do
        set -- --set motion.film= --set motion.squeeze=none
        [ $oil = none ] || set -- --set motion.film= --set motion.squeeze=series
        [ $oil != 27.7 ] || set -- "$@" --set oil.file= --set oil.at="100 degC" --set oil.density="917.75 kg/m3" --set oil.eta0="27.7 mPa s"
        name="$oil mPa s"
        [ $oil = none ] && name="no oil"
        line="| $name |"
        for point in "1250 lower" "2085 lower" "2375 upper"; do
            run "$configs/two-way.yaml" --set "outputs=[motion.dte_rms]" --set duty.mesh_frequency="${point% *} Hz" --set motion.branch="${point#* }" "$@"
            line="$line $(value dte_rms 1e6 %.4f) um |"
        done
        run "$configs/two-way.yaml" --set "outputs=[motion.fold_frequency]" --set motion.max_period=1 --set motion.search_speeds=8 \
            --set motion.atlas.from="1300 Hz" --set motion.atlas.to="3300 Hz" "$@"
        last=$(grep -o '"motion.fold_frequency":{[^}]*}' "$work/run.json" | sed -n 's/.*"data":\[\([^]]*\)\].*/\1/p' | tr ',' '\n' | sort -g | head -n 1)
        echo "$line $(awk -v x="$last" 'BEGIN { printf "%.1f", x }') Hz |"
    done
}

sensitivity()
{
    echo '| film at hand-over, um | end, Hz | oil fills gaps up to, um | end, Hz |'
    echo '|---|---|---|---|'
    for pair in "0.05 1" "0.1 3" "0.2 10" "0.4 30"; do
        handover=$(oily 5.006 --set motion.handover_film="${pair% *} um")
        supply=$(oily 5.006 --set motion.supply_film="${pair#* } um")
        echo "| ${pair% *} | $handover | ${pair#* } | $supply |"
    done
}

{
    cat <<'TEXT'
# Oil between parted flanks

Written by

```sh
sh docs/validation/rattle.sh build
```

On this page no film stage acts back on the motion; the oil between the flanks is that of `squeeze: series` of `dynamics/shooting` ([theory](../theory.md#oil-between-landing-flanks)).

## Where the branch of parted flanks ends

The mesh is that of [both ways](two-way.md#where-oil-ends-the-branch-of-parted-flanks): the pair of Li & Kahraman 2011 with a
stiffness of three small harmonics, k1/k = 0.049. The branch with separated flanks ends at a fold when the speed falls. The
tables give the mesh frequency of this end, in Hz, for oil in series with the teeth.

![End of the branch over viscosity, load and backlash](rattle.svg)

TEXT
    table 1
    echo
    table 2
    echo
    table 3
    cat <<'TEXT'

The branch ends at a higher speed if the oil is more viscous or the load smaller: the momentum that the oil takes from
approaching flanks depends only on the oil (4.9), while a motion without oil is proportional to the load. Without oil,
backlash matters only if separated flanks reach the back flanks, that is below 80 um or above 400 N m. With oil, the end
shifts by 7 Hz (5.006 mPa s) and 25 Hz (27.7 mPa s) from a backlash of 80 um to 200 um.

TEXT
    sensitivity
    cat <<'TEXT'

This table is for 5.006 mPa s and 250 N m, where the end without oil is at 1935.9 Hz. If the film at hand-over
(`handover_film`) is eight times as thick, the effect of the oil is a fifth smaller. Half of the effect arises in gaps below
3 um, four fifths below 10 um, so the effect is smaller if the oil supply fills only smaller gaps (`supply_film`).

## Light load

In `configs/rattle.yaml` the pair idles; its tip relief of 10 um causes a transmission error of 5 um, which excites it.
"Touches" is the share of time in which a film is as thin as `handover_film`, 0.2 um; the last number of a cell is the
peak-to-peak motion. For motions that never repeat, the numbers are means over 64 mesh cycles and depend on round-off.

```sh
flankfilm run configs/rattle.yaml
```

TEXT
    light
    cat <<'TEXT'

- By squeeze alone, oil carries a load permanently only if the flanks bounce, since each bounce draws in new oil. Over a mesh cycle the
momentum of the load, F T_m, must be less than the momentum that the oil takes until hand-over (4.9), 2 A h_c^-1/2; for this
pair and one bounce this allows 0.76 N m. Flanks that do not bounce finally
  touch. A separate model with small steps reproduces such a motion to 5e-5 (`meson test branch-ends`).
- The wedge of the rolling flanks carries loads without bouncing. At 1250 Hz a film of 0.2 um carries 4.9 eta0 u R b/h_c,
about 120 N or 9 N m, but the transmission error reduces this:

TEXT
    errors
    cat <<'TEXT'

Torques of 0.5, 1, 2, 4, 6, 8 and 12 N m were tried; the table gives the largest one up to which the oil carries every torque
permanently. If one motion rattles and another is carried by oil, the motion of the branch `lower` counts; round-off may
decide which that is, as at 20 um and 1 N m. The model assumes rigid flanks and constant viscosity. Elastic flanks and
piezoviscosity, which both make the film thicker, matter above some 50 MPa.

## Points I, II and III

The pair with its own stiffness at 250 N m: rms of the alternating part of the dynamic transmission error s, and the speed at which its upper branch ends:

TEXT
    paper
    cat <<'TEXT'

At I and II the flanks do not separate, so the oil has no effect; the numbers differ because with `squeeze: series` the mesh
force follows the chord of the stiffness, not its slope (4.3a). At III, 970 Hz above the end of its branch, the oil takes
little energy from the motion. The end shifts little, because k1/k is larger than in the mesh above and the excitation
supplies more energy than the oil takes.
Whether a machine runs at III or on the lower branch, which also exists there, depends on the run-up, not on this oil.
TEXT
} > "$here/rattle.md.new"
mv "$here/rattle.md.new" "$here/rattle.md"
sh "$here/../made.sh" "$here/rattle.md" plugins/dynamics

awk -f "$here/plot.awk" "$work/lines" > "$work/figure.json"
sh "$here/../draw.sh" "$program" "$work/figure.json" "$here/rattle.svg"
