/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which maximum near the outlet may be a pressure spike whose tip the cells do not resolve. */
#include "check.h"
#include "stage.h"

#include "../../../plugins/ehl/contact/grid.h"
#include "../../../plugins/ehl/errors/space-error.h"

#include <math.h>
#include <stdio.h>

enum { NODES = 257 };

static const double modulus = 226e9, cells = 80; /* cells in the half-width a */

/* Returns the spike found, and the stated error of p_max, for a crest at x = 0.6 a with a relative
   tip height on one node. */
static ehl_spike look_at(const ehl_laws *laws, double tip, double *error)
{
    const ehl_instant at = {.radius = 0.0128, .entrainment = 4, .load = 1e5};
    double a = ehl_hertz_half_width(at.load, at.radius, modulus), p[NODES], highest = 0;
    ehl_oil oil;
    ehl_reynolds eq;
    ehl_spike spike;
    ehl_fluid_oil(laws, &oil);
    const ehl_grid grid = {.nodes = NODES, .dx = a / cells, .first = -2 * a};
    ehl_reynolds_create(&eq, &grid, laws, &oil, 2);
    for (size_t i = 0; i < NODES; i++) {
        double x = ((grid.first + (double)i * grid.dx) / a - 0.6) / 0.6;
        p[i] = fmax(0, 5e8 * (1 - x * x)) * (fabs(x) < 0.5 / cells ? 1 + tip : 1);
        highest = fmax(highest, p[i]);
    }
    const ehl_crest of = {p, 1e-6, highest};
    spike = ehl_spike_of(&eq, &at, modulus, &of);
    *error = spike.error;
    ehl_reynolds_destroy(&eq);
    return spike;
}

int main(void)
{
    stage *oil = stage_open("viscosity/roelands"), *rho = stage_open("density/dowson-higginson");
    stage_set(oil, "eta0", 0.02);
    stage_set(oil, "alpha", 22e-9);
    stage_set(rho, "rho0", 850);
    const ehl_laws laws = {.viscosity = stage_service(oil, FF_VISCOSITY_ID),
                           .density = stage_service(rho, FF_DENSITY_ID)};
    double of_crest, of_tip;
    ehl_spike crest = look_at(&laws, 0, &of_crest), tip = look_at(&laws, 0.3, &of_tip);
    printf("share %.3f, error of the crest %.4f, of the tip %.4f\n", crest.cut, of_crest, of_tip);
    check_true("a crest has no tip", !(crest.seen > 0));
    check_true("one node has", tip.seen > 6e8);
    check_below("what is stated of the crest", of_crest, 0.7 * of_tip);
    stage_close(oil);
    stage_close(rho);
    return check_done();
}
