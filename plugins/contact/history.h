/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outputs of every contact model: the history of one line contact, with Hertz pressure and Moes
 * numbers. Rows before CONTACT_SERIES_END are series over time, except the reduced modulus. */
#ifndef CONTACT_HISTORY_H
#define CONTACT_HISTORY_H

#include <flankfilm/laws.h>

#include <stdbool.h>

enum {
    CONTACT_TIME,
    CONTACT_RADIUS_1,
    CONTACT_RADIUS_2,
    CONTACT_EQUIVALENT_RADIUS,
    CONTACT_SPEED_1,
    CONTACT_SPEED_2,
    CONTACT_ENTRAINMENT_SPEED,
    CONTACT_SLIDING_SPEED,
    CONTACT_SLIDE_ROLL_RATIO,
    CONTACT_LOAD_PER_WIDTH,
    CONTACT_HERTZ_HALF_WIDTH,
    CONTACT_HERTZ_PRESSURE,
    CONTACT_MOES_M,
    CONTACT_MOES_L,
    CONTACT_GAP,
    CONTACT_REDUCED_MODULUS,
    CONTACT_ROLL_ANGLE, /* rows from here on are for tooth pairs only */
    CONTACT_ENGAGEMENT,
    CONTACT_SERIES_END,
    CONTACT_ENGAGEMENTS_JUDGED = CONTACT_SERIES_END,
    CONTACT_MESH_LOAD_MEAN,
    CONTACT_OUTPUTS
};

extern const ff_port contact_outputs[CONTACT_OUTPUTS];

/* One instant, in SI. radius_1, radius_2 and speed_1 + speed_2 are positive, load >= 0. */
typedef struct contact_point {
    double time, roll_angle, engagement;
    double radius_1, radius_2, speed_1, speed_2;
    double load_per_width, gap;
} contact_point;

typedef struct contact_history {
    const ff_host *host;
    double *series[CONTACT_SERIES_END]; /* NULL: not wanted */
    double reduced_modulus;
    double eta0, alpha; /* eta0, Pa s, and alpha*, 1/Pa; both 0 if no Moes number is wanted */
    double hertz_error; /* largest relative difference between pi a p_H/2 and the load w */
} contact_history;

/* Allocates the wanted outputs for `count` instants. `law` may be NULL if no Moes number is
 * wanted. */
ff_status contact_history_open(contact_history *h, const ff_host *host, uint64_t wanted,
                               size_t count, double reduced_modulus, const ff_viscosity *law,
                               const ff_array *oil);

/* Writes the wanted outputs of instant i. Refuses an instant with a non-finite number. */
ff_status contact_history_set(contact_history *h, size_t i, const contact_point *point);

/* Reports, in a quality line, how well Hertz pressure and half width balance the load. */
void contact_history_report(const contact_history *h);

#endif
