/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "reynolds.h"

#include "../contact/simd-reductions.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns the next array of the block of memory. */
static double *next_array(double **next, size_t nodes)
{
    double *array = *next;
    *next += nodes;
    return array;
}

ff_status ehl_reynolds_create(ehl_reynolds *r, const ehl_grid *g, const ehl_laws *laws,
                              const ehl_oil *oil, int wedge)
{
    enum { OWN = 20 };
    size_t n = g->nodes;
    *r = (ehl_reynolds){.nodes = n, .dx = g->dx, .wedge = wedge, .laws = *laws, .oil = *oil};
    r->floor = 1e-12;
    double *next = r->memory =
        calloc((OWN + EHL_LIQUID_ARRAYS + 2 * (size_t)EHL_STENCIL) * n, sizeof *next);
    if (!next)
        return FF_NOMEM;
    double **own[OWN] = {&r->half_square, &r->h,           &r->thick,     &r->mass,
                         &r->f,           &r->f_p,         &r->f_h,       &r->flux,
                         &r->residual,    &r->mean,        &r->mean_left, &r->mean_right,
                         &r->pinch_left,  &r->pinch_right, &r->carried,   &r->fluid,
                         &r->p_a,         &r->p_a_h,       &r->spare_p_a, &r->spare_p_a_h};
    for (size_t k = 0; k < OWN; k++)
        *own[k] = next_array(&next, n);
    ehl_liquid *q = &r->liquid;
    double **liquid[EHL_LIQUID_ARRAYS] = {&q->rho, &q->rho_p, &q->ln_eta, &q->ln_eta_p,
                                          &q->psi, &q->psi_l, &q->psi_h,  &q->psi_p};
    for (size_t k = 0; k < EHL_LIQUID_ARRAYS; k++)
        *liquid[k] = next_array(&next, n);
    for (size_t k = 0; k < EHL_STENCIL; k++) {
        r->by_p[k] = next_array(&next, n);
        r->by_h[k] = next_array(&next, n);
    }
    ehl_reynolds_place(r, g->first);
    return FF_OK;
}

void ehl_reynolds_destroy(ehl_reynolds *r)
{
    free(r->memory);
    r->memory = NULL;
}

void ehl_reynolds_place(ehl_reynolds *r, double first)
{
    r->first = first;
    for (size_t i = 0; i < r->nodes; i++) {
        double x = first + (double)i * r->dx;
        r->half_square[i] = x * x / 2;
    }
}

double ehl_film_load(const ehl_film *film, size_t nodes, double dx)
{
    return ehl_sum(nodes, film->p) * dx + film->ahead;
}

/* Fills h = h00 + x^2/2 curvature + v. */
FF_SIMD
static void add_gaps(size_t n, double h00, double curvature, const double *restrict half_square,
                     const double *restrict v, double *restrict h)
{
    for (size_t i = 0; i < n; i++)
        h[i] = h00 + half_square[i] * curvature + v[i];
}

void ehl_reynolds_gap(ehl_reynolds *r, double radius, const ehl_film *film)
{
    add_gaps(r->nodes, film->h00, 1 / radius, r->half_square, film->v, r->h);
    if (r->statistical.law) {
        r->law_status = ehl_statistical_pressure(&r->statistical, r->nodes, r->h, film->p, r->p_a,
                                                 r->p_a_h, r->fluid);
        r->touching = ehl_greatest(r->nodes, r->p_a, 0) > 0;
    }
    if (!r->rough)
        return;
    for (size_t i = 0; i < r->nodes; i++)
        r->h[i] -= r->rough[i];
    for (size_t i = 0; film->plastic && i < r->nodes; i++)
        r->h[i] += film->plastic[i];
    size_t end = r->nodes - 1; /* the domain ends where asperities do not reach the other flank, so
                                  p_a is 0 at its ends */
    r->h[0] = fmax(r->h[0], r->contact);
    r->h[end] = fmax(r->h[end], r->contact);
}

