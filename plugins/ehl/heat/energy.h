/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Temperature and flow across a film with given pressure and gap. The balance of energy is rho c
   (dT/dt + u dT/dx + w dT/dz) = k d2T/dz2 - (T/rho)(d rho/dT)(dp/dt + u dp/dx) + tau du/dz. The
   stress is tau = tau_m + (z - h/2) dp/dx with |tau_m| <= limiting stress, and the speed is u_1 at
   z = 0 and u_2 at z = h. The shear rate is du/dz = rate(tau_s) + (d rate/d tau)(tau_s) (tau -
   tau_s), where tau_s is the stress without dp/dx: int rate(tau_s) dz = u_2 - u_1. This
   linearisation is that of the isothermal film, so that a film with uniform temperature has the
   same flow as an isothermal film. The conductivity k depends on p. Across the
   film the equations are solved in weak form in zeta = z/h, at the nodes of across.h, so that
   the heat flux into the flanks is the natural boundary condition. Along x they use second-order
   upwind differences. w follows from the balance of mass. Oil that enters, and flanks before they
   enter the contact, have the temperature T_in. Where there is no film, the oil moves without
   change of temperature and without heat flow. The nodes of rough flanks move with the mean speed
   of the flanks. For these, u is the speed relative to the nodes and changes in time are taken
   along the path of the nodes; the equations are the same, and oil and flanks enter from both
   sides. Where asperities are in contact, their friction heats the oil between them. That oil and
   both flanks have nearly the same temperature. */
#ifndef EHL_ENERGY_H
#define EHL_ENERGY_H

#include "../contact/liquid.h"
#include "../estimates/inlet-heat.h"
#include "across.h"
#include "half-space.h"

/* The film at one instant. */
typedef struct ehl_energy_film {
    size_t count; /* number of nodes that pressure can reach */
    double dx, rate;
    double speed[2]; /* speed of each flank relative to the nodes */
    double frame;    /* speed of the nodes along the film: 0, or the mean speed of the flanks */
    const double *p, *h;
    const double *p_t;             /* dp/dt; NULL: steady */
    const double *through;         /* mass flow, kg/(m s), at the nodes; NULL: the flow
                                      follows from dp/dx */
    const unsigned char *full;     /* 1: the film is full */
    const unsigned char *asperity; /* 1: asperities are in contact; NULL: nowhere */
    const double *friction;        /* friction heat of asperities, W/m2, at the nodes; 0 where none
                                      touch; NULL: nowhere */
    const double *weight;          /* weight of each node in `change` of ehl_energy; NULL: 1 */
    const double *past;            /* dT/dt = rate T + past; NULL: steady */
    const double *past_modes[2];   /* past contribution to the time derivative of the temperature
                                      modes of both flanks */
} ehl_energy_film;

/* Returns 1 if asperities are in contact at node i and carry p. */
static inline int ehl_energy_touches(const ehl_energy_film *film, size_t i)
{
    return film->asperity && film->asperity[i];
}

/* The unknowns of one instant. */
typedef struct ehl_temperature {
    double *T;        /* K, for each node and each point across the film */
    double *modes[2]; /* modes of the flanks, for each node */
} ehl_temperature;

/* Coefficients of the equations of one column of nodes. */
typedef struct ehl_column {
    double damped;                /* artificial conductance, W/(m2 K), that damps the highest
                                     modes of the temperature across the film */
    double lift[EHL_ACROSS_MOST]; /* transverse transport, as a factor of the slope at the point */
    /* transport along the nodes, from the previous and from the next column */
    double on[EHL_ACROSS_MOST], back[EHL_ACROSS_MOST];
    double own[EHL_ACROSS_MOST];      /* storage, transport and compression, as a factor of the
                                         temperature at the point */
    double source[EHL_ACROSS_MOST];   /* heat produced, and storage terms from earlier instants */
    double level[EHL_ACROSS_MOST];    /* derivative of the equation at the point with respect to a
                                         temperature change that is uniform across the film and
                                         does not change tau_m */
    double diagonal[EHL_ACROSS_MOST]; /* level, plus the diagonal entries of conduction and
                                         transport across the film */
} ehl_column;

