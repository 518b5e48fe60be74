/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "film-cases.h"
#include "law-data.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static ff_status viscosity(const void *self, size_t n, const double *p, const double *T,
                           double *ln_eta, double *by_p, double *by_T)
{
    const film_case *c = self;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = log(c->eta) + c->alpha * p[i];
        if (by_p)
            by_p[i] = c->alpha;
        if (by_T)
            by_T[i] = 0;
    }
    return FF_OK;
}

static ff_status density(const void *self, size_t n, const double *p, const double *T, double *rho,
                         double *by_p, double *by_T)
{
    const film_case *c = self;
    (void)p, (void)T;
    for (size_t i = 0; i < n; i++) {
        rho[i] = c->rho;
        if (by_p)
            by_p[i] = 0;
        if (by_T)
            by_T[i] = 0;
    }
    return FF_OK;
}

static ff_status thrice(const void *self, size_t n, const double *ln_eta, const double *h,
                        double u_s, double *psi, double *by_ln_eta, double *by_h)
{
    (void)self, (void)h, (void)u_s;
    for (size_t i = 0; i < n; i++) {
        psi[i] = 3 * exp(-ln_eta[i]);
        if (by_ln_eta)
            by_ln_eta[i] = -psi[i];
        if (by_h)
            by_h[i] = 0;
    }
    return FF_OK;
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    (void)self, (void)p;
    for (size_t i = 0; i < n; i++)
        tau[i] = exp(ln_eta[i]) * u_s / h[i];
    return FF_OK;
}

/* R = 13 mm, u = 2 m/s, 10 mPa s: rigid with h = 2 um, or elastic with a Hertz pressure of 0.4
 * GPa. */
static void set_up(film_case *c, unsigned how)
{
    const double R = 0.013;
    bool rigid = how & FILM_RIGID;
    c->eta = 0.01;
    c->alpha = rigid ? 0 : 10e-9;
    c->rho = 900;
    c->viscosity = (ff_viscosity){sizeof c->viscosity, c, viscosity};
    c->density = (ff_density){sizeof c->density, c, density};
    c->rheology = (ff_rheology){sizeof c->rheology, c, thrice, shear};
    double modulus = rigid ? 1e18 : 226e9, inlet = 20 * sqrt(2 * R * 2e-6),
           a = rigid ? inlet / 20 : 4 * R * 4e8 / modulus,
           first = how & FILM_EVEN ? -6
                   : rigid         ? -20
                                   : -4,
           last = how & FILM_EVEN ? 6
                  : rigid         ? 2
                                  : 1.5;
    c->contact = (ff_film_contact){.size = sizeof c->contact,
                                   .nodes = FILM_NODES,
                                   .dx = a * (last - first) / (FILM_NODES - 1),
                                   .first = a * first,
                                   .half_width = a,
                                   .pressure = rigid ? 1e6 : 4e8,
                                   .modulus = modulus,
                                   .tolerance = 1e-9,
                                   .order = 2,
                                   .viscosity = &c->viscosity,
                                   .density = &c->density,
                                   .rheology = how & FILM_FLUID ? &c->rheology : NULL};
    c->instant = (ff_film_instant){.size = sizeof c->instant,
                                   .entrainment = 2,
                                   .sliding = 0.5,
                                   .radius = R,
                                   .loaded = 1,
                                   .load = pi * a * 4e8 / 2};
}

/* Sets the initial pressure to a semi-ellipse: for elastic flanks the Hertz pressure, for rigid
   flanks a low pressure of the same shape. */
static void guess(film_case *c)
{
    for (size_t i = 0; i < FILM_NODES; i++) {
        double x = (c->contact.first + (double)i * c->contact.dx) / c->contact.half_width;
        c->p[i] = i && i + 1 < FILM_NODES ? c->contact.pressure * sqrt(fmax(0, 1 - x * x)) : 0;
        c->v[i] = c->past[i] = c->content[i] = 0;
        c->full[i] = i && i + 1 < FILM_NODES;
    }
    c->state = (ff_film_state){.size = sizeof c->state,
                               .p = c->p,
                               .v = c->v,
                               .h00 = 5e-7,
                               .full = c->full,
                               .content = c->content};
}

