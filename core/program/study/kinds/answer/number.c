/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "number.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void study_number_exact(double value, char out[STUDY_NUMBER_SIZE])
{
    if (!isfinite(value)) {
        strcpy(out, "nan");
        return;
    }
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, STUDY_NUMBER_SIZE, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            return;
    }
}

/* Copies digits with a gap between the thousands. */
static void group(const char *digits, const char *gap, char out[STUDY_NUMBER_SIZE])
{
    const size_t sign = *digits == '-', whole = strspn(digits + sign, "0123456789");
    size_t length = 0;
    for (size_t i = 0; digits[i] && length + strlen(gap) + 1 < STUDY_NUMBER_SIZE; i++) {
        const size_t left = i < sign + whole ? sign + whole - i : 0;
        if (i > sign && left > 0 && left % 3 == 0)
            for (const char *c = gap; *c; c++)
                out[length++] = *c;
        out[length++] = digits[i];
    }
    out[length] = '\0';
}

void study_number_text(double value, int digits, const char *gap, char out[STUDY_NUMBER_SIZE])
{
    char text[STUDY_NUMBER_SIZE];
    snprintf(text, sizeof text, isfinite(value) ? "%.*g" : "not known", digits, value);
    const double rounded = isfinite(value) ? strtod(text, NULL) : 0;
    const bool large = fabs(rounded) >= 1e4 && fabs(rounded) < 1e9;
    if (large && strchr(text, 'e'))
        snprintf(text, sizeof text, "%.0f", rounded);
    group(text, large ? gap : "", out);
}

void study_number_short(double value, char out[STUDY_NUMBER_SIZE])
{
    snprintf(out, STUDY_NUMBER_SIZE, isfinite(value) ? "%.3g" : "not known", value);
}

study_readable study_readable_unit(const char *si_unit, double magnitude)
{
    const double pi = 3.14159265358979323846;
    /* rows with the same SI unit are in rising order of the magnitude from which they are used */
    const struct {
        const char *si;
        double from, factor;
        const char *unit;
    } rows[] = {
        {"m", 0, 1e6, "um"},
        {"m", 1e-3, 1e3, "mm"},
        {"m", 1, 1, "m"},
        {"Pa", 0, 1, "Pa"},
        {"Pa", 1e3, 1e-3, "kPa"},
        {"Pa", 1e6, 1e-6, "MPa"},
        {"Pa", 1e9, 1e-9, "GPa"},
        {"N", 1e4, 1e-3, "kN"},
        {"N/m", 1e3, 1e-3, "N/mm"},
        {"N/m", 2e7, 1e-6, "N/um"},
        {"rad", 0, 180 / pi, "deg"},
        {"rad/s", 0, 30 / pi, "rpm"},
        {"s", 0, 1e6, "us"},
        {"s", 1e-3, 1e3, "ms"},
        {"s", 1, 1, "s"},
        {"m2/s", 0, 1e6, "mm2/s"},
        {"Pa s", 0, 1e3, "mPa s"},
        {"Pa s", 1, 1, "Pa s"},
        {"m/s", 0, 1e3, "mm/s"},
        {"m/s", 0.1, 1, "m/s"},
        {"W", 1e4, 1e-3, "kW"},
        {"W/m", 1e3, 1e-3, "W/mm"},
        {"1/Pa", 0, 1e9, "1/GPa"},
        {"Hz", 1e5, 1e-3, "kHz"},
        {"1", 0, 1, ""},
    };
    study_readable readable = {1, 0, si_unit};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strcmp(rows[i].si, si_unit) == 0 && magnitude >= rows[i].from)
            readable = (study_readable){rows[i].factor, 0, rows[i].unit};
    return readable;
}

/* Whether an output is a temperature, not a temperature difference such as an error, a rise or a
 * spread. */
static bool is_temperature(const char *name, const char *si_unit)
{
    static const char *const differences[] = {"flash", "error", "spread", "margin", "deviation"};
    bool difference = false;
    for (size_t i = 0; i < sizeof differences / sizeof *differences; i++)
        difference = difference || strstr(name, differences[i]);
    return !strcmp(si_unit, "K") && strstr(name, "temperature") && !difference;
}

study_readable study_readable_output(const char *name, const char *si_unit, double magnitude)
{
    return is_temperature(name, si_unit) ? (study_readable){1, -273.15, "degC"}
                                         : study_readable_unit(si_unit, magnitude);
}

void study_quantity_text(double si, const study_readable *unit, int digits, const char *gap,
                         char out[STUDY_QUANTITY_SIZE])
{
    char text[STUDY_NUMBER_SIZE];
    study_number_text(si * unit->factor + unit->offset, digits, gap, text);
    snprintf(out, STUDY_QUANTITY_SIZE, isfinite(si) && *unit->unit ? "%s %.24s" : "%s", text,
             unit->unit);
}
