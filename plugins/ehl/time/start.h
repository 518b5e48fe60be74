/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film with which a history begins. */
#ifndef EHL_START_H
#define EHL_START_H

#include "../equations/march.h"

/* Starts with the steady film of the first instant. A start without load has the film of a light
   load. A start at rest has the film of a slow motion, or the gap full of oil. */
ff_status ehl_march_start(ehl_march *m);

/* Starts with the steady film of that time, between smooth flanks. */
ff_status ehl_march_start_at(ehl_march *m, double time);

/* Removes the film before another engagement starts; the counters are kept. */
void ehl_march_restart(ehl_march *m);

#endif