const double *ehl_fluid_of(const ehl_reynolds *r, const ehl_film *film, const double *h,
                           double *room)
{
    if (!r->statistical.law)
        return film->p;
    ehl_statistical_pressure(&r->statistical, r->nodes, h, film->p, r->spare_p_a, r->spare_p_a_h,
                             room);
    return room;
}

/* Returns the last node that pressure can reach: one downstream of the last node that is full or
   whose asperities touch. */
static size_t last_node(const ehl_reynolds *r, const ehl_film *film)
{
    size_t i = r->nodes - 1;
    while (!r->conserving && !r->rough && i > 1 && !film->full[i - 1] &&
           !(r->statistical.law && r->p_a[i - 1] > 0))
        i--;
    return i;
}

FF_SIMD
static void multiply(size_t n, const double *restrict a, const double *restrict b,
                     double *restrict product)
{
    for (size_t i = 0; i < n; i++)
        product[i] = a[i] * b[i];
}

static void masses(ehl_reynolds *r, const ehl_film *film, size_t count)
{
    multiply(count, r->liquid.rho, r->h, r->mass);
    for (size_t i = count; i < r->nodes; i++)
        r->mass[i] = r->oil.density * r->h[i] * (r->swell ? r->swell[i] : 1);
    for (size_t i = 1; r->conserving && i + 1 < r->nodes; i++)
        r->mass[i] = film->full[i] ? r->mass[i] : film->content[i];
}

FF_SIMD
static void scale(size_t n, const double *restrict by, double *restrict value)
{
    for (size_t i = 0; i < n; i++)
        value[i] *= by[i];
}

void ehl_reynolds_mass(ehl_reynolds *r, const ehl_film *film)
{
    size_t count = last_node(r, film) + 1;
    ff_status status = r->laws.density->eval(r->laws.density->self, count, ehl_fluid(r, film), NULL,
                                             r->liquid.rho, NULL, NULL);
    if (status != FF_OK)
        r->law_status = status;
    if (r->swell)
        scale(count, r->swell, r->liquid.rho);
    masses(r, film, count);
}

/* Applies the factors of the heated film, which are treated as independent of p and h. */
static void ease_flow(ehl_reynolds *r, size_t count)
{
    const ehl_liquid *q = &r->liquid;
    if (r->swell) {
        scale(count, r->swell, q->rho);
        scale(count, r->swell, q->rho_p);
    }
    scale(count, r->ease, q->psi);
    scale(count, r->ease, q->psi_l);
    scale(count, r->ease, q->psi_p);
    scale(count, r->ease, q->psi_h);
}

FF_SIMD
static void mobility(ehl_reynolds *r, size_t count)
{
    const ehl_liquid *q = &r->liquid;
    const double *restrict rho = q->rho, *restrict rho_p = q->rho_p, *restrict psi = q->psi;
    const double *restrict psi_l = q->psi_l, *restrict psi_h = q->psi_h, *restrict gap = r->h;
    const double *restrict psi_p = q->psi_p, *restrict ln_eta_p = q->ln_eta_p,
                           *restrict thick = r->thick, floor = r->floor;
    double *restrict f = r->f, *restrict f_p = r->f_p, *restrict f_h = r->f_h;
    FF_SIMD_LOOP
    for (size_t i = 0; i < count; i++) {
        double h = thick[i], square = h * h / 12;
        double open = gap[i] > floor ? 1 : 0; /* where the floor applies, the mobility does not
                                                 depend on h */
        f[i] = rho[i] * h * square * psi[i];
        f_p[i] =
            h * square * (rho_p[i] * psi[i] + rho[i] * psi_l[i] * ln_eta_p[i] + rho[i] * psi_p[i]);
        f_h[i] = open * square * rho[i] * (3 * psi[i] + h * psi_h[i]);
    }
}

/* Mobility of the face after node i. f decreases exponentially with p. The geometric mean G is
   suitable for a resolved inlet. The arithmetic mean A keeps a face open where f drops by decades,
   at a pressure spike. With s = (G/A)^2 the mean A (1 - s (1 - s)/2) equals G to second order for s
   near 1, and A for s near 0. */
