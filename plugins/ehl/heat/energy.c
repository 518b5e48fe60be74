/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "energy.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <string.h>

/* A sweep over the columns, with the coefficients that advance the temperature modes of the flanks
   from node to node. */
typedef struct sweep {
    ehl_energy *e;
    const ehl_energy_film *film;
    const ehl_temperature *t;
    ehl_passage passage[2], rest[2]; /* rest: coefficients at the last node, which has no next
                                        node */
} sweep;

/* Computes the transverse mass flow rho (w - z h_x u - z h_t), kg/(m2 s), at the nodes. It follows
   from the divergence of the flow along x. */
FF_SIMD_INLINE void transverse_flow(const sweep *s, size_t i, size_t n, double *at)
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
    for (size_t k = 0; k < n; k++)
        out[k] = mean - out[k];
    ehl_across_apply(a->integral[0], EHL_ACROSS_MOST, n, out, at);
}

/* Computes the transverse transport. Where conduction does not smooth the transported temperature,
   as in a thick inlet, the polynomial across the film would oscillate, and no film would be found.
   Its highest modes therefore get an artificial conductance as large as the largest transport; the
   conductance decreases with the third power of the number of nodes. Resolved temperatures do not
   contain these modes, so the error still decreases faster than any power. */
FF_SIMD_INLINE void transverse_transport(const sweep *s, size_t i, size_t n, ehl_column *c)
{
    const double enough = 8.6; /* number of nodes up to which the conductance is not reduced; with
                                  4, no film is found at 20 m/s with 8 nodes */
    const ehl_energy *e = s->e;
    double at[EHL_ACROSS_MOST], most = 0, few = enough / (double)n;
    transverse_flow(s, i, n, at);
    for (size_t k = 0; k < n; k++) {
        most = fabs(at[k]) > most ? fabs(at[k]) : most;
        c->lift[k] = e->heat_capacity * e->across.weight[k] * at[k];
    }
    c->damped = e->damping * few * few * few * e->heat_capacity * most;
}

/* Transport from one side of a column: (now T(i) - near T - far T_far)/dx, where T and T_far are
   the temperatures of the next two columns on that side. The scheme is of second order except near
   the ends. */
typedef struct side {
    double now, near, far;
    const double *T, *T_far;
} side;

FF_SIMD_INLINE side side_of(const sweep *s, size_t i, int forward)
{
    size_t n = s->e->across.count, count = s->film->count;
    const double *T = s->t->T + i * n;
    ptrdiff_t step = forward ? -(ptrdiff_t)n : (ptrdiff_t)n;
    if (!forward && i + 1 >= count)
        return (side){0, 0, 0, T, T};
    if (forward ? i > 1 : i + 2 < count)
        return (side){1.5, 2, -0.5, T + step, T + 2 * step};
    return (side){1, 1, 0, T + step, T + step};
}

/* Returns the conductance of a column, W/(m2 K), k(p) over h. */
FF_SIMD_INLINE double conductance_of(const sweep *s, size_t i)
{
    const ehl_energy *e = s->e;
    double p = s->film->p[i] > 0 ? s->film->p[i] : 0;
    return e->conductivity * (1 + e->conducts.rise * p / (1 + e->conducts.bend * p)) /
           s->film->h[i];
}

/* Returns 1 over the mean derivative of the shear rate with respect to the stress, or 0 if this
   mean is 0. */
FF_SIMD_INLINE double per_mean_slope(const ehl_energy *e, size_t i, size_t n)
{
    double mean = 0;
    for (size_t l = 0; l < n; l++)
        mean += e->across.weight[l] * e->gamma_tau[i * n + l];
    return mean > 1e-290 ? 1 / mean : 0;
}

/* Sets `off` to the residuals of the equations of a column without the heat flux into the
   flanks. */
