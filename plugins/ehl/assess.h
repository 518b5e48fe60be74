/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How well a model of the film would do, from the history of the contact alone.
 *
 * The measure of all: the largest of three errors, of the lowest h_min, and of h_min and h_central
 * on the mean over the history, each over itself. The numbers of assess.c and tune.c were fitted
 * to finite-volume solutions with 96 to 768 cells and time tolerances from 0.04 to 0.64, against
 * refined ones, of random gear scenes: the seeds 1001 to 1032, 101 to 180 and 301 to 380 of
 * tests/plugins/scenes.py (docs/choice.md judges by others). Hertz pressures from 0.25 to 1.6 GPa,
 * 1 to 30 m/s, eight oils under three laws, quasi-static and dynamic loads.
 */
#ifndef EHL_ASSESS_H
#define EHL_ASSESS_H

#include "fluid.h"
#include "history.h"
#include "probe-solve.h"

#include <flankfilm/plugin.h>

/* Which errors count. */
typedef struct ehl_error_targets {
    int film, lowest, pressure, friction;
} ehl_error_targets;

/* What decides. */
typedef struct ehl_conditions {
    double M_low, M_high, L_high; /* Moes numbers, under load */
    const char *regime;           /* in the middle of the history: "elastic, piezoviscous" */
    double light;                 /* share of the time with M below 1, where no formula holds */
    double unsteady;  /* mean of |ln| of what the motion of the inlet's edge makes of the film */
    double dip;       /* -ln of the lowest of it */
    double curvature; /* mean second difference of ln of the film that enters, of 200 steps */
    double passage;   /* through the contact, over the whole time */
    double boundary_speed;      /* largest speed of that edge over u */
    double truncation_constant; /* error of two-step differences with 200 steps, see assess.c */
    double step_integral;   /* steps over the square root of what each may cut off, see assess.c */
    size_t breakpoints;     /* instants that steps: auto lands on */
    int jumps, lost;        /* the load jumps; the contact is lost */
    int newtonian;          /* no rheology is wired */
    double domain, buildup; /* m, length of the grid; shortest length in which the inlet's pressure
                            rises */
    double half_width;      /* m, largest Hertz half-width */
    double mean_buildup;    /* m, that length on the mean */
    double shear;  /* Pa, largest mean shear stress in the middle of the contact; 0: unknown */
    double lambda; /* film parameter; 0: smooth */
    int steady;    /* one time */
    ehl_instant thin[EHL_PROBE_INSTANTS]; /* where the lowest film may be: the first instant, if it
                           has a load, and that of the least Moes film */
    size_t thin_count;
    int starts_thin; /* no film that enters later is thinner than that of the first instant */
    ehl_probe probe; /* what has been measured there; not by ehl_conditions_read */
} ehl_conditions;

/* `film` of ehl_error_targets: the largest of its errors. */
double ehl_worst_error(ehl_error_targets w, double film, double lowest, double pressure,
                       double friction);

/* The history has been checked; rq_1, rq_2: NULL where no surface is wired. FF_NOMEM, or FF_INVALID
   without a domain. */
ff_status ehl_conditions_read(const ehl_history *h, const ehl_laws *laws, const ehl_oil *oil,
                              const double *rq_1, const double *rq_2, ehl_conditions *conditions);

/* The shape of a light or steep contact's pressure (tune.c). */
int ehl_has_spike(const ehl_conditions *s);

/* Below this film parameter asperities touch. */
#define EHL_MIXED_BELOW 3.

/* What a smooth model makes of flanks that are not, where they do not touch. */
double ehl_rough_error(const ehl_conditions *conditions, ehl_error_targets w);

/* film-formula by Moes, and inlet-analysis. */
double ehl_formula_error(const ehl_conditions *s, ehl_error_targets w);
double ehl_inlet_error(const ehl_conditions *s, ehl_error_targets w);

/* The numbers of the scene, to read. */
void ehl_conditions_print(const ehl_conditions *s, char *out, size_t size);

#endif
