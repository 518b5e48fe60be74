/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Losses of the film. */
#include "results.h"

#include "../contact/simd-reductions.h"
#include "../heat/thermal.h"

#include <math.h>

/*
 * What the film dissipates, per width. The shear stress varies linearly across the film, tau =
 * tau_m + z p_x, and the flow with it: a part that the sliding drives, and a part that the
 * pressure drives (docs/theory.md, 7.9 to 7.14):
 *
 *   sliding    int tau_m u_s dx, where the film has pressure
 *   pressure   D = int (f/rho) p_x^2 dx
 *   rolling    u_r int h p_x dx, which D is in a steady film
 *   squeeze    D - rolling, the part of it that the film's change in time drives
 *   asperity   boundary friction where the asperities carry
 *
 * Upstream of the domain, where the gap is x^2/(2 R), h p_x = 24 eta0 u_r R/x^2 remains of a
 * flooded inlet: its integral, 24 eta0 u_r R/X, counts in D and in rolling.
 */

/* Forces per width. */
typedef struct shear {
    double fluid, asperities;
} shear;

/*
 * Returns how much of the film the stress at node i stands for, in cells: more where the film ends
 * behind it. There p and its slope are 0 and p'' is some c, and the balance of the last volume is
 * p(i-1) - 2 p(i) = c dx^2. Its solution, p(i-k) = c dx^2 [(k + 1) s + k (k + 1)/2], is up to order
 * dx^2 the parabola that ends s cells behind the face of that volume (docs/theory.md, 7.16).
 */
static double film_of_node(const ehl_reynolds *eq, const double *p, size_t i)
{
    if (eq->rough || i < 1 || i + 1 >= eq->nodes || p[i + 1] > 0)
        return 1;
    /* a wedge from the node upstream balances the volume between both nodes */
    int at_node = eq->asymmetric || eq->wedge == 1;
    double bend = p[i - 1] - 2 * p[i], face = at_node ? 0.5 : 1;
    return face + (bend > p[i] ? p[i] / bend : bend > 0);
}

static shear shear_of(ehl_results *r, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_film *film = &m->state[0].film;
    const double *p = ehl_fluid(eq, film);
    size_t count = eq->last + 1;
    double sliding = m->at.sliding, way = (sliding > 0) - (sliding < 0);
    double fluid = 0, asperities = 0;
    ff_status status =
        ehl_fluid_shear(&eq->laws, count, p, NULL, eq->h, sliding, r->ln_eta, r->tau);
    ehl_law_note(&r->laws, status);
    for (size_t i = 0; i < count; i++) {
        double tau = m->thermal ? ehl_thermal_stress(m, i) : r->tau[i];
        if (p[i] > 0 && !film->asperity[i])
            fluid += tau * film_of_node(eq, p, i);
        asperities += eq->statistical.law ? eq->p_a[i] : film->asperity[i] ? p[i] : 0;
    }
    return (shear){fluid * eq->dx, way * r->boundary_friction * asperities * eq->dx};
}

/* Powers per width of the flow that the pressure drives. */
typedef struct pressure_flow {
    double dissipated, rolling, tail;
    double squeezed; /* by the flanks far from the contact */
} pressure_flow;

/* Returns the sum of (h - end)^2/h^3 over n faces between nodes. */
FF_SIMD
static double entrained_past(size_t n, const double *restrict h, double end)
{
    ehl_lanes sum = {0}, gap, next;
    size_t i = 0;
    for (; i + EHL_LANES <= n; i += EHL_LANES) {
        memcpy(&gap, h + i, sizeof gap);
        memcpy(&next, h + i + 1, sizeof next);
        gap = (gap + next) / 2;
        sum += (gap - end) * (gap - end) / (gap * gap * gap);
    }
    for (; i < n; i++) {
        double here = (h[i] + h[i + 1]) / 2;
        sum[0] += (here - end) * (here - end) / (here * here * here);
    }
    return ehl_lanes_sum(&sum);
}

