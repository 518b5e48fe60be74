/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Units: what is read, with which value and dimension, and what is refused with which advice. */
#include <flankfilm/engine.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "value-check.h"

static const double PI = 3.14159265358979323846;

typedef struct good {
    const char *text;
    double factor;
    int8_t power[FF_DIMENSIONS]; /* m, kg, s, K, rad */
} good;

static const good goods[] = {
    {"", 1, {0}},
    {"1", 1, {0}},
    {"%", 0.01, {0}},
    {"m", 1, {1}},
    {"mm", 1e-3, {1}},
    {"um", 1e-6, {1}},
    {"\xC2\xB5m", 1e-6, {1}}, /* micro sign */
    {"\xCE\xBCm", 1e-6, {1}}, /* Greek mu */
    {"nm", 1e-9, {1}},
    {"micron", 1e-6, {1}},
    {"in", 0.0254, {1}},
    {"inch", 0.0254, {1}},
    {"mil", 25.4e-6, {1}},
    {"mm2", 1e-6, {2}},
    {"mm^2", 1e-6, {2}},
    {"mm**2", 1e-6, {2}},
    {"mm²", 1e-6, {2}},
    {"cm3", 1e-6, {3}},
    {"kg", 1, {0, 1}},
    {"g", 1e-3, {0, 1}},
    {"kg m2", 1, {2, 1}},
    {"kg/m3", 1, {-3, 1}},
    {"g/cm3", 1000, {-3, 1}},
    {"s", 1, {0, 0, 1}},
    {"ms", 1e-3, {0, 0, 1}},
    {"min", 60, {0, 0, 1}},
    {"h", 3600, {0, 0, 1}},
    {"s-1", 1, {0, 0, -1}},
    {"s^-1", 1, {0, 0, -1}},
    {"s⁻¹", 1, {0, 0, -1}},
    {"1/s", 1, {0, 0, -1}},
    {"Hz", 1, {0, 0, -1}},
    {"kHz", 1000, {0, 0, -1}},
    {"K", 1, {0, 0, 0, 1}},
    {"rad", 1, {0, 0, 0, 0, 1}},
    {"mrad", 1e-3, {0, 0, 0, 0, 1}},
    {"deg", PI / 180, {0, 0, 0, 0, 1}},
    {"°", PI / 180, {0, 0, 0, 0, 1}},
    {"rev", 2 * PI, {0, 0, 0, 0, 1}},
    {"rpm", PI / 30, {0, 0, -1, 0, 1}},
    {"rev/min", PI / 30, {0, 0, -1, 0, 1}},
    {"rad/s", 1, {0, 0, -1, 0, 1}},
    {"m/s", 1, {1, 0, -1}},
    {"m/s2", 1, {1, 0, -2}},
    {"N", 1, {1, 1, -2}},
    {"mN", 1e-3, {1, 1, -2}},
    {"lbf", 4.4482216152605, {1, 1, -2}},
    {"N m", 1, {2, 1, -2}},
    {"N  m", 1, {2, 1, -2}},
    {"N.m", 1, {2, 1, -2}},
    {"N*m", 1, {2, 1, -2}},
    {"N * m", 1, {2, 1, -2}},
    {"N·m", 1, {2, 1, -2}},
    {"N\xC2\xA0m", 1, {2, 1, -2}}, /* no-break space */
    {" N m ", 1, {2, 1, -2}},
    {"Nm", 1, {2, 1, -2}},
    {"kNm", 1000, {2, 1, -2}},
    {"Nmm", 1e-3, {2, 1, -2}},
    {"J", 1, {2, 1, -2}},
    {"N/m", 1, {0, 1, -2}},
    {"N/mm", 1000, {0, 1, -2}},
    {"N/um", 1e6, {0, 1, -2}},
    {"N/(mm um)", 1e9, {-1, 1, -2}},
    {"N / ( mm um )", 1e9, {-1, 1, -2}},
    {"N um/mm", 1e-3, {1, 1, -2}},
    {"Pa", 1, {-1, 1, -2}},
    {"GPa", 1e9, {-1, 1, -2}},
    {"hPa", 100, {-1, 1, -2}},
    {"bar", 1e5, {-1, 1, -2}},
    {"N/mm2", 1e6, {-1, 1, -2}},
    {"psi", 6894.757293168361, {-1, 1, -2}},
    {"1/GPa", 1e-9, {1, -1, 2}},
    {"1 / GPa", 1e-9, {1, -1, 2}},
    {"/GPa", 1e-9, {1, -1, 2}},
    {"GPa-1", 1e-9, {1, -1, 2}},
    {"GPa^-1", 1e-9, {1, -1, 2}},
    {"Pa s", 1, {-1, 1, -1}},
    {"mPa s", 1e-3, {-1, 1, -1}},
    {"mPas", 1e-3, {-1, 1, -1}},
    {"P", 0.1, {-1, 1, -1}},
    {"cP", 1e-3, {-1, 1, -1}},
    {"reyn", 6894.757293168361, {-1, 1, -1}},
    {"cSt", 1e-6, {2, 0, -1}},
    {"St", 1e-4, {2, 0, -1}},
    {"mm2/s", 1e-6, {2, 0, -1}},
    {"W", 1, {2, 1, -3}},
    {"W/(m K)", 1, {1, 1, -3, -1}},
    {"J/(kg K)", 1, {2, 0, -2, -1}},
};

