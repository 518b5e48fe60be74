/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gmres.h"

#include "../contact/simd-reductions.h"
#include "../equations/asperities.h"
#include "../equations/cavitation.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The coarse grid has a corner at most every LEAST_STRIDE nodes, and at most MOST_CORNERS corners.
   It is used only if it has more than LEAST_CORNERS corners. */
enum { LEAST_STRIDE = 16, LEAST_CORNERS = 16, MOST_CORNERS = 128 };

/* Limits of the imbalance of flow after a linear solution, relative to the imbalance before
   (MOST_IMBALANCE_LEFT) and to the flow through the contact (IMBALANCE_NOTICED). The imbalance is
   too large if it exceeds both limits. */
static const double MOST_IMBALANCE_LEFT = 0.3, IMBALANCE_NOTICED = 0.01;

/* Replaces MOST_IMBALANCE_LEFT for ehl_linear_answer, whose right-hand side is not the residual of
   a Newton step. */
static const double ANSWER_IMBALANCE = 0.1;

/* Least reduction of the residual of a linear system, relative to its first residual.
   CAREFUL_REDUCTION applies to rough flanks, where the remaining residual may open or close
   contacts of asperities, and to light loads, where a norm of the pressure contains little
   information about the film. */
static const double LEAST_REDUCTION = 0.2, CAREFUL_REDUCTION = 0.05;

/* Least reduction if statistical flanks touch: a transfer of load between oil and asperities
   changes the film but hardly the pressure. */
static const double SHARED_REDUCTION = 1e-3;

/* With rough flanks, a linear solution whose change of the pressure is within the tolerance is
   accurate to this share of the tolerance. */
static const double SHARE_OF_LAST = 0.01;

/* The relative error after a Newton step is about this multiple of the square of its relative
   change. For a viscosity exp(alpha p) it is alpha p_max/2, about 10 in a contact of gears. */
static const double CURVATURE = 10;

/* Parameters that adapt this multiple. After two successive Newton steps the multiple becomes
   LEARNED times the value found from these steps, but at least LEAST_CURVATURE. After a single
   sufficient step it is multiplied by FORGETTING. */
static const double LEARNED = 2, LEAST_CURVATURE = 0.3, FORGETTING = 1.05;

/* Share of the tolerance that one time step may use. The oil transports these errors through the
   contact, where they add up; docs/performance.md has the sum for the presets. */
static const double SHARE_OF_STEP = 1. / 20;

/* Largest imbalance of flow between the inlet and any point after a step, in units of the
   tolerance. Between two points the imbalance is then at most twice as large, below 5 tolerances,
   the lowest limit of the quality lines (quality.c). */
static const double MOST_UNBALANCED = 2;

void ehl_linear_deflect(ehl_solver *s, const double *p, double *v)
{
    ehl_linear *w = s->self;
    ehl_fft_apply(w->fft, p, v);
    s->counters.convolutions++;
}

/* Fills rows from ... last - 1 of the product. */
FF_SIMD
static void multiply_rows(const ehl_reynolds *r, size_t from, const double *restrict dp,
                          const double *restrict dh, double *restrict out)
{
    const double *restrict a0 = r->by_p[0], *restrict a1 = r->by_p[1], *restrict a2 = r->by_p[2];
    const double *restrict a3 = r->by_p[3], *restrict b0 = r->by_h[0], *restrict b1 = r->by_h[1];
    const double *restrict b2 = r->by_h[2], *restrict b3 = r->by_h[3];
    for (size_t i = from, last = r->last; i < last; i++)
        out[i] = a0[i] * dp[i - 2] + a1[i] * dp[i - 1] + a2[i] * dp[i] + a3[i] * dp[i + 1] +
                 b0[i] * dh[i - 2] + b1[i] * dh[i - 1] + b2[i] * dh[i] + b3[i] * dh[i + 1];
}

/* Computes out = J (dp, dh) in rows 1 ... last - 1, with the Jacobian J and the change of the film
   dh = dv + dh00. */
