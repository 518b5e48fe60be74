/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film at the instants at which separated flanks land, and the highest pressure of each
   landing. */
#ifndef EHL_LANDINGS_H
#define EHL_LANDINGS_H

#include "../errors/results.h"

/* Writes EHL_FILM_AT_LANDING and the outputs after it. They have one value for each landing of the
   history: each closing of the gap within an engagement, up to the first maximum of the load. */
ff_status ehl_landings_put(const ehl_results *r, const ehl_history *whole);

#endif
