/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every source of mesh stiffness takes from its wires and gives to others. */
#ifndef FF_STIFFNESS_MESH_H
#define FF_STIFFNESS_MESH_H

#include "cycle.h"

#include <flankfilm/author.h>

enum {
    FF_OUT_PHASE,
    FF_OUT_STIFFNESS,
    FF_OUT_MEAN,
    FF_OUT_HARMONICS,
    FF_OUT_LOADED_ERROR,
    FF_OUT_ERROR,
    FF_OUT_TOOTH_FORCE,
    FF_OUT_LOAD_SHARE,
    FF_OUT_PAIRS,
    FF_OUT_BREAKPOINTS,
    FF_OUT_LOADED_RATIO,
    FF_OUT_ENGAGEMENT_ROLL,
    FF_OUT_ENGAGEMENT_FORCE,
    FF_OUT_HUNTING_PERIOD,
    FF_OUT_HUNTING_ERROR,
    FF_OUT_HUNTING_PRESSURE,
    FF_OUT_WORST_CYCLE,
    FF_OUT_WORST_TEETH,
    FF_STIFFNESS_OUTPUTS
};
extern const ff_port ff_stiffness_outputs[FF_STIFFNESS_OUTPUTS];

/* The first input rows of every source, in this order. */
enum { FF_IN_ROLL, FF_IN_SAP, FF_IN_TIP, FF_IN_TEETH, FF_IN_FORCE, FF_MESH_INPUTS };

/* The path of contact. */
typedef struct ff_engagement {
    size_t stations;
    const double *roll;     /* roll angle of gear 1 at the stations, rad */
    double roll_sap, pitch; /* roll angle at SAP and of one mesh cycle, rad */
    double contact_ratio;   /* (tip - SAP)/pitch */
    double line_force;      /* F, N */
} ff_engagement;

/* Reads and checks the first input rows. */
ff_status ff_engagement_read(const ff_host *host, const ff_array *in, ff_engagement *e);

/* One value of a scalar input, or element i of a list; not finite or missing: FF_INVALID. */
ff_status ff_input(const ff_host *host, const ff_array *array, const char *name, size_t i,
                   double *value);

/* The result of a source: all that its outputs are made of. */
typedef struct ff_mesh {
    ff_cycle cycle;
    const double *stiffness; /* k at the points of the cycle, N/m, > 0 */
    const double *error;     /* e at the points of the cycle, m; NULL: 0 */
    const double *loaded;    /* loaded transmission error there, m; NULL: e + F/k */
    const double *pairs;     /* pairs that carry load there; NULL: all on the path of contact */
    size_t breaks;           /* phases in [0, 1) where k or e jumps or has a kink */
    const double *breakpoint;
    /* The function that `stiffness` samples. */
    double (*stiffness_at)(const void *self, double phase, int side);
    /* Share of F that a pair of that age carries at that phase and side. Asked for ages from
       -before to the contact ratio + after. */
    double (*share)(const void *self, double age, double phase, int side);
    const void *self;
    double before, after; /* mesh cycles of contact before SAP and after the tip */
    double balance;       /* limit of |sum of the shares - 1| */
    size_t hunting;       /* mesh cycles of the hunting period; 0: 1 */
    size_t engagements;   /* whose tooth forces are given; 0: 1 */
    /* The same of the pair that enters in that mesh cycle, at any age. */
    double (*share_of_pair)(const void *self, size_t number, double age, int side);
    const double *pressure; /* of the pair of each mesh cycle, Pa; NULL: all are alike */
    size_t worst;           /* the mesh cycle with the highest */
    size_t worst_teeth[2];  /* that meet in it, from 1 */
    size_t hunting_points; /* of hunting_error, equal steps from its start; NULL: e of this cycle */
    const double *hunting_error;
} ff_mesh;

/* Gives the wanted outputs, and the quality lines of the equilibrium of the tooth forces and of the
   straight lines between the points. */
ff_status ff_mesh_publish(const ff_host *host, uint64_t wanted, const ff_mesh *mesh,
                          const ff_engagement *e);

#endif
