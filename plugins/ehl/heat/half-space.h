/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The surface of a flank that is heated while it moves, as a half-space without conduction along x
 * (Carslaw & Jaeger 1959, 2.9). The temperature of each material point is
 *   T = T_bulk + 1/(sqrt(pi) B) int_0^inf q(t - s) s^(-1/2) ds,   B = sqrt(k rho c).
 * s^(-1/2) = int e^(y/2) exp(-e^y s) dy/sqrt(pi) is approximated by a sum of exponentials, by the
 * trapezoidal rule in y. Each exponential is a mode phi that moves with the flank and stores the
 * history of the flux:
 *   d phi/dt + u d phi/dx = q - lambda phi,
 * Modes that decay faster than the oil passes a cell have their steady value q/lambda. All modes
 * that decay more slowly than the flank passes the domain are combined into one. The modes are
 * integrated from node to node, exactly if q - d phi/dt is linear between them.
 */
#ifndef EHL_HALF_SPACE_H
#define EHL_HALF_SPACE_H

#include <stddef.h>

/* EHL_MODES and `count` are multiples of the SIMD width; modes beyond the last one have the weight
   0. */
enum { EHL_MODES = 40 };

typedef struct ehl_half_space {
    size_t count;
    /* decay rates, 1/s, and weights of the kernel: s^(-1/2) = sum weight exp(-lambda s) */
    double lambda[EHL_MODES], weight[EHL_MODES];
    double instant; /* total weight of the modes that are always in their steady state, s^(1/2) */
    double scale;   /* 1/(sqrt(pi) B), m2 K s^(1/2)/J */
} ehl_half_space;

/* Makes a flank with B in J/(m2 K s^(1/2)), for times from `shortest` to `longest`, s. */
void ehl_half_space_create(ehl_half_space *f, double B, double shortest, double longest);

/* Coefficients of the modes from one node to the next: the value at the next node is `keep` times
   the value at the node, plus `before` and `here` times the sources at both nodes. */
typedef struct ehl_passage {
    double keep[EHL_MODES], before[EHL_MODES], here[EHL_MODES];
    double own; /* temperature at a node per heat flux at that node, K m2/W */
} ehl_passage;

/* Computes these coefficients for a flank that moves at u >= 0 along nodes dx apart, with d phi/dt
   = rate phi + past. */
void ehl_half_space_pass(const ehl_half_space *f, double u, double dx, double rate, ehl_passage *p);

/* Sets the modes at a node without the effect of the flux at this node, from the modes and the flux
   at the previous node and the `past` of both nodes (NULL: steady). Returns the resulting T -
   T_bulk. */
double ehl_half_space_reach(const ehl_half_space *f, const ehl_passage *p,
                            const double *modes_before, double flux_before,
                            const double *past_before, const double *past, double *modes);

/* Adds the effect of the flux at the node to its modes. */
void ehl_half_space_add(const ehl_half_space *f, const ehl_passage *p, double flux, double *modes);

#endif
