/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion in which the driving flanks never part. The pair is linear then, so that one step of
   Newton's method finds it. */
#ifndef DYNAMICS_FULL_CONTACT_H
#define DYNAMICS_FULL_CONTACT_H

#include "../excitation/excitation.h"

#include <flankfilm/plugin.h>

/* Finds its state at phase 0, before the node. FF_NOCONV: there is none, or it is not stable. T is
 * the duration of a mesh cycle, `tolerance` the error per step. */
ff_status dynamics_full_contact(const dynamics_excitation *excitation, double T, double tolerance,
                                double *delta, double *rate);

#endif
