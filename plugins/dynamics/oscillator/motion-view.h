/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The statistics and tooth forces of a recorded motion, for samples of any record type. */
#ifndef DYNAMICS_MOTION_VIEW_H
#define DYNAMICS_MOTION_VIEW_H

#include "../excitation/inputs.h"
#include "oscillator.h"

/* Samples that begin with a dynamics_sample, `stride` bytes apart. The record continues beyond the
   shown cycles for as long as a tooth pair stays in mesh. */
typedef struct dynamics_motion_view {
    const void *samples;
    size_t stride, recorded;
    size_t cycles; /* number of mesh cycles that are shown */
    double T;      /* duration of a mesh cycle */
    /* times within the shown cycles: without contact, and with contact on the back flank */
    double parted, back;
    int period;
    /* Gives the force and the gap at a phase. At a jump of the excitation, `left` selects the
       values before the jump. */
    void (*look_up)(const void *self, double phase, int left, double *force, double *gap);
    const void *self;
} dynamics_motion_view;

typedef struct dynamics_statistics {
    double mean, rms, low, high, force, least_force;
    double rms_error; /* error of rms due to the spacing of the samples, relative to rms */
} dynamics_statistics;

size_t
/* number of samples in the shown cycles */
dynamics_motion_view_count(const dynamics_motion_view *view);
double dynamics_motion_view_phase(const dynamics_motion_view *view, size_t sample);
dynamics_statistics dynamics_motion_view_statistics(const dynamics_motion_view *view);
/* Finds the first sample of the interval that contains the phase. At a jump, `left` selects the
   interval before the jump. */
size_t dynamics_motion_view_before(const dynamics_motion_view *view, double phase, int left);

/* Returns the phase of a station: mesh cycles from SAP. */
double dynamics_station_phase(const dynamics_inputs *inputs, size_t station);

/* Writes the scalar outputs of the statistics, and force and gap at the stations. */
ff_status dynamics_motion_view_put(const dynamics_motion_view *view,
                                   const dynamics_statistics *statistics,
                                   const dynamics_excitation *excitation,
                                   const dynamics_inputs *inputs, const ff_host *host);

#endif
