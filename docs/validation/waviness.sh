#!/bin/sh
# Writes waviness.md: what is left of waves that pass the contact, against Venner et al. 1997.
#   sh docs/validation/waviness.sh build
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
export FLANKFILM_TEST_PLUGINS="$build/plugins"
export FLANKFILM_TEST_SOURCE="$here/../.."

rows()
{
    "$build/tests/plugins/ehl/test-ehl-waviness" "$@" | sed -n '/^| /p; /^|-/p'
}

{
    cat <<'TEXT'
# Waviness in a transient contact

Every number of this page comes from

```sh
sh docs/validation/waviness.sh build
```

which writes the page from `tests/plugins/ehl/waviness.c`; the test of that name holds three of the
points to 5 % in every run of the tests.

One flank of a line contact in pure rolling is wavy; M = 100 and L = 11 as in Venner, Couhier,
Lubrecht & Greenwood 1997, "Amplitude reduction of waviness in transient EHL line contacts". A_d is
half of the way between the highest and the lowest film at x = 0 while a wave passes, A_i the
amplitude of the flank, a the Hertz half-width, H_c the smooth central film. The domain is -2.5 a to
1.5 a; Roelands' law with z = 0.68, alpha = 22 1/GPa, Dowson & Higginson's compression. The fit is

    A_d/A_i = 1/(1 + 0.17 n + 0.03 n^2),   n = (wavelength/a) M^(3/4)/L^(1/2)

and is meant for ratios below a half.

## 1024 cells

TEXT
    rows table 1024
    cat <<'TEXT'

The paper's own table and fit differ among themselves by far more than 5 % at the longest waves.
Two sets of points are more than 5 % off the paper's table: the highest waves of one half-width,
where the table deviates from the smooth trend of its own rows, and the low waves of an eighth. Neither is due to the grid, as the
refinement shows: the shortest waves converge to values above the table, and a coarse grid only makes them smaller.

## Refinement

A_i = 0.1 H_c; a wave of an eighth of the half-width is 8, 16, 32 and 64 cells long. The central film is interpolated linearly
between two nodes. This alone reduces a wave of n cells by up to 1 - cos(pi/n): by 8 % with 8 cells, by 2 % with 16.

TEXT
    rows refinement
} > "$here/waviness.md.new"
mv "$here/waviness.md.new" "$here/waviness.md"
sh "$here/../made.sh" "$here/waviness.md" plugins/ehl
