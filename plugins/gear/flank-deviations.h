/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Deviations of the flanks from true involutes: reliefs, profile crown, profile slope, a measured
   curve, and index deviations of single teeth. Deviations are positive where there is more metal,
   along the normal (ISO 1328-1); reliefs and crown remove metal. */
#ifndef GEAR_FLANK_DEVIATIONS_H
#define GEAR_FLANK_DEVIATIONS_H

#include "measured-curves.h"
#include "spur-geometry.h"

#include <flankfilm/plugin.h>

#include <stdbool.h>

/* A relief of `amount`, m, at one end of the flank: one value for both gears, or two. Its start is
   optional and is given in one of three ways: as a roll angle of the gear itself, rad; as a
   diameter; or as a length along the line of action from the end of the flank. */
typedef struct gear_relief {
    ff_reals amount, start, diameter, length;
    int32_t shape; /* 1: parabolic */
} gear_relief;

typedef struct gear_flank_spec {
    gear_relief tip, root;
    ff_reals crown;    /* metal removed at both ends of the flank, m; one value or two */
    ff_reals slope;    /* f_H_alpha: rise from the lowest contact to the tip, m; one value or two */
    ff_reals index[2]; /* deviations of the first teeth, m; those of the other teeth are 0 */
    const char *file;  /* may be NULL */
    bool back;         /* true for back flanks whose tip relief is given by its own parameters */
} gear_flank_spec;

/* The flanks built from a specification; angles in rad, deviations in m. */
typedef struct gear_flanks {
    double low[2], high[2]; /* roll angles of the lowest contact and of the tip, each on its own
                               gear */
    double tip_start[2], root_start[2];
    double moved_start; /* largest move of a relief's start due to rounding, rad */
    gear_curve measured[2];
    size_t points;                  /* number of points of each of the two profiles */
    double *roll[2], *deviation[2]; /* profiles, linear between these points */
} gear_flanks;

/* Checks the specification against the pair, and samples the profiles. The caller frees them, also
   after an error. */
ff_status gear_flanks_make(const ff_host *host, const gear_flank_spec *spec,
                           const gear_spur_spec *gears, const gear_spur_pair *pair,
                           gear_flanks *flanks);
void gear_flanks_free(gear_flanks *flanks);

/* Returns the specification of the back flanks: that of the driving flanks, but with the tip relief
   given for the back flanks. */
gear_flank_spec gear_flanks_back(const gear_flank_spec *driving, const gear_relief *back);
/* Whether a relief of the back flanks is given. */
bool gear_flanks_have_back(const gear_relief *back);

#endif
