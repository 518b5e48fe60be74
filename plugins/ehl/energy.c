/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "energy.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <string.h>

/* What a sweep has of the flanks: their passage from node to node. */
typedef struct sweep {
    ehl_energy *e;
    const ehl_energy_film *film;
    const ehl_temperature *t;
    ehl_passage passage[2];
} sweep;

/* The equations of one column. */
typedef struct column {
    ehl_across_matrix a;
    double right[EHL_ACROSS_MOST];
} column;

/* Transverse flow of mass rho (w - z h_x u - z h_t), kg/(m2 s), at the nodes and, below each node,
   between them: what the flow along x does not carry off. */
FF_SIMD_INLINE void transverse_flow(const sweep *s, size_t i, size_t n, double *at, double *below)
{
    const ehl_energy_film *film = s->film;
    const ehl_across *a = &s->e->across;
    size_t before = i > 0 ? i - 1 : 0, next = i + 1 < film->count ? i + 1 : i;
    const double *left = s->e->through + before * n, *right = s->e->through + next * n;
    double per = next > before ? 1 / ((double)(next - before) * film->dx) : 0, out[EHL_ACROSS_MOST];
    double mean = 0;
    for (size_t l = 0; l < n; l++) {
        out[l] = (right[l] - left[l]) * per;
        mean += a->weight[l] * out[l];
    }
    below[0] = 0;
    for (size_t k = 0; k < n; k++) {
        at[k] = 0;
        below[k + 1] = below[k] - a->weight[k] * (out[k] - mean);
    }
    for (size_t l = 0; l < n; l++)
        for (size_t k = 0; k < n; k++)
            at[k] -= a->integral[l][k] * (out[l] - mean);
}

/*
 * The transverse transport, over the heat capacity. Where conduction does not smooth what is
 * carried between two nodes, as in a thick inlet, the polynomial would swing; the temperature there
 * comes from the node that the oil comes from.
 */
FF_SIMD_INLINE void transverse_transport(const sweep *s, size_t i, size_t n, ehl_across_matrix m)
{
    const double smooth = 25; /* square of a Peclet number between two nodes */
    const ehl_energy *e = s->e;
    const ehl_across *a = &e->across;
    double at[EHL_ACROSS_MOST], below[EHL_ACROSS_MOST + 1], most = 0;
    transverse_flow(s, i, n, at, below);
    for (size_t k = 1; k < n; k++) {
        double here = fabs(below[k]) * (a->z[k] - a->z[k - 1]);
        most = here > most ? here : most;
    }
    double peclet = e->heat_capacity * most * s->film->h[i] / e->conductivity;
    double sharp = peclet * peclet / (peclet * peclet + smooth);
    for (size_t k = 0; k < n; k++) {
        double carried = (1 - sharp) * a->weight[k] * at[k];
        for (size_t l = 0; l < n; l++)
            m[k][l] = carried * a->slope[k][l];
    }
    for (size_t k = 0; k < n; k++) {
        double up = below[k] > 0 ? sharp * below[k] : 0;
        double down = below[k + 1] < 0 ? -sharp * below[k + 1] : 0;
        m[k][k] += up + down;
        if (k > 0)
            m[k][k - 1] -= up;
        if (k + 1 < n)
            m[k][k + 1] -= down;
    }
}

/* Conduction and transverse transport. */
FF_SIMD_INLINE void add_across(const sweep *s, size_t i, size_t n, column *c)
{
    const ehl_energy *e = s->e;
    const ehl_across *a = &e->across;
    double conducted = e->conductivity / s->film->h[i];
    transverse_transport(s, i, n, c->a);
    for (size_t k = 0; k < n; k++)
        for (size_t l = 0; l < n; l++)
            c->a[k][l] = conducted * a->stiffness[k][l] + e->heat_capacity * c->a[k][l];
}

/* Returns what node k brings from upstream: diag T(i) - the value returned, over dx, of second
   order away from the ends. */
FF_SIMD_INLINE double upstream(const sweep *s, size_t i, size_t k, double *diag)
{
    const double *T = s->t->T;
    size_t n = s->e->across.count, count = s->film->count;
    int forward = s->e->u[i * n + k] >= 0, two = forward ? i > 1 : i + 2 < count;
    if (!forward && i + 1 >= count) {
        *diag = 0;
        return 0;
    }
    double one = T[(forward ? i - 1 : i + 1) * n + k];
    *diag = two ? 1.5 : 1;
    return two ? 2 * one - 0.5 * T[(forward ? i - 2 : i + 2) * n + k] : one;
}

