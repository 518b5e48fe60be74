/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Temperature and flow across a film, for a film whose pressure and gap are held:
 *
 *   rho c (dT/dt + u dT/dx + w dT/dz) = k d2T/dz2 - (T/rho)(d rho/dT)(dp/dt + u dp/dx) + tau du/dz
 *   tau = tau_m + (z - h/2) dp/dx,  u = u_1 at z = 0 and u_2 at z = h,  |tau_m| <= limiting stress
 *   du/dz = rate(tau_s) + (d rate/d tau)(tau_s) (tau - tau_s),  int rate(tau_s) dz = u_2 - u_1
 *
 * with k(p), in zeta = z/h at the nodes of across.h, in weak form, so that the flux into the flanks
 * is the natural condition; along x by differences of second order from where the oil comes. w
 * follows from the balance of mass. The rates are taken at tau_s, as the mobility of the isothermal
 * film is: where all the film has one temperature the flow is the same. Oil that enters has the
 * temperature T_in, and so have flanks that have not been in the contact. Where there is no film
 * the oil carries on as it is, and no heat flows.
 *
 * The nodes of rough flanks move with the mean speed of the flanks. u is then the speed beyond it,
 * of oil and flanks, changes in time are those along the path, and the equations are the same; oil
 * and flanks come from both sides. Where asperities are in contact their friction is the heat of
 * the oil between them: it has nearly one temperature, and so have both flanks.
 */
#ifndef EHL_ENERGY_H
#define EHL_ENERGY_H

#include "../contact/liquid.h"
#include "../estimates/inlet-heat.h"
#include "across.h"
#include "half-space.h"

/* The film at one instant. */
typedef struct ehl_energy_film {
    size_t count; /* nodes that pressure can reach */
    double dx, rate;
    double speed[2]; /* of the flanks, along the nodes */
    double frame;    /* of the nodes, along the film: 0, or the mean speed of the flanks */
    const double *p, *h;
    const double *p_t;             /* dp/dt; NULL: steady */
    const double *through;         /* mass that passes, kg/(m s), nodes; NULL: dp/dx is held */
    const unsigned char *full;     /* 1: the film is full */
    const unsigned char *asperity; /* 1: asperities are in contact; NULL: none are */
    const double *friction; /* heat of asperities, W/m2, nodes; 0 where none touch; NULL: nowhere */
    const double *weight;   /* how much a change at a node matters to the film; NULL: 1 */
    const double *past;     /* dT/dt = rate T + past; NULL: steady */
    const double *past_modes[2]; /* the same of the modes of both flanks */
} ehl_energy_film;

/* 1: asperities are in contact at node i, and carry p. */
static inline int ehl_energy_touches(const ehl_energy_film *film, size_t i)
{
    return film->asperity && film->asperity[i];
}

/* The unknowns of one instant. */
typedef struct ehl_temperature {
    double *T;        /* K, nodes x across */
    double *modes[2]; /* of the flanks, nodes x their count */
} ehl_temperature;

/* Coefficients of the equations of one column. */
typedef struct ehl_column {
    double damped;                /* conductance of the highest modes across, W/(m2 K) */
    double lift[EHL_ACROSS_MOST]; /* transverse transport by the slope at the node */
    /* transport along the nodes, from the column before and from the one behind */
    double on[EHL_ACROSS_MOST], back[EHL_ACROSS_MOST];
    double own[EHL_ACROSS_MOST]; /* storage, transport and compression, by the temperature here */
    double source[EHL_ACROSS_MOST];   /* heat produced, and storage by earlier instants */
    double level[EHL_ACROSS_MOST];    /* resists a change that is one across, without tau_m */
    double diagonal[EHL_ACROSS_MOST]; /* level, and what resists differences across */
} ehl_column;

typedef struct ehl_energy {
    size_t nodes;
    ehl_across across;
    ehl_laws laws;
    const ff_rheology_2 *flow; /* NULL: Newtonian */
    double conductivity, heat_capacity, T_in;
    ehl_conductivity_rise conducts; /* of the conductivity over p */
    ehl_half_space flank[2];
    double *memory;
    /* nodes x across */
    double *p, *ln_eta, *rho, *tau, *gamma, *u, *through;
    double *gamma_tau, *gamma_eta; /* slopes of the shear rate by tau and by ln(eta) */
    ehl_column *column;            /* nodes */
    double *base[2];  /* temperature of the flanks without the flux at the node, over T_in, nodes */
    double *inverse;  /* of the equations of each node, nodes x across^2 */
    double *inverted; /* the coefficients at the last inversion: diagonal, lift, level */
    double keep;      /* change of these, over the diagonal, up to which the inverse is kept */
    double *called_p, *called_T; /* where the laws were called last; T = 0: nowhere yet */
    double *called_ln_eta, *ln_eta_p, *ln_eta_T, *called_rho, *rho_p, *rho_T; /* what they gave */
    double *bend;   /* curvature of ln(eta), by its own first-order change since the last call */
    double *before; /* ln(eta) of the last flow */
    /* nodes */
    int guessed;            /* tau_m has been computed before; 0: guess it first */
    double *tau_m;          /* tau_s, Pa, the stress without dp/dx, whose rates are the flow */
    double *excess;         /* part of tau_m beyond the limiting stress: tau lacks it, Pa */
    double *p_x;            /* Pa/m, of the flow */
    double *mobility;       /* -d(flow of mass)/d(dp/dx), kg s/m2 m: f of the tangent */
    double *mass;           /* rho h, kg/m2 */
    double *carried;        /* mass that flows without dp/dx, over the entrainment, kg/m2 */
    double *flux[2];        /* into the flanks, W/m2 */
    unsigned char *reverse; /* 1: oil flows towards the first node */
    unsigned char *there;   /* 1: tau_m has been found */
    double highest, lowest; /* K, bounds of the temperatures that the laws are called with */
    double reach;           /* change of ln(eta) up to which laws are followed by their slopes */
    double damping;         /* of the highest modes across, over the usual one */
    double share;           /* of the change of each temperature that a sweep takes */
    double change;          /* largest change of ln(eta) by the last sweep, weighted */
    ff_status law_status;
} ehl_energy;

ff_status ehl_energy_create(ehl_energy *e, size_t nodes, size_t across);
void ehl_energy_destroy(ehl_energy *e);

/* Forgets all that is kept of other films. */
void ehl_energy_restart(ehl_energy *e);

/* Computes all of e at these temperatures except the fluxes: the laws and the flow across the film.
 */
void ehl_energy_flow(ehl_energy *e, const ehl_energy_film *film, const double *T);

/* One sweep of Newton's method for the temperatures. The dissipation is linearised with tau_m
 * within each column; all else is linear. A sweep takes `share` of the change, and keeps inverses
 * whose equations have changed by less than `keep`. The flow must be that of the temperatures. */
void ehl_energy_sweep(ehl_energy *e, const ehl_energy_film *film, const ehl_temperature *t);

/* Heat per width of the film, W/m, by the equations that are solved; their sum is what the solution
 * has left unbalanced. */
typedef struct ehl_energy_sums {
    double shear, compression, asperities, stored, carried, flank[2];
} ehl_energy_sums;

ehl_energy_sums ehl_energy_balance(ehl_energy *e, const ehl_energy_film *film,
                                   const ehl_temperature *t);

#endif
