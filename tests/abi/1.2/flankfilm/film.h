/* Draft: may change until a release freezes it. SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.film/1": a discretisation of the film of a smooth line contact, one instant at
 * a time.
 *
 * ehl/finite-volume finds the film that a history starts with, chooses the time steps, carries the
 * film through lost contact, gives the outputs and judges them. Where its wire `discretisation` is
 * connected, it asks the stage behind it for the film of each instant:
 *
 *   film: {use: ehl/finite-volume, discretisation: mine}
 *   mine: {use: discretisation/penalty}
 *
 * The film has a pressure p >= 0, which is 0 at the first and at the last node, and a gap h, with
 *
 *   d/dx (f dp/dx) = u d(rho h)/dx + d(rho h)/dt,   f = rho h^3 psi/12,   where it is full,
 *   h = h00 + x^2/(2 R) + v,   v(x) = -4/(pi E') int p(x') ln(|x - x'|/half_width) dx',
 *   int p dx = load.
 *
 * How they are discretised on the nodes is the solver's affair, as are its iterations. The caller
 * holds what it gets against sums of its own: the load to 1e-8 of the largest, everything else to
 * some parts in a hundred, which is what may be the error of the cells; a film that is further off
 * fails the run.
 *
 * All numbers are SI, all pressures are gauge. Arrays have one value per node, never overlap, and
 * belong to the caller.
 */
#ifndef FLANKFILM_FILM_H
#define FLANKFILM_FILM_H

#include "laws.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_FILM_ID "flankfilm.film/1"

/* What is the same at all instants of a run. */
typedef struct ff_film_contact {
    size_t size;
    size_t nodes;       /* 17 or more, equally spaced along the motion of the oil */
    double dx, first;   /* m; x[i] = first + i dx, and x = 0 is the middle of the contact */
    double half_width;  /* m, Hertz's under the largest load */
    double pressure;    /* Pa, likewise */
    double modulus;     /* E', Pa: 2/E' = sum (1 - nu^2)/E */
    double tolerance;   /* the last change of p of a solution, over the highest pressure */
    int32_t order;      /* of the wedge term u d(rho h)/dx that is asked for: 1 or 2 */
    int32_t conserving; /* 1: where p = 0 the share content/(rho h) of the gap is filled, and moves
                           with the oil; 0: nothing is asked of the oil there */
    /* The laws answer at the temperature of the run when they are called with T = NULL. */
    const ff_viscosity *viscosity;
    const ff_density *density;
    const ff_rheology *rheology; /* NULL: Newtonian, psi = 1/eta */
} ff_film_contact;

/* What an instant prescribes. */
typedef struct ff_film_instant {
    size_t size;
    double entrainment; /* u = |u1 + u2|/2, m/s */
    double sliding;     /* u1 - u2, m/s */
    double radius;      /* R, m */
    int32_t loaded;     /* 1: h00 follows from the load; 0: h00 is given, and the load follows */
    double load;        /* N/m, when loaded */
    double rate;        /* d(rho h)/dt = rate rho h + past; 1/s, 0: steady */
    const double *past; /* kg/(m2 s), by the rho h of the instants before; NULL: 0 */
} ff_film_instant;

/* In: the last film, one that is extrapolated from the last ones, or a first guess. Out: that of
   the instant, or after FF_NOCONV anything. */
typedef struct ff_film_state {
    size_t size;
    double *p;           /* Pa */
    double *v;           /* m */
    double h00;          /* m */
    unsigned char *full; /* 1: full, 0: cavitated, with p = 0; 0 at both ends */
    double *content;     /* kg/m2, theta rho h where cavitated; used when `conserving` */
    double iterations;   /* out: what it took, for the record */
} ff_film_state;

typedef struct ff_film {
    size_t size;
    const void *self;
    /* Makes a solver for one run: any number at once, in any threads, each used by one thread at a
       time. *contact lives as long as the solver does. FF_UNSUPPORTED: no such film, why says
       host->fail. */
    ff_status (*open)(const void *self, const ff_film_contact *contact, void **solver);
    /* FF_OK; FF_NOCONV: not found, and the caller tries another guess or a shorter step. It depends
       on the arguments alone. */
    ff_status (*solve)(void *solver, const ff_film_instant *instant, ff_film_state *film);
    void (*close)(void *solver); /* accepts NULL */
} ff_film;

#ifdef __cplusplus
}
#endif
#endif