static void check_factor(const char *text, double factor, double expected)
{
    /* decimal units are exact; the others are a product of two rounded numbers */
    ck_assert_msg(fabs(factor - expected) <= 1e-15 * fabs(expected), "%s: %.17g, not %.17g", text,
                  factor, expected);
}

START_TEST(reads_unit)
{
    const good *row = &goods[_i];
    ff_unit unit;
    char why[256] = "";
    ck_assert_msg(ff_unit_parse(row->text, &unit, why, sizeof why), "\"%s\" %s", row->text, why);
    check_factor(row->text, unit.factor, row->factor);
    ck_assert_msg(!memcmp(unit.power, row->power, sizeof unit.power), "%s", row->text);
    ck_assert_double_eq(unit.offset, 0);
}
END_TEST

static const struct {
    const char *text, *clause; /* a part of what must be said */
} bads[] = {
    {"N/mm um", "is ambiguous; write \"N/(mm um)\" or \"N um/mm\""},
    {"W/m K", "is ambiguous; write \"W/(m K)\" or \"W K/m\""},
    {"1/GPa um", "\"1/(GPa um)\" or \"um/GPa\""},
    {"m/s/s", "has two \"/\"; write \"m/(s s)\""},
    {"N/(m/s)", "second \"/\""},
    {"N/(mm um", "without \")\""},
    {"N)", "without \"(\""},
    {"N/(m))", "without \"(\""},
    {"(N m)", "in the wrong place"},
    {"W/(m degC)", "write \"W/(m K)\""},
    {"degC/m", "write \"K/m\""},
    {"1/degC", "write \"1/K\""},
    {"degC2", "write \"K2\""},
    {"RPM", "did you mean \"rpm\"?"},
    {"MM", "did you mean \"mm\"?"},
    {"gpa", "did you mean \"GPa\"?"},
    {"hz", "did you mean \"Hz\"?"},
    {"C", "did you mean \"degC\"?"},
    {"sec", "did you mean \"s\"?"},
    {"degrees", "did you mean \"deg\"?"},
    {"furlong", "is not known"},
    {"N furlong", "unknown part \"furlong\""},
    {"mrpm", "did you mean \"rpm\"?"},
    {"kdeg", "did you mean \"deg\"?"},
    {"N-m", "write a space"},
    {"W/m-K", "write a space"},
    {"mm 2", "has a number where a unit is expected"},
    {"2 mm", "has a number where a unit is expected"},
    {"m^0.5", "not a whole number"},
    {"m0", "powers are whole numbers"},
    {"m10", "powers are whole numbers"},
    {"m99999999999999999999", "powers are whole numbers"},
    {"m^", "powers are whole numbers"},
    {"m^x", "powers are whole numbers"},
    {"mm2s", "needs a space"},
    {"N m/", "another unit"},
    {"N*", "another unit"},
    {"N..m", "\".\" where a unit is expected"},
    {"/", "another unit"},
    {"k", "is not known; did you mean \"K\"?"},
    {"\xC2\xB5", "is not known"},
    {"m$", "\"$\""},
    {"€", "\"€\" where"},
    {"m9 m9 m9 m9 m9 m9 m9", "too high a power"},
    {"Tm9 Tm9 Tm9 Tm9 Tm9 Tm9", "is too large or too small for a number"},
    {"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa",
     "not known"},
};

