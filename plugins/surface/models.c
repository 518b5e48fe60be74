/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists the surface models of this shared object. */
#include <flankfilm/author.h>

extern const ff_model surface_dent, surface_measured, surface_sinusoidal, surface_statistical,
    surface_synthetic;

FF_EXPORT_MODELS(&surface_dent, &surface_measured, &surface_sinusoidal, &surface_statistical,
                 &surface_synthetic);
