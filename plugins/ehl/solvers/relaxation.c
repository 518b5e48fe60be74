/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves one instant by line relaxation in semi-system form, with the coefficients of the last
   film. A sweep changes the pressures of the whole line at once. A band matrix contains the
   pressure flow, and the effect of the deflection of nearby nodes on wedge and squeeze (Ai 1993;
   Zhu & Hu 2001: where the pressure flow vanishes the wedge keeps the diagonal large). The
   deflection by all nodes follows by FFT and is used in the next sweep. Anderson acceleration
   replaces the relaxation factors of these authors. A border of the matrix, the balance of the
   load, replaces their search for h00. */
#include "../equations/cavitation.h"
#include "../equations/deflection.h"
#include "../equations/reynolds.h"
#include "../equations/solver.h"
#include "anderson.h"
#include "line.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* SWEEPS: largest number of sweeps with one set of coefficients. The matrix is renewed if a
   solution takes STALE_SWEEPS sweeps more than the first solution with this matrix. */
enum { SWEEPS = 60, STALE_SWEEPS = 2 };

/* Largest number of consecutive alternations of the film boundary between two nodes. In the
   second-order flow at a node, the second node has a coefficient of the wrong sign, so the balances
   behind the pressure maximum do not form an M-matrix. At some nodes no film boundary is then
   consistent: the last full node must not have p < 0, and the cavitated node downstream must not
   gain mass. After MOST_FLIPS alternations the boundary stays at the first of the two nodes. The
   mass that the other node gains is reported in the quality line `complementarity`. The first-order
   flow always has a consistent boundary. */
enum { MOST_FLIPS = 4 };

typedef struct relaxation {
    ehl_fft *fft;
    ehl_line_matrix *matrix;
    ehl_anderson anderson;
    ehl_cavitation cavitation;
    double *memory;
    double *product; /* remaining residual of the balances */
    double *sweep, *change, *pressure, *deflection, *total;
    double *p_step, *v_step, *h_step;
    double missing;           /* missing load over dx */
    int whole;                /* 1: the sweeps of the last solution converged */
    int sweeps, sweeps_fresh; /* number of sweeps of the last solution, and with a new matrix */
    unsigned char *made_full; /* states of the nodes for which the matrix was made */
    int made, made_loaded;
    int flips;              /* consecutive alternations of the film boundary in this solution */
    size_t end, end_before; /* last full node after the last two steps */
    double made_rate;
} relaxation;

static void deflect(ehl_solver *s, const double *p, double *v)
{
    relaxation *w = s->self;
    ehl_fft_apply(w->fft, p, v);
    s->counters.convolutions++;
}

static void destroy(ehl_solver *s)
{
    relaxation *w = s->self;
    if (!w)
        return;
    ehl_fft_destroy(w->fft);
    ehl_line_destroy(w->matrix);
    ehl_anderson_destroy(&w->anderson);
    ehl_cavitation_destroy(&w->cavitation);
    free(w->memory);
    free(w->made_full);
    free(w);
    s->self = NULL;
}

/* Returns the weight of h00 relative to pressures, Pa/m: a uniform pressure on the whole contact
   divided by its deflection. */
static double h00_weight(const ehl_solver *s)
{
    const ehl_grid *g = s->grid;
    return g->dx / (g->half_width * (s->kernel[0] - s->kernel[g->nodes - 1]));
}

/* Subtracts the Jacobian times (dp, dh) from `product` in rows 1 ... last - 1. At cavitated nodes
   dp contains masses. */
static void subtract_jacobian(const ehl_reynolds *r, const double *dp, const double *dh,
                              double *product)
{
    for (size_t i = 1; i < r->last; i++) {
        size_t end =
            i + EHL_STENCIL - EHL_ASYMMETRIC_BEFORE < r->nodes ? EHL_STENCIL : EHL_STENCIL - 1;
        double sum = 0;
        for (size_t s = 0, k = i - EHL_ASYMMETRIC_BEFORE; s < end; s++, k++)
            sum += r->by_p[s][i] * dp[k] + r->by_h[s][i] * dh[k];
        product[i] -= sum;
    }
}

/* Solves the matrix for the residual of the balances. The solution contains pressures, masses of
   cavitated nodes in multiples of `unit`, and at index 0 the change of h00, weighted like a
   pressure. Returns the largest entry. */
