/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "number.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The powers of ten that a double holds exactly: scaling by one of them rounds once. */
static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
enum { MAX_POWER = 22 };

/* Returns the mantissa of `digits` digits in magnitude = mantissa * 10^(*exponent - digits + 1); 0
   when the scaling would round twice. */
static uint64_t to_decimal(double magnitude, int digits, int *exponent)
{
    int binary;
    frexp(magnitude, &binary);
    *exponent = (int)floor((binary - 1) * 0.30102999566398119521); /* right or one too low */
    for (int tries = 0; tries < 2; tries++, ++*exponent) {
        int power = digits - 1 - *exponent;
        if (power > MAX_POWER || power < -MAX_POWER)
            return 0;
        double scaled = rint(power < 0 ? magnitude / powers[-power] : magnitude * powers[power]);
        if (scaled < powers[digits])
            return (uint64_t)scaled;
    }
    return 0;
}

/* Writes the digits of mantissa with the point after `before` of them. Trailing zeros of a fraction
   are left out. */
static char *write_digits(uint64_t mantissa, int digits, int before, char *out)
{
    for (; digits > before && mantissa % 10 == 0; digits--)
        mantissa /= 10;
    char *end = out + digits + (digits > before);
    for (char *at = end; at > out; mantissa /= 10) {
        *--at = (char)('0' + mantissa % 10);
        if (--digits == before && at > out)
            *--at = '.';
    }
    return end;
}

size_t results_number_print(double value, int digits, char out[RESULTS_NUMBER_SIZE])
{
    int exponent;
    char *at = out;
    if (value == 0) {
        memcpy(out, "0", 2);
        return 1;
    }
    uint64_t mantissa = to_decimal(fabs(value), digits, &exponent);
    if (mantissa == 0)
        return (size_t)snprintf(out, RESULTS_NUMBER_SIZE, "%.*g", digits, value);
    if (value < 0)
        *at++ = '-';
    if (exponent < -4 || exponent >= digits) {
        at = write_digits(mantissa, digits, 1, at);
        return (size_t)(at - out + sprintf(at, "e%+03d", exponent));
    }
    if (exponent < 0) /* zeros in front */
        at = write_digits(mantissa, digits - exponent, 1, at);
    else
        at = write_digits(mantissa, digits, exponent + 1, at);
    *at = '\0';
    return (size_t)(at - out);
}

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

results_readable results_readable_unit(const char *si_unit, double magnitude)
{
    const double pi = 3.14159265358979323846;
    /* rows of one unit, in rising order of the magnitude from which they are used */
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
        {"N", 1e5, 1e-3, "kN"},
        {"N/m", 1e3, 1e-3, "kN/m"},
        {"N/m", 1e6, 1e-6, "MN/m"},
        {"rad", 0, 180 / pi, "deg"},
        {"rad/s", 0, 30 / pi, "rpm"},
        {"s", 0, 1e6, "us"},
        {"s", 1e-3, 1e3, "ms"},
        {"s", 1, 1, "s"},
        {"Pa s", 0, 1e3, "mPa s"},
        {"Pa s", 1, 1, "Pa s"},
        {"m/s", 0, 1e3, "mm/s"},
        {"m/s", 0.1, 1, "m/s"},
        {"W", 1e4, 1e-3, "kW"},
        {"W/m", 1e4, 1e-3, "kW/m"},
        {"Hz", 1e5, 1e-3, "kHz"},
        {"1", 0, 1, ""},
    };
    results_readable readable = {1, si_unit};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strcmp(rows[i].si, si_unit) == 0 && magnitude >= rows[i].from)
            readable = (results_readable){rows[i].factor, rows[i].unit};
    return readable;
}