FF_SIMD
static void face_mobilities(ehl_reynolds *r)
{
    const double *restrict f = r->f;
    double *restrict all = r->mean, *restrict by_left = r->mean_left;
    double *restrict by_right = r->mean_right;
    for (size_t i = 0, last = r->last; i < last; i++) {
        double a = f[i], b = f[i + 1], mean = 0.5 * (a + b), inverse = 1 / mean;
        double per = mean > 0 ? inverse : 0;
        double left = a * per, right = b * per, s = left * right;
        double share = 1 - 0.5 * s * (1 - s), slope = s - 0.5;
        all[i] = mean * share;
        by_left[i] = 0.5 * share + slope * (right - s);
        by_right[i] = 0.5 * share + slope * (left - s);
    }
}

/* Mobility of a face between rough flanks, h^3 times rho psi/12. The logarithmic mean of rho psi is
   used: it is the mean over the pressures between both nodes if psi decreases exponentially with p.
   The flow then increases with any pressure difference, even a large one. The mean of h^3 is
   M^(1/3) N^(2/3). M = 2/(h^-3 + h'^-3) holds for two channels in series, and N = 2 (h h')^2/(h +
   h') for a gap that widens linearly. Next to a wide gap the mean is 2 h^3 (h'/h)^(2/3), within 8 %
   of the mean for a gap that opens in proportion to x^(3/2) upstream of an elastic contact. The
   flow out of inlets is therefore correct even if the cells do not resolve the inlets. */
FF_SIMD
static void rough_face_mobilities(ehl_reynolds *r)
{
    const double *restrict f = r->f, *restrict thick = r->thick, *restrict h = r->h;
    double *restrict all = r->mean, *restrict by_left = r->mean_left, floor = r->floor;
    double *restrict by_right = r->mean_right, *restrict pinch_left = r->pinch_left;
    double *restrict pinch_right = r->pinch_right;
    FF_SIMD_LOOP
    for (size_t i = 0, last = r->last; i < last; i++) {
        double x = thick[i], y = thick[i + 1], a = x * x * x, b = y * y * y;
        double ea = f[i] / a, eb = f[i + 1] / b;
        ea = ea > 1e-200 ? ea : 1e-200;
        eb = eb > 1e-200 ? eb : 1e-200;
        /* if both are nearly equal, the difference would suffer from cancellation, so a series is
           used */
        double t = ff_log(ea / eb), size = fabs(t), grown = 1 + t * t / 24;
        double alike = eb * (1 + t / 2 * (1 + t / 3 * (1 + t / 4 * (1 + t / 5 * (1 + t / 6)))));
        double root = alike / grown, alike_a = root * (grown / 2 + t / 12) / ea;
        double alike_b = root * (grown / 2 - t / 12) / eb;
        double apart = (ea - eb) / t, apart_a = (1 - apart / ea) / t,
               apart_b = (apart / eb - 1) / t;
        double fluidity = size < 1e-2 ? alike : apart, la = size < 1e-2 ? alike_a : apart_a;
        double lb = size < 1e-2 ? alike_b : apart_b;
        double cubes = 1 / (a + b), sum = 1 / (x + y), product = x * y;
        double gap = 2 * product * product * ff_exp(ff_log(product * cubes * sum * sum) / 3);
        double ga = gap * (7 / (3 * x) - x * x * cubes - 2 * sum / 3);
        double gb = gap * (7 / (3 * y) - y * y * cubes - 2 * sum / 3);
        double left = gap * la / a, right = gap * lb / b;
        all[i] = gap * fluidity;
        by_left[i] = left;
        by_right[i] = right;
        double by_x = ga * fluidity - 3 * x * x * ea * left;
        double by_y = gb * fluidity - 3 * y * y * eb * right;
        pinch_left[i] = h[i] > floor ? by_x : 0;
        pinch_right[i] = h[i + 1] > floor ? by_y : 0;
    }
}

/* Adds u times the mass transported through each face, near m(i) + far m(i-1), with the same
   weights for all faces. */
