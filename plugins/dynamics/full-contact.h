/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion in which the driving flanks never part. The pair is linear then, so that one step of
   Newton's method finds it. */
#ifndef DYNAMICS_FULL_CONTACT_H
#define DYNAMICS_FULL_CONTACT_H

#include "excitation.h"

/* Finds its state at phase 0, before the node. 0: there is none, it is not stable, or memory ran
   out. T is the duration of a mesh cycle, `tolerance` the error per step. */
int dynamics_full_contact(const dynamics_excitation *excitation, double T, double tolerance,
                          double *delta, double *rate);

#endif