START_TEST(refuses_unit)
{
    ff_unit unit;
    char why[256] = "";
    ck_assert_msg(!ff_unit_parse(bads[_i].text, &unit, why, sizeof why), "%s", bads[_i].text);
    ck_assert_msg(why[0] && strstr(why, bads[_i].clause), "\"%s\" %s", bads[_i].text, why);
}
END_TEST

static ff_unit unit_of(const char *text)
{
    ff_unit unit;
    char why[256];
    ck_assert_msg(ff_unit_parse(text, &unit, why, sizeof why), "%s", text);
    return unit;
}

START_TEST(turning_is_no_frequency)
{
    ff_unit rpm = unit_of("rpm"), hertz = unit_of("Hz"), rad = unit_of("rad"), one = unit_of("1");
    ck_assert(!ff_unit_same_dimension(&rpm, &hertz));
    ck_assert(!ff_unit_same_dimension(&rad, &one));
    ck_assert(!ff_unit_is_dimensionless(&rad));
    ck_assert(ff_unit_is_dimensionless(&one));
}
END_TEST

START_TEST(knows_si)
{
    ff_unit pascal = unit_of("Pa"), milli = unit_of("mm"), celsius = unit_of("degC");
    ck_assert(ff_unit_is_si(&pascal));
    ck_assert(!ff_unit_is_si(&milli));
    ck_assert(!ff_unit_is_si(&celsius));
}
END_TEST

START_TEST(temperature_has_offset)
{
    ff_unit celsius = unit_of("degC"), sign = unit_of("°C"), fahrenheit = unit_of("degF");
    ck_assert_double_eq_tol(ff_unit_to_si(&celsius, 100), 373.15, 1e-12);
    ck_assert_double_eq_tol(ff_unit_to_si(&sign, 40), 313.15, 1e-12);
    ck_assert_double_eq_tol(ff_unit_to_si(&fahrenheit, 212), 373.15, 1e-12);
    ck_assert_double_eq_tol(ff_unit_from_si(&celsius, 313.15), 40, 1e-12);
    ck_assert_double_eq_tol(ff_unit_from_si(&fahrenheit, 273.15), 32, 1e-12);
}
END_TEST

/* The factors of decimal units are the nearest doubles, and a conversion adds one rounding. */
START_TEST(decimal_units_round_once)
{
    static const char *const units[] = {"mm", "um", "nm", "1/GPa", "mPa s", "cSt"};
    for (size_t i = 0; i < ROWS(units); i++) {
        ff_unit unit = unit_of(units[i]);
        ck_assert_double_eq(ff_unit_to_si(&unit, 3), 3 / round(1 / unit.factor));
        ck_assert_double_eq(ff_unit_from_si(&unit, ff_unit_to_si(&unit, 250)), 250);
    }
    ck_assert_double_eq(unit_of("1/GPa").factor, 1e-9);
    ck_assert_double_eq(unit_of("mm2").factor, 1e-6);
    ck_assert_double_eq(unit_of("N/(mm um)").factor, 1e9);
}
END_TEST

START_TEST(every_example_reads_as_its_dimension)
{
    static const char *const units[] = {"1",    "m",     "rpm",   "Hz",      "N m",      "Pa",
                                        "Pa s", "cSt",   "K",     "W/(m K)", "J/(kg K)", "1/GPa",
                                        "N/m",  "kg m2", "kg/m3", "deg",     "m/s",      "W"};
    for (size_t i = 0; i < ROWS(units); i++) {
        ff_unit unit = unit_of(units[i]);
        char list[128], *rest = NULL;
        snprintf(list, sizeof list, "%s", ff_unit_examples(&unit));
        ck_assert(list[0]);
        for (char *word = strtok_r(list, ",", &rest); word; word = strtok_r(NULL, ",", &rest)) {
            ff_unit example = unit_of(word);
            ck_assert_msg(ff_unit_same_dimension(&unit, &example), "%s: %s", units[i], word);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("unit");
    add_loop(suite, reads_unit, ROWS(goods));
    add_loop(suite, refuses_unit, ROWS(bads));
    add_test(suite, turning_is_no_frequency);
    add_test(suite, knows_si);
    add_test(suite, temperature_has_offset);
    add_test(suite, decimal_units_round_once);
    add_test(suite, every_example_reads_as_its_dimension);
    return run_suite(suite);
}