FF_SIMD_INLINE void find_rest(const sweep *s, size_t i, size_t n, double *off)
{
    const ehl_across *a = &s->e->across;
    const ehl_column *c = &s->e->column[i];
    const side ahead = side_of(s, i, 1), behind = side_of(s, i, 0);
    const double *T = s->t->T + i * n;
    double conducted = conductance_of(s, i), bend[EHL_ACROSS_MOST], damped[EHL_ACROSS_MOST],
           slope[EHL_ACROSS_MOST];
    ehl_across_apply(a->stiffness[0], EHL_ACROSS_MOST, n, T, bend);
    ehl_across_apply(a->damping[0], EHL_ACROSS_MOST, n, T, damped);
    ehl_across_apply(a->slope[0], EHL_ACROSS_MOST, n, T, slope);
    FF_SIMD_LOOP
    for (size_t k = 0; k < n; k++) {
        double from_ahead = ahead.near * ahead.T[k] + ahead.far * ahead.T_far[k],
               from_behind = behind.near * behind.T[k] + behind.far * behind.T_far[k];
        double across = conducted * bend[k] + c->damped * damped[k] + c->lift[k] * slope[k];
        off[k] = c->source[k] + c->on[k] * from_ahead + c->back[k] * from_behind -
                 c->own[k] * T[k] - across;
    }
}

/* Subtracts `share` times a row from another row. Both have n numbers, padded to whole vectors. */
FF_SIMD_INLINE void subtract_row(size_t n, double share, const double *row, double *from)
{
    for (size_t j = 0; j < n; j += EHL_LANES) {
        ehl_lanes a, b;
        memcpy(&a, row + j, sizeof a);
        memcpy(&b, from + j, sizeof b);
        b -= share * a;
        memcpy(from + j, &b, sizeof b);
    }
}

/* Inverts a in place by Gauss-Jordan elimination with the largest pivot of each column. The padding
   of its rows must contain finite numbers. Returns 0 if a is singular. */
FF_SIMD_INLINE int invert(size_t n, ehl_across_matrix a)
{
    size_t from[EHL_ACROSS_MOST];
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        for (size_t i = k + 1; i < n; i++)
            pivot = fabs(a[i][k]) > fabs(a[pivot][k]) ? i : pivot;
        from[k] = pivot;
        if (!(fabs(a[pivot][k]) > 0))
            return 0;
        for (size_t j = 0; j < n && pivot != k; j++) {
            double kept = a[k][j];
            a[k][j] = a[pivot][j];
            a[pivot][j] = kept;
        }
        double per = 1 / a[k][k];
        a[k][k] = 1;
        for (size_t j = 0; j < n; j++)
            a[k][j] *= per;
        for (size_t i = 0; i < n; i++) {
            double share = a[i][k];
            if (i == k)
                continue;
            a[i][k] = 0;
            subtract_row(n, share, a[k], a[i]);
        }
    }
    for (size_t k = n; k-- > 0;)
        for (size_t i = 0; i < n && from[k] != k; i++) {
            double kept = a[i][k];
            a[i][k] = a[i][from[k]];
            a[i][from[k]] = kept;
        }
    return 1;
}

/* Inverts the equations of a column. m[l][k] is the coefficient of temperature l in equation k. */
FF_SIMD_INLINE void renew(const sweep *s, size_t i, size_t n)
{
    const ehl_across *a = &s->e->across;
    double conducted = conductance_of(s, i);
    const ehl_energy *e = s->e;
    const ehl_column *c = &e->column[i];
    const double *tau = e->tau + i * n, *gamma = e->gamma + i * n, *slope = e->gamma_tau + i * n,
                 *by_eta = e->gamma_eta + i * n, *ln_eta_T = e->ln_eta_T + i * n;
    double *to = e->inverse + i * n * n, by_stress[EHL_ACROSS_MOST], moved[EHL_ACROSS_MOST];
    /* tau_m depends on the temperatures of the whole column, except at the limiting stress */
    double moves = fabs(e->excess[i]) > 0 ? 0 : 1;
    double per = ehl_energy_touches(s->film, i) ? 0 : s->film->h[i] * per_mean_slope(e, i, n);
    ehl_across_matrix m;
    for (size_t k = 0; k < n; k++) {
        moved[k] = a->weight[k] * by_eta[k] * ln_eta_T[k];
        by_stress[k] = a->weight[k] * (tau[k] * slope[k] + moves * gamma[k]) * per;
    }
    for (size_t l = 0; l < n; l++) {
        memset(m[l], 0, sizeof m[l]);
        for (size_t k = 0; k < n; k++)
            m[l][k] = conducted * a->stiffness[l][k] + c->damped * a->damping[l][k] +
                      c->lift[k] * a->slope[l][k] + by_stress[k] * moved[l];
    }
    for (size_t k = 0; k < n; k++)
        m[k][k] = c->diagonal[k] + by_stress[k] * moved[k];
    int found = invert(n, m);
    for (size_t l = 0; l < n; l++)
        for (size_t k = 0; k < n; k++)
            to[l * n + k] = found ? m[l][k] : NAN;
    memcpy(e->inverted + 3 * i * n, c->diagonal, n * sizeof *to);
    memcpy(e->inverted + (3 * i + 1) * n, c->lift, n * sizeof *to);
    memcpy(e->inverted + (3 * i + 2) * n, c->level, n * sizeof *to);
}