FF_SIMD
static void add_wedge(size_t from, size_t faces, double u, double near, double far,
                      const double *restrict m, double *restrict flux)
{
    for (size_t i = from; i < faces; i++)
        flux[i] = -u * (near * m[i] + far * m[i - 1]);
}

FF_SIMD
static void add_pressure_flow(size_t count, double per_dx, const double *restrict mean,
                              const double *restrict p, double *restrict flux)
{
    for (size_t i = 0; i < count; i++)
        flux[i] += per_dx * mean[i] * (p[i + 1] - p[i]);
}

static void fluxes(ehl_reynolds *r, const ehl_step *step, const ehl_film *film)
{
    const double *m = r->carry ? r->carried : r->mass;
    const double u = step->follows ? 0 : step->entrainment;
    const size_t faces = r->nodes - 1;
    double near, far;
    r->flux[0] = -u * (r->wedge == 2 ? 0.5 * (m[0] + m[1]) : m[0]);
    for (size_t i = 1; r->conserving && i < faces; i++) {
        ehl_upwind(r, film, i, &near, &far);
        r->flux[i] = -u * (near * m[i] + far * m[i - 1]);
    }
    if (!r->conserving) {
        ehl_upwind(r, film, 1, &near, &far);
        add_wedge(1, faces, u, near, far, m, r->flux);
    }
    for (size_t i = 0; step->follows && r->carry && i < faces; i++)
        r->flux[i] -= step->entrainment / 2 *
                      ((r->carried[i] - r->mass[i]) + (r->carried[i + 1] - r->mass[i + 1]));
    add_pressure_flow(r->last, 1 / r->dx, r->mean, ehl_fluid(r, film), r->flux);
}

/* Balances nodes 1 to n - 2: inflow minus outflow minus storage. */
FF_SIMD
static void balance(size_t n, double dx, double rate, const double *restrict flux,
                    const double *restrict mass, const double *restrict past,
                    double *restrict residual)
{
    for (size_t i = 1; i + 1 < n; i++)
        residual[i] = flux[i] - flux[i - 1] - dx * (rate * mass[i] + past[i]);
}

/* Computes the loss of mass of nodes 1 to n - 2 from the masses and the mobilities of the faces. */
static void balances(ehl_reynolds *r, const ehl_step *step, const ehl_film *film)
{
    const size_t n = r->nodes;
    const double *p = ehl_fluid(r, film);
    fluxes(r, step, film);
    if (step->past)
        balance(n, r->dx, step->rate, r->flux, r->mass, step->past, r->residual);
    for (size_t i = 1; !step->past && i + 1 < n; i++)
        r->residual[i] = r->flux[i] - r->flux[i - 1];
    for (size_t i = 1; r->leak > 0 && i + 1 < n; i++)
        r->residual[i] -= r->dx * r->leak * r->f[i] * p[i];
}

void ehl_reynolds_evaluate(ehl_reynolds *r, const ehl_step *step, const ehl_film *film)
{
    ehl_reynolds_gap(r, step->radius, film);
    r->last = last_node(r, film);
    size_t count = r->last + 1;
    for (size_t i = 0; i < count; i++)
        r->thick[i] = r->h[i] > r->floor ? r->h[i] : r->floor;
    const double *p = ehl_fluid(r, film);
    ff_status contact = r->statistical.law ? r->law_status : FF_OK;
    r->law_status = ehl_fluid_evaluate(&r->laws, count, p, r->thick, step->sliding, &r->liquid);
    if (r->law_status == FF_OK)
        r->law_status = contact;
    if (r->ease)
        ease_flow(r, count);
    masses(r, film, count);
    if (r->carry)
        multiply(r->nodes, r->mass, r->carry, r->carried);
    mobility(r, count);
    if (r->rough)
        rough_face_mobilities(r);
    else
        face_mobilities(r);
    if (r->asymmetric)
        ehl_asymmetric_balance(r, step, film);
    else
        balances(r, step, film);
}

void ehl_reynolds_turned(ehl_reynolds *r, const ehl_step *step, const ehl_film *film)
{
    if (!r->conserving ||
        r->asymmetric) { /* the set of nodes that pressure reaches may have changed */
        ehl_reynolds_evaluate(r, step, film);
        return;
    }
    masses(r, film, r->last + 1);
    if (r->carry)
        multiply(r->nodes, r->mass, r->carry, r->carried);
    balances(r, step, film);
}

