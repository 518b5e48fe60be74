/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Relative errors of a film due to the cells. Those of h_min and h_central come from their
 * transport or from a film on half the cells, that of the pressure peak from a model of its spike.
 * Errors above their limits are measured on more cells. */
#ifndef EHL_SPACE_ERROR_H
#define EHL_SPACE_ERROR_H

#include "../equations/solver.h"

#include <math.h>

/* Above these limits the quality lines are doubtful. */
#define EHL_FILM_LIMIT 0.02
#define EHL_PEAK_LIMIT 0.1

/* A larger error due to the cells is taken as infinite, that is, not known: on cells so coarse, the
 * order of convergence does not hold. */
#define EHL_KNOWN_ERROR 0.5

static inline double ehl_known_error(double error)
{
    return fabs(error) <= EHL_KNOWN_ERROR ? error : (double)INFINITY;
}

/* The values of a film from which the error of its peak follows. */
typedef struct ehl_crest {
    const double *p;
    double h_central, p_max;
} ehl_crest;

/* The spike at the outlet. */
typedef struct ehl_spike {
    double seen, tip; /* Pa: highest node, 0 if there is no spike; and the estimated tip */
    double cut;       /* the share of the tip that the cells cut off, by the formula */
    double error;     /* of p_max */
} ehl_spike;

enum { EHL_LEAST, EHL_CENTRAL, EHL_PEAK, EHL_BOUNDS };

/* Estimates the spike at the outlet, which the cells may cut off. */
ehl_spike ehl_spike_of(const ehl_reynolds *eq, const ehl_instant *at, double modulus,
                       const ehl_crest *of);

/* Returns the order of the errors due to the cells. It is 1 for control volumes that may be
   cavitated, since the change in time is then taken at one node. */
int ehl_space_order(const ehl_reynolds *eq);

/* The film of an instant, and how it changes. */
typedef struct ehl_instant_film {
    double h_central, p_max;
    ehl_instant at;
    size_t cells;
    double frame;   /* m/s, speed of a frame in which the film changes slowly */
    double *change; /* rate of change of its mass in that frame, at the nodes, kg/(m2 s) */
} ehl_instant_film;

/* Whether the film is much the same as one with these values. */
int ehl_is_like(const ehl_instant_film *f, double h_central, double p_max);

/* Solves the contact of an instant, whose load is > 0, on 1, 2, 4, 8, 16 times the cells of `s`,
 * until it is known whether the error of the peak exceeds `enough` > 0. If no film is found on 8 or
 * 16 times the cells, the films on fewer cells decide. Gives the relative error of run->p_max;
 * *finest is the largest number of cells used, divided by that of `s`. On more cells than those of
 * `run`, `fine` gives the rate of change of the mass, in a frame that moves with the spike at the
 * outlet: in a fixed frame the spike passes each place, and the cells of `run` have smoothed this
 * change. Returns FF_OK; FF_NOMEM; FF_NOCONV if no film is found, or if the film on the cells of
 * `s` is not that of `run`. */
ff_status ehl_peak_error(const ehl_solver *s, const ehl_instant_film *run,
                         const ehl_instant_film *fine, double enough, double *error, int *finest);

#endif
