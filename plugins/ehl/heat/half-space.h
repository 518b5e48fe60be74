/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The surface of a flank, heated as it moves: a half-space without conduction along x (Carslaw &
 * Jaeger 1959, 2.9). Each material point has
 *
 *   T = T_bulk + 1/(sqrt(pi) B) int_0^inf q(t - s) s^(-1/2) ds,   B = sqrt(k rho c).
 *
 * s^(-1/2) = int e^(y/2) exp(-e^y s) dy/sqrt(pi) is a sum of exponentials by the trapezoidal rule
 * in y, so that each of them is a mode phi that moves with the flank,
 *
 *   d phi/dt + u d phi/dx = q - lambda phi,
 *
 * and remembers all that was before. What decays faster than the oil passes a cell is at its steady
 * value q/lambda, what decays slower than the flank passes the domain is one mode. The modes are
 * solved for from node to node, exactly for a q - d phi/dt that is linear between them.
 */
#ifndef EHL_HALF_SPACE_H
#define EHL_HALF_SPACE_H

#include <stddef.h>

/* EHL_MODES and `count` are multiples of the modes that are treated at once; modes beyond the last
 * one have no weight. */
enum { EHL_MODES = 40 };

typedef struct ehl_half_space {
    size_t count;
    /* 1/s; of the kernel, s^(-1/2) = sum weight exp(-lambda s) */
    double lambda[EHL_MODES], weight[EHL_MODES];
    double instant; /* weight of the modes that are steady at once, s^(1/2) */
    double scale;   /* 1/(sqrt(pi) B), m2 K s^(1/2)/J */
} ehl_half_space;

/* Creates a flank with B in J/(m2 K s^(1/2)), for times from `shortest` to `longest`, s. */
void ehl_half_space_create(ehl_half_space *f, double B, double shortest, double longest);

/* Passage of a mode from a node to the next one: it becomes `keep` times the mode plus `before` and
 * `here` times its sources at both nodes. */
typedef struct ehl_passage {
    double keep[EHL_MODES], before[EHL_MODES], here[EHL_MODES];
    double own; /* K m2/W: temperature at a node per flux at it */
} ehl_passage;

/* Computes the passage of a flank that moves at u >= 0 along nodes dx apart, with d phi/dt = rate
 * phi + past. */
void ehl_half_space_pass(const ehl_half_space *f, double u, double dx, double rate, ehl_passage *p);

/* Sets the modes at a node to their part without the flux there, from the modes and the flux at the
 * node before and the pasts of both nodes; NULL: steady. Returns that part of T - T_bulk. */
double ehl_half_space_reach(const ehl_half_space *f, const ehl_passage *p,
                            const double *modes_before, double flux_before,
                            const double *past_before, const double *past, double *modes);

/* Adds the flux at the node to its modes. */
void ehl_half_space_add(const ehl_half_space *f, const ehl_passage *p, double flux, double *modes);

#endif
