/* Draft: may change until a release freezes it. SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.film/1": a solver for the film of a smooth line contact at one instant.
 *
 * ehl/finite-volume computes the initial film, chooses the time steps, continues the film through
 * contact loss, writes the outputs and judges them. If its wire `discretisation` is connected, it
 * calls the solver of that stage for the film of each instant:
 *
 *   film: {use: ehl/finite-volume, discretisation: mine}
 *   mine: {use: discretisation/penalty}
 *
 * The film has a pressure p >= 0, which is 0 at the first and the last node, and a gap h, with
 *
 *   d/dx (f dp/dx) = u d(rho h)/dx + d(rho h)/dt,   f = rho h^3 psi/12,   in the full film,
 *   h = h00 + x^2/(2 R) + v,   v(x) = -4/(pi E') int p(x') ln(|x - x'|/half_width) dx',
 *   int p dx = load.
 *
 * The solver chooses how to discretise these equations on the nodes and how to iterate. The caller
 * checks its results by independent sums: the load to 1e-8 of the largest load, everything else to
 * a few per cent, which allows for the discretisation error of the cells. A film with a larger
 * error fails the run.
 *
 * All numbers are SI; all pressures are gauge pressures. Arrays have one value per node, never
 * overlap, and belong to the caller.
 */
#ifndef FLANKFILM_FILM_H
#define FLANKFILM_FILM_H

#include "laws.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_FILM_ID "flankfilm.film/1"

/* Constants of a run, the same for all instants. */
typedef struct ff_film_contact {
    size_t size;
    size_t nodes;       /* 17 or more, equally spaced; x increases in the direction of oil flow */
    double dx, first;   /* m; x[i] = first + i dx, and x = 0 is the middle of the contact */
    double half_width;  /* Hertzian half width under the largest load, m */
    double pressure;    /* Hertzian pressure under the largest load, Pa */
    double modulus;     /* E', Pa: 2/E' = sum (1 - nu^2)/E */
    double tolerance;   /* convergence: last change of p relative to the highest pressure */
    int32_t order;      /* required order of the wedge term u d(rho h)/dx: 1 or 2 */
    int32_t conserving; /* 1: the cavitated zone conserves mass: the share content/(rho h) of the
                           gap is filled and moves with the oil; 0: mass there is ignored */
    /* Called with T = NULL, the laws use the temperature of the run. */
    const ff_viscosity *viscosity;
    const ff_density *density;
    const ff_rheology *rheology; /* NULL: Newtonian, psi = 1/eta */
} ff_film_contact;

/* The given values of an instant. */
typedef struct ff_film_instant {
    size_t size;
    double entrainment; /* u = |u1 + u2|/2, m/s */
    double sliding;     /* u1 - u2, m/s */
    double radius;      /* R, m */
    int32_t loaded;     /* 1: h00 follows from the load; 0: h00 is given, and the load follows */
    double load;        /* N/m, when loaded */
    double rate;        /* factor in d(rho h)/dt = rate rho h + past, 1/s; 0: steady */
    const double
        *past; /* term in the same sum, from rho h of earlier instants, kg/(m2 s); NULL: 0 */
} ff_film_instant;

/* On input: the last film, an extrapolation of the last films, or a first guess. On output: the
   film of the instant; undefined after FF_NOCONV. */
typedef struct ff_film_state {
    size_t size;
    double *p;           /* Pa */
    double *v;           /* m */
    double h00;          /* m */
    unsigned char *full; /* 1: full, 0: cavitated, with p = 0; 0 at both ends */
    double *content;     /* kg/m2, theta rho h where cavitated; used if `conserving` */
    double iterations;   /* output: number of iterations, for the record */
} ff_film_state;

typedef struct ff_film {
    size_t size;
    const void *self;
    /* Creates a solver for one run. Any number of solvers may exist, in any threads; one thread at
       a time uses a solver. *contact must outlive the solver. FF_UNSUPPORTED: the solver cannot
       treat this film; host->fail gives the reason. */
    ff_status (*open)(const void *self, const ff_film_contact *contact, void **solver);
    /* FF_OK, or FF_NOCONV if no solution was found; the caller then tries another guess or a
       shorter step. The result must depend only on the arguments. */
    ff_status (*solve)(void *solver, const ff_film_instant *instant, ff_film_state *film);
    void (*close)(void *solver); /* accepts NULL */
} ff_film;

#ifdef __cplusplus
}
#endif
#endif
