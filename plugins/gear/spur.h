/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An instance of gear/involute-spur. */
#ifndef GEAR_SPUR_H
#define GEAR_SPUR_H

#include "flank-deviations.h"
#include "flank-tolerances.h"
#include "materials.h"
#include "spur-geometry.h"

typedef struct spur {
    const ff_host *host;
    gear_spur_spec spec;
    double face_width;
    gear_material_spec material;
    ff_reals bore, given_inertia, roughness_rq, roughness_ra;
    int64_t stations;
    gear_flank_spec flank_spec;
    gear_relief back_relief; /* relief of the back flanks; shape -1: the shape of the driving
                                flanks */
    gear_spur_pair pair;
    gear_material made_of[2]; /* the named material with the values given by the user */
    double bore_radius[2], mass[2], inertia[2];
    gear_flanks flanks;
    gear_flanks back; /* no points: the same as the driving flanks */
    ff_reals quality; /* class of ISO 1328-1 */
    gear_tolerances tolerances[2];
} spur;

/* Writes the wanted outputs. */
ff_status gear_spur_write(const spur *s, uint64_t wanted);

#endif
