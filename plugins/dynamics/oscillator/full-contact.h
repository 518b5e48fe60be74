/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion in which the driving flanks never part. Without its gap the pair is linear for a
 * straight spring, so that one Newton step finds it. */
#ifndef DYNAMICS_FULL_CONTACT_H
#define DYNAMICS_FULL_CONTACT_H

#include "../excitation/excitation.h"

#include <flankfilm/plugin.h>

/* Finds the state of that motion at phase 0, before the node. T is the duration of a mesh cycle,
 * `tolerance` the error per step. FF_NOCONV: there is none, or it is not stable. */
ff_status dynamics_full_contact(const dynamics_excitation *excitation, double T, double tolerance,
                                double *delta, double *rate);

#endif
