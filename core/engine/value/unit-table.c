/* SPDX-License-Identifier: MIT */
/* The table of unit symbols, and the search in it. */
#include <string.h>
#include <strings.h>

#include "unit-table.h"

static const double PI = 3.14159265358979323846;

/* Standard gravity and the international pound: lbf = 0.45359237 kg * 9.80665 m/s2 exactly. */
static const double LBF = 4.4482216152605;
static const double PSI = 6894.757293168361; /* lbf / (0.0254 m)^2 */

/* The powers are those of m, kg, s, K, rad. Products that engineers write without a separator (Nm,
   Pas) are symbols of their own; mN is always millinewton. */
static const fe_symbol symbols[] = {
    {"m", 1, 0, {1, 0, 0, 0, 0}, true, 0},
    {"g", 1, -3, {0, 1, 0, 0, 0}, true, 0},
    {"s", 1, 0, {0, 0, 1, 0, 0}, true, 0},
    {"K", 1, 0, {0, 0, 0, 1, 0}, true, 0},
    {"rad", 1, 0, {0, 0, 0, 0, 1}, true, 0},
    {"Hz", 1, 0, {0, 0, -1, 0, 0}, true, 0},
    {"N", 1, 0, {1, 1, -2, 0, 0}, true, 0},
    {"Pa", 1, 0, {-1, 1, -2, 0, 0}, true, 0},
    {"J", 1, 0, {2, 1, -2, 0, 0}, true, 0},
    {"W", 1, 0, {2, 1, -3, 0, 0}, true, 0},
    {"bar", 1, 5, {-1, 1, -2, 0, 0}, true, 0},
    {"Nm", 1, 0, {2, 1, -2, 0, 0}, true, 0},
    {"Nmm", 1, -3, {2, 1, -2, 0, 0}, false, 0},
    {"Pas", 1, 0, {-1, 1, -1, 0, 0}, true, 0},
    {"P", 1, -1, {-1, 1, -1, 0, 0}, false, 0},
    {"cP", 1, -3, {-1, 1, -1, 0, 0}, false, 0},
    {"St", 1, -4, {2, 0, -1, 0, 0}, false, 0},
    {"cSt", 1, -6, {2, 0, -1, 0, 0}, false, 0},
    {"micron", 1, -6, {1, 0, 0, 0, 0}, false, 0},
    {"min", 60, 0, {0, 0, 1, 0, 0}, false, 0},
    {"h", 3600, 0, {0, 0, 1, 0, 0}, false, 0},
    {"deg", PI / 180, 0, {0, 0, 0, 0, 1}, false, 0},
    {"rev", 2 * PI, 0, {0, 0, 0, 0, 1}, false, 0},
    {"rpm", PI / 30, 0, {0, 0, -1, 0, 1}, false, 0},
    {"degC", 1, 0, {0, 0, 0, 1, 0}, false, 273.15},
    {"degF", 5. / 9, 0, {0, 0, 0, 1, 0}, false, 459.67 * 5 / 9},
    {"%", 1, -2, {0, 0, 0, 0, 0}, false, 0},
    {"in", 254, -4, {1, 0, 0, 0, 0}, false, 0},
    {"inch", 254, -4, {1, 0, 0, 0, 0}, false, 0},
    {"mil", 254, -7, {1, 0, 0, 0, 0}, false, 0},
    {"ft", 3048, -4, {1, 0, 0, 0, 0}, false, 0},
    {"lb", 45359237, -8, {0, 1, 0, 0, 0}, false, 0},
    {"lbf", LBF, 0, {1, 1, -2, 0, 0}, false, 0},
    {"psi", PSI, 0, {-1, 1, -2, 0, 0}, false, 0},
    {"ksi", PSI, 3, {-1, 1, -2, 0, 0}, false, 0},
    {"reyn", PSI, 0, {-1, 1, -1, 0, 0}, false, 0}, /* psi s */
};

static const struct {
    const char *text;
    int ten;
} prefixes[] = {
    {"", 0},   {"T", 12}, {"G", 9},  {"M", 6},  {"k", 3},  {"h", 2},
    {"d", -1}, {"c", -2}, {"m", -3}, {"u", -6}, {"n", -9}, {"p", -12},
};

#define COUNT(array) (sizeof(array) / sizeof *(array))

bool fe_symbol_find(const char *word, fe_symbol *symbol)
{
    for (size_t p = 0; p < COUNT(prefixes); p++) {
        size_t n = strlen(prefixes[p].text);
        if (strncmp(word, prefixes[p].text, n) != 0)
            continue;
        for (size_t i = 0; i < COUNT(symbols); i++) {
            if (strcmp(word + n, symbols[i].name) != 0 || (n > 0 && !symbols[i].prefixed))
                continue;
            *symbol = symbols[i];
            symbol->ten += prefixes[p].ten;
            return true;
        }
    }
    return false;
}