static double sweep(ehl_solver *s, const ehl_step *step)
{
    relaxation *w = s->self;
    double h00_change, most = 0;
    ehl_line_solve(w->matrix, w->product, step->loaded ? w->missing : 0, w->sweep, &h00_change);
    w->sweep[0] = h00_change * h00_weight(s);
    for (size_t i = 0; i < s->reynolds->last; i++)
        most = fabs(w->sweep[i]) <= most ? most : fabs(w->sweep[i]);
    return most;
}

/* Adds the change of one sweep to p_step and v_step and updates the residual of the balances. */
static void apply_sweep(ehl_solver *s, const ehl_film *film)
{
    relaxation *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    double h00_change = w->change[0] / h00_weight(s);
    w->pressure[0] = 0;
    for (size_t i = 1; i < r->nodes; i++)
        w->pressure[i] = film->full[i] ? w->change[i] : 0;
    deflect(s, w->pressure, w->deflection);
    for (size_t i = 0; i < r->nodes; i++) {
        w->total[i] += w->change[i];
        w->v_step[i] += w->deflection[i];
        w->deflection[i] += h00_change;
        w->missing -= w->pressure[i];
    }
    w->change[0] = 0;
    subtract_jacobian(r, w->change, w->deflection, w->product);
}

/* Sweeps until a sweep is small compared with the first one. Returns FF_NOCONV if a number
   overflowed. */
static ff_status relax(ehl_solver *s, const ehl_step *step, const ehl_film *film, double reduction)
{
    relaxation *w = s->self;
    size_t n = s->reynolds->nodes;
    memset(w->total, 0, n * sizeof *w->total);
    memset(w->v_step, 0, n * sizeof *w->v_step);
    ehl_anderson_begin(&w->anderson);
    double first = sweep(s, step), now = first;
    for (w->sweeps = 0; w->sweeps < SWEEPS && isfinite(now); w->sweeps++) {
        ehl_anderson_step(&w->anderson, w->total, w->sweep, w->change);
        apply_sweep(s, film);
        s->counters.krylov++;
        now = sweep(s, step);
        if (now <= reduction * first)
            break;
    }
    w->whole = now <= reduction * first;
    return isfinite(now) ? FF_OK : FF_NOCONV;
}

/* Renews the matrix if the film boundary or the time step has changed, or if the old matrix takes
   too many sweeps. */
static void update_matrix(ehl_solver *s, const ehl_step *step, const ehl_film *film)
{
    relaxation *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    int fits = w->made && w->made_loaded == step->loaded &&
               w->sweeps <= w->sweeps_fresh + STALE_SWEEPS &&
               fabs(step->rate - w->made_rate) <= 0.2 * w->made_rate &&
               memcmp(w->made_full, film->full, r->nodes) == 0;
    if (fits)
        return;
    ehl_line_factor(w->matrix, r, film, step->loaded);
    memcpy(w->made_full, film->full, r->nodes);
    w->made = 1;
    w->made_loaded = step->loaded;
    w->made_rate = step->rate;
    w->sweeps_fresh = -1;
    s->counters.factorisations++;
}

/* Solves the linearised balances by relaxation, for p_step, v_step and the change *dh00 of h00. */
static ff_status linear_step(ehl_solver *s, const ehl_step *step, ehl_film *film, double *dh00)
{
    relaxation *w = s->self;
    ehl_reynolds *r = s->reynolds;
    s->counters.newton++;
    ehl_reynolds_evaluate(r, step, film);
    if (r->conserving            ? ehl_cavitation_fill(&w->cavitation, r, film, step->rate > 0)
        : w->flips >= MOST_FLIPS ? 0
                                 : ehl_cavitation_grow_film(&w->cavitation, r, film))
        ehl_reynolds_evaluate(r, step, film);
    ehl_asymmetric_slopes(r, step, film);
    update_matrix(s, step, film);
    for (size_t i = 1; i < r->last; i++)
        w->product[i] = film->full[i] || r->conserving ? -r->residual[i] : 0;
    w->missing = (step->load - ehl_film_load(film, r->nodes, r->dx)) / r->dx;
    if (relax(s, step, film, s->tolerance < 1e-6 ? 1e-3 : 5e-2) != FF_OK)
        return FF_NOCONV;
    if (w->sweeps_fresh < 0)
        w->sweeps_fresh = w->sweeps;
    *dh00 = w->total[0] / h00_weight(s);
    return FF_OK;
}

/* The largest change of the pressure, and the largest relative change of the film. */
typedef struct size {
    double dp, dh;
} size;