static void apply_jacobian(const ehl_reynolds *r, const double *dp, const double *dh, double *out)
{
    const double *a1 = r->by_p[1], *a2 = r->by_p[2], *a3 = r->by_p[3];
    const double *b1 = r->by_h[1], *b2 = r->by_h[2], *b3 = r->by_h[3];
    if (r->last > 1)
        out[1] = a1[1] * dp[0] + a2[1] * dp[1] + a3[1] * dp[2] + b1[1] * dh[0] + b2[1] * dh[1] +
                 b3[1] * dh[2];
    multiply_rows(r, 2, dp, dh, out);
}

FF_SIMD
static double dot(const double *restrict a, const double *restrict b, size_t n)
{
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
    size_t i = 0;
    for (; i + 4 <= n; i += 4) {
        s0 += a[i] * b[i];
        s1 += a[i + 1] * b[i + 1];
        s2 += a[i + 2] * b[i + 2];
        s3 += a[i + 3] * b[i + 3];
    }
    for (; i < n; i++)
        s0 += a[i] * b[i];
    return (s0 + s1) + (s2 + s3);
}

FF_SIMD
void ehl_add(double *restrict y, double factor, const double *restrict x, size_t n)
{
    for (size_t i = 0; i < n; i++)
        y[i] += factor * x[i];
}

FF_SIMD
static void scale(double *y, double factor, size_t n)
{
    for (size_t i = 0; i < n; i++)
        y[i] *= factor;
}

/* Computes y = factor x. */
FF_SIMD
static void multiply(const double *restrict x, double factor, double *restrict y, size_t n)
{
    for (size_t i = 0; i < n; i++)
        y[i] = x[i] * factor;
}

/* Computes y[i] = x[i] + by. */
FF_SIMD
static void shift(const double *restrict x, double by, double *restrict y, size_t n)
{
    for (size_t i = 0; i < n; i++)
        y[i] = x[i] + by;
}

FF_SIMD
static void keep_full(size_t n, const unsigned char *restrict full, const double *restrict v,
                      double *restrict part)
{
    for (size_t i = 0; i < n; i++)
        part[i] = full[i] ? v[i] : 0;
}

const double *ehl_pressure_part(const ehl_solver *s, const ehl_film *film, const double *v)
{
    ehl_linear *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    if (!r->conserving)
        return v;
    keep_full(r->nodes, film->full, v, w->masked);
    for (size_t i = 0; film->yielding > 0 && i < r->nodes; i++)
        w->masked[i] = ehl_yields(r, film, i) ? 0 : w->masked[i];
    return w->masked;
}

/* Applies the preconditioner: (dp, dh00) = M^-1 (product, sum). The coarse grid solves for the long
   waves, then the band matrix for the rest. */
static void apply_preconditioner(ehl_solver *s, const ehl_film *film, double sum, double *dp,
                                 double *dh00)
{
    ehl_linear *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    double h00_change = 0;
    int split = w->split && ehl_coarse_solve(w->coarse, r->last, w->product, sum, film, w->p_step,
                                             w->h_step, &h00_change);
    if (split) {
        apply_jacobian(r, w->p_step, w->h_step, w->left);
        ehl_add(w->product + 1, -1, w->left + 1, r->last - 1);
    }
    ehl_band_solve(w->band, w->product, split ? 0 : sum, dp, dh00);
    if (split)
        ehl_add(dp + 1, 1, w->p_step + 1, r->last - 1);
    *dh00 += h00_change;
}

/* Extends the Krylov space: next = M^-1 J basis[k]. The deflection of basis[k] is stored too. A
   vector contains `weight` times the change of h00 at index 0 and the change of p at 1 ... last -
   1. */
static void extend_krylov_space(ehl_solver *s, const ehl_film *film, int loaded, double weight,
                                size_t k)
{
    ehl_linear *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    double *v = w->basis[k], *next = w->basis[k + 1], dh00 = v[0] / weight;
    v[0] = 0; /* the pressure is 0 at both ends */
    const double *p = ehl_pressure_part(s, film, v);
    ehl_linear_deflect(s, p, w->deflection[k]);
    shift(w->deflection[k], dh00, w->h_step, r->last + 1);
    apply_jacobian(r, v, w->h_step, w->product);
    double sum = ehl_sum(r->last - 1, p + 1);
    v[0] = dh00 * weight;
    apply_preconditioner(s, film, loaded ? sum : 0, next, &dh00);
    memset(next + r->last, 0, (r->nodes - r->last) * sizeof *next);
    next[0] = dh00 * weight;
}

