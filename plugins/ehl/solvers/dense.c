/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves one instant by Newton's method with a dense Jacobian, assembled face by face, and LAPACK.
   The deflection is a plain double sum. This slow and simple solver is the reference with which the
   fast solver is compared. */
#include "../equations/cavitation.h"
#include "../equations/deflection.h"
#include "../equations/solver.h"

#include <dlfcn.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* LAPACK's solver of `size` equations with `sides` right-hand sides, in place. Matrices are stored
   by columns. */
typedef void dgesv(const int *size, const int *sides, double *matrix, const int *rows, int *pivot,
                   double *rhs, const int *rhs_rows, int *info);

typedef struct dense {
    size_t size;      /* nodes + 1: all pressures, then h00 */
    double *jacobian; /* stored by columns, as LAPACK expects */
    double *rhs, *change;
    int *pivot;
    dgesv *solve;
    ehl_cavitation cavitation;
} dense;

static void deflect(ehl_solver *s, const double *p, double *v)
{
    ehl_kernel_direct(s->grid->nodes, s->kernel, p, v);
    s->counters.convolutions++;
}

static void destroy(ehl_solver *s)
{
    dense *d = s->self;
    if (!d)
        return;
    free(d->jacobian);
    free(d->rhs);
    free(d->change);
    free(d->pivot);
    ehl_cavitation_destroy(&d->cavitation);
    free(d);
    s->self = NULL;
}

/* Adds by_h dh(node)/d(unknowns) + by_p dp(node)/d(unknowns) to a row. */
static void add_gap_and_pressure(const ehl_solver *s, const ehl_film *film, size_t row, size_t node,
                                 double by_p, double by_h)
{
    dense *d = s->self;
    size_t nodes = s->grid->nodes;
    double *j = d->jacobian + row;
    if (!ehl_is_cavitated(s->reynolds, film, node))
        j[node * d->size] += by_p;
    for (size_t k = 0; k < nodes; k++)
        if (!ehl_is_cavitated(s->reynolds, film, k))
            j[k * d->size] += by_h * s->kernel[node > k ? node - k : k - node];
    j[nodes * d->size] += by_h;
}

/* Adds factor d(rho h)(node) to a row. */
static void add_mass(const ehl_solver *s, const ehl_film *film, size_t row, size_t node,
                     double factor)
{
    dense *d = s->self;
    const ehl_reynolds *r = s->reynolds;
    if (ehl_is_cavitated(r, film, node))
        d->jacobian[node * d->size + row] += factor * r->unit;
    else
        add_gap_and_pressure(s, film, row, node, factor * r->liquid.rho_p[node] * r->h[node],
                             factor * r->liquid.rho[node]);
}

/* Adds `sign` times the flux through the face after node i to a row. */
static void add_face(const ehl_solver *s, const ehl_step *step, const ehl_film *film, size_t row,
                     size_t i, double sign)
{
    const ehl_reynolds *r = s->reynolds;
    size_t n = r->nodes;
    double u = sign * step->entrainment, near = 1, far = 0;
    if (i < r->last && i + 1 < n) { /* no pressure flow downstream of the last full node */
        double rise = sign * (film->p[i + 1] - film->p[i]) / r->dx;
        double left = rise * r->mean_left[i], right = rise * r->mean_right[i];
        double mean = sign * r->mean[i] / r->dx;
        add_gap_and_pressure(s, film, row, i, left * r->f_p[i] - mean, left * r->f_h[i]);
        add_gap_and_pressure(s, film, row, i + 1, right * r->f_p[i + 1] + mean,
                             right * r->f_h[i + 1]);
    }
    if (i > 0) {
        ehl_upwind(r, film, i, &near, &far);
        add_mass(s, film, row, i - 1, -u * far);
    } else if (r->wedge == 2) {
        near = 0.5;
        add_mass(s, film, row, 1, -u * near);
    }
    add_mass(s, film, row, i, -u * near);
}

static void assemble(const ehl_solver *s, const ehl_step *step, const ehl_film *film)
{
    dense *d = s->self;
    const ehl_reynolds *r = s->reynolds;
    size_t n = r->nodes, size = d->size;
    memset(d->jacobian, 0, size * size * sizeof *d->jacobian);
    for (size_t i = 0; i < n; i++) {
        if (!film->full[i] && !ehl_is_cavitated(r, film, i)) {
            d->jacobian[i * size + i] = 1;
            d->rhs[i] = (i == 0 ? step->feed : 0) - film->p[i];
            continue;
        }
        double squeeze = r->dx * step->rate;
        add_face(s, step, film, i, i, 1);
        add_face(s, step, film, i, i - 1, -1);
        add_mass(s, film, i, i, -squeeze);
        d->rhs[i] = -r->residual[i];
    }
    for (size_t k = 0; k < n && step->loaded; k++)
        d->jacobian[k * size + n] = ehl_is_cavitated(r, film, k) ? 0 : r->dx;
    if (!step->loaded)
        d->jacobian[n * size + n] = 1;
    d->rhs[n] = step->loaded ? step->load - ehl_film_load(film, n, r->dx) : 0;
}

