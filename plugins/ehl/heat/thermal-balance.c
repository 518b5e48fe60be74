/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks the heat balance of a film, and writes the quality lines of its temperatures. */
#include "thermal.h"

#include "../contact/simd-reductions.h"

#include <math.h>
#include <stdio.h>

static const double pi = 3.14159265358979323846;

double ehl_thermal_pressure_flow(const ehl_march *m)
{
    const ehl_energy *e = &m->thermal->energy;
    const ehl_reynolds *r = m->solver->reynolds;
    const ehl_across *a = &e->across;
    size_t n = a->count;
    double sum = 0;
    for (size_t i = 0; i <= r->last; i++) {
        double h = r->h[i], here = 0;
        for (size_t k = 0; k < n; k++)
            here += a->weight[k] * (a->z[k] - 0.5) * e->gamma[i * n + k];
        sum += (i > 0 && i < r->last ? 1 : 0.5) * h * h * e->p_x[i] * here;
    }
    return sum * r->dx;
}

/* Returns the heat that a flank of a steady film has absorbed up to node `end`, computed from its
   temperature alone: B sqrt(u/pi) int (T - T_bulk)/sqrt(x_end - x) dx, with T linear between the
   nodes. */
static double taken_by_flank(const ehl_thermal *t, size_t flank, const double *T, size_t stride,
                             double dx, double u, size_t end)
{
    double sum = 0, B = 1 / (t->energy.flank[flank].scale * sqrt(pi));
    for (size_t i = 0; i < end; i++) {
        /* integral over the cell between `far` and `near` cells upstream of the end */
        double near = (double)(end - i - 1), far = near + 1, whole = 2 * (sqrt(far) - sqrt(near));
        double tilt = far * whole - 2. / 3 * (far * sqrt(far) - near * sqrt(near));
        double left = T[i * stride] - t->energy.T_in, right = T[(i + 1) * stride] - t->energy.T_in;
        sum += left * whole + (right - left) * tilt;
    }
    return sum * B * sqrt(u * dx / pi);
}

/* Returns the heat flow of the oil at node i, relative to oil at the inlet temperature. */
static double carried_past(const ehl_energy *e, const double *T, size_t i)
{
    const ehl_across *a = &e->across;
    double sum = 0;
    for (size_t k = 0; k < a->count; k++)
        sum += a->weight[k] * e->through[i * a->count + k] * (T[i * a->count + k] - e->T_in);
    return sum * e->heat_capacity;
}

/* Balances the heat of a steady film with independent sums: the heat dissipated by the forces on
   the flanks and by the pressure flow, the heat that the oil transports out of the film, and the
   heat that the flanks have absorbed according to their temperature. The imbalance decreases with
   the cell size. */
static double steady_balance(const ehl_march *m, const ehl_energy_film *f,
                             const ehl_energy_sums *sum)
{
    const ehl_thermal *t = m->thermal;
    const ehl_energy *e = &t->energy;
    const ehl_film *film = &m->state[0].film;
    const double *T = m->state[0].heat;
    size_t n = e->across.count, end = f->count - 1, first = 1;
    while (end > 1 && !film->full[end])
        end--;
    while (first < end && !film->full[first])
        first++;
    double made = ehl_thermal_pressure_flow(m) + sum->compression, gone = 0;
    for (size_t i = 1; i <= end; i++)
        if (film->full[i])
            made += f->dx * ehl_thermal_stress(m, i) * m->step.sliding;
    for (size_t g = 0; g < 2; g++)
        gone += taken_by_flank(t, g, T + (g > 0 ? n - 1 : 0), n, f->dx, f->speed[g], end);
    gone += carried_past(e, T, end) - carried_past(e, T, first);
    return fabs(made - gone) / (sum->shear + fabs(sum->compression));
}

void ehl_thermal_hold(ehl_march *m)
{
    ehl_thermal *t = m->thermal;
    const ehl_energy_film f = t->film;
    double a = ehl_hertz_half_width(m->at.load, m->at.radius, m->history->modulus);
    if (!ehl_march_is_loaded(m))
        return;
    ehl_reynolds_evaluate(m->solver->reynolds, &m->step, &m->state[0].film);
    ehl_temperature now = ehl_thermal_state(t, m->state[0].heat);
    ehl_energy_flow(&t->energy, &f, now.T);
    ehl_energy_sums sum = ehl_energy_balance(&t->energy, &f, &now);
    double made = sum.shear + sum.compression + sum.asperities,
           gone = sum.stored + sum.carried + sum.flank[0] + sum.flank[1];
    double scale = sum.shear + fabs(sum.compression) + sum.asperities;
    if (scale <= 0)
        return;
    ehl_worse(&t->unbalanced, fabs(made - gone) / scale);
    if (!(f.rate > 0))
        ehl_worse(&t->elsewise, steady_balance(m, &f, &sum));
    for (size_t g = 0; g < 2; g++)
        t->least_peclet = fmin(t->least_peclet, (f.speed[g] + f.frame) * a / t->diffusivity[g]);
    double highest = ehl_thermal_highest(m);
    t->highest = fmax(t->highest, highest);
    ehl_thermal_look_at_nodes(t, &f, &now, m->solver->reynolds->oil.alpha, highest);
}

void ehl_thermal_report(const ehl_thermal *t, const ff_host *host, const ehl_march *m)
{
    const double enough = 0.05, limit = 10 * fmax(m->solver->tolerance, 1e-4), slow = 5;
    char text[200];
    /* reported first, since it explains the other lines of a film whose temperature is limited */
    host->quality(host->ctx, "temperature_max", t->highest, t->energy.highest,
                  t->highest < t->energy.highest ? FF_GOOD : FF_BAD,
                  "highest temperature of the film, K; it must be below the limit to which "
                  "temperatures are clipped");
    snprintf(text, sizeof text,
             "relative difference between the heat of shear, compression and asperities and the "
             "heat taken by the oil and both flanks, with thermal: full; %.3g solutions per "
             "instant",
             t->rounds / fmax(t->solved, 1));
    host->quality(host->ctx, "heat_balance", t->unbalanced, limit,
                  t->unbalanced <= limit  ? FF_GOOD
                  : t->unbalanced <= 0.05 ? FF_DOUBTFUL
                                          : FF_BAD,
                  text);
    if (!m->rough) {
        const double off = t->by_nodes;
        snprintf(text, sizeof text,
                 "estimated relative error of the film and its friction due to the number of nodes "
                 "across the film, at the hottest instant; thermal_nodes is %zu%s",
                 t->energy.across.count, off <= enough ? "" : ": increase it");
        host->quality(host->ctx, "node_error", off, enough, off <= enough ? FF_GOOD : FF_DOUBTFUL,
                      text);
    }
    if (m->history->count == 1 && !m->rough)
        host->quality(host->ctx, "heat_of_flanks", t->elsewise, 0.02,
                      t->elsewise <= 0.02 ? FF_GOOD : FF_DOUBTFUL,
                      "balance of heat from independent sums: heat of the flanks from their "
                      "temperature, of the oil from the oil that leaves the film, of the shear "
                      "from the forces");
    host->quality(
        host->ctx, "flank_peclet", t->least_peclet, slow,
        t->least_peclet >= slow ? FF_GOOD : FF_RANGE,
        "smallest Peclet number u a rho c/k of the flanks: below the limit heat spreads along the "
        "flank, which the model neglects");
}
