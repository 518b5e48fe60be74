/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The oil between separated flanks, in series with the teeth. On each flank, with the sign s of its
   force (1: driving, -1: back), the load W, the tooth stiffness k and q = s delta - b: W = k (q +
   y), y' = -V(W, h), h = h_c + y. Here h_c is the film thickness of the loaded flanks (the
   hand-over film), y the film thickness beyond h_c, q + y the deflection of the teeth, and V the
   speed of approach at the load W (squeeze-law.h). While y = 0 a flank is called held: the film of
   the loaded flanks is stiff and keeps its thickness. While W = 0 a flank is called free; oil does
   not pull, so y = -q then. All units are those of excitation.h. */
#ifndef DYNAMICS_FILM_H
#define DYNAMICS_FILM_H

#include "squeeze-law.h"

typedef struct dynamics_film {
    double viscosity; /* eta0 b omega / mean stiffness */
    double hand_over; /* h_c */
    double supply;    /* thickness above which the oil does not fill the gap; infinity: it always
                         fills the gap */
    double pairs;     /* contact ratio */
    double span;      /* mesh cycles in one cycle of the excitation; T and phases refer to that
                         cycle */
    double
        radius[3]; /* equivalent radius of a pair, as a polynomial in the mesh cycles since SAP */
    double entrainment;           /* distance that the oil travels at (u1 + u2)/2 per mesh cycle */
    int rolling;                  /* 1: the wedge of the rolling flanks carries load too */
    dynamics_squeeze_table table; /* made if `rolling` is 1 */
} dynamics_film;

/* Coefficients of the film at a phase of the mesh cycle, summed over all pairs in mesh. */
typedef struct dynamics_film_place {
    double squeeze;      /* sum of 3 sqrt(2) pi eta0 b R^1.5 */
    double wedge, speed; /* n eta0 u R b and u/sqrt(2 R), with the number n of pairs and the common
                            R that gives `squeeze` */
} dynamics_film_place;

/* V and its derivatives with respect to W, h and u; the last one is multiplied by u. */
typedef struct dynamics_approach {
    double speed, by_load, by_film, by_entrainment;
} dynamics_approach;

/* Returns the phase, in the current mesh cycle, at which a pair leaves the mesh. The other nodes
   are the starts of the mesh cycles, at which a pair enters. */
double dynamics_film_node(const dynamics_film *film, double phase);

dynamics_film_place dynamics_film_at(const dynamics_film *film, double phase, double T);

dynamics_approach dynamics_film_approach(const dynamics_film *film,
                                         const dynamics_film_place *place, double load, double h);

/* Returns the load that the wedge carries at the hand-over film. Under a larger load the hand-over
   film does not grow. */
double dynamics_film_holding_load(const dynamics_film *film, const dynamics_film_place *place);

/* Returns the quasi-static film y between flanks that approach with q' = speed. A motion whose film
   is not known starts with this film. */
double dynamics_film_quasi_static(const dynamics_film *film, const dynamics_film_place *place,
                                  double stiffness, double q, double speed);

#endif