/* Computes the stencil of the wedge and of the change in time, in rho h. */
static void transport_stencil(const ehl_reynolds *r, const ehl_step *step, const ehl_film *film,
                              size_t i, double *c)
{
    double u = step->follows ? 0 : step->entrainment;
    double near, far, near_before = 1, far_before = 0;
    ehl_upwind(r, film, i, &near, &far);
    if (i > 1)
        ehl_upwind(r, film, i - 1, &near_before, &far_before);
    else if (r->wedge == 2) /* the face downstream of the first node has only one node upstream */
        near = 1, far = 0;
    c[0] = u * far_before;
    c[1] = u * (near_before - far);
    c[2] = -u * near - r->dx * step->rate;
}

/* Writes the column of a cavitated node, whose unknown is its mass instead of the pressure. */
static void cavitated_column(ehl_reynolds *r, size_t i, size_t s, double c, double mass_by_h)
{
    r->by_p[s][i] = c * r->unit;
    r->by_h[s][i] -= c * mass_by_h;
}

/* Adds the derivatives of faces with an abrupt change of the gap, and of the side flow. */
FF_SIMD
static void add_pinched_flow(ehl_reynolds *r, const ehl_film *film)
{
    const double *restrict p = film->p, *restrict left = r->pinch_left;
    const double *restrict right = r->pinch_right, *restrict f = r->f, *restrict f_p = r->f_p;
    const double *restrict f_h = r->f_h;
    const unsigned char *restrict full = film->full;
    double *restrict p2 = r->by_p[2], *restrict h1 = r->by_h[1], *restrict h2 = r->by_h[2];
    double *restrict h3 = r->by_h[3];
    const double per_dx = 1 / r->dx, all = r->conserving ? 1 : 0, leak = r->dx * r->leak;
    FF_SIMD_LOOP
    for (size_t i = 1, last = r->last; i < last; i++) {
        double here = (all + (1 - all) * full[i]) * per_dx, side = full[i] * leak;
        double up = here * (p[i + 1] - p[i]), down = here * (p[i] - p[i - 1]);
        h1[i] -= down * left[i - 1];
        h2[i] += up * left[i] - down * right[i - 1] - side * f_h[i] * p[i];
        h3[i] += up * right[i];
        p2[i] -= side * (f[i] + f_p[i] * p[i]);
    }
}

/* Adds the mass that the flanks transport in addition to u_r rho h to the columns of the wedge. If
   the nodes move with the oil, the mass through a face is the mean of both nodes. */
static void add_carried(ehl_reynolds *r, const ehl_step *step, const ehl_film *film)
{
    for (size_t i = 1; i < r->last; i++) {
        double c[EHL_STENCIL], rest = r->dx * step->rate;
        if (!film->full[i] && !r->conserving)
            continue;
        transport_stencil(r, step, film, i, c);
        c[2] += rest;
        c[1] += step->follows ? step->entrainment / 2 : 0;
        c[3] = step->follows ? -step->entrainment / 2 : 0;
        for (size_t s = i > 1 ? 0 : 1; s < EHL_STENCIL; s++) {
            size_t k = i + s - 2;
            double more = c[s] * (r->carry[k] - 1);
            if (!ehl_is_cavitated(r, film, k)) {
                r->by_p[s][i] += more * r->liquid.rho_p[k] * r->h[k];
                r->by_h[s][i] += more * r->liquid.rho[k];
            }
        }
    }
}

/* Fills rows from ... to - 1, which share the transport stencil c. `back` is the number of nodes by
   which the stencil extends upstream; in row 1, with only one node upstream, it is 1. */
