/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gear materials by name. */
#ifndef GEAR_MATERIALS_H
#define GEAR_MATERIALS_H

#include <flankfilm/plugin.h>

#include <stdint.h>

/* The names in the order of the table. */
#define GEAR_MATERIALS                                                                             \
    "steel|16MnCr5|20MnCr5|15CrNi6|18CrNiMo7-6|20NiCrMo2|42CrMo4|31CrMoV9|EN-GJS-500-7|"           \
    "EN-GJS-700-2|EN-GJL-250|CuSn12Ni2|POM|PA66|PEEK"

/* In SI; 0: unknown. Hardness and yield strength are those of the flank. */
typedef struct gear_material {
    double modulus, poisson, density;
    double conductivity, specific_heat;
    double hardness, yield;
} gear_material;

gear_material gear_material_of(int64_t rank);

/* Values given by the user, which replace those of the material: one or two each, or none. */
typedef struct gear_material_spec {
    int32_t name[2]; /* ranks; -1: not given */
    ff_reals modulus, poisson, density, conductivity, specific_heat, hardness, yield;
} gear_material_spec;

/* Returns the material of gear `g`, 0 or 1. If a given modulus or density differs from that of the
   named material, the gear is of another material: its heat data, hardness and strength are then
   unknown unless given. */
gear_material gear_material_make(const gear_material_spec *spec, int g);

#endif
