/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Balances over volumes on one side of their node, for ehl/control-volume (reynolds.h). */
#include "reynolds.h"

/* Returns whether the flow at a face is of second order. The first order is used downstream of a
   cavitated node, where the film begins sharply. The order must not depend on the states of nodes i
   and i + 1 next to the face; otherwise a node could be neither full nor cavitated. */
static int is_second_order(const ehl_reynolds *r, const ehl_film *film, size_t i)
{
    return r->wedge == 2 && !(i > 0 && ehl_is_cavitated(r, film, i - 1));
}

/* Weights of the wedge flow q(i) at the face behind node i, from the flows Q = u rho h of the
   nodes: q(i) = here Q(i) + next Q(i+1). */
typedef struct face {
    double here, next;
} face;

static face face_weights(const ehl_reynolds *r, const ehl_film *film, size_t i)
{
    int second = is_second_order(r, film, i) && i + 2 < r->nodes;
    return second ? (face){1.5, -0.5} : (face){1, 0};
}

/* Returns the fraction of the mass between the midpoints on both sides of node i that belongs to
   the volume of node i; the rest belongs to the next volume. If nodes may be cavitated, the
   fraction is 1: in short steps the trapezoidal rule would require a negative mass in one volume to
   balance an excess in the next volume. */
static double own_part(const ehl_reynolds *r)
{
    return r->wedge == 2 && !r->conserving ? 0.5 : 1;
}

/* Returns Q(i), or 0 downstream of the last node that pressure can reach. */
static double between(const ehl_reynolds *r, const ehl_film *film, size_t i)
{
    return i < r->last ? r->mean[i] * (film->p[i + 1] - film->p[i]) / r->dx : 0;
}

void ehl_asymmetric_balance(ehl_reynolds *r, const ehl_step *step, const ehl_film *film)
{
    size_t n = r->nodes;
    const double *m = r->carry ? r->carried : r->mass;
    double flow = between(r, film, 0), own = own_part(r);
    for (size_t i = 0; i + 1 < n; i++) {
        face c = face_weights(r, film, i);
        double next = between(r, film, i + 1);
        r->flux[i] = c.here * flow + c.next * next - step->entrainment * m[i];
        flow = next;
    }
    for (size_t i = 1; i + 1 < n; i++)
        r->residual[i] = r->flux[i] - r->flux[i - 1];
    for (size_t i = 1; step->past && i + 1 < n; i++) {
        double here = step->rate * r->mass[i] + step->past[i],
               before = step->rate * r->mass[i - 1] + step->past[i - 1];
        r->residual[i] -= r->dx * (own * here + (1 - own) * before);
    }
}

/* Adds weight times Q(k) to row i. */
static void add_flow(ehl_reynolds *r, const ehl_film *film, size_t i, size_t k, double weight)
{
    if (k >= r->last)
        return;
    size_t s = k + EHL_ASYMMETRIC_BEFORE - i;
    double rise = weight * (film->p[k + 1] - film->p[k]) / r->dx,
           mean = weight * r->mean[k] / r->dx;
    double left = rise * r->mean_left[k], right = rise * r->mean_right[k];
    if (!ehl_is_cavitated(r, film, k))
        r->by_p[s][i] += left * r->f_p[k] - mean;
    if (!ehl_is_cavitated(r, film, k + 1))
        r->by_p[s + 1][i] += right * r->f_p[k + 1] + mean;
    r->by_h[s][i] += left * r->f_h[k];
    r->by_h[s + 1][i] += right * r->f_h[k + 1];
}

/* Adds `stored` times m(k), plus `flows` times the mass transported with the flanks, to row i. */
static void add_mass(ehl_reynolds *r, const ehl_film *film, size_t i, size_t k, double stored,
                     double flows)
{
    size_t s = k + EHL_ASYMMETRIC_BEFORE - i;
    double weight = stored + flows * (r->carry ? r->carry[k] : 1);
    if (ehl_is_cavitated(r, film, k)) {
        r->by_p[s][i] += weight * r->unit;
        return;
    }
    r->by_p[s][i] += weight * r->liquid.rho_p[k] * r->h[k];
    r->by_h[s][i] += weight * r->liquid.rho[k];
}

void ehl_asymmetric_slopes(ehl_reynolds *r, const ehl_step *step, const ehl_film *film)
{
    double storage = r->dx * step->rate, u = step->entrainment, own = own_part(r);
    for (size_t i = 1; i < r->last; i++) {
        for (size_t s = 0; s < EHL_STENCIL; s++)
            r->by_p[s][i] = r->by_h[s][i] = 0;
        if (!film->full[i] && !r->conserving)
            continue;
        face in = face_weights(r, film, i - 1), out = face_weights(r, film, i);
        add_flow(r, film, i, i - 1, -in.here);
        add_flow(r, film, i, i, out.here - in.next);
        add_flow(r, film, i, i + 1, out.next);
        add_mass(r, film, i, i, -storage * own, -u);
        add_mass(r, film, i, i - 1, -storage * (1 - own), u);
    }
}
