/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of outputs from the transport equation of the film's errors. */
#include "results.h"

#include "../time/error-transport.h"

#include <math.h>
#include <string.h>

/* A bar is this many times the computed error. The equation of the errors is linear, and its source
 * tau is only approximately known. */
static const double CAUTION = 1.5;

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
    for (size_t i = 0; error && i < r->nodes; i++)
        eq->h[i] -= error[i];
    film[EHL_LEAST] = ehl_least_film(eq, &node);
    film[EHL_CENTRAL] = ehl_central_film(m->solver->grid, eq);
    memcpy(eq->h, kept, r->nodes * sizeof *kept);
}

/* Turns errors into bars, with a floor that fades within a passage. An error that is not finite is
 * not known, and its bar is infinite. */
static void widen(const ehl_march *m, const double *film, double *error, double *known)
{
    double way = m->known > 1 ? m->at.entrainment * (m->state[0].time - m->state[1].time) : 0;
    double largest = 0;
    for (int k = 0; k < EHL_PEAK; k++)
        largest = fmax(largest, isfinite(error[k]) ? fabs(error[k]) / film[k] : 0);
    *known = fmax(largest, *known * exp(-way / (2 * m->solver->grid->half_width)));
    for (int k = 0; k < EHL_PEAK; k++)
        error[k] =
            isfinite(error[k])
                ? copysign(CAUTION * fmax(fabs(error[k]), FLOOR * *known * film[k]), error[k])
                : (double)INFINITY;
}

ehl_transported ehl_results_transported(ehl_results *r, const ehl_march *m)
{
    double film[EHL_PEAK], less[EHL_PEAK], *of[EHL_CAUSES];
    ehl_transported e;
    of[EHL_BY_CELLS] = e.by_cells;
    of[EHL_BY_STEPS] = e.by_steps;
    films_without(r, m, NULL, film);
    for (int cause = 0; cause < EHL_CAUSES; cause++) {
        films_without(r, m, m->transport->of[cause].h, less);
        for (int k = 0; k < EHL_PEAK; k++)
            of[cause][k] = film[k] - less[k];
        widen(m, film, of[cause], &r->known_error[cause]);
    }
    return e;
}
