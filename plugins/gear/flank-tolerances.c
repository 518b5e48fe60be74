/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The text of ISO 1328-1:1995 was not available. The formulas of f_pt, f_f_alpha and
   f_H_alpha for class 5 come from public code. These and the formulas of F_p and F_alpha, with the
   standard's ranges, steps and rounding, reproduce every value of class 6 printed in the public
   reports of the NREL 5 MW gearbox (gfsReboucas/Drivetrain, stage_01.rtf to stage_03.rtf; test
   `tolerances`). */
#include "flank-tolerances.h"

#include <flankfilm/author.h>

#include <math.h>

static const double modules[] = {0.5, 2, 3.5, 6, 10, 16, 25, 40, 70};
static const double diameters[] = {5,    20,   50,   125,  280,  560,  1000,
                                   1600, 2500, 4000, 6000, 8000, 10000};

/* Returns the geometric mean of the limits of the range that contains the value; 0 if no range
   contains it. */
static double range_mean(const double *ends, size_t count, double value)
{
    const double slack = 1 + 1e-9;
    for (size_t i = 1; i < count; i++)
        if (value >= ends[i - 1] / slack && value <= ends[i] * slack)
            return sqrt(ends[i - 1] * ends[i]);
    return 0;
}

/* Returns the tolerance of a class from that of class 5; one class is a factor of sqrt 2. The
   value is rounded to a multiple of 1 um above 10 um, of 0.5 um between 5 and 10 um, and of 0.1 um
   below 5 um. */
static double of_class(double class_5, double quality)
{
    const double value = class_5 * pow(2, 0.5 * (quality - 5));
    const double step = value > 10 ? 1 : value >= 5 ? 0.5 : 0.1;
    return 1e-6 * step * round(value / step);
}

ff_status gear_tolerances_of(const ff_host *host, int gear, double quality, double module,
                             double reference_diameter, gear_tolerances *t)
{
    const double m = range_mean(modules, sizeof modules / sizeof *modules, 1e3 * module);
    const double d =
        range_mean(diameters, sizeof diameters / sizeof *diameters, 1e3 * reference_diameter);
    if (!(m > 0 && d > 0))
        return ff_failf(host, FF_INVALID, "quality",
                        "gear %d has module %g mm and reference diameter %g mm; ISO 1328-1 has "
                        "classes for 0.5 to 70 mm and 5 to 10000 mm",
                        gear, 1e3 * module, 1e3 * reference_diameter);
    t->single_pitch = of_class(0.3 * (m + 0.4 * sqrt(d)) + 4, quality);
    t->total_pitch = of_class(0.3 * m + 1.25 * sqrt(d) + 7, quality);
    t->profile_form = of_class(2.5 * sqrt(m) + 0.17 * sqrt(d) + 0.5, quality);
    t->profile_slope = of_class(2 * sqrt(m) + 0.14 * sqrt(d) + 0.5, quality);
    t->profile = of_class(3.2 * sqrt(m) + 0.22 * sqrt(d) + 0.7, quality);
    return FF_OK;
}
