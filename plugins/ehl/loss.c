/* SPDX-License-Identifier: GPL-3.0-or-later */
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
#include "loss.h"

#include <flankfilm/author.h>

#include <math.h>

/* Forces per width. */
typedef struct shear {
    double fluid, asperities;
} shear;

static shear shear_of(ehl_results *r, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_film *film = &m->state[0].film;
    const double *p = film->p;
    size_t count = eq->last + 1;
    double sliding = m->at.sliding, way = (sliding > 0) - (sliding < 0);
    double fluid = 0, asperities = 0;
    ff_status status = ehl_fluid_shear(&eq->laws, count, p, eq->h, sliding, r->ln_eta, r->tau);
    r->out_of_law |= status != FF_OK;
    for (size_t i = 0; i < count; i++) {
        fluid += p[i] > 0 && !film->asperity[i] ? r->tau[i] : 0;
        asperities += film->asperity[i] ? p[i] : 0;
    }
    return (shear){fluid * eq->dx, way * r->boundary_friction * asperities * eq->dx};
}

/* Powers per width of the flow that the pressure drives. */
typedef struct flow {
    double dissipated, rolling, tail;
} flow;

/* The mobility of the faces is that of the last Newton step, whose change of the pressure is below
   the tolerance. */
static flow flow_of(const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = m->state[0].film.p, *h = eq->h, *rho = eq->liquid.rho;
    double u = m->at.entrainment, dissipated = 0, work = 0;
    for (size_t i = 0; i < eq->last; i++) {
        double rise = p[i + 1] - p[i];
        dissipated += eq->mean[i] * rise * rise * (rho[i] + rho[i + 1]) / (rho[i] * rho[i + 1]);
        work += (h[i] + h[i + 1]) * rise;
    }
    int flooded = p[1] > 0;
    double tail = flooded ? 24 * eq->oil.viscosity * u * m->at.radius / fabs(eq->first) : 0;
    return (flow){dissipated / (2 * eq->dx) + u * tail, u * (work / 2 + tail), u * tail};
}

int ehl_loss_of_shear(uint64_t wanted)
{
    return (wanted &
            (FF_BIT(EHL_FRICTION_COEFFICIENT) | FF_BIT(EHL_TRACTION) | FF_BIT(EHL_POWER_LOSS) |
             FF_BIT(EHL_SLIDING_LOSS) | FF_BIT(EHL_ASPERITY_LOSS))) != 0;
}

int ehl_loss_of_flow(uint64_t wanted)
{
    return (wanted &
            (FF_BIT(EHL_POWER_LOSS) | FF_BIT(EHL_ROLLING_LOSS) | FF_BIT(EHL_SQUEEZE_LOSS))) != 0;
}

void ehl_loss_record(ehl_results *r, const ehl_march *m)
{
    const shear force = ehl_loss_of_shear(r->wanted) ? shear_of(r, m) : (shear){0, 0};
    const flow f = ehl_loss_of_flow(r->wanted) ? flow_of(m) : (flow){0, 0, 0};
    if (ehl_march_is_loaded(m) && m->at.entrainment > 0 && f.dissipated > 0) {
        r->tail_share = fmax(r->tail_share, f.tail / f.dissipated);
        r->starved += !(f.tail > 0);
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
