/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "number.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void results_number_exact(double value, char out[RESULTS_NUMBER_SIZE])
{
    if (!isfinite(value)) {
        strcpy(out, "nan");
        return;
    }
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, RESULTS_NUMBER_SIZE, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            return;
    }
}

void results_number_short(double value, char out[RESULTS_NUMBER_SIZE])
{
    snprintf(out, RESULTS_NUMBER_SIZE, isfinite(value) ? "%.3g" : "not known", value);
}

results_readable results_readable_unit(const char *si_unit, double magnitude)
{
    const double pi = 3.14159265358979323846;
    /* rows of one unit, in rising order of the magnitude from which they are used */
    const struct {
        const char *si;
        double from, factor;
        const char *unit;
    } rows[] = {
        {"m", 0, 1e6, "um"},        {"m", 1e-3, 1e3, "mm"},      {"m", 1, 1, "m"},
        {"Pa", 0, 1, "Pa"},         {"Pa", 1e3, 1e-3, "kPa"},    {"Pa", 1e6, 1e-6, "MPa"},
        {"Pa", 1e9, 1e-9, "GPa"},   {"N", 1e4, 1e-3, "kN"},      {"N/m", 1e3, 1e-3, "N/mm"},
        {"N/m", 2e7, 1e-6, "N/um"}, {"rad", 0, 180 / pi, "deg"}, {"rad/s", 0, 30 / pi, "rpm"},
        {"s", 0, 1e6, "us"},        {"s", 1e-3, 1e3, "ms"},      {"s", 1, 1, "s"},
        {"Pa s", 0, 1e3, "mPa s"},  {"Pa s", 1, 1, "Pa s"},      {"m/s", 0, 1e3, "mm/s"},
        {"m/s", 0.1, 1, "m/s"},     {"W", 1e4, 1e-3, "kW"},      {"W/m", 1e3, 1e-3, "W/mm"},
        {"1/Pa", 0, 1e9, "1/GPa"},  {"Hz", 1e5, 1e-3, "kHz"},    {"1", 0, 1, ""},
    };
    results_readable readable = {1, 0, si_unit};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strcmp(rows[i].si, si_unit) == 0 && magnitude >= rows[i].from)
            readable = (results_readable){rows[i].factor, 0, rows[i].unit};
    return readable;
}

bool results_is_temperature(const char *name, const char *si_unit)
{
    static const char *const differences[] = {"flash", "error", "spread", "margin", "deviation"};
    bool difference = false;
    for (size_t i = 0; i < sizeof differences / sizeof *differences; i++)
        difference = difference || strstr(name, differences[i]);
    return !strcmp(si_unit, "K") && strstr(name, "temperature") && !difference;
}

results_readable results_readable_output(const char *name, const char *si_unit, double magnitude)
{
    return results_is_temperature(name, si_unit) ? (results_readable){1, -273.15, "degC"}
                                                 : results_readable_unit(si_unit, magnitude);
}