/* Returns whether the equations of a column are close to those whose inverse is stored. Entries of
   the slope matrix are at most n^2/2. In a thin film, conduction is most of the diagonal, but only
   `level` resists a change that is uniform across the film. The sum of the changes is therefore
   limited to a tenth of `keep`. */
FF_SIMD_INLINE int is_inverted(const sweep *s, size_t i, size_t n)
{
    const ehl_column *c = &s->e->column[i];
    const double *diagonal = s->e->inverted + 3 * i * n, *lift = diagonal + n, *level = lift + n;
    const double keep = s->e->keep, steep = (double)(n * n) / 2, level_share = 0.1;
    double moved = 0, all = 0;
    int64_t other = 0;
    for (size_t k = 0; k < n; k++)
        other |= !(fabs(c->diagonal[k] - diagonal[k]) + steep * fabs(c->lift[k] - lift[k]) <=
                   keep * fabs(diagonal[k]));
    for (size_t k = 0; k < n; k++) {
        moved += fabs(c->level[k] - level[k]);
        all += level[k];
    }
    return !other && moved <= level_share * keep * fabs(all) && keep > 0;
}

/* Prepares storage, transport along x, compression, and either dissipation or the friction of
   asperities, which does not depend on their temperature. The diagonal includes all derivatives
   with respect to temperature except those through tau_m. */
FF_SIMD_INLINE void prepare_column(const sweep *s, size_t i, size_t n)
{
    const ehl_energy *e = s->e;
    const ehl_energy_film *film = s->film;
    const ehl_across *a = &e->across;
    ehl_column *c = &e->column[i];
    const side ahead = side_of(s, i, 1), behind = side_of(s, i, 0);
    const double *u = e->u + i * n, *rho = e->rho + i * n, *rho_T = e->rho_T + i * n,
                 *tau = e->tau + i * n, *gamma = e->gamma + i * n, *by_eta = e->gamma_eta + i * n,
                 *ln_eta_T = e->ln_eta_T + i * n, none[EHL_ACROSS_MOST] = {0},
                 *past = film->past ? film->past + i * n : none;
    double p_t = film->p_t ? film->p_t[i] : 0, p_x = e->p_x[i], h = film->h[i],
           per_dx = 1 / film->dx, rate = film->rate, capacity = e->heat_capacity;
    int touches = ehl_energy_touches(film, i);
    double friction = film->friction ? film->friction[i] : 0, sheared = touches ? 0 : h;
    double warmed = per_mean_slope(e, i, n) > 0 ? sheared : 0, conducted = conductance_of(s, i);
    transverse_transport(s, i, n, c);
    FF_SIMD_LOOP
    for (size_t k = 0; k < n; k++) {
        double held = h * a->weight[k] * rho[k] * capacity, expansion = -rho_T[k] / rho[k];
        double on = held * (u[k] > 0 ? u[k] : 0) * per_dx,
               back = held * (u[k] < 0 ? -u[k] : 0) * per_dx;
        double own = held * rate + on * ahead.now + back * behind.now -
                     h * a->weight[k] * expansion * (p_t + u[k] * p_x);
        c->on[k] = on;
        c->back[k] = back;
        c->own[k] = own;
        c->source[k] = a->weight[k] * (sheared * tau[k] * gamma[k] + friction) - held * past[k];
        c->level[k] = own - warmed * a->weight[k] * tau[k] * (by_eta[k] * ln_eta_T[k]);
    }
    c->level[0] += 1 / s->passage[0].own;
    c->level[n - 1] += 1 / s->passage[1].own;
    FF_SIMD_LOOP
    for (size_t k = 0; k < n; k++)
        c->diagonal[k] = conducted * a->stiffness[k][k] + c->damped * a->damping[k][k] +
                         c->lift[k] * a->slope[k][k] + c->level[k];
    if (!is_inverted(s, i, n))
        renew(s, i, n);
}

