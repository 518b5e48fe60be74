/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a recorded motion shows of itself and of the teeth, whatever moves beside them. */
#ifndef DYNAMICS_SHOWN_H
#define DYNAMICS_SHOWN_H

#include "inputs.h"
#include "oscillator.h"

/* Samples that begin with an dynamics_sample, `stride` bytes apart; recorded for longer than shown.
 */
typedef struct dynamics_shown {
    const void *samples;
    size_t stride, recorded;
    size_t cycles; /* mesh cycles that are shown */
    double T;      /* duration of a mesh cycle */
    /* of the duration of what is shown */
    double parted, back; /* time without force, and with contact on the back flank */
    int period;
    /* Force and gap at a phase; where the excitation jumps, `left` asks for those before it. */
    void (*look_up)(const void *self, double phase, int left, double *force, double *gap);
    const void *self;
} dynamics_shown;

typedef struct dynamics_statistics {
    double mean, rms, low, high, force;
    double rms_error; /* of the samples, over rms */
} dynamics_statistics;

size_t dynamics_shown_count(const dynamics_shown *shown); /* samples that are shown */
dynamics_statistics dynamics_shown_statistics(const dynamics_shown *shown);
/* The sample before the phase; at a jump the one that begins with the value asked for. */
size_t dynamics_shown_before(const dynamics_shown *shown, double phase, int left);

/* Mesh cycles from SAP to a station. */
double dynamics_station_phase(const dynamics_inputs *inputs, size_t station);

/* Gives the scalars of the statistics, and force and gap at the stations. */
ff_status dynamics_shown_put(const dynamics_shown *shown, const dynamics_statistics *statistics,
                             const dynamics_mesh *mesh, const dynamics_inputs *inputs,
                             const ff_host *host);

#endif
