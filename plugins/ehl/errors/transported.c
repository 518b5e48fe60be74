/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of outputs from the transport equation of the film's errors. */
#include "results.h"

#include "../time/error-transport.h"

#include <math.h>
#include <string.h>

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

/* Turns errors, relative, into bars. Their floors are the error `of_end`, and one that fades while
 * the oil moves by `way`, in half-widths. An error that is not finite is not known, and its bar is
 * infinite. */
static void widen(double way, double of_end, double *error, double *known)
{
    double largest = 0;
    for (int k = 0; k < EHL_PEAK; k++)
        largest = fmax(largest, isfinite(error[k]) ? fabs(error[k]) : 0);
    *known = fmax(largest, *known * exp(-way / 2));
    for (int k = 0; k < EHL_PEAK; k++)
        error[k] =
            isfinite(error[k])
                ? copysign(EHL_CAUTION * fmax(of_end, fmax(fabs(error[k]), EHL_FLOOR * *known)),
                           error[k])
                : (double)INFINITY;
}

double ehl_error_of_end(const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_state *now = &m->state[0];
    const double *p = ehl_fluid(eq, &now->film), radius = m->at.radius;
    const double a = ehl_hertz_half_width(m->at.load, radius, m->history->modulus),
                 narrow = sqrt(2 * radius * now->thinnest) / (2 * a),
                 rigid = 1 / (1 + pow(narrow, -4));
    size_t i = eq->last;
    while (i > 1 && !now->film.full[i])
        i--;
    const double bend = p[i - 1] - 2 * p[i];
    return bend > p[i] ? rigid * bend / (24 * now->highest) : 0;
}

void ehl_results_transported(ehl_results *r, const ehl_march *m, double *error)
{
    const double film[] = {r->row[EHL_H_MIN], r->row[EHL_H_CENTRAL]};
    films_without(r, m, m->transport->h, error);
    for (int k = 0; k < EHL_PEAK; k++)
        error[k] = 1 - error[k] / film[k];
    double way = m->known > 1 ? m->at.entrainment * (m->state[0].time - m->state[1].time) : 0;
    widen(way / m->solver->grid->half_width, ehl_error_of_end(m), error, &r->known_by_cells);
}