typedef struct hessenberg {
    double h[EHL_KRYLOV + 1][EHL_KRYLOV], c[EHL_KRYLOV], s[EHL_KRYLOV], rest[EHL_KRYLOV + 1];
} hessenberg;

/* Makes column k triangular by Givens rotations. Returns the norm of the remaining residual. */
static double rotate_column(hessenberg *q, size_t k)
{
    for (size_t j = 0; j < k; j++) {
        double a = q->h[j][k], b = q->h[j + 1][k];
        q->h[j][k] = q->c[j] * a + q->s[j] * b;
        q->h[j + 1][k] = -q->s[j] * a + q->c[j] * b;
    }
    double length = hypot(q->h[k][k], q->h[k + 1][k]);
    q->c[k] = q->h[k][k] / length;
    q->s[k] = q->h[k + 1][k] / length;
    q->h[k][k] = length;
    q->rest[k + 1] = -q->s[k] * q->rest[k];
    q->rest[k] *= q->c[k];
    return fabs(q->rest[k + 1]);
}

/* Combines `count` basis vectors to p_step and v_step so that the residual is smallest. Returns
   dh00. */
static double combine_basis(ehl_linear *w, hessenberg *q, size_t count, size_t nodes, double weight)
{
    if (count == 0) {
        memset(w->p_step, 0, nodes * sizeof *w->p_step);
        memset(w->v_step, 0, nodes * sizeof *w->v_step);
    }
    for (size_t i = count; i-- > 0;) {
        for (size_t j = i + 1; j < count; j++)
            q->rest[i] -= q->h[i][j] * q->rest[j];
        q->rest[i] /= q->h[i][i];
        if (i + 1 == count) {
            multiply(w->basis[i], q->rest[i], w->p_step, nodes);
            multiply(w->deflection[i], q->rest[i], w->v_step, nodes);
            continue;
        }
        ehl_add(w->p_step, q->rest[i], w->basis[i], nodes);
        ehl_add(w->v_step, q->rest[i], w->deflection[i], nodes);
    }
    double dh00 = w->p_step[0] / weight;
    w->p_step[0] = 0;
    return dh00;
}

/* Predicts the relative error after a step with this relative change: the share of the change that
   the linear solution leaves, plus the quadratic term that Newton's method neglects. */
static double left_of(const ehl_linear *w, double change)
{
    return change * (w->reached + w->curvature * change);
}

void ehl_linear_learn(ehl_solver *s, double before, double reached, double now)
{
    ehl_linear *w = s->self;
    double found = fmax(now / before - reached, 0) / before;
    w->curvature = fmin(fmax(LEARNED * found, LEAST_CURVATURE), CURVATURE);
}

void ehl_linear_unlearn(ehl_solver *s)
{
    ehl_linear *w = s->self;
    w->curvature = CURVATURE;
}

void ehl_linear_forget(ehl_solver *s)
{
    ehl_linear *w = s->self;
    w->curvature = fmin(FORGETTING * w->curvature, CURVATURE);
}

int ehl_linear_settles(const ehl_solver *s, double pressure, double film, double times)
{
    double allowed = SHARE_OF_STEP * s->tolerance;
    return left_of(s->self, pressure) <= allowed && left_of(s->self, film) <= times * allowed;
}

int ehl_linear_balances(const ehl_solver *s)
{
    const ehl_linear *w = s->self;
    return w->unbalanced <= MOST_UNBALANCED * s->tolerance;
}

/* Returns the share of the residual that may remain after a relative change of the pressure
   (forcing term, Eisenstat & Walker 1996). With this share and the quadratic term that Newton's
   method neglects, the film meets its tolerance. If the quadratic term is larger than the
   tolerance, the share is the relative size of this term. */