FF_SIMD
static void slopes_of_rows(ehl_reynolds *r, const ehl_film *film, const double c[3], size_t back,
                           size_t from, size_t to)
{
    const double *restrict p = ehl_fluid(r, film), *restrict rho = r->liquid.rho;
    const double *restrict h = r->h;
    const double *restrict rho_p = r->liquid.rho_p, *restrict mean = r->mean;
    const double *restrict mean_left = r->mean_left, *restrict mean_right = r->mean_right;
    const double *restrict f_p = r->f_p, *restrict f_h = r->f_h;
    const unsigned char *restrict full = film->full;
    double *restrict p0 = r->by_p[0], *restrict p1 = r->by_p[1], *restrict p2 = r->by_p[2];
    double *restrict p3 = r->by_p[3], *restrict h0 = r->by_h[0], *restrict h1 = r->by_h[1];
    double *restrict h2 = r->by_h[2], *restrict h3 = r->by_h[3];
    const double c0 = c[0], c1 = c[1], c2 = c[2], per_dx = 1 / r->dx, all = r->conserving ? 1 : 0;
    FF_SIMD_LOOP
    for (size_t i = from; i < to; i++) {
        double on = all + (1 - all) * full[i], here = on * per_dx;
        double up = here * (p[i + 1] - p[i]), down = here * (p[i] - p[i - 1]);
        double up_here = up * mean_left[i], up_next = up * mean_right[i];
        double down_before = down * mean_left[i - 1], down_here = down * mean_right[i - 1];
        p0[i] = on * c0 * (rho_p[i - back] * h[i - back]);
        p1[i] = here * mean[i - 1] - down_before * f_p[i - 1] + on * c1 * rho_p[i - 1] * h[i - 1];
        p2[i] = (up_here - down_here) * f_p[i] - here * (mean[i - 1] + mean[i]) +
                on * c2 * rho_p[i] * h[i];
        p3[i] = here * mean[i] + up_next * f_p[i + 1];
        h0[i] = on * c0 * rho[i - back];
        h1[i] = -down_before * f_h[i - 1] + on * c1 * rho[i - 1];
        h2[i] = (up_here - down_here) * f_h[i] + on * c2 * rho[i];
        h3[i] = up_next * f_h[i + 1];
    }
}

/* Writes the columns of cavitated nodes into row i. */
static void cavitated_columns(ehl_reynolds *r, const ehl_step *step, const ehl_film *film, size_t i)
{
    double c[EHL_STENCIL] = {0};
    transport_stencil(r, step, film, i, c);
    for (size_t s = i > 1 ? 0 : 1; s < EHL_STENCIL; s++)
        if (ehl_is_cavitated(r, film, i + s - 2))
            cavitated_column(r, i, s, c[s], r->liquid.rho[i + s - 2]);
}

/* Returns the end of the run of rows, starting at `from`, that share the transport stencil of row
   `from`. */
static size_t end_of_alike(const ehl_reynolds *r, const ehl_film *film, size_t from)
{
    enum { OWN = 3 }; /* rows before OWN have individual stencils */
    size_t to = from + 1;
    if (from < OWN)
        return to;
    if (!r->conserving || r->wedge == 1) /* ehl_upwind does not depend on the node then */
        return r->last;
    int here = ehl_is_cavitated(r, film, from - 1), before = ehl_is_cavitated(r, film, from - 2);
    while (to < r->last && ehl_is_cavitated(r, film, to - 1) == here &&
           ehl_is_cavitated(r, film, to - 2) == before)
        to++;
    return to;
}

void ehl_reynolds_slopes(ehl_reynolds *r, const ehl_step *step, const ehl_film *film)
{
    double c[EHL_STENCIL];
    for (size_t from = 1, to; from < r->last; from = to) {
        to = end_of_alike(r, film, from);
        transport_stencil(r, step, film, from, c);
        slopes_of_rows(r, film, c, from > 1 ? 2 : 1, from, to);
    }
    if (r->rough)
        add_pinched_flow(r, film);
    for (size_t i = 1; r->conserving && i < r->last; i++)
        if (!(film->full[i > 1 ? i - 2 : 0] & film->full[i - 1] & film->full[i] &
              film->full[i + 1]))
            cavitated_columns(r, step, film, i);
    if (r->carry)
        add_carried(r, step, film);
}