typedef struct ehl_energy {
    size_t nodes;
    ehl_across across;
    ehl_laws laws;
    const ff_rheology_2 *flow; /* NULL: Newtonian */
    double conductivity, heat_capacity, T_in;
    ehl_conductivity_rise conducts; /* increase of the conductivity with p */
    ehl_half_space flank[2];
    double *memory;
    /* for each node and each point across the film */
    double *p, *ln_eta, *rho, *tau, *gamma, *u, *through;
    double *gamma_tau, *gamma_eta; /* derivatives of the shear rate with respect to tau and to
                                      ln(eta) */
    ehl_column *column;            /* one per node */
    double *base[2];  /* for each node: temperature of the flanks minus T_in, without the heat
                         that enters them at this node */
    double *inverse;  /* inverse of the equations of each node, nodes x across^2 */
    double *inverted; /* coefficients at the last inversion: diagonal, lift, level */
    double keep;      /* an inverse is reused if its coefficients have changed by less than this,
                         relative to the diagonal */
    double *called_p, *called_T; /* arguments of the last evaluation of the laws; T = 0: not yet
                                    evaluated */
    /* results of the last evaluation */
    double *called_ln_eta, *ln_eta_p, *ln_eta_T, *called_rho, *rho_p, *rho_T;
    double *bend;   /* curvature of a parabola d + bend d^2 that extrapolates ln(eta) from the last
                       evaluation of the laws; d is its change to first order in p and T */
    double *before; /* ln(eta) when the flow was last computed */
    int guessed;    /* 1: tau_m has been computed before; 0: tau_m must be guessed first */
    /* one value per node */
    double *tau_m;          /* Pa: first tau_s, then the solution tau_m of the linearised flow */
    double *excess;         /* part of tau_m beyond the limiting stress, Pa; it is subtracted from
                               tau */
    double *p_x;            /* pressure gradient of the flow, Pa/m */
    double *mobility;       /* mobility f of the linearised flow: -d(mass flow)/d(dp/dx) */
    double *mass;           /* rho h, kg/m2 */
    double *carried;        /* mass flow without dp/dx, over the entrainment, kg/m2 */
    double *flux[2];        /* heat flux into the flanks, W/m2 */
    unsigned char *reverse; /* 1: oil flows towards the first node */
    unsigned char *there;   /* 1: tau_m has been found */
    double highest, lowest; /* bounds of the temperatures with which the laws are evaluated, K */
    double reach;           /* change of ln(eta) up to which the laws are extrapolated */
    double damping;         /* factor on the artificial conductance `damped` */
    double share;           /* share of the change of each temperature that a sweep takes */
    double change;          /* largest change of ln(eta) in the last sweep, weighted */
    ff_status law_status;
} ehl_energy;

ff_status ehl_energy_create(ehl_energy *e, size_t nodes, size_t across);
void ehl_energy_destroy(ehl_energy *e);

/* Removes all data stored about earlier films. */
void ehl_energy_restart(ehl_energy *e);

/* Computes all members of e at these temperatures except the fluxes: the laws and the flow across
   the film. */
void ehl_energy_flow(ehl_energy *e, const ehl_energy_film *film, const double *T);

/* Performs one sweep of Newton's method for the temperatures. Within each column the dissipation is
   linearised, including tau_m; all other terms are linear. A sweep takes `share` of the change, and
   reuses inverses whose equations have changed by less than `keep`. The flow must have been
   computed for the current temperatures. */
void ehl_energy_sweep(ehl_energy *e, const ehl_energy_film *film, const ehl_temperature *t);

/* Heat per width of the film, W/m, from the equations that are solved. The sum of all members is
   the remaining imbalance of the solution. */
typedef struct ehl_energy_sums {
    double shear, compression, asperities, stored, carried, flank[2];
} ehl_energy_sums;

ehl_energy_sums ehl_energy_balance(ehl_energy *e, const ehl_energy_film *film,
                                   const ehl_temperature *t);

#endif
