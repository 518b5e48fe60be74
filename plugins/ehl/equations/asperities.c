/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "asperities.h"

#include "../contact/simd-reductions.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <string.h>

/* Returns the derivative with respect to h of the mass that cell i loses, for oil that moves with
   the flanks, without pressure flow. */
static double carried(const ehl_reynolds *r, const ehl_step *step, const ehl_film *film, size_t i)
{
    double near, far, u = step->follows ? 0 : step->entrainment;
    ehl_upwind(r, film, i, &near, &far);
    return r->liquid.rho[i] * (u * near + r->dx * step->rate);
}

/* Does the same as ehl_contact_choose for nodes that move with the oil, so that no oil is
   transported between cells; `by_h` is dx times the rate. */
FF_SIMD
static int64_t choose_moving(size_t n, double contact, double by_h, const double *restrict h,
                             const double *restrict rho, const double *restrict residual,
                             unsigned char *restrict full, unsigned char *restrict asperity)
{
    int64_t changed = 0;
    for (size_t i = 1; i + 1 < n; i++) {
        double open = h[i] - contact, least = full[i] ? -residual[i] : 0;
        double weight = full[i] ? rho[i] * by_h : 1;
        unsigned char now = weight * open < least;
        changed |= now ^ asperity[i];
        asperity[i] = now;
        full[i] |= now;
    }
    return changed;
}

int ehl_contact_choose(const ehl_reynolds *r, const ehl_step *step, ehl_film *film)
{
    int changed = 0;
    if (step->follows)
        return choose_moving(r->nodes, r->contact, r->dx * step->rate, r->h, r->liquid.rho,
                             r->residual, film->full, film->asperity) != 0;
    for (size_t i = 1; i + 1 < r->nodes; i++) {
        double open = r->h[i] - r->contact;
        int asperity =
            film->full[i] ? carried(r, step, film, i) * open < -r->residual[i] : open < 0;
        changed |= asperity != film->asperity[i];
        film->asperity[i] = (unsigned char)asperity;
        film->full[i] |= (unsigned char)asperity;
    }
    return changed;
}

void ehl_contact_rows(ehl_reynolds *r, const ehl_step *step, const ehl_film *film)
{
    for (size_t i = 1; i < r->last; i++) {
        if (!film->asperity[i])
            continue;
        double c = carried(r, step, film, i);
        for (int s = 0; s < EHL_STENCIL; s++)
            r->by_p[s][i] = r->by_h[s][i] = 0;
        r->by_h[2][i] = -c;
        r->residual[i] = -c * (r->h[i] - r->contact);
    }
}

void ehl_contact_mass(ehl_reynolds *r, const ehl_step *step, const ehl_film *film, double *mass)
{
    if (!(step->rate > 0) || !step->follows || !memchr(film->asperity, 1, r->nodes))
        return;
    ehl_reynolds_evaluate(r, step, film);
    for (size_t i = 1; i + 1 < r->nodes; i++)
        if (film->asperity[i])
            mass[i] = fmin(r->mass[i], fmax(0, r->mass[i] + r->residual[i] / (r->dx * step->rate)));
}

void ehl_statistical_rows(ehl_reynolds *r, const ehl_film *film)
{
    for (size_t i = 1; i < r->last; i++) {
        for (size_t s = i > 1 ? 0 : 1; s < EHL_STENCIL && film->full[i]; s++)
            r->by_h[s][i] -= r->by_p[s][i] * r->p_a_h[i + s - 2];
        if (film->full[i])
            continue;
        for (size_t s = 0; s < EHL_STENCIL; s++)
            r->by_p[s][i] = r->by_h[s][i] = 0;
        r->by_p[2][i] = 1;
        r->by_h[2][i] = -r->p_a_h[i];
        r->residual[i] = r->fluid[i];
    }
}

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
    if (!film->plastic ||
        (film->yielding == 0 && !(ehl_greatest(r->last, film->p, 0) > r->hardness)))
        return 0;
    for (size_t i = 1; i < r->last; i++) {
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
    enum {
        ROUNDS = 8
    }; /* rounds are needed, since the remaining load may raise further nodes to
          H */
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
