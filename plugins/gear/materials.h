/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Materials of gears by name. */
#ifndef GEAR_MATERIALS_H
#define GEAR_MATERIALS_H

#include <stdint.h>

/* The names in the order of the table. */
#define GEAR_MATERIALS                                                                             \
    "steel|16MnCr5|20MnCr5|15CrNi6|18CrNiMo7-6|20NiCrMo2|42CrMo4|31CrMoV9|EN-GJS-500-7|"           \
    "EN-GJS-700-2|EN-GJL-250"

typedef struct gear_material {
    double modulus, poisson, density; /* SI */
    double yield;                     /* of the flank, Pa; 0: not known */
} gear_material;

gear_material gear_material_of(int64_t rank);

#endif
