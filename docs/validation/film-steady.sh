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

which writes the page from the test programs of `tests/plugins/ehl`. The same programs, without
`print`, hold the models to these numbers in every run of the tests.

| model | what it is | order | what it claims |
|---|---|---|---|
| `ehl/film-formula` | formulas of the literature | | h_min within 10 % of full solutions (Moes), see below |
| `ehl/inlet-analysis` | Reynolds equation of the inlet, carried through the contact | | h_central within 10 %, M 2 to 200, L 0 to 15 |
| `ehl/finite-volume` | volumes around the nodes, Newton-GMRES | 2 | error below `h_min_error` |
| `ehl/control-volume` | volumes from node to node, line relaxation | 2 | error below `h_min_error` |
| `ehl/dense-newton` | the equations of finite-volume, dense | 2 | equal to finite-volume |

M, L and H are those of Moes: M = W (2U)^-1/2, L = G (2U)^1/4, H = (h/R)(2U)^-1/2, with
U = eta0 u/(E' R), W = w/(E' R), G = alpha E'.

## Rigid cylinder, constant viscosity

The load number w h0/(eta u R) against the exact solution with Reynolds' condition at the exit
(Martin 1916), 4.894968 for an inlet at infinity, for inlets at xi = x/sqrt(2 R h0).

TEXT
    tables rigid
    cat <<'TEXT'

## Central film

References are solutions of an independent program (dense Newton, penalty cavitation, Hertz's
scaling, a second-order wedge), extrapolated from 513, 1025 and 2049 nodes; Roelands with
z = 0.68 and alpha = 22 1/GPa, the compression of Dowson & Higginson. The domain of the table begins
at -4 a (-6 a isoviscous, -8 a and -12 a at M = 10 and 5), as in the references; the two
models that use formulas assume an infinite inlet. `order` is that of the last three grids; it is
empty if the error changes its sign among them.

TEXT
    tables table
    cat <<'TEXT'

Finite-volume converges from below and control-volume from above, so their difference shows the error of
both. Control-volume needs fewer cells, because its wedge uses rho h at the right places and transports
it without error where the pressure flow has vanished.

The second table is a check without a reference: rho H at the middle of a compressible film is close
to Moes' incompressible one.

## Formulas

Differences of h_min and h_central from `ehl/finite-volume` on 1024 cells, lowest and highest over
the range: with Roelands' law and compression, and with Barus' law without compression.

TEXT
    tables formula
    cat <<'TEXT'

Moes and Dowson & Toyoda give no h_min; here it is the central film times 0.725 + 0.07/(1 + alpha p_H). Dowson &
Higginson give no h_central; here it is that of Dowson & Toyoda. For a compressible oil Moes' central film is divided by rho/rho0 in the
middle; the other formulas are used as printed. Pan & Hamrock's central film is closer to that of compressible oils.

## Inlet

The part of the film that the default inlet leaves out for the gear contact of Li & Kahraman 2011 (Roelands,
M = 16, L = 4.8 at the nominal load), by comparison with a domain nine times as long with the same node
spacing; `as stated` is the line `starvation` of the quality record.

TEXT
    tables domain
} > "$here/film-steady.md.new"
mv "$here/film-steady.md.new" "$here/film-steady.md"
sh "$here/../made.sh" "$here/film-steady.md" plugins/ehl
