/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What every contact model gives: the history of one line contact, with its Hertz and Moes
 * figures. Rows before FF_CONTACT_SERIES_END are series over time, but for the reduced modulus.
 */
#ifndef FF_CONTACT_HISTORY_H
#define FF_CONTACT_HISTORY_H

#include <flankfilm/viscosity.h>

#include <stdbool.h>

enum {
    FF_CONTACT_TIME,
    FF_CONTACT_RADIUS_1,
    FF_CONTACT_RADIUS_2,
    FF_CONTACT_EQUIVALENT_RADIUS,
    FF_CONTACT_SPEED_1,
    FF_CONTACT_SPEED_2,
    FF_CONTACT_ENTRAINMENT_SPEED,
    FF_CONTACT_SLIDING_SPEED,
    FF_CONTACT_SLIDE_ROLL_RATIO,
    FF_CONTACT_LOAD_PER_WIDTH,
    FF_CONTACT_HERTZ_HALF_WIDTH,
    FF_CONTACT_HERTZ_PRESSURE,
    FF_CONTACT_MOES_M,
    FF_CONTACT_MOES_L,
    FF_CONTACT_GAP,
    FF_CONTACT_REDUCED_MODULUS,
    FF_CONTACT_ROLL_ANGLE, /* this and the next: only a tooth pair has them */
    FF_CONTACT_ENGAGEMENT,
    FF_CONTACT_SERIES_END,
    FF_CONTACT_ENGAGEMENTS_JUDGED = FF_CONTACT_SERIES_END,
    FF_CONTACT_MESH_LOAD_MEAN,
    FF_CONTACT_OUTPUTS
};

extern const ff_port ff_contact_outputs[FF_CONTACT_OUTPUTS];

/* One instant, SI. radius_1, radius_2 and speed_1 + speed_2 are above 0, load >= 0. */
typedef struct ff_contact_point {
    double time, roll_angle, engagement;
    double radius_1, radius_2, speed_1, speed_2;
    double load_per_width, gap;
} ff_contact_point;

typedef struct ff_history {
    const ff_host *host;
    double *series[FF_CONTACT_SERIES_END]; /* NULL: not wanted */
    double reduced_modulus;
    double eta0, alpha; /* Pa s; alpha*, 1/Pa; both 0 where no Moes figure is wanted */
    double hertz_error; /* greatest relative departure from w = pi a p_H / 2 */
} ff_history;

/* Takes memory for the wanted outputs, `count` instants long. `law` may be NULL when neither Moes
   figure is wanted. */
ff_status ff_history_open(ff_history *h, const ff_host *host, uint64_t wanted, size_t count,
                          double reduced_modulus, const ff_viscosity *law);

/* Gives instant i; refuses one whose figures are not finite. */
ff_status ff_history_put(ff_history *h, size_t i, const ff_contact_point *point);

/* Reports the quality of the Hertz figures. */
void ff_history_report(const ff_history *h);

#endif