/* Prepares and inverts the equations of a column. The preset number of nodes is passed as a
   compile-time constant. */
FF_SIMD
static void prepare(const sweep *s, size_t i)
{
    if (s->e->across.count == EHL_ACROSS_PRESET)
        prepare_column(s, i, EHL_ACROSS_PRESET);
    else
        prepare_column(s, i, s->e->across.count);
}

/* Returns whether flank g moves towards the first node. */
static int is_backward(const sweep *s, size_t g)
{
    return s->film->speed[g] < 0;
}

/* Returns the coefficients of flank g from its previous node to node i. */
static const ehl_passage *passage_to(const sweep *s, size_t g, size_t i)
{
    return is_backward(s, g) && i + 1 >= s->e->nodes ? &s->rest[g] : &s->passage[g];
}

/* Computes the modes of flank g at node i without the heat flux at this node. Returns the flank
   temperature that follows from these modes. */
static double flank_at(const sweep *s, size_t g, size_t i)
{
    const ehl_energy *e = s->e;
    const ehl_passage *way = passage_to(s, g, i);
    size_t n = e->flank[g].count, from = is_backward(s, g) ? i + 1 : i - 1;
    from = way == &s->rest[g] ? i : from;
    double *modes = s->t->modes[g];
    const double *past = s->film->past_modes[g];
    return e->T_in + ehl_half_space_reach(&e->flank[g], way, modes + from * n, e->flux[g][from],
                                          past ? past + from * n : NULL, past ? past + i * n : NULL,
                                          modes + i * n);
}

/* Changes the temperatures of a column, unless the change is not finite. */
FF_SIMD_INLINE void change_temperatures(sweep *s, size_t i, size_t n, const double *by)
{
    const double most = 100; /* largest change of a temperature in a sweep, K */
    const double weight = s->film->weight ? s->film->weight[i] : 1;
    ehl_energy *e = s->e;
    const double *ln_eta_T = e->ln_eta_T + i * n;
    double *now = s->t->T + i * n, largest = 0, sum = 0, change = e->change, moved[EHL_ACROSS_MOST],
           lowest = e->lowest, highest = e->highest;
    for (size_t k = 0; k < n; k++)
        sum += fabs(by[k]);
    if (!isfinite(sum)) {
        e->change = HUGE_VAL;
        return;
    }
    for (size_t k = 0; k < n && sum > most; k++)
        largest = fabs(by[k]) > largest ? fabs(by[k]) : largest;
    double share = e->share * (largest > most ? most / largest : 1);
    FF_SIMD_LOOP
    for (size_t k = 0; k < n; k++) {
        double next = now[k] + share * by[k];
        next = next > lowest ? next : lowest;
        next = next < highest ? next : highest;
        moved[k] = fabs((next - now[k]) * ln_eta_T[k]) * weight;
        now[k] = next;
    }
    for (size_t k = 0; k < n; k++)
        change = moved[k] > change ? moved[k] : change;
    e->change = change;
}

/* Solves for the temperatures of a column. In the backward sweep (`returns`), the temperature of
   the flanks without the flux at the node is taken from the last forward sweep. */
FF_SIMD_INLINE void solve_across(sweep *s, size_t i, size_t n, int returns)
{
    ehl_energy *e = s->e;
    size_t end[2] = {0, n - 1};
    double base[2], by[EHL_ACROSS_MOST], *T = s->t->T + i * n;
    double off[EHL_ACROSS_MOST];
    find_rest(s, i, n, off);
    for (size_t g = 0; g < 2; g++) {
        base[g] = returns ? e->base[g][i] + e->T_in : flank_at(s, g, i);
        e->base[g][i] = base[g] - e->T_in;
        off[end[g]] += (base[g] - T[end[g]]) / s->passage[g].own;
    }
    ehl_across_apply(e->inverse + i * n * n, n, n, off, by);
    change_temperatures(s, i, n, by);
    for (size_t g = 0; g < 2 && !returns; g++) {
        e->flux[g][i] = (T[end[g]] - base[g]) / s->passage[g].own;
        ehl_half_space_add(&e->flank[g], &s->passage[g], e->flux[g][i],
                           s->t->modes[g] + i * e->flank[g].count);
    }
}

