/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "march.h"

#include <math.h>
#include <string.h>

/*
 * Half an ellipse of pressure: Hertz's under high load, and as wide as the pressure of a rigid
 * cylinder (from -2 S to 0.475 S, S = sqrt(2 R h)) under low load.
 */
void ehl_first_guess(ehl_solver *s, const ehl_instant *at, double modulus, double thinnest,
                     ehl_film *film)
{
    const ehl_grid *g = s->grid;
    double a = ehl_hertz_half_width(at->load, at->radius, modulus);
    double film_length = sqrt(2 * at->radius * thinnest);
    double width = hypot(a, 1.2 * film_length), sum = 0;
    double centre = -0.5 * film_length * film_length / (a + film_length);
    centre = fmax(centre, -0.5 * g->inlet);
    width = fmin(fmax(width, 2 * g->dx), 0.9 * fmin(g->inlet, g->outlet));
    memset(film->full, 0, g->nodes);
    memset(film->asperity, 0, g->nodes);
    for (size_t i = 0; i < g->nodes; i++) {
        double x = (g->first + (double)i * g->dx - centre) / width;
        int inner = i > 0 && i + 1 < g->nodes;
        film->p[i] = inner && fabs(x) < 1 ? sqrt(1 - x * x) : 0;
        film->full[i] = inner && x < 1;
        sum += film->p[i];
    }
    for (size_t i = 0; i < g->nodes; i++)
        film->p[i] *= at->load / (sum * g->dx);
    s->deflect(s, film->p, film->v);
    film->h00 = 0;
    ehl_reynolds_gap(s->reynolds, at->radius, film);
    double least = s->reynolds->h[0];
    for (size_t i = 0; i < g->nodes; i++)
        least = fmin(least, s->reynolds->h[i]);
    film->h00 = thinnest - least;
    for (size_t i = 0; i < g->nodes; i++)
        film->content[i] = s->reynolds->oil.density * thinnest;
}