/* Storage, transport along x, compression. */
FF_SIMD_INLINE void add_along(const sweep *s, size_t i, size_t n, column *c)
{
    const ehl_energy *e = s->e;
    const ehl_energy_film *film = s->film;
    const ehl_across *a = &e->across;
    double p_t = film->p_t ? film->p_t[i] : 0, h = film->h[i], per_dx = 1 / film->dx;
    for (size_t k = 0; k < n; k++) {
        size_t at = i * n + k;
        double diag, from = upstream(s, i, k, &diag), passes = fabs(e->u[at]) * per_dx;
        double held = h * a->weight[k] * e->rho[at] * e->heat_capacity;
        double expansion = -e->rho_T[at] / e->rho[at];
        c->a[k][k] += held * (film->rate + passes * diag) -
                      h * a->weight[k] * expansion * (p_t + e->u[at] * e->p_x[i]);
        c->right[k] = held * (passes * from - (film->past ? film->past[at] : 0));
    }
}

/* The dissipation, linear in the temperatures of the whole column: with them goes tau_m. */
FF_SIMD_INLINE void add_dissipation(const sweep *s, size_t i, size_t n, column *c)
{
    const ehl_energy *e = s->e;
    const ehl_across *a = &e->across;
    size_t at = i * n;
    const double *tau = e->tau + at, *gamma = e->gamma + at, *slope = e->gamma_tau + at,
                 *by_T = e->gamma_T + at, *T = s->t->T + at;
    double h = s->film->h[i], mean = 0, drop = 0, moved[EHL_ACROSS_MOST];
    for (size_t l = 0; l < n; l++) {
        moved[l] = a->weight[l] * by_T[l];
        drop += moved[l] * T[l];
        mean += a->weight[l] * slope[l];
    }
    double per_mean = mean > 1e-290 ? 1 / mean : 0;
    for (size_t k = 0; k < n; k++) {
        double part = h * a->weight[k], own = per_mean > 0 ? part * tau[k] * by_T[k] : 0;
        double by_stress = part * (tau[k] * slope[k] + gamma[k]) * per_mean;
        for (size_t l = 0; l < n; l++)
            c->a[k][l] += by_stress * moved[l];
        c->a[k][k] -= own;
        c->right[k] += part * tau[k] * gamma[k] - (own * T[k] - by_stress * drop);
    }
}

/* Solves the equations in place, by elimination with the largest pivot of each column; whole rows
   are subtracted, which are vectors. 0: singular. */
FF_SIMD_INLINE int eliminate(column *c, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        for (size_t i = k + 1; i < n; i++)
            pivot = fabs(c->a[i][k]) > fabs(c->a[pivot][k]) ? i : pivot;
        if (!(fabs(c->a[pivot][k]) > 0))
            return 0;
        if (pivot != k) {
            double right = c->right[k];
            for (size_t j = 0; j < n; j++) {
                double kept = c->a[k][j];
                c->a[k][j] = c->a[pivot][j];
                c->a[pivot][j] = kept;
            }
            c->right[k] = c->right[pivot];
            c->right[pivot] = right;
        }
        double per = 1 / c->a[k][k];
        for (size_t i = k + 1; i < n; i++) {
            double share = c->a[i][k] * per;
            for (size_t j = 0; j < n; j++)
                c->a[i][j] -= share * c->a[k][j];
            c->right[i] -= share * c->right[k];
        }
    }
    for (size_t k = n; k-- > 0;) {
        for (size_t j = k + 1; j < n; j++)
            c->right[k] -= c->a[k][j] * c->right[j];
        c->right[k] /= c->a[k][k];
    }
    return 1;
}

/* The modes of flank g at node i without the flux there; returns what they make of its
   temperature. */
static double flank_at(const sweep *s, size_t g, size_t i)
{
    const ehl_energy *e = s->e;
    size_t n = e->flank[g].count;
    double *modes = s->t->modes[g] + i * n;
    const double *past = s->film->past_modes[g];
    return e->T_in + ehl_half_space_reach(&e->flank[g], &s->passage[g], modes - n,
                                          e->flux[g][i - 1], past ? past + (i - 1) * n : NULL,
                                          past ? past + i * n : NULL, modes);
}

FF_SIMD_INLINE void keep_temperatures(sweep *s, size_t i, size_t n, const double *T)
{
    const double most = 100; /* K by which a sweep changes a temperature */
    ehl_energy *e = s->e;
    double *now = s->t->T + i * n, largest = 0, change = e->change;
    for (size_t k = 0; k < n; k++) {
        double here = fabs(T[k] - now[k]);
        largest = here > largest ? here : largest;
    }
    double share = largest > most ? most / largest : 1;
    for (size_t k = 0; k < n; k++) {
        double next = now[k] + share * (T[k] - now[k]);
        next = next > e->lowest ? next : e->lowest;
        next = next < e->highest ? next : e->highest;
        double here = fabs((next - now[k]) * e->ln_eta_T[i * n + k]);
        change = here > change ? here : change;
        now[k] = next;
    }
    e->change = change;
}

