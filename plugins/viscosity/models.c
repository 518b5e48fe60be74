/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists the viscosity laws of this shared object. */
#include <flankfilm/author.h>

extern const ff_model viscosity_isoviscous, viscosity_barus, viscosity_roelands,
    viscosity_two_slope, viscosity_doolittle_tait, viscosity_yasutomi, viscosity_modulus;

FF_EXPORT_MODELS(&viscosity_isoviscous, &viscosity_barus, &viscosity_roelands, &viscosity_two_slope,
                 &viscosity_doolittle_tait, &viscosity_yasutomi, &viscosity_modulus);
