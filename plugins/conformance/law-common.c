/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Argument axes and extreme values for the checks of laws. */
#include "law-checks.h"

static const double pressures[] = {-1e30, -1e10, -1e6, 0, 1e6, 1e9, 1e10, 1e12, 1e30};
static const double temperatures[] = {-1e30, 0, 1, 300, 1000, 1e30};
static const double ln_etas[] = {-1e4, -700, -5, 0, 30, 700, 1e4};
static const double stresses[] = {-1e30, -1e9, -1, 0, 1, 1e9, 1e30};
static const double films[] = {1e-300, 1e-15, 1e-9, 1e-6, 1, 1e30};

const conformance_axis conformance_pressure = {.name = "p",
                                               .low = 1e5,
                                               .high = 3e9,
                                               .logarithmic = true,
                                               .extremes = pressures,
                                               .extreme_count =
                                                   sizeof pressures / sizeof *pressures};
const conformance_axis conformance_temperature = {.name = "T",
                                                  .low = 280,
                                                  .high = 420,
                                                  .optional = true,
                                                  .extremes = temperatures,
                                                  .extreme_count =
                                                      sizeof temperatures / sizeof *temperatures};
const conformance_axis conformance_ln_eta = {.name = "ln_eta",
                                             .low = -7,
                                             .high = 20,
                                             .extremes = ln_etas,
                                             .extreme_count = sizeof ln_etas / sizeof *ln_etas};
const conformance_axis conformance_film = {.name = "h",
                                           .low = 1e-8,
                                           .high = 1e-4,
                                           .logarithmic = true,
                                           .extremes = films,
                                           .extreme_count = sizeof films / sizeof *films};
const conformance_axis conformance_stress = {.name = "tau",
                                             .low = -1e8,
                                             .high = 1e8,
                                             .scale = 1e6,
                                             .extremes = stresses,
                                             .extreme_count = sizeof stresses / sizeof *stresses};

ff_status conformance_constant_law(const void *self, size_t n, const double *p, const double *T,
                                   double *value, double *by_p, double *by_T)
{
    (void)p, (void)T;
    for (size_t i = 0; i < n; i++) {
        value[i] = *(const double *)self;
        if (by_p)
            by_p[i] = 0;
        if (by_T)
            by_T[i] = 0;
    }
    return FF_OK;
}
