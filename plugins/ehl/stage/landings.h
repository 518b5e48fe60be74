/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film at the instants at which parted flanks land, and the highest pressure of the landing. */
#ifndef EHL_LANDINGS_H
#define EHL_LANDINGS_H

#include "../errors/results.h"

/* Gives EHL_FILM_AT_LANDING and the outputs after it, one number for each landing of the history:
 * where the gap closes within an engagement, up to the first maximum of the load. */
ff_status ehl_landings_put(const ehl_results *r, const ehl_history *whole);

#endif
