/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files that draw and write a map. */
#ifndef FF_MAP_H
#define FF_MAP_H

#include "stability.h"

#include <jansson.h>

json_t *ff_map_counts(const ff_map *map); /* {verdict: [cells of the grid, between]} */

/* map-svg.c */
void ff_map_svg(const ff_map *map, FILE *out);

#endif
