#!/bin/sh
# Writes film-steady.md: every steady film model against exact and independent solutions.
#   sh docs/validation/film-steady.sh build
set -eu

build=$(realpath "${1:-build}")
here=$(cd "$(dirname "$0")" && pwd)
export FLANKFILM_TEST_PLUGINS="$build/plugins"
export FLANKFILM_TEST_SOURCE="$here/../.."

tables()
{
    "$build/tests/plugins/ehl/test-ehl-$1" print
}

{
    cat <<'TEXT'
# Steady films: five models compared

Every number of this page comes from

```sh
sh docs/validation/film-steady.sh build
```

which writes the page from the test programs of `tests/plugins/ehl`. Without the argument `print`, the same programs check in
every run of the tests that the models still give these numbers.

| model | method | order of convergence | stated accuracy |
|---|---|---|---|
| `ehl/film-formula` | formulas of the literature | | h_min within 10 % of full solutions (Moes), see below |
| `ehl/inlet-analysis` | Reynolds' equation in the inlet; the film then moves through the contact unchanged | | h_central within 10 %, M 2 to 200, L 0 to 15 |
| `ehl/finite-volume` | volumes around the nodes, Newton-GMRES | 2 | error below `h_min_error` |
| `ehl/control-volume` | volumes from node to node, line relaxation | 2 | error below `h_min_error` |
| `ehl/dense-newton` | equations of finite-volume, Newton's method with a dense matrix | 2 | equal to finite-volume |

M, L and H are those of Moes: M = W (2U)^-1/2, L = G (2U)^1/4, H = (h/R)(2U)^-1/2, with
U = eta0 u/(E' R), W = w/(E' R), G = alpha E'.

## Rigid cylinder, constant viscosity

The load number w h0/(eta u R) of each model, compared with the exact solution with Reynolds' condition at the exit (Martin
1916). The inlet is at xi = x/sqrt(2 R h0); the column heads give the exact values, and an inlet at infinity has 4.894968.

TEXT
    tables rigid
    cat <<'TEXT'

## Central film

The table gives H at x = 0, and in brackets the difference from the reference. References are solutions of an independent
program (dense Newton, penalty cavitation, Hertzian scaling, a second-order wedge), extrapolated from 513, 1025 and 2049
nodes, for Roelands' law with z = 0.68 and alpha = 22 1/GPa and the compression of Dowson & Higginson. As in the references,
the domain begins at -4 a (isoviscous: -6 a; at M = 10 and 5: -8 a and -12 a); film-formula and inlet-analysis assume an
infinite inlet. `order` is the order of convergence of the last three grids, and empty if the error changes its sign among
them.

TEXT
    tables table
    cat <<'TEXT'

Finite-volume converges from below and control-volume from above, so their difference shows the error of
both. Control-volume needs fewer cells, because its wedge term uses rho h at the nodes and transports rho h without error
where there is no pressure flow.

The second table is a check without a reference: rho H at the middle of a compressible film is close to H by Moes' formula
for incompressible oils.

## Formulas

Lowest and highest difference of each formula from `ehl/finite-volume` on 1024 cells, over ranges of M and L. The ranges
include Roelands' law with compression and Barus' law without compression.

TEXT
    tables formula
    cat <<'TEXT'

Moes and Dowson & Toyoda give no h_min; it is taken as h_central times 0.725 + 0.07/(1 + alpha p_H). Dowson & Higginson give
no h_central; it is taken from Dowson & Toyoda. For compressible oils Moes' h_central is divided by rho/rho0 in the middle;
the other formulas are used as printed. Pan & Hamrock's h_central is closer for compressible oils.

## Inlet

The computed domain begins at a finite distance, which makes the film too thin. The table gives the missing share of the film
with the preset inlet, for the gear contact of Li & Kahraman 2011 (Roelands, M = 16, L = 4.8 at the nominal load), by
comparison with a domain nine times as long with the same node spacing; *stated* is the quality line `starvation`. Inlet
lengths are in units of sqrt(2 R h).

TEXT
    tables domain
} > "$here/film-steady.md.new"
mv "$here/film-steady.md.new" "$here/film-steady.md"
sh "$here/../made.sh" "$here/film-steady.md" plugins/ehl
