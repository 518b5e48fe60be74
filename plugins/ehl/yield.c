/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "yield.h"

#include <math.h>
#include <string.h>

int ehl_yield_begin(const ehl_reynolds *r, ehl_film *film)
{
    int changed = 0;
    film->yielding = 0;
    for (size_t i = 0; film->plastic && i < r->nodes; i++) {
        int yields = film->p[i] >= r->hardness;
        changed |= film->p[i] > r->hardness;
        film->p[i] = yields ? r->hardness : film->p[i];
        film->plastic[i] = yields ? film->plastic[i] : 0;
        film->yielding += (size_t)yields;
    }
    return changed;
}

void ehl_yield_columns(ehl_reynolds *r, const ehl_film *film)
{
    for (size_t i = 1; film->yielding > 0 && i < r->last; i++)
        for (size_t s = 0; s < EHL_STENCIL && ehl_yields(r, film, i); s++)
            if (i + 2 > s && i + 2 - s < r->last)
                r->by_p[s][i + 2 - s] = r->by_h[s][i + 2 - s] * r->give;
}

void ehl_yield_step(const ehl_reynolds *r, ehl_film *film, double share, const double *step)
{
    for (size_t i = 1; film->yielding > 0 && i < r->last; i++)
        if (ehl_yields(r, film, i))
            film->plastic[i] += share * r->give * step[i];
}

double ehl_yield_turn(const ehl_reynolds *r, ehl_film *film, double *change)
{
    double cut = 0, below = nextafter(r->hardness, 0);
    for (size_t i = 1; film->plastic && i < r->last; i++) {
        double over = film->p[i] - r->hardness;
        if (over > 0) {
            change[i] -= over;
            film->p[i] = r->hardness;
            film->yielding++;
            cut = fmax(cut, over);
        } else if (film->plastic[i] < 0) {
            cut = fmax(cut, -film->plastic[i] / r->give);
            film->p[i] = below;
            film->plastic[i] = 0;
            film->yielding--;
        }
    }
    return cut;
}

double ehl_yield_load(const ehl_reynolds *r, const ehl_film *film)
{
    double sum = 0;
    for (size_t i = 1; film->yielding > 0 && i + 1 < r->nodes; i++)
        sum += ehl_yields(r, film, i) ? r->hardness : 0;
    return sum * r->dx;
}

int ehl_yield_balance(const ehl_reynolds *r, ehl_film *film, double load, double *change)
{
    enum { ROUNDS = 8 }; /* as the last of the load puts further nodes to H */
    size_t n = r->nodes;
    for (size_t i = 0; i < n; i++)
        change[i] = -film->p[i];
    int held = 0;
    for (int k = 0; k < ROUNDS && !held; k++) {
        double hard = ehl_yield_load(r, film), all = ehl_film_load(film, n, r->dx);
        double factor = (load - hard) / (all - hard);
        if (!(fabs(factor - 1) < 0.05))
            break;
        held = 1;
        for (size_t i = 0; i < n; i++) {
            if (ehl_yields(r, film, i))
                continue;
            film->p[i] = fmin(film->p[i] * factor, r->hardness);
            int reached = film->p[i] >= r->hardness;
            film->yielding += (size_t)reached;
            held &= !reached;
        }
    }
    for (size_t i = 0; i < n; i++)
        change[i] += film->p[i];
    return held;
}
