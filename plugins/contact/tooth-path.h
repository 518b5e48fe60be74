/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a tooth pair takes from its wires: the path of contact, and the forces of the engagements.
 */
#ifndef FF_CONTACT_TOOTH_PATH_H
#define FF_CONTACT_TOOTH_PATH_H

#include <flankfilm/plugin.h>

enum {
    FF_TOOTH_ROLL_ANGLE,
    FF_TOOTH_RADIUS_1,
    FF_TOOTH_RADIUS_2,
    FF_TOOTH_FACE_WIDTH,
    FF_TOOTH_TEETH,
    FF_TOOTH_REDUCED_MODULUS,
    FF_TOOTH_SPEED,
    FF_TOOTH_LINE_FORCE,
    FF_TOOTH_TOOTH_FORCE,
    FF_TOOTH_GAP,
    FF_TOOTH_VISCOSITY,
    FF_TOOTH_INPUTS
};

extern const ff_port ff_tooth_inputs[FF_TOOTH_INPUTS];

enum { FF_ENGAGEMENTS_ALL = -1 };

/* Which engagements are taken. */
typedef struct ff_engagements {
    long one; /* the number of one, or FF_ENGAGEMENTS_ALL */
    size_t most;
} ff_engagements;

/* The inputs, once checked. */
typedef struct ff_tooth_path {
    size_t n; /* stations */
    const double *angle, *radius_1, *radius_2;
    const double *force, *gap; /* gap NULL: none */
    size_t gaps;               /* engagements that have one of their own */
    size_t had, count;         /* engagements of the load, and those that are taken */
    size_t *engagement;        /* their numbers */
    double pitch;              /* roll angle from one pair to the next */
    double face_width, ratio;  /* omega2 / omega1 */
    double speed, reduced_modulus;
    double line_force; /* 0: not wired */
} ff_tooth_path;

/* Reads and checks; p->engagement is freed by the caller, also after a failure. */
ff_status ff_tooth_path_read(const ff_host *host, const ff_array *in, ff_engagements wanted,
                             ff_tooth_path *p);

#endif
