/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs of a tooth pair: the path of contact, and the forces of the engagements. */
#ifndef CONTACT_TOOTH_PATH_H
#define CONTACT_TOOTH_PATH_H

#include "../numerics/exchange.h"
#include "engagements.h"

#include <flankfilm/plugin.h>

/* The model of the flanks that carry the mean load reads the rows from CONTACT_TOOTH_FIRST on; the
   model of the opposite flanks reads all rows but the last two. */
enum {
    CONTACT_TOOTH_BACK_TOOTH_FORCE, /* this row and the next one, the gap */
    CONTACT_TOOTH_FIRST = CONTACT_TOOTH_BACK_TOOTH_FORCE + 2,
    CONTACT_TOOTH_ROLL_ANGLE = CONTACT_TOOTH_FIRST,
    CONTACT_TOOTH_RADIUS_1,
    CONTACT_TOOTH_RADIUS_2,
    CONTACT_TOOTH_FACE_WIDTH,
    CONTACT_TOOTH_TEETH,
    CONTACT_TOOTH_REDUCED_MODULUS,
    CONTACT_TOOTH_SPEED,
    CONTACT_TOOTH_LINE_FORCE,
    CONTACT_TOOTH_VISCOSITY,
    CONTACT_TOOTH_OIL, /* this row and the next one */
    CONTACT_TOOTH_BACK_FORCE_MEAN = CONTACT_TOOTH_OIL + 2,
    CONTACT_TOOTH_TOOTH_FORCE, /* this row and the next one, the gap */
    CONTACT_TOOTH_INPUTS = CONTACT_TOOTH_TOOTH_FORCE + 2
};

static inline uint32_t contact_tooth_first(int back)
{
    return back ? 0 : CONTACT_TOOTH_FIRST;
}

extern const ff_port contact_tooth_inputs[CONTACT_TOOTH_INPUTS];

/* The checked inputs, in SI units. */
typedef struct contact_tooth_path {
    size_t n; /* number of stations */
    const double *angle, *radius_1, *radius_2;
    const double *force, *gap; /* `gap` NULL: no gap */
    size_t gaps;               /* number of engagements that have their own gap */
    size_t available, count;   /* engagements in the load, and engagements used */
    size_t *engagement;        /* indices of the used engagements */
    double pitch;              /* roll angle from one pair to the next, rad */
    double face_width, ratio;  /* ratio: omega2 / omega1 */
    double speed, reduced_modulus;
    double mean_force;          /* mean of the total force of all pairs, N; 0: unknown */
    int both_bear;              /* whether both flanks of a tooth carry load, at different times */
    numerics_exchange exchange; /* the pair whose driving flanks carry the load */
    ff_array in[CONTACT_TOOTH_INPUTS];
    uint32_t force_row;  /* row of the tooth force in `in` */
    const ff_array *oil; /* two inputs */
} contact_tooth_path;

/* Reads and checks the inputs of the flanks that carry the mean load, or of the opposite flanks if
   `back` is set. `p` points into itself, so it must not be moved. The caller closes `p`, also after
   an error. */
ff_status contact_tooth_path_read(const ff_host *host, const ff_array *in, int back,
                                  contact_engagement_choice wanted, contact_tooth_path *p);
void contact_tooth_path_close(contact_tooth_path *p);

#endif
