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

which writes the page from `tests/plugins/ehl/waviness.c`. In every run of the tests, the test of that name checks that three
of the points are within 5 % of the published values.

One flank of a line contact in pure rolling is wavy; M = 100 and L = 11 as in Venner, Couhier,
Lubrecht & Greenwood 1997, "Amplitude reduction of waviness in transient EHL line contacts". A_d is half the difference
between the highest and the lowest film at x = 0 while a wave passes, A_i the amplitude of the flank's waves, a the Hertz
half-width, H_c the central film of smooth flanks. The domain is -2.5 a to 1.5 a, with Roelands' law (z = 0.68, alpha = 22
1/GPa) and Dowson & Higginson's compression. The fit of that paper is

    A_d/A_i = 1/(1 + 0.17 n + 0.03 n^2),   n = (wavelength/a) M^(3/4)/L^(1/2)

and is meant for ratios below a half.

## 1024 cells

TEXT
    rows table 1024
    cat <<'TEXT'

At the longest waves, the paper's table and its fit differ from each other by far more than 5 %. Two sets of points differ
from the paper's table by more than 5 %. At a wavelength of one half-width and A_i/H_c = 0.5, the table deviates from the
smooth trend of its other rows. At a wavelength of an eighth, the two smaller amplitudes are higher than in the table.
Neither is due to the grid: under refinement the shortest waves converge to values above the table, and a coarse grid makes
them smaller.

## Refinement

A_d/A_i for A_i = 0.1 H_c. A wave of an eighth of the half-width is 8, 16, 32 and 64 cells long. The central film is
interpolated linearly between two nodes; this alone reduces a wave of n cells by up to 1 - cos(pi/n), which is 8 % with 8
cells and 2 % with 16.

TEXT
    rows refinement
} > "$here/waviness.md.new"
mv "$here/waviness.md.new" "$here/waviness.md"
sh "$here/../made.sh" "$here/waviness.md" plugins/ehl