static size measure_step(const ehl_solver *s, const ehl_film *film, double dh00)
{
    relaxation *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    size most = {0};
    for (size_t i = 0; i < r->nodes; i++)
        w->p_step[i] = i > 0 && film->full[i] ? w->total[i] : 0;
    for (size_t i = 1; i < r->last; i++) {
        double filled = w->total[i] * r->unit / r->oil.density;
        w->h_step[i] = w->v_step[i] + dh00;
        double dh = ehl_is_cavitated(r, film, i) ? filled : w->h_step[i];
        most.dp = fmax(most.dp, fabs(w->p_step[i]));
        if (film->full[i] || r->conserving)
            most.dh = fmax(most.dh, fabs(dh) / r->thick[i]);
    }
    return most;
}

static void apply_step(const ehl_solver *s, ehl_film *film, double share, double dh00)
{
    const relaxation *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    for (size_t i = 1; r->conserving && i < r->last; i++)
        if (ehl_is_cavitated(r, film, i))
            film->content[i] = fmax(0, film->content[i] + share * r->unit * w->total[i]);
    for (size_t i = 0; i < r->nodes; i++) {
        film->p[i] += share * w->p_step[i];
        film->v[i] += share * w->v_step[i];
    }
    film->h00 += share * dh00;
}

static void watch_film_boundary(relaxation *w, const ehl_film *film, size_t nodes)
{
    size_t end = nodes - 1;
    while (end > 0 && !film->full[end])
        end--;
    if (end == w->end_before && end != w->end)
        w->flips++;
    else if (w->flips < MOST_FLIPS)
        w->flips = 0;
    w->end_before = w->end;
    w->end = end;
}

static ff_status solve(ehl_solver *s, const ehl_step *step, ehl_film *film, int limit)
{
    relaxation *w = s->self;
    size_t n = s->grid->nodes;
    ehl_cavitation_begin(&w->cavitation, n);
    ehl_rescale_to_load(s, step, film);
    w->flips = 0;
    w->end = w->end_before = n;
    for (int k = 0; k < limit; k++) {
        double dh00;
        if (linear_step(s, step, film, &dh00) != FF_OK)
            break;
        size most = measure_step(s, film, dh00);
        double share = ehl_step_share(s->grid, s->reynolds, film, most.dp, w->h_step);
        apply_step(s, film, share, dh00);
        double cut = ehl_cavitation_shrink_film(&w->cavitation, s->reynolds, film, w->p_step);
        if (cut > 0) {
            deflect(s, w->p_step, w->v_step);
            for (size_t i = 0; i < n; i++)
                film->v[i] += w->v_step[i];
        }
        watch_film_boundary(w, film, n);
        int whole =
            ehl_rescale_to_load(s, step, film) && share >= 1 && w->whole && !w->cavitation.split;
        double close = s->tolerance * ehl_pressure_scale(s->grid, film, n);
        if (whole && most.dp <= close && cut <= close &&
            most.dh <= (s->reynolds->conserving ? 1 : 10) * s->tolerance) {
            s->counters.undecided += w->flips >= MOST_FLIPS;
            return FF_OK;
        }
    }
    w->made = 0;
    return FF_NOCONV;
}

ff_status ehl_line_relaxation(ehl_solver *s)
{
    size_t n = s->grid->nodes;
    relaxation *w = s->self = calloc(1, sizeof *w);
    s->solve = solve;
    s->deflect = deflect;
    s->destroy = destroy;
    s->reynolds->asymmetric = 1;
    if (!w)
        return FF_NOMEM;
    w->fft = ehl_fft_create(n, s->kernel);
    w->matrix = ehl_line_create(n, s->kernel);
    w->made_full = calloc(n, 1);
    double *next = w->memory = calloc(9 * n, sizeof *next);
    if (!w->fft || !w->matrix || !w->memory || !w->made_full ||
        !ehl_anderson_create(&w->anderson, n) ||
        ehl_cavitation_create(&w->cavitation, n) != FF_OK) {
        destroy(s);
        return FF_NOMEM;
    }
    double **line[] = {&w->product, &w->sweep,  &w->change, &w->pressure, &w->deflection,
                       &w->total,   &w->p_step, &w->v_step, &w->h_step};
    for (size_t k = 0; k < sizeof line / sizeof line[0]; k++, next += n)
        *line[k] = next;
    return FF_OK;
}
