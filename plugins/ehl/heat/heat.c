/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "heat.h"

#include "../estimates/inlet-heat.h"
#include "thermal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Largest number of solutions for the film of one instant. */
enum { MOST_ROUNDS = 30 };

/* Film and heat have converged if the relative change of the pressure flow in the inlet is below
   this value. This change is at most 1 - R times the relative change of rho h at the highest
   pressure. A steady film begins without heat and takes many rounds; a time step begins close to
   its solution. */
static const double settled = 1e-4, settled_steady = 1e-5;

ff_status ehl_heat_create(ehl_heat *heat, size_t nodes, double conductivity)
{
    enum { OWN = 10 };
    *heat = (ehl_heat){.conductivity = conductivity, .least = 1};
    heat->memory = calloc(OWN * nodes, sizeof *heat->memory);
    if (!heat->memory)
        return FF_NOMEM;
    heat->ease = heat->memory;
    heat->room = heat->memory + nodes;
    for (size_t i = 0; i < nodes; i++)
        heat->ease[i] = 1;
    return FF_OK;
}

void ehl_heat_destroy(ehl_heat *heat)
{
    free(heat->memory);
    heat->memory = NULL;
}

/* Multiples of -a between which the exponent of R falls from 1 to 0. */
static const double BEGIN = 1.05, END = 0.95;

/* Returns the next node at which the ratio is computed. The ratio varies over the distance to the
   edge of the contact (x = -a). Between these nodes it is interpolated linearly. */
static size_t next_place(const ehl_reynolds *r, size_t i, double a)
{
    const double outside = 4, share = 1. / 8;
    double far = -(r->first + (double)i * r->dx) - BEGIN * a;
    if (far <= 0)
        return i + 1;
    return i + (size_t)fmax(1, fmin(fmax(outside, share * far / r->dx), far / r->dx));
}

/* Interpolates the thermal mobility factor `ease` linearly between two nodes. */
static void set_between(double *ease, size_t from, size_t to, double left, double right)
{
    double rise = to > from ? (right - left) / (double)(to - from) : 0;
    for (size_t i = from; i < to; i++)
        ease[i] = left + rise * (double)(i - from);
}

/* Computes `ease` = R^-s in the inlet. The exponent s decreases from 1 to 0 between BEGIN and END
   times -a, at the edge of the contact, so that there is no jump. Further downstream the flanks no
   longer have equal temperatures. r contains the gap of the film. */
static void ease_inlet(ehl_heat *heat, const ehl_march *m, const ehl_step *step,
                       const ehl_film *film)
{
    const ehl_reynolds *r = m->solver->reynolds;
    const ehl_heated heated = {step->entrainment, step->sliding, heat->conductivity, heat->middle};
    const ff_density *law = r->laws.density;
    double a = ehl_hertz_half_width(step->load, step->radius, m->history->modulus);
    size_t n = r->nodes,
           end = (size_t)fmin(fmax((-END * a - r->first) / r->dx, 0) + 1, (double)n - 1), count = 0;
    double *p = heat->room, *h = p + n, *mass = h + n, *ratio = mass + n, *room = ratio + n;
    for (size_t i = 0; i < end; i = next_place(r, i, a), count++) {
        p[count] = film->p[i];
        h[count] = fmax(r->h[i], r->floor);
    }
    ff_status status = law->eval(law->self, count, p, NULL, mass, NULL, NULL);
    for (size_t k = 0; k < count; k++)
        mass[k] *= h[k];
    status = numerics_worse(
        status, ehl_inlet_ratio(&r->laws, &heated, count, p, h, mass, room, ratio, &heat->most));
    if (status != FF_OK)
        heat->law_status = status;
    heat->ratio = 1;
    size_t from = 0;
    for (size_t i = 0, k = 0; k < count; k++) {
        double far = -(r->first + (double)i * r->dx);
        size_t next = next_place(r, i, a);
        heat->ratio = far >= a ? fmin(heat->ratio, ratio[k]) : heat->ratio;
        double share = far >= BEGIN * a ? 1 : fmax((far / a - END) / (BEGIN - END), 0);
        ratio[k] = share < 1 ? pow(ratio[k], -share) : 1 / ratio[k];
        if (k > 0)
            set_between(heat->ease, from, i, ratio[k - 1], ratio[k]);
        from = i;
        i = next;
    }
    set_between(heat->ease, from, end, count > 0 ? ratio[count - 1] : 1, 1);
    for (size_t i = end; i < n; i++)
        heat->ease[i] = 1;
    heat->least = fmin(heat->least, heat->ratio);
}

/* Returns rho h at the highest pressure, or 0 without pressure. r contains the gap of the film. */
static double mass_at_peak(const ehl_reynolds *r, const ehl_film *film)
{
    const ff_density *law = r->laws.density;
    size_t peak = 0;
    double rho = 0, most = film->p[0];
    for (size_t i = 1; i < r->nodes; i++)
        if (film->p[i] > most)
            most = film->p[peak = i];
    if (!(film->p[peak] > 0))
        return 0;
    law->eval(law->self, 1, &film->p[peak], NULL, &rho, NULL, NULL);
    return rho * fmax(r->h[peak], r->floor);
}

/* Computes the heat of the film, unless it has converged after the first round. Returns 1 if it has
   converged. */
static int update(ehl_heat *heat, const ehl_march *m, const ehl_step *step, const ehl_film *film,
                  int first)
{
    ehl_reynolds *r = m->solver->reynolds;
    ehl_reynolds_gap(r, step->radius, film);
    double before = heat->middle;
    heat->middle = mass_at_peak(r, film);
    double within = step->past ? settled : settled_steady;
    if (!first && fabs(heat->middle - before) * (1 - heat->ratio) <= within * heat->middle)
        return 1;
    if (heat->middle > 0)
        ease_inlet(heat, m, step, film);
    for (size_t i = 0; !(heat->middle > 0) && i < r->nodes; i++)
        heat->ease[i] = 1;
    return 0;
}

ff_status ehl_heat_solve(ehl_march *m, const ehl_step *step, ehl_film *film, double time, int limit)
{
    if (m->thermal)
        return ehl_thermal_solve(m, step, film, time, limit);
    ehl_heat *heat = m->heat;
    ff_status status = FF_OK;
    if (!heat)
        return m->solver->solve(m->solver, step, film, limit);
    heat->solved++;
    for (int round = 0; round < MOST_ROUNDS && status == FF_OK; round++) {
        if (update(heat, m, step, film, round == 0))
            return FF_OK;
        heat->rounds++;
        status = m->solver->solve(m->solver, step, film, limit);
    }
    return status == FF_OK ? FF_NOCONV : status;
}

void ehl_heat_report(const ehl_heat *heat, const ff_host *host)
{
    const double end = expm1((EHL_HEAT_TABLE - 1) * EHL_HEAT_STEP);
    char text[192];
    snprintf(text, sizeof text,
             "smallest pressure gradient in the inlet over that without heat, with thermal: inlet; "
             "%.3g solutions per instant",
             heat->rounds / fmax(heat->solved, 1));
    host->quality(host->ctx, "inlet_heat", heat->least, 0, FF_GOOD, text);
    if (heat->most > end)
        host->quality(host->ctx, "inlet_heat_range", heat->most, end, FF_RANGE,
                      "largest value of F and S; above the limit it is outside the table of the "
                      "heated channel");
}
