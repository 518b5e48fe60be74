/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is read off the series of a motion while it passes: moments, energies, times and samples. */
#ifndef FF_DYNAMICS_TRACE_H
#define FF_DYNAMICS_TRACE_H

#include "flow.h"
#include "motion.h"

typedef struct ff_trace {
    double origin;      /* of s in the moments */
    double sum, square; /* integrals over time of s - origin and of its square */
    double loss, work;  /* energy taken by the damper, brought in by the excitation */
    double energy;      /* of the state at the end */
    double start;       /* of the state at the start */
    ff_clocks clocks;
    ff_record *record;
    size_t next;              /* number of the next sample of the cycle */
    int begun, side, pressed; /* of the last stride */
} ff_trace;

/* Observers. */
void ff_trace_moments(void *trace, const ff_stride *stride);
void ff_trace_all(void *trace, const ff_stride *stride);

/* Records the motion from x as ff_motion_record does, but exactly: `motion` has mesh, period,
   cycles and T set. A periodic motion is begun anew after each period. */
ff_status ff_trace_motion(const ff_flow *flow, const ff_inputs *inputs, size_t per_cycle,
                          const double x[2], ff_motion *motion);

#endif
