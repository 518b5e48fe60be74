/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The equations of a gear pair on elastic bearings within one smooth regime, the events that end
   the regime, and the derivatives of both with respect to the state. */
#ifndef DYNAMICS_COUPLED_FIELD_H
#define DYNAMICS_COUPLED_FIELD_H

#include "coupled-pair.h"

/* The state: coordinates, their rates, and the energy taken by the springs and dampers of mesh and
   bearings. */
enum {
    DYNAMICS_RATES = DYNAMICS_COORDINATES,
    DYNAMICS_TAKEN = 2 * DYNAMICS_COORDINATES,
    DYNAMICS_COUPLED_SIZE
};

/* A stretch of the mesh cycle. It ends at a node of the excitation, or at the phase where a tooth
   pair of the mounted gears leaves the mesh. */
typedef struct dynamics_stretch {
    const dynamics_piece *piece;
    double start, length; /* mesh cycles */
    dynamics_pairs mounted;
    int jump;
} dynamics_stretch;

enum { DYNAMICS_DRIVING, DYNAMICS_BACK, DYNAMICS_FLANKS };

/* A regime in which the equations are smooth. A flank may touch without being pressed: a clipped
   damper does not pull, so the flank carries no force where spring and damper together would
   pull. */
typedef struct dynamics_regime {
    int touches[DYNAMICS_FLANKS], pressed[DYNAMICS_FLANKS];
    int band[DYNAMICS_FLANKS]; /* band of the spring (spring.h) */
    dynamics_pairs pairs;
} dynamics_regime;

typedef struct dynamics_field {
    const dynamics_coupled *pair;
    const dynamics_stretch *now;
    dynamics_regime regime;
    double T; /* duration of a mesh cycle */
} dynamics_field;

/* The mesh force, and its generalised forces on the coordinates. */
typedef struct dynamics_push {
    double force; /* generalised force on q, positive on the driving flank */
    double on[DYNAMICS_COORDINATES];
    dynamics_overlap overlap[DYNAMICS_FLANKS];
    double normal[DYNAMICS_FLANKS]; /* force of spring and damper on a touching flank, even if it is
                                       not pressed; 0 if the flank does not touch */
} dynamics_push;

/* Return the phase, and the mesh force, at the time t since the start of the stretch. */
double dynamics_field_phase(const dynamics_field *field, double t);
dynamics_push dynamics_field_push(const dynamics_field *field, double t, const double *y,
                                  const dynamics_place *place);

/* Computes the rate of change of the state, in GSL's form; `field` is a dynamics_field. */
int dynamics_field_slope(double t, const double y[], double dydt[], void *field);

/* Computes the derivatives of the accelerations with respect to coordinates and rates. */
void dynamics_field_jacobian(const dynamics_field *field, double t, const double *y,
                             double jacobian[DYNAMICS_COORDINATES][DYNAMICS_TAKEN]);

/* The motion within a step: polynomials of degree 5 that match coordinates, rates and accelerations
 * at both ends. */
typedef struct dynamics_course {
    double h, power[6][DYNAMICS_COORDINATES]; /* coefficients in powers of the fraction of the
                                                 step */
} dynamics_course;

/* Computes the polynomials for a step of duration h from time t, between two states. */
void dynamics_course_find(const dynamics_field *field, double t, double h, const double *from,
                          const double *to, dynamics_course *course);
/* Evaluates the state at a fraction of the step. The energy, the last component, is set to 0. */
void dynamics_course_state(const dynamics_course *course, double share, double *state);

/* Returns whether the mesh damper acts on a flank, or in the gap for flank = DYNAMICS_FLANKS. */
int dynamics_field_damps(const dynamics_field *field, int flank);

/* Gates: functions of the state that end the regime. The regime lasts as long as no gate is below
   0. */
enum {
    DYNAMICS_TOUCH,
    DYNAMICS_PRESS = DYNAMICS_FLANKS,
    DYNAMICS_FALLS = 2 * DYNAMICS_FLANKS, /* the overlap falls below the start of its band */
    DYNAMICS_RISES = 3 * DYNAMICS_FLANKS, /* the overlap rises above the end of its band */
    DYNAMICS_COMES = 4 * DYNAMICS_FLANKS,
    DYNAMICS_GOES,
    DYNAMICS_GATES
};

/* Sets the bands of the springs from the overlaps of the flanks. */
void dynamics_field_find_bands(dynamics_field *field, double t, const double *overlap);

void dynamics_field_gates(const dynamics_field *field, double t, const double *y,
                          double gate[DYNAMICS_GATES]);
/* Changes to the regime that follows when this gate falls below 0. */
void dynamics_field_pass_gate(dynamics_field *field, int gate);
/* Computes the derivatives of a gate at which flanks touch or a tooth pair enters or leaves.
   `slope` is the derivative with respect to coordinates and rates; the return value is the
   derivative with respect to time at fixed coordinates. For a gate at which flanks touch, these are
   the derivatives of the overlap; the value of the gate may have the opposite sign. */
double dynamics_field_gate_slope(const dynamics_field *field, int gate, double t, const double *y,
                                 double slope[DYNAMICS_TAKEN]);

#endif