const char *fe_symbol_nearest(const char *word)
{
    static const char *const habits[][2] = {
        {"C", "degC"},      {"celsius", "degC"}, {"F", "degF"},     {"fahrenheit", "degF"},
        {"kelvin", "K"},    {"sec", "s"},        {"second", "s"},   {"seconds", "s"},
        {"hr", "h"},        {"hour", "h"},       {"hours", "h"},    {"minutes", "min"},
        {"metre", "m"},     {"meter", "m"},      {"degree", "deg"}, {"degrees", "deg"},
        {"radians", "rad"}, {"turns", "rev"},    {"percent", "%"},  {"newton", "N"},
    };
    static const char *const common[] = {
        "m",   "cm",  "mm",  "um",   "Nm",  "nm",   "kg",  "g",    "s",      "ms", "us",
        "min", "h",   "K",   "degC", "rad", "mrad", "deg", "rev",  "rpm",    "Hz", "kHz",
        "N",   "kN",  "MPa", "GPa",  "kPa", "Pa",   "mPa", "bar",  "J",      "kJ", "W",
        "kW",  "kNm", "Nmm", "P",    "cP",  "St",   "cSt", "inch", "mil",    "ft", "lb",
        "lbf", "psi", "ksi", "reyn", "Pas", "mPas", "mN",  "degF", "micron",
    };
    for (size_t i = 0; i < COUNT(habits); i++)
        if (!strcasecmp(habits[i][0], word))
            return habits[i][1];
    return ff_nearest(word, common, COUNT(common));
}

/* Names of the dimensions used in this field, for messages, with the units to suggest. */
static const struct dimension {
    int8_t power[FF_DIMENSIONS];
    const char *name, *examples;
} dimensions[] = {
    {{0, 0, 0, 0, 0}, "a plain number", "1, %"},
    {{1, 0, 0, 0, 0}, "a length", "m, mm, um, nm"},
    {{2, 0, 0, 0, 0}, "an area", "m2, mm2"},
    {{3, 0, 0, 0, 0}, "a volume", "m3, cm3, mm3"},
    {{0, 1, 0, 0, 0}, "a mass", "kg, g"},
    {{2, 1, 0, 0, 0}, "a moment of inertia", "kg m2, kg mm2"},
    {{0, 0, 1, 0, 0}, "a time", "s, ms, us"},
    {{0, 0, 0, 1, 0}, "a temperature", "degC, K"},
    {{0, 0, 0, -1, 0}, "an expansion coefficient", "1/K"},
    {{0, 0, 0, 0, 1}, "an angle", "deg, rad, mrad, rev"},
    {{0, 0, -1, 0, 0}, "a frequency", "Hz, kHz, 1/s"},
    {{0, 0, -1, 0, 1}, "a rotational speed", "rpm, rev/s, rad/s"},
    {{1, 0, -1, 0, 0}, "a speed", "m/s, mm/s"},
    {{1, 0, -2, 0, 0}, "an acceleration", "m/s2"},
    {{1, 1, -2, 0, 0}, "a force", "N, kN"},
    {{2, 1, -2, 0, 0}, "a torque or an energy", "N m, kN m, J"},
    {{0, 1, -2, 0, 0}, "a stiffness or a force per width", "N/m, N/mm, N/um"},
    {{-1, 1, -2, 0, 0}, "a pressure", "Pa, MPa, GPa, bar"},
    {{1, -1, 2, 0, 0}, "a pressure coefficient", "1/Pa, 1/GPa"},
    {{-1, 1, -1, 0, 0}, "a viscosity", "Pa s, mPa s, cP"},
    {{2, 0, -1, 0, 0}, "a kinematic viscosity", "cSt, mm2/s, m2/s"},
    {{-3, 1, 0, 0, 0}, "a density", "kg/m3, g/cm3"},
    {{2, 1, -3, 0, 0}, "a power", "W, kW"},
    {{1, 1, -3, 0, 0}, "a power per width", "W/m, W/mm"},
    {{0, 1, -1, 0, 0}, "a damping coefficient", "N s/m"},
    {{1, 1, -3, -1, 0}, "a thermal conductivity", "W/(m K)"},
    {{2, 0, -2, -1, 0}, "a specific heat", "J/(kg K)"},
    {{-1, 0, 0, 0, 0}, "a wavenumber", "1/m, 1/mm"},
};

static const struct dimension *find_dimension(const ff_unit *unit)
{
    for (size_t i = 0; i < COUNT(dimensions); i++)
        if (!memcmp(dimensions[i].power, unit->power, sizeof unit->power))
            return &dimensions[i];
    return NULL;
}

const char *fe_dimension_name(const ff_unit *unit)
{
    const struct dimension *found = find_dimension(unit);
    return found ? found->name : NULL;
}

const char *ff_unit_examples(const ff_unit *unit)
{
    const struct dimension *found = find_dimension(unit);
    return found ? found->examples : "";
}
