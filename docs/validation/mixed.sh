#!/bin/sh
# Writes mixed.md: shares of the load between oil and asperities over speed, cells, steps and surfaces.
#   sh docs/validation/mixed.sh build        (eight minutes of one core)
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
export FLANKFILM_TEST_PLUGINS="$build/plugins"
export FLANKFILM_TEST_SOURCE="$here/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

rows()
{
    "$build/tests/bench/bench-mixed" "$@" | sed -n 's/^ *\([0-9. ]*|.*[^ ]\) *$/| \1 |/p' > "$work/new"
    cat "$work/new" >> "$work/all"
    cat "$work/new"
}

head()
{
    echo '| rpm | waves from | cells | steps | surface | asperity share | contact ratio | trapped share | lambda | friction | yield share | plastic depth, nm | least film, nm | p_max, GPa | steps cut | cells per inlet | CPU s |'
    echo '|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|'
}

# The largest change of the asperity share from rows with $1 in column $2 to those with $3, in per
# cent of it, over the surfaces where it exceeds 0.01.
change()
{
    awk -F ' *[|] *' -v from="$1" -v column="$2" -v to="$3" '
        { key = $2 " " $3 " " $6; where = $column; gsub(/ .*/, "", $7) }
        column == 4 && $5 != 1000 { next }
        column == 5 && $4 != 256 { next }
        where == from { share[key] = $7 }
        where == to && key in share && $7 > 0.01 {
            off = 100 * (share[key] / $7 - 1)
            off = off < 0 ? -off : off
            if ($6 != "all" && off > worst) worst = off
        }
        END { printf "%.1f\n", worst }' "$work/all"
}

{
    cat <<'TEXT'
# Mixed lubrication: what depends on the grid

Every number of this page comes from

```sh
sh docs/validation/mixed.sh build
```

which writes the page from `tests/bench/bench-mixed.c`: one tooth pair of Li & Kahraman 2011 over its path of contact. Both flanks
have Rq 0.5 um and waves of 40 to 800 um, like a profile filtered at 40 um; no further waves are removed (`roughness_cutoff: 0 um`) unless a row
says so. Each row is a run; values are means over the path of contact, except the least film and `p_max`, which are extremes.
The row `all` of a group has means and standard deviations over its surfaces. `asperity share` is the share of the load on
asperities, `trapped share` that on enclosed oil, `yield share` that on yielding metal, and `plastic depth` the highest
plastic part of the gap. `cells per inlet` is the number of cells over sqrt(2 h/k), the length over which an asperity draws
in its film, for the contact film h of 1 nm and the rms curvature k of the flanks. Every run reports this number as quality
line `asperity_resolution`, which says `share not resolved` below 1.

## Speeds, surfaces and cells

TEXT
    head
    rows cells=512 surfaces=3
    rows cells=1024 surfaces=2 most=15
    set -- $(change 512 4 1024)
    cat <<TEXT

From 512 to 1024 cells the asperity share changes by at most $1 % of its value, for surfaces where it is above 0.01.

## Steps

The program divides time steps so that the oil moves at most one cell, or a sixteenth of \`roughness_cutoff\` if that is more.
If flanks touch, the limit is half of an asperity's inlet, but at least a quarter of a cell. If asperities carry less than
0.01 of the load, this limit is multiplied by sqrt(0.01/share). In this table the column \`steps\` gives the number of steps before any is divided.

TEXT
    head
    rows cells=256 most=15
    rows cells=256 steps=13500 most=15
    rows cells=256 steps=27000 most=15
    set -- $(change 1000 5 13500)
    set -- "$1" $(change 1000 5 27000)
    cat <<TEXT

With 13500 and 27000 steps, a step is a half and a quarter of the longest step allowed in contact. The asperity share with
1000 steps differs from these runs by at most $1 % and $2 %.

## Open valleys

With \`valleys: ventilated\`, valleys are 0.2 mm long along the tooth and open at both ends: the oil behind the ridges flows
off, and the asperities carry its load.

TEXT
    rm -f "$work/all"
    head
    rows ventilated=1 cells=512 most=150
    rows ventilated=1 cells=1024 least=15 most=15
    set -- $(change 512 4 1024)
    cat <<TEXT

From 512 to 1024 cells the asperity share changes by at most $1 % of its value.

## Shorter waves

With waves from 20 um on, and the same Rq, the cells of this table are too wide:

TEXT
    rm -f "$work/all"
    head
    rows shortest=20 cells=256 most=15
    rows shortest=20 cells=512 most=15
    set -- $(change 256 4 512)
    cat <<TEXT

From 256 to 512 cells the asperity share changes by $1 %; the runs report that it is not resolved.

## Waves that the cells do not resolve

By preset, the cut-off is 16 cells long and depends on the grid. In this table it is 29 um, the preset for 512 cells, for all
grids, so that the asperity share depends only on flanks and oil. "9.1 % off" is the share of Rq that is removed:

TEXT
    rm -f "$work/all"
    head
    rows shortest=20 cutoff=29 cells=512 least=15 most=15
    rows shortest=20 cutoff=29 cells=1024 least=15 most=15
    rows shortest=20 cutoff=29 cells=2048 least=15 most=15
    set -- $(change 512 4 1024)
    set -- "$1" $(change 1024 4 2048)
    cat <<TEXT

From 512 to 1024 cells the asperity share changes by $1 %, from there to 2048 by $2 %. With the preset it depends on
which waves are removed. The quality line \`roughness_left_out\` gives their share of Rq; above 5 % the film is outside its
range:

TEXT
    head
    rows shortest=20 cutoff=-1 cells=256 least=15 most=150
    rows shortest=20 cutoff=-1 cells=512 least=15 most=150
    rows shortest=20 cutoff=-1 cells=1024 least=15 most=150
    cat <<TEXT

## Hardness

No pressure above reaches the preset of \`asperity_hardness\`, 7 GPa. Softer flanks with a hardness of 3 and 2 GPa yield:
\`p_max\` then equals the hardness. The plastic depth is the mean over the path of its highest value at each instant.

TEXT
    rm -f "$work/all"
    head
    rows hardness=0 cells=512 least=15 most=15
    rows hardness=3 cells=512 least=15 most=15
    rows hardness=2 cells=256 least=15 most=15
    rows hardness=2 cells=512 least=15 most=15
    rows hardness=2 cells=1024 least=15 most=15
    cat <<TEXT

In all runs the load is balanced to 1e-8 and no step failed; "steps cut" counts the instants before which steps were
shortened. In a line contact, oil between two asperity contacts cannot escape; the load that it carries is the trapped share. The highest pressures are beyond the range of the oil's law.
TEXT
} > "$work/mixed.md"
mv "$work/mixed.md" "$here/mixed.md"
sh "$here/../made.sh" "$here/mixed.md" plugins/ehl plugins/surface