static double forcing_term(const ehl_solver *s, double change, int careful)
{
    if (s->reynolds->rough && change <= s->tolerance)
        return fmax(CAREFUL_REDUCTION, SHARE_OF_LAST * s->tolerance / change);
    double least = careful ? CAREFUL_REDUCTION : LEAST_REDUCTION;
    const ehl_linear *w = s->self;
    double allowed = SHARE_OF_STEP * s->tolerance / change, neglected = w->curvature * change;
    double left = neglected < allowed ? fmax(allowed - neglected, neglected) : neglected;
    return fmin(s->reynolds->touching ? SHARED_REDUCTION : least, left);
}

/* The accuracy required for a right-hand side that is not the residual of a Newton step
   (ehl_linear_answer). */
typedef struct goal {
    double share;            /* allowed error, over the larger of answer and guess */
    const ehl_answer *guess; /* start of the solution */
    const double *rows;      /* the right-hand side before the guess was subtracted */
} goal;

/* Returns the share of the preconditioned residual `first` that may remain for this goal. The
   preconditioned residual is measured in the same norm as the answer. */
static double share_left(const goal *of, double first, size_t rows, double weight)
{
    const ehl_answer *e = of->guess;
    double most = ehl_greater(hypot(sqrt(dot(e->p, e->p, rows)), e->h00 * weight), first);
    return first > 0 ? of->share * most / first : 1;
}

/* Solves J (dp, dh00) = (product, missing) until the preconditioned residual has decreased to the
   share that forcing_term allows, or to the goal `of` if it is not NULL. With left preconditioning
   the norm measures the error of the pressure. With a norm of the balances, short waves of the
   pressure would grow from step to step, since they hardly change the balances. */
static ff_status gmres(ehl_solver *s, const ehl_film *film, int loaded, double missing,
                       const goal *of, double *dh00)
{
    ehl_linear *w = s->self;
    const ehl_grid *g = s->grid;
    hessenberg q;
    size_t rows = s->reynolds->last, nodes = s->reynolds->nodes, k = 0;
    double p_max = ehl_pressure_scale(g, film, nodes);
    /* the weight, in Pa/m, makes a change of h00 comparable with a change of the pressure: a
       pressure over the whole contact divided by its deflection. Under light loads the film reacts
       to the pressure long before the flanks deflect; the weight is then the pressure over the
       smallest film */
    double weight = g->dx / (g->half_width * (s->kernel[0] - s->kernel[nodes - 1]));
    double by_film = p_max / ehl_least(rows, s->reynolds->thick);
    int careful = w->careful = s->reynolds->rough || by_film < weight;
    weight = fmin(weight, by_film);
    apply_preconditioner(s, film, loaded ? missing : 0, w->basis[0], dh00);
    memset(w->basis[0] + rows, 0, (nodes - rows) * sizeof *w->basis[0]);
    w->basis[0][0] = *dh00 * weight;
    double first = sqrt(dot(w->basis[0], w->basis[0], rows)), norm = first;
    if (!isfinite(first))
        return FF_NOCONV;
    double reduction = of ? share_left(of, first, rows, weight)
                          : forcing_term(s, ehl_greatest_size(rows, w->basis[0]) / p_max, careful);
    scale(w->basis[0], first > 0 ? 1 / first : 0, rows);
    q.rest[0] = first;
    while (k < EHL_KRYLOV && norm > reduction * first) {
        extend_krylov_space(s, film, loaded, weight, k);
        double *next = w->basis[k + 1];
        for (size_t j = 0; j <= k; j++) {
            q.h[j][k] = dot(next, w->basis[j], rows);
            ehl_add(next, -q.h[j][k], w->basis[j], rows);
        }
        double length = q.h[k + 1][k] = sqrt(dot(next, next, rows));
        if (length > 0)
            scale(next, 1 / length, rows);
        norm = rotate_column(&q, k++);
        s->counters.krylov++;
    }
    *dh00 = combine_basis(w, &q, k, nodes, weight);
    w->krylov = k;
    w->suffices = s->reynolds->touching ? CAREFUL_REDUCTION : 0;
    w->reached = first > 0 ? norm / first : 0;
    return isfinite(norm) ? FF_OK : FF_NOCONV;
}

