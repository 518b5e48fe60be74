/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draft. Checks of a film discretisation (film.h): exact films of rigid flanks, and balances of an
   elastic film. */
#include "film-cases.h"
#include "offer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* A rigid cylinder approaches with the speed V = -dh/dt, without entrainment: p = 6 eta V R (1/h^2
   - 1/h_end^2), where h_end is the gap at the ends of the domain. */
static void squeeze(const ff_fixture *fixture)
{
    const double fall = 0.02; /* V, m/s */
    film_case c;
    if (!film_case_open(&c, fixture, FILM_RIGID | FILM_EVEN))
        return;
    for (size_t i = 0; i < FILM_NODES; i++)
        c.past[i] = -c.rho * fall;
    c.instant.entrainment = 0;
    c.instant.past = c.past;
    c.instant.loaded = 0;
    c.state.h00 = 2e-6;
    if (film_case_solve(&c)) {
        double end = film_case_gap(&c, 0);
        for (size_t i = 1; i + 1 < FILM_NODES; i++) {
            double h = film_case_gap(&c, i),
                   p = 6 * c.eta * fall * c.instant.radius * (1 / (h * h) - 1 / (end * end)),
                   top = 6 * c.eta * fall * c.instant.radius / (c.state.h00 * c.state.h00);
            if (!film_case_near(&c, "the pressure under a cylinder that approaches at 0.02 m/s", i,
                                c.state.p[i], p, top, 0.03))
                break;
        }
    }
    film_case_close(&c);
}

/* A rigid wedge must carry Martin's load, w h/(eta u R) = 4.86526 for an inlet at 20 sqrt(2 R
   h). */
static void wedge(const ff_fixture *fixture)
{
    film_case c;
    if (!film_case_open(&c, fixture, FILM_RIGID))
        return;
    c.instant.loaded = 0;
    c.state.h00 = 2e-6;
    if (film_case_solve(&c)) {
        double load = film_case_load(&c), u = c.instant.entrainment,
               expected = 4.86526 * c.eta * u * c.instant.radius / c.state.h00;
        film_case_near(&c, "the load of a rigid wedge", 0, load, expected, expected, 0.05);
    }
    film_case_close(&c);
}

/* If shear makes the oil three times as fluid, the same pressure gives three times the flow, so the
   load is a third. */
static void fluidity(const ff_fixture *fixture)
{
    film_case c;
    if (!film_case_open(&c, fixture, FILM_RIGID | FILM_FLUID))
        return;
    c.instant.loaded = 0;
    c.state.h00 = 2e-6;
    if (film_case_solve(&c)) {
        double expected =
            4.86526 * c.eta * c.instant.entrainment * c.instant.radius / c.state.h00 / 3;
        film_case_near(&c,
                       "the load of a rigid wedge, if shear makes the oil three times as fluid,", 0,
                       film_case_load(&c), expected, expected, 0.05);
    }
    film_case_close(&c);
}

/* v = -4/(pi E') int p ln(|x - x'|/half_width) dx', p linear between the nodes. */
static double deflection_at(const film_case *c, size_t i)
{
    double sum = 0, dx = c->contact.dx;
    for (size_t j = 1; j < FILM_NODES; j++)
        for (int k = 0; k < 8; k++) {
            double share = (k + 0.5) / 8,
                   p = (1 - share) * c->state.p[j - 1] + share * c->state.p[j],
                   at = fabs(((double)j - 1 + share - (double)i) * dx);
            sum += p * log(at / c->contact.half_width) * dx / 8;
        }
    return -4 / (pi * c->contact.modulus) * sum;
}

/* An elastic contact: checks the load, the deflection, and that the same flow of oil passes each
 * section. */
static void elastic(const ff_fixture *fixture)
{
    film_case c;
    if (!film_case_open(&c, fixture, FILM_PLAIN))
        return;
    bool good = film_case_solve(&c);
    double load = film_case_load(&c), most = 0, flow = 0;
    size_t top = 1;
    good = good && film_case_near(&c, "the load that p carries", 0, load, c.instant.load,
                                  c.instant.load, 1e-3);
    for (size_t i = 0; i < FILM_NODES && good; i++) {
        most = fmax(most, fabs(c.state.v[i]));
        top = c.state.p[i] > c.state.p[top] ? i : top;
    }
    for (size_t i = 0; i < FILM_NODES && good; i += 8)
        good = film_case_near(&c, "the deflection v of its pressure", i, c.state.v[i],
                              deflection_at(&c, i), most, 0.01);
    flow = good ? film_case_flow(&c, top) : 0;
    for (size_t i = 2; i <= top && good; i++)
        good = film_case_near(&c, "the oil flow into this node from the node before it", i,
                              film_case_flow(&c, i), flow,
                              c.rho * c.instant.entrainment * film_case_gap(&c, i), 0.03);
    film_case_close(&c);
}

static const ff_check checks[] = {
    {"squeeze", "a rigid approaching cylinder has the exact pressure", squeeze},
    {"wedge", "a rigid wedge carries Martin's load", wedge},
    {"fluidity", "the flow includes shear thinning", fluidity},
    {"elastic", "load, deflection and flow follow from the pressure", elastic},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("discretisation",
                  "checks of a film discretisation: exact films, load, deflection, flow",
                  "Martin 1916, Engineering 102; Cameron 1966, Principles of Lubrication");
