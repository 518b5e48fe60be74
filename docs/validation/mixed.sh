#!/bin/sh
# Writes mixed.md: shares of the load between oil and asperities over speed, cells and surfaces.
#   sh docs/validation/mixed.sh build        (about ten minutes)
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
export FLANKFILM_TEST_PLUGINS="$build/plugins"
export FLANKFILM_TEST_SOURCE="$here/../.."

rows()
{
    "$build/tests/bench/bench-mixed" "$@" | sed -n 's/^ *\([0-9. ]*|.*[^ ]\) *$/| \1 |/p'
}

{
    cat <<'TEXT'
# Mixed lubrication: what depends on the grid

Every number of this page comes from

```sh
sh docs/validation/mixed.sh build
```

which writes the page from `tests/bench/bench-mixed.c`: one tooth pair of Li & Kahraman 2011 over its
path of contact, Rq 0.5 um on both flanks, waves of 20 to 800 um; means over the path. The last row of
each group is the mean over the surfaces and the standard deviation of its samples, of the shares of
the load, lambda and the friction coefficient in turn.

| rpm | cells | surface | asperity share | contact ratio | trapped share | lambda | friction | least film, nm | p_max, GPa | steps cut | CPU s |
|---|---|---|---|---|---|---|---|---|---|---|---|
TEXT
    rows 256 3
    rows 512 2
    rows 1024 1 15 1500
    cat <<'TEXT'

Time steps are no variable here: the oil moves one cell in each. Between grids lambda holds at every
speed, and the asperity share changes by less than 5 % of the load at every speed; that is the measure,
because a share of almost nothing has no relative error worth its name. At the two slower speeds
the share is not settled relative to itself: it rises with the cells, and the load on shut-in oil more so:
behind ridges across a line contact the oil has no way out. Take the split between asperities and
trapped oil there as an order of magnitude, or let the valleys leak (`valleys: ventilated`). The highest
pressures are past what steel and the oil's law stand for. A single surface has no spread.
TEXT
} > "$here/mixed.md.new"
mv "$here/mixed.md.new" "$here/mixed.md"
