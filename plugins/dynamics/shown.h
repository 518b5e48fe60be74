/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a recorded motion shows of itself and of the teeth, whatever moves beside them. */
#ifndef FF_DYNAMICS_SHOWN_H
#define FF_DYNAMICS_SHOWN_H

#include "inputs.h"
#include "oscillator.h"

/* Samples that begin with an ff_sample, `stride` bytes apart; recorded for longer than shown. */
typedef struct ff_shown {
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
} ff_shown;

typedef struct ff_statistics {
    double mean, rms, low, high, force;
    double rms_error; /* of the samples, over rms */
} ff_statistics;

size_t ff_shown_count(const ff_shown *shown); /* samples that are shown */
ff_statistics ff_shown_statistics(const ff_shown *shown);
/* The sample before the phase; at a jump the one that begins with the value asked for. */
size_t ff_shown_before(const ff_shown *shown, double phase, int left);

/* Mesh cycles from SAP to a station. */
double ff_station_phase(const ff_inputs *inputs, size_t station);

/* Gives the scalars of the statistics, and force and gap at the stations. */
ff_status ff_shown_put(const ff_shown *shown, const ff_statistics *statistics, const ff_mesh *mesh,
                       const ff_inputs *inputs, const ff_host *host);

#endif
