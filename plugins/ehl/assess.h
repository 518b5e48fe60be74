/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Estimates how well a model of the film would do, from the history of the contact alone.
 *
 * The measure is the largest of three relative errors: of the lowest h_min, and of h_min and
 * h_central on the mean over the history. The numbers of assess.c and tune.c were fitted
 * to finite-volume solutions with 96 to 768 cells and time tolerances from 0.04 to 0.64, against
 * refined ones, of random gear scenes: the seeds 1001 to 1032, 101 to 180 and 301 to 380 of
 * tests/plugins/scenes.py (docs/choice.md judges by others). Hertz pressures from 0.25 to 1.6 GPa,
 * 1 to 30 m/s, eight oils under three laws, quasi-static and dynamic loads.
 */
#ifndef EHL_ASSESS_H
#define EHL_ASSESS_H

#include "history.h"
#include "liquid.h"
#include "start.h"
#include "surface.h"

#include <flankfilm/plugin.h>

/* Flags: which errors count. */
typedef struct ehl_error_targets {
    int film, lowest, pressure, friction;
} ehl_error_targets;

/* The properties of the contact and its history that the errors depend on. */
typedef struct ehl_conditions {
    double M_low, M_high, L_high; /* Moes numbers, under load */
    const char *regime;           /* in the middle of the history: "elastic, piezoviscous" */
    double light;                 /* share of the time with M below 1, where no formula holds */
    double unsteady;  /* mean |ln| of the factor by which the motion of the inlet boundary changes
                         the film */
    double dip;       /* -ln of the lowest such factor */
    double curvature; /* mean second difference of ln of the film that enters, in 200 steps */
    double passage;   /* time of the oil through the contact, over the whole time */
    double boundary_speed;      /* largest speed of the inlet boundary over u */
    double truncation_constant; /* error of two-step differences with 200 steps, see assess.c */
    double step_integral;   /* number of steps times the square root of the truncation allowed, see
                               assess.c */
    size_t breakpoints;     /* instants at which an automatic step must end */
    int jumps, lost;        /* the load jumps; the contact is lost */
    int newtonian;          /* no rheology is wired */
    double domain, buildup; /* m, length of the grid; shortest length in which the inlet's pressure
                            rises */
    double half_width;      /* m, largest Hertz half-width */
    double mean_buildup;    /* m, mean of that length */
    double shear;  /* Pa, largest mean shear stress in the middle of the contact; 0: unknown */
    double lambda; /* film parameter; 0: smooth */
    int steady;    /* one time */
    ehl_instant thin[EHL_PROBE_INSTANTS]; /* where the lowest film may be: the first instant, if it
                           has a load, and that of the least Moes film */
    size_t thin_count;
    int starts_thin; /* no film that enters later is thinner than that of the first instant */
    ehl_probe probe; /* what a probe solve measured there; not set by ehl_conditions_read */
} ehl_conditions;

/* Returns the largest of the errors that count. */
double ehl_worst_error(ehl_error_targets w, double film, double lowest, double pressure,
                       double friction);

/* The history has been checked; rq_1, rq_2: NULL where no surface is wired. FF_NOMEM, or FF_INVALID
   without a domain. */
ff_status ehl_conditions_read(const ehl_history *h, const ehl_laws *laws, const ehl_oil *oil,
                              const double *rq_1, const double *rq_2, ehl_conditions *conditions);

/* Returns 1 when the pressure has a spike: under light loads, or with a steep viscosity. */
int ehl_has_spike(const ehl_conditions *s);

/* Returns the error of a smooth model for rough flanks without asperity contact. */
double ehl_rough_error(const ehl_conditions *conditions, ehl_error_targets w);

/* Return the errors of film-formula by Moes and of inlet-analysis. */
double ehl_formula_error(const ehl_conditions *s, ehl_error_targets w);
double ehl_inlet_error(const ehl_conditions *s, ehl_error_targets w);

/* Prints the conditions for a reader. */
void ehl_conditions_print(const ehl_conditions *s, char *out, size_t size);

/* Finds the fewest cells and the longest steps with which a film keeps an accuracy. */
typedef struct ehl_tuning {
    size_t cells;
    size_t steps;     /* 0: auto */
    double tolerance; /* time tolerance of automatic steps */
    double count;     /* expected number of steps */
    /* relative errors by cells and steps together: of the film on the mean, of its lowest, ... */
    double mean, lowest, pressure, friction;
} ehl_tuning;

/* given: EHL_TUNE_... of what is already set in `t` and stays. */
enum { EHL_TUNE_CELLS = 1, EHL_TUNE_STEPS = 2, EHL_TUNE_TOLERANCE = 4 };
void ehl_tune(const ehl_conditions *s, double accuracy, int given, ehl_error_targets w,
              ehl_tuning *t);
double ehl_tuned_error(const ehl_tuning *t, ehl_error_targets w);

#endif
