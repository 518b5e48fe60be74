/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a recorded motion shows of itself and of the teeth, whatever moves beside them. */
#ifndef DYNAMICS_MOTION_VIEW_H
#define DYNAMICS_MOTION_VIEW_H

#include "inputs.h"
#include "oscillator.h"

/* Samples that begin with an dynamics_sample, `stride` bytes apart; recorded for longer than shown.
 */
typedef struct dynamics_motion_view {
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
} dynamics_motion_view;

typedef struct dynamics_statistics {
    double mean, rms, low, high, force;
    double rms_error; /* of the samples, over rms */
} dynamics_statistics;

size_t dynamics_motion_view_count(const dynamics_motion_view *view); /* samples that are shown */
dynamics_statistics dynamics_motion_view_statistics(const dynamics_motion_view *view);
/* The sample before the phase; at a jump the one that begins with the value asked for. */
size_t dynamics_motion_view_before(const dynamics_motion_view *view, double phase, int left);

/* Mesh cycles from SAP to a station. */
double dynamics_station_phase(const dynamics_inputs *inputs, size_t station);

/* Gives the scalars of the statistics, and force and gap at the stations. */
ff_status dynamics_motion_view_put(const dynamics_motion_view *view,
                                   const dynamics_statistics *statistics,
                                   const dynamics_excitation *excitation,
                                   const dynamics_inputs *inputs, const ff_host *host);

#endif