/*
 * Returns by how much the dissipation in the outer half of the inlet differs from that of a steady
 * film, 12 eta0 u_r^2 (h - h_e)^2/h^3 along the way. `power` is 2 dx times the dissipation of each
 * face. If the radius changes by R' in time, the flanks squeeze the oil at x^2 R'/(2 R^2), and the
 * power of that grows with the domain (docs/theory.md, 7.17).
 */
static double squeezed_far_off(const ehl_march *m, const double *power)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    double u = m->at.entrainment;
    size_t outer = (size_t)(-eq->first / (2 * eq->dx)), centre = 2 * outer;
    double end = m->state[0].mass[centre] / eq->oil.density;
    double entrained = 12 * eq->oil.viscosity * u * u * entrained_past(outer, eq->h, end);
    return fabs(ehl_sum(outer, power) / (2 * eq->dx) - entrained * eq->dx);
}

/* Returns the powers of the newest film. The mobility of the faces is computed again, since that of
   the last Newton step belongs to the film before that step. */
static pressure_flow flow_of(const ehl_results *r, const ehl_march *m)
{
    ehl_reynolds *eq = m->solver->reynolds;
    ehl_reynolds_evaluate(eq, &m->step, &m->state[0].film);
    const double *p = ehl_fluid(eq, &m->state[0].film), *h = eq->h, *rho = eq->liquid.rho;
    double u = m->at.entrainment, dissipated = 0, work = 0, flow = 0;
    double *power = r->tau; /* the stress has been summed */
    /* h p_a(h)_x adds up to 0, and in these sums h p_x is the moment of p to the last digits */
    const double *all = m->state[0].film.p;
    for (size_t i = 0; i < eq->last; i++) {
        double rise = p[i + 1] - p[i];
        power[i] = eq->mean[i] * rise * rise * (rho[i] + rho[i + 1]) / (rho[i] * rho[i + 1]);
        dissipated += power[i];
        work += (h[i] + h[i + 1]) * (all[i + 1] - all[i]);
    }
    if (m->thermal)
        flow = ehl_thermal_pressure_flow(m);
    else
        flow = dissipated / (2 * eq->dx);
    int flooded = p[1] > 0;
    double tail = flooded ? 24 * eq->oil.viscosity * u * m->at.radius / fabs(eq->first) : 0;
    double squeezed = flooded && u > 0 ? squeezed_far_off(m, power) : 0;
    return (pressure_flow){flow + u * tail, u * (work / 2 + tail), u * tail, squeezed};
}

void ehl_results_loss(ehl_results *r, const ehl_march *m)
{
    const shear force = ehl_loss_of_shear(r->wanted) ? shear_of(r, m) : (shear){0, 0};
    const pressure_flow f =
        ehl_loss_of_flow(r->wanted) ? flow_of(r, m) : (pressure_flow){0, 0, 0, 0};
    if (ehl_march_is_loaded(m) && m->at.entrainment > 0 && f.dissipated > 0) {
        r->tail_share = fmax(r->tail_share, f.tail / f.dissipated);
        r->starved += !(f.tail > 0);
        ehl_worse(&r->worst_squeezed, f.squeezed);
    }
    double traction = force.fluid + force.asperities;
    double sliding = force.fluid * m->at.sliding, asperity = force.asperities * m->at.sliding;
    double rolling = f.rolling, squeeze = f.dissipated - f.rolling;
    r->row[EHL_TRACTION] = traction;
    r->row[EHL_FRICTION_COEFFICIENT] = m->contact_lost ? 0 : traction / m->at.load;
    r->row[EHL_SLIDING_LOSS] = sliding;
    r->row[EHL_ROLLING_LOSS] = rolling;
    r->row[EHL_SQUEEZE_LOSS] = squeeze;
    r->row[EHL_ASPERITY_LOSS] = asperity;
    r->row[EHL_POWER_LOSS] = sliding + rolling + squeeze + asperity;
}
