/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draft. Checks of a roughness record: the heights have the stated rms. */
#include "evaluation.h"
#include "offer.h"

#include <math.h>
#include <string.h>

/* Returns the rms about the mean, for heights in equal steps over whole periods. */
static double rms(conformance_array height)
{
    double mean = 0, square = 0;
    for (size_t i = 0; i < height.count; i++)
        mean += height.data[i] / (double)height.count;
    for (size_t i = 0; i < height.count; i++)
        square += (height.data[i] - mean) * (height.data[i] - mean) / (double)height.count;
    return sqrt(square);
}

/* Checks a periodic record: its last point is one step before the period, and rq is the rms of its
   heights. A record that does not repeat, such as a dent, is no roughness. */
static void record(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    const conformance_array position = conformance_array_of(&run, "position");
    const double period = conformance_scalar_of(&run, "period");
    bool good = true;
    const size_t n = position.count;
    for (size_t i = 0; good && i < n; i++)
        good = conformance_near(&run, "position (equal steps from 0)", i, position.data[i],
                                position.data[n - 1] * (double)i / (double)(n > 1 ? n - 1 : 1),
                                position.data[n - 1], 1e-9);
    if (good && n > 1 && period > 0)
        good = conformance_near(&run, "period (one step beyond the last position)", 0, period,
                                position.data[n - 1] * (double)n / (double)(n - 1), period, 1e-6);
    for (int g = 0; good && n > 1 && period > 0 && g < 2; g++) {
        const conformance_array height = conformance_array_of(&run, g ? "height_2" : "height_1");
        const double rough = height.count == n ? rms(height) : (double)NAN;
        good =
            conformance_near(&run, g ? "rq_2 (rms of height_2)" : "rq_1 (rms of height_1)", 0,
                             conformance_scalar_of(&run, g ? "rq_2" : "rq_1"), rough, rough, 0.01);
    }
    conformance_close(&run);
}

static const ff_check checks[] = {
    {"record", "the steps over a period are equal, and rq is the rms of the heights", record},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("surface", "checks of a roughness record: its rms", "");
