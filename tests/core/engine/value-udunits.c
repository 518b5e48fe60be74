/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Our factors against those of UDUNITS-2. It takes the radian for a number, knows neither cP nor
 * reyn nor rev, and writes degree in full: where it differs, the row says how it spells the unit.
 */
#include <flankfilm/engine.h>

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <udunits2.h>

#include "value-check.h"

static const char *const rows[][2] = {
    {"m", NULL},           {"km", NULL},
    {"cm", NULL},          {"mm", NULL},
    {"um", NULL},          {"nm", NULL},
    {"pm", NULL},          {"\xC2\xB5m", NULL},
    {"\xCE\xBCm", NULL},   {"micron", NULL},
    {"in", NULL},          {"inch", NULL},
    {"ft", NULL},          {"mil", "0.001 inch"},
    {"mm2", NULL},         {"mm^2", NULL},
    {"mm²", NULL},         {"cm3", NULL},
    {"dm3", NULL},         {"kg", NULL},
    {"g", NULL},           {"mg", NULL},
    {"lb", NULL},          {"s", NULL},
    {"ms", NULL},          {"us", NULL},
    {"min", NULL},         {"h", NULL},
    {"K", NULL},           {"mK", NULL},
    {"rad", NULL},         {"mrad", NULL},
    {"urad", NULL},        {"deg", "degree"},
    {"°", NULL},           {"rev", "turn"},
    {"rpm", NULL},         {"rev/min", "turn/min"},
    {"rev/s", "turn/s"},   {"rad/s", NULL},
    {"deg/s", "degree/s"}, {"Hz", NULL},
    {"kHz", NULL},         {"1/s", NULL},
    {"s-1", NULL},         {"s^-1", NULL},
    {"m/s", NULL},         {"mm/s", NULL},
    {"m/s2", NULL},        {"m s-2", NULL},
    {"N", NULL},           {"mN", NULL},
    {"kN", NULL},          {"MN", NULL},
    {"lbf", NULL},         {"N m", NULL},
    {"N.m", NULL},         {"N*m", NULL},
    {"N·m", NULL},         {"Nm", "N m"},
    {"kNm", "kN m"},       {"Nmm", "N mm"},
    {"mNm", "mN m"},       {"lbf in", NULL},
    {"J", NULL},           {"kJ", NULL},
    {"W", NULL},           {"kW", NULL},
    {"N/m", NULL},         {"N/mm", NULL},
    {"kN/mm", NULL},       {"N/um", NULL},
    {"N/(mm um)", NULL},   {"N um/mm", NULL},
    {"N s/m", NULL},       {"Pa", NULL},
    {"hPa", NULL},         {"kPa", NULL},
    {"MPa", NULL},         {"GPa", NULL},
    {"bar", NULL},         {"mbar", NULL},
    {"N/mm2", NULL},       {"psi", NULL},
    {"ksi", "1000 psi"},   {"1/Pa", NULL},
    {"1/MPa", NULL},       {"1/GPa", NULL},
    {"GPa-1", NULL},       {"GPa^-1", NULL},
    {"Pa s", NULL},        {"mPa s", NULL},
    {"Pa.s", NULL},        {"mPas", "mPa s"},
    {"P", "poise"},        {"cP", "centipoise"},
    {"reyn", "psi s"},     {"St", "stokes"},
    {"cSt", NULL},         {"mm2/s", NULL},
    {"m2/s", NULL},        {"kg/m3", NULL},
    {"g/cm3", NULL},       {"kg m2", NULL},
    {"kg mm2", NULL},      {"W/m", NULL},
    {"W/(m K)", NULL},     {"J/(kg K)", NULL},
    {"1/K", NULL},         {"1/m", NULL},
    {"%", NULL},           {"N m/rad", NULL},
    {"N m s/rad", NULL},   {"degC", NULL},
    {"degF", NULL},        {"°C", NULL},
    {"°F", NULL},
};

static ut_system *read_database(void)
{
    ut_set_error_message_handler(ut_ignore);
    return ut_read_xml(NULL);
}

/* The coherent unit of the same dimension, in words of UDUNITS. */
static ut_unit *coherent(ut_system *system, const ff_unit *unit)
{
    static const char *const names[] = {"m", "kg", "s", "kelvin", "radian"};
    char text[128] = "1";
    for (int i = 0; i < FF_DIMENSIONS; i++) {
        size_t used = strlen(text);
        if (unit->power[i] != 0)
            snprintf(text + used, sizeof text - used, " %s^%d", names[i], unit->power[i]);
    }
    return ut_parse(system, text, UT_UTF8);
}

/* Both sides multiply fewer than 16 rounded factors. */
static void check_close(const char *text, double ours, double theirs)
{
    ck_assert_msg(fabs(ours - theirs) <= 16 * 2.3e-16 * fabs(theirs), "%s: %.17g, UDUNITS %.17g",
                  text, ours, theirs);
}

START_TEST(agrees_with_udunits)
{
    ut_system *system = read_database();
    ck_assert_msg(system != NULL, "the database of UDUNITS cannot be read");
    for (size_t i = 0; i < ROWS(rows); i++) {
        const char *text = rows[i][0], *theirs = rows[i][1] ? rows[i][1] : text;
        ff_unit unit;
        char why[256] = "";
        ck_assert_msg(ff_unit_parse(text, &unit, why, sizeof why), "\"%s\" %s", text, why);
        ut_unit *from = ut_parse(system, theirs, UT_UTF8), *to = coherent(system, &unit);
        ck_assert_msg(from && to, "UDUNITS does not know \"%s\"", theirs);
        cv_converter *converter = ut_get_converter(from, to);
        ck_assert_msg(converter != NULL, "%s has another dimension for UDUNITS", text);
        check_close(text, ff_unit_to_si(&unit, 1), cv_convert_double(converter, 1));
        check_close(text, ff_unit_to_si(&unit, 1234.5), cv_convert_double(converter, 1234.5));
        cv_free(converter);
        ut_free(from);
        ut_free(to);
    }
    ut_free_system(system);
}
END_TEST

/* Its silent traps: a turning speed passes for a frequency, and "a/b c" for "a c/b". */
START_TEST(refuses_where_udunits_errs)
{
    static const char *const traps[] = {"N/mm um", "W/m K", "W/m-K", "mm^0.5", "mm 2"};
    ff_unit unit, hertz;
    char why[256];
    for (size_t i = 0; i < ROWS(traps); i++)
        ck_assert_msg(!ff_unit_parse(traps[i], &unit, why, sizeof why), "%s", traps[i]);
    ck_assert(ff_unit_parse("rpm", &unit, why, sizeof why));
    ck_assert(ff_unit_parse("Hz", &hertz, why, sizeof why));
    ck_assert(!ff_unit_same_dimension(&unit, &hertz));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("udunits");
    add_test(suite, agrees_with_udunits);
    add_test(suite, refuses_where_udunits_errs);
    return run_suite(suite);
}
