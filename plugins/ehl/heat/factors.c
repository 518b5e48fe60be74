/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Factors by which the temperatures across a film change its flow, and their fixed-point iteration
   for a steady film. */
#include "thermal.h"

#include <math.h>

/* Returns the factors stored in a state: factors on mobility, density and transported mass. */
double *ehl_thermal_factors(const ehl_thermal *t, double *heat)
{
    return heat + t->width - EHL_THERMAL_FACTORS * t->energy.nodes;
}

/* Sets the weights of changes along a steady film. A relative error of the viscosity at a node
   changes the pressure there by the same share, and the film by at most alpha times this change of
   pressure. The weight is therefore small where the pressure begins to rise: vortices of the oil
   there need thousands of sweeps to converge to the last digits, which do not affect the film.
   Behind the contact the weight does not decrease. */
void ehl_thermal_weigh(const ehl_thermal *t, const ehl_reynolds *r, const ehl_film *film)
{
    double most = 0;
    for (size_t i = 0; i < r->nodes; i++) {
        most = fmax(most, r->oil.alpha * film->p[i]);
        t->weight[i] = fmin(most, 1);
    }
}

/* Sets the factors downstream of the nodes that pressure can reach. The oil next to the void keeps
   its density there while it moves with u_r. If its density changed at once, the void would gain
   more mass than its growing gap can contain, and would fill. The factor of the transported mass is
   that of the last node. */
static void leave_behind(const ehl_thermal *t, const ehl_energy_film *f, size_t n, double *next)
{
    const double *past = f->past ? t->past + t->width - (EHL_THERMAL_FACTORS - 1) * n : NULL;
    const double passes = (f->speed[0] + f->speed[1]) / 2 / f->dx;
    for (size_t i = f->count; i < n; i++) {
        next[i] = 1;
        next[n + i] =
            past ? (passes * next[n + i - 1] - past[i]) / (passes + f->rate) : next[n + i - 1];
        next[2 * n + i] = next[2 * n + i - 1];
    }
}

/*
 * Computes the factors from the flow across the film. Returns the largest change of the mass flow
 * that they cause, relative to the mass transported with the flanks, weighted.
 */
double ehl_thermal_find_factors(ehl_thermal *t, const ehl_reynolds *r, const ehl_energy_film *f,
                                const ehl_film *film, double *next)
{
    const ehl_energy *e = &t->energy;
    size_t n = r->nodes;
    double most = 0, held = r->rough ? EHL_NEAR_CONTACT * r->contact : 0;
    for (size_t i = 0; i < f->count; i++) {
        double mass = r->liquid.rho[i] * r->thick[i], swell = t->swell[i] * e->mass[i] / mass;
        int within = ehl_is_cavitated(r, film, i) && !(i > 0 && film->full[i - 1]);
        double carry = within ? 1 : e->carried[i] / e->mass[i];
        double ratio = r->f[i] > 0 && e->mobility[i] > 0 ? e->mobility[i] / r->f[i] : 1;
        double u = (f->speed[0] + f->speed[1]) / 2 + f->frame;
        double driven = fabs(r->f[i] * e->p_x[i]) / (u * mass), part = driven / (1 + driven);
        double off =
            fabs(ratio - 1) * part + fabs(swell / t->swell[i] - 1) + fabs(carry - t->carry[i]);
        double share = t->damping * (off > EHL_LARGE_FACTOR ? EHL_LARGE_FACTOR / off : 1);
        off *= f->weight ? f->weight[i] : 1;
        if (film->full[i] && r->thick[i] > held && !(off <= most))
            most = isfinite(off) ? off : HUGE_VAL;
        swell = t->swell[i] + share * (swell - t->swell[i]);
        next[i] = t->ease[i] * (1 + share * (ratio - 1)) * t->swell[i] / swell;
        next[n + i] = swell;
        next[2 * n + i] = t->carry[i] + share * (carry - t->carry[i]);
    }
    leave_behind(t, f, n, next);
    return most;
}

/* Accelerates the factors of a steady film with those of earlier rounds (Anderson). If all the
   shear of the oil is in a thin layer, the factors cause waves of a few cells in h, and these waves
   amplify the factors. Rounds without acceleration then diverge, even if only a small share of the
   change is applied. */
void ehl_thermal_accelerate(ehl_thermal *t, size_t count, double *next)
{
    size_t n = t->energy.nodes;
    double *now = t->now, *by = t->change, largest = 0;
    const double *of[EHL_THERMAL_FACTORS] = {t->ease, t->swell, t->carry};
    for (size_t i = 0; i < n; i++) {
        now[i] = log(of[0][i]);
        next[i] = log(next[i] / of[0][i]);
        for (size_t k = 1; k < EHL_THERMAL_FACTORS; k++) {
            now[k * n + i] = of[k][i];
            next[k * n + i] -= of[k][i];
        }
    }
    ehl_anderson_step(&t->anderson, now, next, by);
    for (size_t j = 0; j < EHL_THERMAL_FACTORS * n; j++)
        largest = fmax(largest, fabs(by[j]));
    double share = largest > EHL_LARGE_FACTOR ? EHL_LARGE_FACTOR / largest : 1;
    for (size_t j = 0; j < EHL_THERMAL_FACTORS * n; j++)
        next[j] = now[j] + share * by[j];
    for (size_t i = 0; i < n; i++)
        next[i] = i < count ? exp(next[i]) : 1;
}
