/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records the motion that a series describes, and solves the variational equation along it. */
#ifndef DYNAMICS_HARMONICS_MOTION_H
#define DYNAMICS_HARMONICS_MOTION_H

#include "../oscillator/motion.h"

/* Fills the members record, clocks, monodromy and det_error of a motion of one mesh cycle. Its
   excitation, period, cycles (1) and T are already set. The energy balance is not checked. Returns
   FF_OK or FF_NOMEM. */
ff_status dynamics_harmonics_motion(dynamics_motion *motion, const dynamics_inputs *inputs,
                                    const double *x, size_t harmonics, size_t per_cycle);

#endif