bool film_case_open(film_case *c, const ff_fixture *fixture, unsigned how)
{
    *c = (film_case){.fixture = fixture};
    c->film = conformance_open_law(fixture, FF_FILM_ID, &c->model);
    if (!c->film) {
        fixture->close(fixture->ctx, c->model);
        return false;
    }
    double **arrays[] = {&c->p, &c->v, &c->past, &c->content};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        *arrays[i] = fixture->numbers(fixture->ctx, FILM_NODES);
    set_up(c, how);
    guess(c);
    fixture->step(fixture->ctx, "open");
    if (c->film->open(c->film->self, &c->contact, &c->solver) == FF_OK)
        return true;
    ff_check_failf(fixture,
                   "open refuses a smooth contact of %d nodes without a cavitation model: %s",
                   FILM_NODES, fixture->why(fixture->ctx, c->model));
    c->solver = NULL;
    film_case_close(c);
    return false;
}

bool film_case_solve(film_case *c)
{
    c->fixture->step(c->fixture->ctx, "solve");
    ff_status status = c->film->solve(c->solver, &c->instant, &c->state);
    if (status != FF_OK)
        return ff_check_failf(c->fixture, "solve gave the status %d for a smooth contact", status);
    for (size_t i = 0; i < FILM_NODES; i++)
        if (!(c->p[i] >= 0) || !isfinite(c->p[i]) || !isfinite(c->v[i]))
            return ff_check_failf(c->fixture, "p is %g Pa and v %g m at node %zu of %d", c->p[i],
                                  c->v[i], i, FILM_NODES);
    const double *arrays[] = {c->p, c->v, c->past, c->content};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        if (!c->fixture->is_intact(c->fixture->ctx, arrays[i], FILM_NODES))
            return ff_check_failf(c->fixture, "solve wrote outside of an array of %d nodes",
                                  FILM_NODES);
    return true;
}

void film_case_close(film_case *c)
{
    c->fixture->step(c->fixture->ctx, "close");
    c->film->close(c->solver);
    c->fixture->close(c->fixture->ctx, c->model);
}

double film_case_gap(const film_case *c, size_t node)
{
    double x = c->contact.first + (double)node * c->contact.dx;
    return c->state.h00 + x * x / (2 * c->instant.radius) + c->state.v[node];
}

double film_case_load(const film_case *c)
{
    double sum = 0;
    for (size_t i = 0; i < FILM_NODES; i++)
        sum += c->state.p[i] * c->contact.dx;
    return sum;
}

double film_case_flow(const film_case *c, size_t node)
{
    double h = (film_case_gap(c, node) + film_case_gap(c, node - 1)) / 2,
           p = (c->state.p[node] + c->state.p[node - 1]) / 2,
           slope = (c->state.p[node] - c->state.p[node - 1]) / c->contact.dx;
    return c->rho *
           (c->instant.entrainment * h - h * h * h / (12 * c->eta * exp(c->alpha * p)) * slope);
}

bool film_case_near(const film_case *c, const char *what, size_t node, double value,
                    double expected, double scale, double tolerance)
{
    return fabs(value - expected) <= tolerance * fabs(scale) ||
           ff_check_failf(
               c->fixture,
               "%s is %.6g at node %zu, but must be %.6g (R = %g m, u = %g m/s, eta0 = %g Pa s, E' "
               "= %g Pa, %d nodes that begin at x = %.4g m, %.4g m apart)",
               what, value, node, expected, c->instant.radius, c->instant.entrainment, c->eta,
               c->contact.modulus, FILM_NODES, c->contact.first, c->contact.dx);
}
