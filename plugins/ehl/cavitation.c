/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cavitation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Largest change of pressure of a step with rough flanks, over the largest pressure. */
static const double ROUGH_PRESSURE_CHANGE = 0.1;

enum { FULL = 1, FILLING = 2, QUICK_FILLINGS = 2, MOST_FILLINGS = 8, ROUGH_FILLINGS = 24 };

ff_status ehl_cavitation_create(ehl_cavitation *w, size_t nodes)
{
    w->filled = calloc(nodes, 1);
    return w->filled ? FF_OK : FF_NOMEM;
}

void ehl_cavitation_destroy(ehl_cavitation *w)
{
    free(w->filled);
    w->filled = NULL;
}

void ehl_cavitation_begin(ehl_cavitation *w, size_t nodes)
{
    memset(w->filled, 0, nodes);
    w->stride = 1;
    w->split = 0;
}

int ehl_cavitation_grow_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film)
{
    size_t end = r->nodes - 1, reach = w->stride - 1;
    int grown = 0, longer = 0;
    for (size_t i = 1; i < end; i++) {
        if ((film->full[i] & FULL) || !(r->residual[i] > 0))
            continue;
        size_t from = i > reach ? i - reach : 1, to = i + reach < end ? i + reach : end - 1;
        for (size_t k = from; k <= to; k++)
            film->full[k] |= FILLING;
        grown = 1;
    }
    for (size_t i = 1; grown && i < end; i++) {
        longer |= film->full[i] && i >= r->last;
        film->full[i] = film->full[i] != 0;
    }
    w->stride = grown ? 2 * w->stride : 1;
    return longer;
}

int ehl_cavitation_fill(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film)
{
    int most = r->rough ? ROUGH_FILLINGS : MOST_FILLINGS; /* a rough step fails then, and is cut */
    int filled = 0, beside = 0; /* beside: the node in front was void and is now wet */
    for (size_t i = 1; i + 1 < r->nodes; i++) {
        int over = !film->full[i] && film->content[i] > r->oil.density * r->h[i];
        int careful = w->filled[i] >= QUICK_FILLINGS;
        beside = over && !(careful && beside) && w->filled[i] < most;
        if (!beside)
            continue;
        filled = film->full[i] = 1;
        w->filled[i]++;
    }
    return filled;
}

double ehl_cavitation_shrink_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film,
                                  double *change)
{
    size_t nodes = r->nodes;
    double cut = 0;
    int full_behind = 0;
    memset(change, 0, nodes * sizeof *change);
    w->split = 0;
    for (size_t i = nodes - 2; i > 0; i--) {
        full_behind |= film->full[i] && !(film->p[i] < 0);
        if (film->p[i] < 0) {
            w->split |= full_behind;
            change[i] = -film->p[i];
            cut = fmax(cut, -film->p[i]);
            film->p[i] = 0;
            film->full[i] = 0;
            film->asperity[i] = 0;
            w->stride = 1;
            if (r->conserving)
                film->content[i] = r->oil.density * r->h[i];
        }
    }
    return cut;
}

double ehl_pressure_scale(const ehl_grid *g, const ehl_film *film, size_t nodes)
{
    double peak = 1e-6 * g->pressure;
    for (size_t i = 0; i < nodes; i++)
        peak = film->p[i] > peak ? film->p[i] : peak;
    return peak;
}

double ehl_step_share(const ehl_grid *g, const ehl_reynolds *r, const ehl_film *film, double dp,
                      const double *dh)
{
    double most = 0.3 * fmax(g->pressure, ehl_pressure_scale(g, film, r->nodes)), fall = 1;
    double share = dp > most ? most / dp : 1;
    if (r->rough) /* a film that would fall too far gets into contact */
        return dp > ROUGH_PRESSURE_CHANGE * most / 0.3 ? ROUGH_PRESSURE_CHANGE * most / (0.3 * dp)
                                                       : 1;
    for (size_t i = 1; i < r->last; i++) { /* the film keeps a tenth of its thickness */
        double part = r->h[i] > r->floor && film->full[i] ? -dh[i] / (0.9 * r->h[i]) : 0;
        fall = part > fall ? part : fall;
    }
    return fmin(share, 1 / fall);
}
