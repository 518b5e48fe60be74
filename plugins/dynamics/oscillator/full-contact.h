/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion in which the driving flanks stay in contact. If the spring is linear, the pair without
   a gap is linear, and one Newton step finds the motion. */
#ifndef DYNAMICS_FULL_CONTACT_H
#define DYNAMICS_FULL_CONTACT_H

#include "../excitation/excitation.h"

#include <flankfilm/plugin.h>

/* Finds the state of this motion at phase 0, before a jump of the excitation there. T is the
   duration of a mesh cycle, `tolerance` the error per step. Returns FF_NOCONV if there is no such
   motion, or if it is unstable. */
ff_status dynamics_full_contact(const dynamics_excitation *excitation, double T, double tolerance,
                                double *delta, double *rate);

#endif
