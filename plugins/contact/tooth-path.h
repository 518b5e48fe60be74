/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a tooth pair takes from its wires: the path of contact, and the forces of the engagements.
 */
#ifndef CONTACT_TOOTH_PATH_H
#define CONTACT_TOOTH_PATH_H

#include <flankfilm/plugin.h>

enum {
    CONTACT_TOOTH_ROLL_ANGLE,
    CONTACT_TOOTH_RADIUS_1,
    CONTACT_TOOTH_RADIUS_2,
    CONTACT_TOOTH_FACE_WIDTH,
    CONTACT_TOOTH_TEETH,
    CONTACT_TOOTH_REDUCED_MODULUS,
    CONTACT_TOOTH_SPEED,
    CONTACT_TOOTH_LINE_FORCE,
    CONTACT_TOOTH_TOOTH_FORCE,
    CONTACT_TOOTH_GAP,
    CONTACT_TOOTH_VISCOSITY,
    CONTACT_TOOTH_INPUTS
};

extern const ff_port contact_tooth_inputs[CONTACT_TOOTH_INPUTS];

enum { CONTACT_ENGAGEMENTS_ALL = -1 };

/* Which engagements are taken. */
typedef struct contact_engagements {
    long one; /* the number of one, or CONTACT_ENGAGEMENTS_ALL */
    size_t most;
} contact_engagements;

/* The inputs, once checked. */
typedef struct contact_tooth_path {
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
} contact_tooth_path;

/* Reads and checks; p->engagement is freed by the caller, also after a failure. */
ff_status contact_tooth_path_read(const ff_host *host, const ff_array *in,
                                  contact_engagements wanted, contact_tooth_path *p);

#endif
