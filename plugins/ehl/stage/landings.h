/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film on which flanks land that have been apart, and the highest pressure as they do. */
#ifndef EHL_LANDINGS_H
#define EHL_LANDINGS_H

#include "../errors/results.h"

/* Gives EHL_FILM_AT_LANDING and those behind it, a number for each landing of the history: where
   the gap closes within an engagement, up to the first maximum of the load. */
ff_status ehl_landings_put(const ehl_results *r, const ehl_history *whole);

#endif
