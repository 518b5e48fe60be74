/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of outputs from the transport equation of the film's errors. */
#include "results.h"

#include "../time/error-transport.h"

#include <math.h>
#include <string.h>

/* An output whose error crosses 0 is known no better than this share of the largest error of the
   film in the last passage. */
static const double FLOOR = 1. / 3;

/* Computes h_min and h_central of the film without the error, m. */
static void films_without(ehl_results *r, const ehl_march *m, const double *error, double *film)
{
    ehl_reynolds *eq = m->solver->reynolds;
    double *kept = r->tau;
    size_t node;
    memcpy(kept, eq->h, r->nodes * sizeof *kept);
    for (size_t i = 0; i < r->nodes; i++)
        eq->h[i] -= error[i];
    film[EHL_LEAST] = ehl_least_film(eq, &node);
    film[EHL_CENTRAL] = ehl_central_film(m->solver->grid, eq);
    memcpy(eq->h, kept, r->nodes * sizeof *kept);
}

/* Turns errors, relative, into bars with a floor that fades while the oil moves by `way`, in
 * half-widths. An error that is not finite is not known, and its bar is infinite. */
static void widen(double way, double *error, double *known)
{
    double largest = 0;
    for (int k = 0; k < EHL_PEAK; k++)
        largest = fmax(largest, isfinite(error[k]) ? fabs(error[k]) : 0);
    *known = fmax(largest, *known * exp(-way / 2));
    for (int k = 0; k < EHL_PEAK; k++)
        error[k] = isfinite(error[k])
                       ? copysign(EHL_CAUTION * fmax(fabs(error[k]), FLOOR * *known), error[k])
                       : (double)INFINITY;
}

void ehl_results_transported(ehl_results *r, const ehl_march *m, double *error)
{
    const double film[] = {r->row[EHL_H_MIN], r->row[EHL_H_CENTRAL]};
    films_without(r, m, m->transport->h, error);
    for (int k = 0; k < EHL_PEAK; k++)
        error[k] = 1 - error[k] / film[k];
    double way = m->known > 1 ? m->at.entrainment * (m->state[0].time - m->state[1].time) : 0;
    widen(way / m->solver->grid->half_width, error, &r->known_by_cells);
}
