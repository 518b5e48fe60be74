/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outputs of every mesh stiffness model. */
#ifndef STIFFNESS_OUTPUTS_H
#define STIFFNESS_OUTPUTS_H

#include "cycle.h"
#include "path-inputs.h"

/* In the order of the rows. */
enum {
    STIFFNESS_OUT_PHASE,
    STIFFNESS_OUT_STIFFNESS,
    STIFFNESS_OUT_MEAN,
    STIFFNESS_OUT_HARMONICS,
    STIFFNESS_OUT_LOADED_ERROR,
    STIFFNESS_OUT_ERROR,
    STIFFNESS_OUT_TOOTH_FORCE,
    STIFFNESS_OUT_LOAD_SHARE,
    STIFFNESS_OUT_PAIRS,
    STIFFNESS_OUT_BREAKPOINTS,
    STIFFNESS_OUT_LOADED_RATIO,
    STIFFNESS_OUT_ENGAGEMENT_ROLL,
    STIFFNESS_OUT_ENGAGEMENT_FORCE,
    STIFFNESS_OUT_HUNTING_PERIOD,
    STIFFNESS_OUT_HUNTING_ERROR,
    STIFFNESS_OUT_HUNTING_PRESSURE,
    STIFFNESS_OUT_WORST_CYCLE,
    STIFFNESS_OUT_WORST_TEETH,
    STIFFNESS_OUT_PEAK_TO_PEAK,
    STIFFNESS_OUTPUTS,
    /* further outputs, for models that can compute the mesh force at any deflection */
    STIFFNESS_OUT_FORCE_LEVEL = STIFFNESS_OUTPUTS,
    STIFFNESS_OUT_LEVEL_ERROR,
    STIFFNESS_OUT_LEVEL_STIFFNESS,
    STIFFNESS_OUT_LEVEL_TOOTH_FORCE,
    STIFFNESS_LEVEL_OUTPUTS,
    /* outputs of models that compute the back flanks, opposite to the flanks that carry the mean
       load */
    STIFFNESS_OUT_BACK_PHASE = STIFFNESS_LEVEL_OUTPUTS,
    STIFFNESS_OUT_BACK_OFFSET,
    STIFFNESS_OUT_BACK_STIFFNESS,
    STIFFNESS_OUT_BACK_ERROR,
    STIFFNESS_OUT_BACK_LOADED_ERROR,
    STIFFNESS_OUT_BACK_LEVEL_ERROR,
    STIFFNESS_OUT_BACK_LEVEL_STIFFNESS,
    STIFFNESS_OUT_BACK_LEVEL_TOOTH_FORCE,
    STIFFNESS_ALL_OUTPUTS
};
extern const ff_port stiffness_outputs[STIFFNESS_ALL_OUTPUTS];

/* The rows of a model without levels, in place of FF_TABLE(stiffness_outputs). */
#define STIFFNESS_PLAIN_OUTPUTS stiffness_outputs, STIFFNESS_OUTPUTS, sizeof stiffness_outputs[0]

/* Returns the mesh cycles from SAP to a station, and the limit that applies there. */
double stiffness_station_age(const stiffness_path *path, size_t station, int *side);

/* The result of a model, from which all its outputs are computed. */
typedef struct stiffness_result {
    stiffness_cycle cycle;
    const double *stiffness; /* k at the points of the cycle, N/m, > 0 */
    const double *error;     /* e at the points of the cycle, m; NULL: 0 everywhere */
    const double *loaded;    /* loaded transmission error at the points, m; NULL: e + F/k */
    const double *pairs;     /* number of loaded pairs at the points; NULL: all pairs on the path of
                                contact     are loaded */
    size_t breakpoints;      /* phases in [0, 1) where k or e jumps or changes its slope */
    const double *breakpoint;
    /* The function whose samples are `stiffness`. */
    double (*stiffness_at)(const void *self, double phase, int side);
    /* Returns the share of F on a pair of that age at that phase and side. Ages range from -before
       to the contact ratio + after. */
    double (*share)(const void *self, double age, double phase, int side);
    const void *self;
    double before, after; /* mesh cycles of contact before SAP and after the tip */
    double balance;       /* limit for |sum of the shares - 1| */
    size_t hunting;       /* mesh cycles of the hunting period; 0 stands for 1 */
    size_t engagements;   /* number of engagements whose tooth forces are given; 0 means 1 */
    /* Returns the share of the pair that enters in that mesh cycle, at any age. */
    double (*share_of_pair)(const void *self, size_t number, double age, int side);
    const double *pressure; /* by mesh cycle: Hertz pressure on the pair that enters in it, Pa;
                               NULL: all pairs are equal */
    size_t worst;           /* the mesh cycle with the highest pressure */
    size_t worst_teeth[2];  /* the teeth that meet in it, counted from 1 */
    size_t hunting_points;  /* number of points of hunting_error, at equal steps from the start of
                               the hunting period */
    const double *hunting_error;
} stiffness_result;

/* Writes the wanted outputs, and the quality lines about the balance of the tooth forces and the
   interpolation between the points. */
ff_status stiffness_result_publish(const ff_host *host, uint64_t wanted,
                                   const stiffness_result *result, const stiffness_path *path);

#endif