/* Scales each row by its largest entry, since rows have different units. */
static void scale_rows(dense *d)
{
    for (size_t i = 0; i < d->size; i++) {
        double most = 0;
        for (size_t k = 0; k < d->size; k++)
            most = fmax(most, fabs(d->jacobian[k * d->size + i]));
        for (size_t k = 0; k < d->size && most > 0; k++)
            d->jacobian[k * d->size + i] /= most;
        d->rhs[i] /= most > 0 ? most : 1;
    }
}

/* Applies the full change of the masses of cavitated nodes, and removes these changes from the step
   of the pressures. */
static void apply_mass_changes(dense *d, const ehl_reynolds *r, ehl_film *film, double *dh)
{
    for (size_t i = 1; i + 1 < r->nodes; i++)
        if (ehl_is_cavitated(r, film, i)) {
            double change = r->unit * d->rhs[i];
            film->content[i] = fmax(0, film->content[i] + change);
            *dh = fmax(*dh, fabs(change) / (r->oil.density * r->thick[i]));
            d->rhs[i] = 0;
        }
}

static ff_status solve(ehl_solver *s, const ehl_step *step, ehl_film *film, int limit)
{
    dense *d = s->self;
    ehl_reynolds *r = s->reynolds;
    size_t n = r->nodes;
    const int size = (int)d->size, sides = 1;
    ehl_cavitation_begin(&d->cavitation, n);
    film->ahead = step->ahead - step->feed * r->dx / 2;
    for (int k = 0; k < limit; k++) {
        s->counters.newton++;
        ehl_reynolds_evaluate(r, step, film);
        if (r->conserving ? ehl_cavitation_fill(&d->cavitation, r, film, step->rate > 0)
                          : ehl_cavitation_grow_film(&d->cavitation, r, film))
            ehl_reynolds_evaluate(r, step, film);
        assemble(s, step, film);
        scale_rows(d);
        s->counters.factorisations++;
        int info;
        d->solve(&size, &sides, d->jacobian, &size, d->pivot, d->rhs, &size, &info);
        if (info != 0)
            return FF_NOCONV;
        double dp = 0, dh = 0;
        for (size_t i = 0; i <= n; i++)
            if (!isfinite(d->rhs[i]))
                return FF_NOCONV;
        apply_mass_changes(d, r, film, &dh);
        for (size_t i = 0; i < n; i++)
            dp = fmax(dp, fabs(d->rhs[i]));
        ehl_kernel_direct(n, s->kernel, d->rhs, d->change);
        for (size_t i = 0; i < n; i++)
            d->change[i] += d->rhs[n];
        double share = ehl_step_share(s->grid, r, film, dp, d->change);
        for (size_t i = 0; i < n; i++)
            film->p[i] += share * d->rhs[i];
        film->h00 += share * d->rhs[n];
        double cut = ehl_cavitation_shrink_film(&d->cavitation, r, film, d->rhs);
        deflect(s, film->p, film->v);
        for (size_t i = 0; i < r->last; i++)
            if (film->full[i])
                dh = fmax(dh, fabs(d->change[i]) / r->thick[i]);
        double most = s->tolerance * ehl_pressure_scale(s->grid, film, n);
        if (step->loaded && fabs(ehl_film_load(film, n, r->dx) / step->load - 1) > 1e-9)
            continue; /* a negative pressure was cut off */
        if (share >= 1 && !d->cavitation.split && dp <= most && cut <= most &&
            dh <= (s->reynolds->conserving ? 1 : 10) * s->tolerance)
            return FF_OK;
    }
    return FF_NOCONV;
}

/* Loads LAPACK. Loading takes longer than solving a small film, so only this solver loads it.
   Returns NULL if LAPACK is not installed. */
static dgesv *load_dgesv(void)
{
    dgesv *function = NULL;
    void *library = dlopen(EHL_LAPACK, RTLD_NOW | RTLD_LOCAL);
    if (library)
        *(void **)(void *)&function = dlsym(library, "dgesv_");
    return function;
}

ff_status ehl_dense_newton(ehl_solver *s)
{
    dense *d = s->self = calloc(1, sizeof *d);
    s->solve = solve;
    s->deflect = deflect;
    s->destroy = destroy;
    if (!d)
        return FF_NOMEM;
    d->solve = load_dgesv();
    if (!d->solve) {
        destroy(s);
        return FF_UNSUPPORTED;
    }
    d->size = s->grid->nodes + 1;
    d->jacobian = malloc(d->size * d->size * sizeof *d->jacobian);
    d->rhs = malloc(d->size * sizeof *d->rhs);
    d->change = malloc(d->size * sizeof *d->change);
    d->pivot = malloc(d->size * sizeof *d->pivot);
    if (!d->jacobian || !d->rhs || !d->change || !d->pivot ||
        ehl_cavitation_create(&d->cavitation, s->grid->nodes) != FF_OK) {
        destroy(s);
        return FF_NOMEM;
    }
    return FF_OK;
}
