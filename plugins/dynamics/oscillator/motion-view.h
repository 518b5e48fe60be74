/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The statistics and tooth forces of a recorded motion, whatever else is recorded beside it. */
#ifndef DYNAMICS_MOTION_VIEW_H
#define DYNAMICS_MOTION_VIEW_H

#include "../excitation/inputs.h"
#include "oscillator.h"

/* Samples that begin with a dynamics_sample and lie `stride` bytes apart. The record goes on behind
   what is shown, for as long as a tooth pair stays in mesh. */
typedef struct dynamics_motion_view {
    const void *samples;
    size_t stride, recorded;
    size_t cycles; /* mesh cycles that are shown */
    double T;      /* duration of a mesh cycle */
    /* time, within what is shown, without force and with contact on the back flank */
    double parted, back;
    int period;
    /* The force and the gap at a phase; where the excitation jumps, `left` asks for those before
     * it. */
    void (*look_up)(const void *self, double phase, int left, double *force, double *gap);
    const void *self;
} dynamics_motion_view;

typedef struct dynamics_statistics {
    double mean, rms, low, high, force, least_force;
    double rms_error; /* by the spacing of the samples, relative to rms */
} dynamics_statistics;

size_t dynamics_motion_view_count(const dynamics_motion_view *view); /* samples that are shown */
double dynamics_motion_view_phase(const dynamics_motion_view *view, size_t sample);
dynamics_statistics dynamics_motion_view_statistics(const dynamics_motion_view *view);
/* The first sample of the interval that holds the phase; at a jump `left` asks for the interval
   before it. */
size_t dynamics_motion_view_before(const dynamics_motion_view *view, double phase, int left);

/* Mesh cycles from SAP to a station. */
double dynamics_station_phase(const dynamics_inputs *inputs, size_t station);

/* Gives the scalars of the statistics, and force and gap at the stations. */
ff_status dynamics_motion_view_put(const dynamics_motion_view *view,
                                   const dynamics_statistics *statistics,
                                   const dynamics_excitation *excitation,
                                   const dynamics_inputs *inputs, const ff_host *host);

#endif