/* Returns 1 if the flow is unbalanced after the solution although GMRES's norm is small. If the
   blocks of the coarse grid are wider than the contact, the preconditioner M^-1 almost cancels some
   waves of the balances, and the left-preconditioned norm does not show them. */
static int misses_imbalance(const ehl_solver *s, const ehl_step *step, const ehl_film *film,
                            const goal *of, double dh00)
{
    ehl_linear *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    const double *whole = of ? of->rows : w->asked;
    double flow = 0, left = 0, most = 0, most_left = 0, thin = ehl_least(r->last, r->thick);
    shift(w->v_step, dh00, w->h_step, r->last + 1);
    apply_jacobian(r, w->p_step, w->h_step, w->left);
    for (size_t i = 1; i < r->last; i++) {
        flow += film->full[i] ? whole[i] : 0;
        left += film->full[i] ? w->asked[i] - w->left[i] : 0;
        most = ehl_greater(fabs(flow), most);
        most_left = ehl_greater(fabs(left), most_left);
    }
    double passing = r->oil.density * thin * (step->entrainment + step->rate * s->grid->half_width);
    w->unbalanced = most_left / passing;
    return of ? most_left > ANSWER_IMBALANCE * most
              : most_left > MOST_IMBALANCE_LEFT * most && w->unbalanced > IMBALANCE_NOTICED;
}

/* Fills the right-hand side of rows 1 ... last - 1 at the nodes where ehl_is_solved is true. */
FF_SIMD
static void negate_solved(size_t last, int all, const unsigned char *restrict full,
                          const double *restrict residual, double *restrict asked)
{
    for (size_t i = 1; i < last; i++)
        asked[i] = (full[i] | all) ? -residual[i] : 0;
}

/* Solves the system with the right-hand side w->asked in the rows of the nodes and `sum` in the row
   of the load. For `of` see gmres. */
static ff_status solve_for_asked(ehl_solver *s, const ehl_step *step, const ehl_film *film,
                                 double sum, const goal *of, double *dh00)
{
    ehl_linear *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    for (w->split = w->coarse != NULL;; w->split = 0) { /* the band matrix alone converges more
                                                           slowly, but its norm shows all waves */
        memcpy(w->product + 1, w->asked + 1, (r->last - 1) * sizeof *w->product);
        ff_status status = gmres(s, film, step->loaded, sum, of, dh00);
        if (status != FF_OK) {
            w->factored = 0; /* after an overflow the factors must not be reused */
            return status;
        }
        w->unbalanced = 0;
        if (!(w->split || of) || !(misses_imbalance(s, step, film, of, *dh00) && w->split))
            return FF_OK;
    }
}

ff_status ehl_linear_solve(ehl_solver *s, const ehl_step *step, const ehl_film *film, double *dh00)
{
    ehl_linear *w = s->self;
    ehl_linear_factor(s, step, film);
    const ehl_reynolds *r = s->reynolds;
    double missing = (step->load - ehl_film_load(film, r->nodes, r->dx)) / r->dx;
    negate_solved(r->last, r->conserving || r->statistical.law, film->full, r->residual, w->asked);
    ff_status status = solve_for_asked(s, step, film, missing, NULL, dh00);
    if (status == FF_OK && w->krylov_fresh == 0)
        w->krylov_fresh = w->krylov;
    return status;
}

