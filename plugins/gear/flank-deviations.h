/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Deviations of the flanks from true involutes: reliefs, profile crown, profile slope, a measured
 * curve, and index deviations tooth by tooth. Deviations are positive where there is more metal, in
 * the direction of the normal (ISO 1328-1); reliefs and crown take metal off.
 */
#ifndef GEAR_FLANK_DEVIATIONS_H
#define GEAR_FLANK_DEVIATIONS_H

#include "measured-curves.h"
#include "spur-geometry.h"

#include <flankfilm/plugin.h>

#include <stdbool.h>

/* A relief of `amount`, m, at the end of the flank, one value or two. Where it starts is said in
   one way of three, or not at all: as a roll angle of the own gear, rad, as a diameter, or as a
   length along the line of action from the end of the flank. */
typedef struct gear_relief {
    ff_reals amount, start, diameter, length;
    int32_t shape; /* 1: parabolic */
} gear_relief;

typedef struct gear_flank_spec {
    gear_relief tip, root;
    ff_reals crown;    /* taken off both ends of the flank, m; one value or two */
    ff_reals slope;    /* f_H_alpha: rise from the lowest contact to the tip, m; one value or two */
    ff_reals index[2]; /* deviations of the first teeth, m; the others have none */
    const char *file;  /* may be NULL */
    bool back;         /* of the back flanks, whose tip relief has names of its own */
} gear_flank_spec;

/* The flanks that follow from a specification; angles in rad, deviations in m. */
typedef struct gear_flanks {
    double low[2], high[2]; /* roll angles of the lowest contact and of the tip, own gear */
    double tip_start[2], root_start[2];
    double moved_start; /* the farthest that the rounding of a drawing has moved a start, rad */
    gear_curve measured[2];
    size_t points;                  /* of either profile */
    double *roll[2], *deviation[2]; /* at these points, linear between them */
} gear_flanks;

/* Checks the specification against the pair and samples the profiles. To be freed in any case. */
ff_status gear_flanks_make(const ff_host *host, const gear_flank_spec *spec,
                           const gear_spur_spec *gears, const gear_spur_pair *pair,
                           gear_flanks *flanks);
void gear_flanks_free(gear_flanks *flanks);

/* The back flanks: as the driving ones, but for what is given of their own tip relief. */
gear_flank_spec gear_flanks_back(const gear_flank_spec *driving, const gear_relief *back);
/* Whether anything is. */
bool gear_flanks_have_back(const gear_relief *back);

#endif
