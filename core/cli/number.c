/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "number.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* The powers of ten that a double holds exactly: scaling by one of them rounds once. */
static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
enum { MAX_POWER = 22 };

static double scale_by(double value, int power)
{
    return power < 0 ? value / powers[-power] : value * powers[power];
}

/* magnitude = mantissa * 10^(exponent - digits + 1) with a mantissa of `digits` digits; false when
   the scale is out of reach. */
static bool decimal(double magnitude, int digits, uint64_t *mantissa, int *exponent)
{
    int binary;
    frexp(magnitude, &binary);
    int guess = (int)floor((binary - 1) * 0.30102999566398119521); /* exact or one too low */
    for (int e = guess; e <= guess + 1; e++) {
        int power = digits - 1 - e;
        if (power > MAX_POWER || power < -MAX_POWER)
            return false;
        double scaled = rint(scale_by(magnitude, power));
        if (scaled < powers[digits]) {
            *mantissa = (uint64_t)scaled;
            *exponent = e;
            return true;
        }
    }
    return false;
}

/* Writes the digits of mantissa without its trailing zeros, the last one at out[width - 1]. */
static int write_digits(uint64_t mantissa, int digits, char *out)
{
    for (int i = digits - 1; i >= 0; i--) {
        out[i] = (char)('0' + mantissa % 10);
        mantissa /= 10;
    }
    while (digits > 1 && out[digits - 1] == '0')
        digits--;
    return digits;
}

static size_t write_fixed(const char *digit, int count, int exponent, char *out)
{
    char *at = out;
    if (exponent < 0) {
        *at++ = '0';
        *at++ = '.';
        for (int i = -1; i > exponent; i--)
            *at++ = '0';
        memcpy(at, digit, (size_t)count);
        return (size_t)(at + count - out);
    }
    for (int i = 0; i <= exponent || i < count; i++) {
        if (i == exponent + 1)
            *at++ = '.';
        *at++ = i < count ? digit[i] : '0';
    }
    return (size_t)(at - out);
}

static size_t write_scientific(const char *digit, int count, int exponent, char *out)
{
    char *at = out;
    *at++ = digit[0];
    if (count > 1) {
        *at++ = '.';
        memcpy(at, digit + 1, (size_t)count - 1);
        at += count - 1;
    }
    int size = exponent < 0 ? -exponent : exponent; /* below 100: MAX_POWER + digits */
    *at++ = 'e';
    *at++ = exponent < 0 ? '-' : '+';
    *at++ = (char)('0' + size / 10);
    *at++ = (char)('0' + size % 10);
    return (size_t)(at - out);
}

size_t ff_number_print(double value, int digits, char out[FF_NUMBER_SIZE])
{
    char digit[FF_NUMBER_DIGITS] = {0};
    uint64_t mantissa = 0;
    int exponent = 0;
    char *at = out;
    if (value == 0) {
        memcpy(out, "0", 2);
        return 1;
    }
    if (!decimal(fabs(value), digits, &mantissa, &exponent))
        return (size_t)snprintf(out, FF_NUMBER_SIZE, "%.*g", digits, value);
    if (value < 0)
        *at++ = '-';
    int count = write_digits(mantissa, digits, digit);
    bool fixed = exponent >= -4 && exponent < digits;
    at += fixed ? write_fixed(digit, count, exponent, at)
                : write_scientific(digit, count, exponent, at);
    *at = '\0';
    return (size_t)(at - out);
}

ff_readable ff_readable_unit(const char *si_unit, double magnitude)
{
    const double pi = 3.14159265358979323846;
    /* rows of one unit in rising order of the magnitude that they are good from */
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
    ff_readable readable = {1, si_unit};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strcmp(rows[i].si, si_unit) == 0 && magnitude >= rows[i].from)
            readable = (ff_readable){rows[i].factor, rows[i].unit};
    return readable;
}