/* Sets the guess to 0 where no equation holds, and updates its deflection. */
static void fit_guess(ehl_solver *s, const ehl_step *step, const ehl_film *film, ehl_answer *e)
{
    enum { FEW = 16 }; /* a convolution takes as long as updating for about 30 nodes */
    const ehl_reynolds *r = s->reynolds;
    size_t cut = 0;
    for (size_t i = 0; i < r->nodes; i++)
        if (fabs(e->p[i]) > 0 && !(i > 0 && i < r->last && ehl_is_solved(r, film, i))) {
            if (!r->conserving && cut < FEW)
                ehl_deflect_by(r->nodes, i, -e->p[i], s->kernel, e->v);
            e->p[i] = 0;
            cut++;
        }
    if (r->conserving ? cut > 0 : cut > FEW)
        ehl_linear_deflect(s, ehl_pressure_part(s, film, e->p), e->v);
    if (!step->loaded)
        e->h00 = 0;
}

ff_status ehl_linear_answer(ehl_solver *s, const ehl_step *step, const ehl_film *film,
                            const double *rows, double share, ehl_answer *e, double *rest)
{
    ehl_linear *w = s->self;
    const ehl_reynolds *r = s->reynolds;
    const ehl_linear before = *w;
    const ehl_counters counters = s->counters;
    fit_guess(s, step, film, e);
    shift(e->v, e->h00, w->h_step, r->last + 1);
    apply_jacobian(r, e->p, w->h_step, w->left);
    for (size_t i = 1; i < r->last; i++)
        w->asked[i] = ehl_is_solved(r, film, i) ? rows[i] - w->left[i] : 0;
    ehl_linear_factor(s, step, film);
    double dh00 = 0, sum = -ehl_sum(r->last - 1, ehl_pressure_part(s, film, e->p) + 1);
    const goal of = {share, e, rows};
    ff_status status = solve_for_asked(s, step, film, sum, &of, &dh00);
    ehl_add(e->p, 1, w->p_step, r->nodes);
    ehl_add(e->v, 1, w->v_step, r->nodes);
    e->h00 += dh00;
    for (size_t i = 0; i < r->nodes; i++) /* misses_imbalance has computed w->left */
        rest[i] = i > 0 && i < r->last && ehl_is_solved(r, film, i) ? w->asked[i] - w->left[i] : 0;
    if (status == FF_OK && !ehl_linear_converged(w))
        status = FF_NOCONV;
    w->krylov = before.krylov;
    w->suffices = before.suffices;
    w->reached = before.reached;
    w->unbalanced = before.unbalanced;
    w->careful = before.careful;
    s->counters = counters;
    return status;
}

ff_status ehl_linear_create(ehl_solver *s, ehl_linear *w)
{
    size_t n = s->grid->nodes;
    w->curvature = CURVATURE;
    w->fft = ehl_fft_create(n, s->kernel);
    w->band = ehl_band_create(n, s->kernel);
    /* if cavitated masses are unknowns, the band matrix converges faster without the coarse grid */
    size_t stride = n / MOST_CORNERS < LEAST_STRIDE ? LEAST_STRIDE : n / MOST_CORNERS;
    int split = n > LEAST_CORNERS * LEAST_STRIDE && !s->reynolds->conserving;
    w->coarse = split ? ehl_coarse_create(n, stride, s->kernel) : NULL;
    w->factored_kind = calloc(2 * n, 1);
    w->kind = w->factored_kind ? w->factored_kind + n : NULL;
    double *next = w->memory = calloc((2 * (size_t)EHL_KRYLOV + 9) * n, sizeof *next);
    if (!w->fft || !w->band || (split && !w->coarse) || !w->memory || !w->factored_kind)
        return FF_NOMEM;
    double **line[] = {&w->product,  &w->p_step, &w->v_step, &w->h_step,
                       &w->diagonal, &w->masked, &w->left,   &w->asked};
    for (size_t k = 0; k < sizeof line / sizeof line[0]; k++, next += n)
        *line[k] = next;
    for (size_t k = 0; k <= EHL_KRYLOV; k++, next += n)
        w->basis[k] = next;
    for (size_t k = 0; k < EHL_KRYLOV; k++, next += n)
        w->deflection[k] = next;
    return FF_OK;
}

void ehl_linear_destroy(ehl_linear *w)
{
    ehl_fft_destroy(w->fft);
    ehl_band_destroy(w->band);
    ehl_coarse_destroy(w->coarse);
    free(w->memory);
    free(w->factored_kind);
}