FF_SIMD_INLINE void solve_across(sweep *s, size_t i, size_t n)
{
    ehl_energy *e = s->e;
    size_t end[2] = {0, n - 1};
    double base[2], sum = 0;
    column c;
    add_across(s, i, n, &c);
    add_along(s, i, n, &c);
    add_dissipation(s, i, n, &c);
    for (size_t g = 0; g < 2; g++) {
        double per = 1 / s->passage[g].own;
        base[g] = flank_at(s, g, i);
        c.a[end[g]][end[g]] += per;
        c.right[end[g]] += base[g] * per;
    }
    int solved = eliminate(&c, n);
    for (size_t k = 0; k < n; k++)
        sum += fabs(c.right[k]);
    if (solved && isfinite(sum))
        keep_temperatures(s, i, n, c.right);
    for (size_t g = 0; g < 2; g++) {
        e->flux[g][i] = (s->t->T[i * n + end[g]] - base[g]) / s->passage[g].own;
        ehl_half_space_add(&e->flank[g], &s->passage[g], e->flux[g][i],
                           s->t->modes[g] + i * e->flank[g].count);
    }
}

/* The preset number of nodes is known when it is compiled. */
FF_SIMD
static void solve_column(sweep *s, size_t i)
{
    if (s->e->across.count == EHL_ACROSS_PRESET)
        solve_across(s, i, EHL_ACROSS_PRESET);
    else
        solve_across(s, i, s->e->across.count);
}

/* Where there is no film. */
static void carry_column(sweep *s, size_t i)
{
    size_t n = s->e->across.count;
    memcpy(s->t->T + i * n, s->t->T + (i - 1) * n, n * sizeof *s->t->T);
    for (size_t g = 0; g < 2; g++) {
        flank_at(s, g, i);
        s->e->flux[g][i] = 0;
    }
}

static void begin(sweep *s)
{
    ehl_energy *e = s->e;
    for (size_t k = 0; k < e->across.count; k++)
        s->t->T[k] = e->T_in;
    for (size_t g = 0; g < 2; g++) {
        e->flux[g][0] = 0;
        memset(s->t->modes[g], 0, e->flank[g].count * sizeof *s->t->modes[g]);
        ehl_half_space_pass(&e->flank[g], s->film->speed[g], s->film->dx, s->film->rate,
                            &s->passage[g]);
    }
    e->change = 0;
}

static int is_film(const sweep *s, size_t i)
{
    return i < s->film->count && s->film->full[i];
}

/* Where oil flows back, the columns are solved against the entrainment first: its temperature
   comes from there. */
void ehl_energy_sweep(ehl_energy *e, const ehl_energy_film *film, const ehl_temperature *t)
{
    sweep s = {.e = e, .film = film, .t = t};
    begin(&s);
    size_t back = film->count;
    while (back > 0 && !(e->reverse[back - 1] && film->full[back - 1]))
        back--;
    for (size_t i = back; i-- > 1;)
        if (is_film(&s, i))
            solve_column(&s, i);
    for (size_t i = 1; i < e->nodes; i++) {
        if (is_film(&s, i))
            solve_column(&s, i);
        else
            carry_column(&s, i);
    }
}

ehl_energy_sums ehl_energy_balance(ehl_energy *e, const ehl_energy_film *film,
                                   const ehl_temperature *t)
{
    sweep s = {.e = e, .film = film, .t = t};
    ehl_energy_sums sum = {.shear = 0};
    size_t n = e->across.count;
    for (size_t i = 1; i < film->count; i++) {
        ehl_across_matrix across;
        double h = film->h[i], p_t = film->p_t ? film->p_t[i] : 0;
        if (!is_film(&s, i))
            continue;
        transverse_transport(&s, i, n, across);
        for (size_t k = 0; k < n; k++) {
            size_t at = i * n + k;
            double part = film->dx * h * e->across.weight[k], diag, rise = 0;
            double from = upstream(&s, i, k, &diag), held = part * e->rho[at] * e->heat_capacity;
            for (size_t l = 0; l < n; l++)
                rise += across[k][l] * t->T[i * n + l];
            sum.shear += part * e->tau[at] * e->gamma[at];
            sum.compression -=
                part * e->rho_T[at] / e->rho[at] * t->T[at] * (p_t + e->u[at] * e->p_x[i]);
            sum.stored += held * (film->rate * t->T[at] + (film->past ? film->past[at] : 0));
            sum.carried += held * fabs(e->u[at]) / film->dx * (diag * t->T[at] - from) +
                           film->dx * e->heat_capacity * rise;
        }
        for (size_t g = 0; g < 2; g++)
            sum.flank[g] += film->dx * e->flux[g][i];
    }
    return sum;
}