FF_SIMD
static void solve_column(sweep *s, size_t i, int returns)
{
    if (s->e->across.count == EHL_ACROSS_PRESET)
        solve_across(s, i, EHL_ACROSS_PRESET, returns);
    else
        solve_across(s, i, s->e->across.count, returns);
}

/* Transports the oil with unchanged temperature where there is no film. */
static void carry_column(sweep *s, size_t i)
{
    const ehl_energy *e = s->e;
    const ehl_energy_film *film = s->film;
    size_t n = e->across.count;
    double *T = s->t->T + i * n, on = fmax(film->speed[0] + film->speed[1], 0) / (2 * film->dx);
    for (size_t k = 0; k < n; k++) {
        double before = film->past ? film->past[i * n + k] : 0, come = on > 0 ? on * T[k - n] : 0;
        T[k] = fmin(fmax((come - before) / (film->rate + on), e->lowest), e->highest);
    }
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
        ehl_half_space_pass(&e->flank[g], fabs(s->film->speed[g]), s->film->dx, s->film->rate,
                            &s->passage[g]);
        if (s->film->frame > 0)
            ehl_half_space_pass(&e->flank[g], 0, s->film->dx, s->film->rate, &s->rest[g]);
    }
    e->change = 0;
}

static int is_film(const sweep *s, size_t i)
{
    return i < s->film->count && s->film->full[i];
}

/* Columns with reverse flow are first solved in the direction against the entrainment, since their
   oil comes from downstream. */
void ehl_energy_sweep(ehl_energy *e, const ehl_energy_film *film, const ehl_temperature *t)
{
    sweep s = {.e = e, .film = film, .t = t};
    begin(&s);
    size_t back = film->count;
    for (size_t i = 1; i < film->count; i++)
        if (film->full[i])
            prepare(&s, i);
    while (back > 0 && !(e->reverse[back - 1] && film->full[back - 1]))
        back--;
    if (film->frame > 0)
        back = e->nodes;
    for (size_t i = back; i-- > 1;) {
        if (is_film(&s, i))
            solve_column(&s, i, !(film->frame > 0));
        else if (film->frame > 0)
            carry_column(&s, i);
    }
    for (size_t i = 1; i < e->nodes; i++) {
        if (is_film(&s, i))
            solve_column(&s, i, 0);
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
        ehl_column c;
        double slope[EHL_ACROSS_MOST], h = film->h[i], p_t = film->p_t ? film->p_t[i] : 0;
        if (!is_film(&s, i))
            continue;
        const side sides[2] = {side_of(&s, i, 0), side_of(&s, i, 1)};
        transverse_transport(&s, i, n, &c);
        ehl_across_apply(e->across.slope[0], EHL_ACROSS_MOST, n, t->T + i * n, slope);
        for (size_t k = 0; k < n; k++) {
            size_t at = i * n + k;
            const side *from = &sides[e->u[at] >= 0];
            double part = film->dx * h * e->across.weight[k];
            double held = part * e->rho[at] * e->heat_capacity;
            double more =
                from->now * t->T[at] - (from->near * from->T[k] + from->far * from->T_far[k]);
            if (!ehl_energy_touches(film, i))
                sum.shear += part * e->tau[at] * e->gamma[at];
            sum.compression -=
                part * e->rho_T[at] / e->rho[at] * t->T[at] * (p_t + e->u[at] * e->p_x[i]);
            sum.stored += held * (film->rate * t->T[at] + (film->past ? film->past[at] : 0));
            sum.carried +=
                held * fabs(e->u[at]) / film->dx * more + film->dx * c.lift[k] * slope[k];
        }
        sum.asperities += film->friction ? film->dx * film->friction[i] : 0;
        for (size_t g = 0; g < 2; g++)
            sum.flank[g] += film->dx * e->flux[g][i];
    }
    return sum;
}
