/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "wet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Largest change of pressure of a step with rough flanks, over the largest pressure. */
static const double rough_most = 0.1;

enum { WET = 1, WETTING = 2, HASTY_FILLINGS = 2, MOST_FILLINGS = 8, ROUGH_FILLINGS = 24 };

ff_status ehl_wet_create(ehl_wet *w, size_t nodes)
{
    w->filled = calloc(nodes, 1);
    return w->filled ? FF_OK : FF_NOMEM;
}

void ehl_wet_destroy(ehl_wet *w)
{
    free(w->filled);
    w->filled = NULL;
}

void ehl_wet_begin(ehl_wet *w, size_t nodes)
{
    memset(w->filled, 0, nodes);
    w->stride = 1;
    w->torn = 0;
}

int ehl_wet_grow(ehl_wet *w, const ehl_reynolds *r, ehl_film *film)
{
    size_t end = r->nodes - 1, reach = w->stride - 1;
    int grown = 0, longer = 0;
    for (size_t i = 1; i < end; i++) {
        if ((film->wet[i] & WET) || !(r->residual[i] > 0))
            continue;
        size_t from = i > reach ? i - reach : 1, to = i + reach < end ? i + reach : end - 1;
        for (size_t k = from; k <= to; k++)
            film->wet[k] |= WETTING;
        grown = 1;
    }
    for (size_t i = 1; grown && i < end; i++) {
        longer |= film->wet[i] && i >= r->last;
        film->wet[i] = film->wet[i] != 0;
    }
    w->stride = grown ? 2 * w->stride : 1;
    return longer;
}

int ehl_wet_fill(ehl_wet *w, const ehl_reynolds *r, ehl_film *film)
{
    int most = r->rough ? ROUGH_FILLINGS : MOST_FILLINGS; /* a rough step fails then, and is cut */
    int filled = 0, beside = 0; /* beside: the node in front was void and is now wet */
    for (size_t i = 1; i + 1 < r->nodes; i++) {
        int over = !film->wet[i] && film->content[i] > r->oil.density * r->h[i];
        int careful = w->filled[i] >= HASTY_FILLINGS;
        beside = over && !(careful && beside) && w->filled[i] < most;
        if (!beside)
            continue;
        filled = film->wet[i] = 1;
        w->filled[i]++;
    }
    return filled;
}

double ehl_wet_shrink(ehl_wet *w, const ehl_reynolds *r, ehl_film *film, double *change)
{
    size_t nodes = r->nodes;
    double cut = 0;
    int wet_behind = 0;
    memset(change, 0, nodes * sizeof *change);
    w->torn = 0;
    for (size_t i = nodes - 2; i > 0; i--) {
        wet_behind |= film->wet[i] && !(film->p[i] < 0);
        if (film->p[i] < 0) {
            w->torn |= wet_behind;
            change[i] = -film->p[i];
            cut = fmax(cut, -film->p[i]);
            film->p[i] = 0;
            film->wet[i] = 0;
            film->touch[i] = 0;
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
        return dp > rough_most * most / 0.3 ? rough_most * most / (0.3 * dp) : 1;
    for (size_t i = 1; i < r->last; i++) { /* the film keeps a tenth of its thickness */
        double part = r->h[i] > r->floor && film->wet[i] ? -dh[i] / (0.9 * r->h[i]) : 0;
        fall = part > fall ? part : fall;
    }
    return fmin(share, 1 / fall);
}
