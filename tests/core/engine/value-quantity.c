/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers and quantities as users write them. */
#include <flankfilm/engine.h>

#include <locale.h>
#include <math.h>
#include <string.h>

#include "value-check.h"

static const double PI = 3.14159265358979323846;

static const struct {
    const char *text, *row;
    double si;
} goods[] = {
    {"250 N m", "N m", 250},
    {"250 Nm", "N m", 250},
    {"3mm", "mm", 3e-3},
    {"3 mm", "m", 3e-3},
    {"20 deg", "deg", 20 * PI / 180},
    {"1500 rpm", "rpm", 50 * PI},
    {"1500 rev/min", "rpm", 50 * PI},
    {"1500 min^-1", "rpm", 50 * PI},
    {"1500 1/min", "rpm", 50 * PI},
    {"1500 min^-1", "Hz", 25},
    {"0.5 um", "um", 0.5e-6},
    {"0.5 \xC2\xB5m", "um", 0.5e-6},
    {"0.5 \xCE\xBCm", "um", 0.5e-6},
    {"11 1/GPa", "1/GPa", 11e-9},
    {"11/GPa", "1/GPa", 11e-9},
    {"80 mPa s", "Pa s", 0.08},
    {"5 cP", "Pa s", 5e-3},
    {"100 degC", "degC", 373.15},
    {"373.15 K", "degC", 373.15},
    {"1250 Hz", "Hz", 1250},
    {"0.3", "1", 0.3},
    {"5 %", "1", 0.05},
    {"5%", "1", 0.05},
    {"  3 mm  ", "mm", 3e-3},
    {"+3 mm", "mm", 3e-3},
    {"-3 mm", "mm", -3e-3},
    {"-20 degC", "degC", 253.15},
    {".5 mm", "mm", 0.5e-3},
    {"5. mm", "mm", 5e-3},
    {"1e3", "1", 1000},
    {"1e-9", "1", 1e-9},
    {"1E+3 N", "N", 1000},
    {"010", "1", 10},
    {"2e3mm", "mm", 2},
};

static ff_unit unit_of(const char *text)
{
    ff_unit unit;
    char why[256];
    ck_assert_msg(ff_unit_parse(text, &unit, why, sizeof why), "%s", text);
    return unit;
}

START_TEST(reads_quantity)
{
    ff_unit row = unit_of(goods[_i].row);
    char why[256] = "";
    double si = NAN;
    ck_assert_msg(ff_quantity_parse(goods[_i].text, &row, goods[_i].row, &si, why, sizeof why),
                  "%s: %s", goods[_i].text, why);
    ck_assert_msg(fabs(si - goods[_i].si) <= 4e-16 * fabs(goods[_i].si), "%s: %.17g",
                  goods[_i].text, si);
}
END_TEST

static const struct {
    const char *text, *row, *sentence; /* a part of what must be said */
} bads[] = {
    {"250", "N m", "\"250\" has no unit; write for example \"250 N m\""},
    {"250 ", "N m", "has no unit"},
    {"3 furlong", "mm", "the unit \"furlong\" is not known; expected a length (m, mm, um, nm)"},
    {"3 s", "mm", "\"3 s\" is a time; expected a length"},
    {"1500 rpm", "Hz",
     "is a rotational speed; expected a frequency (Hz, kHz, 1/s); it is 25 rev/s"},
    {"25 Hz", "rpm", "is a frequency; expected a rotational speed"},
    {"3 mm", "1", "\"3 mm\" is a length; expected a plain number"},
    {"3 rad", "1", "is an angle; expected a plain number"},
    {"40 C", "degC", "did you mean \"degC\"?"},
    {"3 N/mm um", "N/m", "is ambiguous; write \"N/(mm um)\""},
    {"2 W/(m degC)", "W/(m K)", "write \"W/(m K)\""},
    {"", "mm", "is empty; expected a length"},
    {"   ", "mm", "is empty"},
    {"mm", "mm", "does not begin with a decimal number"},
    {"nan", "1", "does not begin with a decimal number"},
    {"NaN mm", "mm", "does not begin with a decimal number"},
    {"inf", "1", "does not begin with a decimal number"},
    {"-infinity", "1", "does not begin with a decimal number"},
    {"0x10", "1", "does not begin with a decimal number"},
    {"0X1p3 mm", "mm", "does not begin with a decimal number"},
    {"--3", "1", "does not begin with a decimal number"},
    {".", "1", "does not begin with a decimal number"},
    {"e5", "1", "does not begin with a decimal number"},
    {"1e400", "1", "is too large a number"},
    {"1e308 km", "m", "is too large a number"},
    {"1,5 mm", "mm", "write the decimal point as \".\""},
    {"1_500 rpm", "rpm", "without separators"},
    {"1'500 rpm", "rpm", "without separators"},
    {"1.5.2", "1", "two decimal points"},
    {"1 500 rpm", "rpm", "has a number where a unit is expected"},
    {"1 mm 2", "m", "has a number where a unit is expected"},
    {"3 1", "1", "is a number"},
    {"3 mm^0.5", "mm", "not a whole number"},
    {"3 kg m5", "mm", "is not a length"},
    {"3 s", "kg m5", "expected a quantity in kg m5"},
};

START_TEST(refuses_quantity)
{
    ff_unit row = unit_of(bads[_i].row);
    char why[256] = "";
    double si = 17;
    ck_assert_msg(!ff_quantity_parse(bads[_i].text, &row, bads[_i].row, &si, why, sizeof why), "%s",
                  bads[_i].text);
    ck_assert_msg(strstr(why, bads[_i].sentence), "%s: %s", bads[_i].text, why);
    ck_assert_double_eq(si, 17);
}
END_TEST

START_TEST(quotes_little_of_a_long_text)
{
    char text[5000], why[256];
    double si;
    ff_unit row = unit_of("mm");
    for (size_t i = 0; i < sizeof text - 3; i += 2)
        memcpy(text + i, "\xC3\xA4", 3);
    ck_assert(!ff_quantity_parse(text, &row, "mm", &si, why, sizeof why));
    ck_assert_uint_lt(strlen(why), 200);
    ck_assert_ptr_nonnull(strstr(why, "\xC3\xA4...\""));
}
END_TEST

START_TEST(small_buffers_are_kept)
{
    ff_unit row = unit_of("Hz");
    double si;
    for (size_t size = 0; size < 90; size++) {
        char why[100];
        memset(why, '#', sizeof why);
        ck_assert(!ff_quantity_parse("1500 rpm", &row, "Hz", &si, why, size));
        ck_assert_int_eq(why[size], '#');
        ck_assert(!ff_unit_parse("N/mm um", &row, why, size));
        ck_assert_int_eq(why[size], '#');
        row = unit_of("Hz");
    }
}
END_TEST

START_TEST(reads_number_up_to_its_end)
{
    static const struct {
        const char *text;
        double value;
        const char *rest;
    } rows[] = {
        {"3mm", 3, "mm"},    {"1e3", 1000, ""}, {"1e", 1, "e"},       {"1e+", 1, "e+"},
        {"-.5e1x", -5, "x"}, {"7.", 7, ""},     {"1.5.2", 1.5, ".2"}, {"3e 4", 3, "e 4"},
        {"1e-400", 0, ""},   {"00012", 12, ""}, {"4,5", 4, ",5"},     {"2 3", 2, " 3"},
    };
    for (size_t i = 0; i < ROWS(rows); i++) {
        double value;
        const char *end;
        ck_assert_msg(ff_number_parse(rows[i].text, &value, &end), "%s", rows[i].text);
        ck_assert_double_eq(value, rows[i].value);
        ck_assert_str_eq(end, rows[i].rest);
    }
}
END_TEST

START_TEST(reads_whole_numbers)
{
    static const struct {
        const char *text;
        int64_t value;
    } rows[] = {{"512", 512},
                {"-3", -3},
                {"+7", 7},
                {" 12 ", 12},
                {"1e3", 1000},
                {"010", 10},
                {"512.0", 512},
                {"9223372036854775807", INT64_MAX},
                {"-9223372036854775808", INT64_MIN}};
    for (size_t i = 0; i < ROWS(rows); i++) {
        char why[256] = "";
        int64_t value = 99;
        ck_assert_msg(ff_integer_parse(rows[i].text, &value, why, sizeof why), "%s", why);
        ck_assert_int_eq(value, rows[i].value);
    }
}
END_TEST

START_TEST(refuses_what_is_not_whole)
{
    static const char *const rows[][2] = {
        {"512.5", "is not a whole number"},
        {"12 mm", "is not a whole number"},
        {"many", "is not a number"},
        {"", "is not a number"},
        {"0x10", "is not a number"},
        {"9223372036854775808", "too large"},
        {"1e20", "too large"},
        {"1e999", "too large"},
        {"1_000", "is not a whole number"},
        {"nan", "is not a number"},
    };
    for (size_t i = 0; i < ROWS(rows); i++) {
        char why[256] = "";
        int64_t value;
        ck_assert_msg(!ff_integer_parse(rows[i][0], &value, why, sizeof why), "%s", rows[i][0]);
        ck_assert_msg(strstr(why, rows[i][1]), "%s: %s", rows[i][0], why);
    }
}
END_TEST

START_TEST(prints_in_the_units_of_the_row)
{
    static const struct {
        double si;
        const char *row, *text;
    } rows[] = {{250, "N m", "250 N m"},      {0.003, "mm", "3 mm"},     {0.3, "1", "0.3"},
                {373.15, "degC", "100 degC"}, {1.0 / 3, "", "0.333333"}, {0.05, "%", "5 %"}};
    for (size_t i = 0; i < ROWS(rows); i++) {
        ff_unit row = unit_of(rows[i].row);
        char text[64];
        ff_quantity_print(rows[i].si, &row, rows[i].row, text, sizeof text);
        ck_assert_str_eq(text, rows[i].text);
    }
}
END_TEST

/* A locale with a decimal comma, where the machine has one; otherwise the plain one. */
START_TEST(locale_changes_nothing)
{
    static const char *const locales[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"};
    for (size_t i = 0; i < ROWS(locales); i++)
        if (setlocale(LC_ALL, locales[i]))
            break;
    ff_unit row = unit_of("mm");
    char why[256], text[64];
    double si;
    ck_assert(ff_quantity_parse("1.5 mm", &row, "mm", &si, why, sizeof why));
    ck_assert_double_eq(si, 1.5e-3);
    ff_quantity_print(si, &row, "mm", text, sizeof text);
    ck_assert_str_eq(text, "1.5 mm");
}
END_TEST

/* Whatever the text, the answer is a finite number or a sentence. */
START_TEST(random_texts)
{
    static const char *const pieces[] = {
        "1",  "3.5",  "e",  "-",   "+", ".", " ", "/",    "(", ")", "^", "*", "m", "N", "mm", "s",
        "Pa", "degC", "um", "GPa", "°", "·", "²", "\xFF", "2", "9", "%", "_", ",", "k", "rad"};
    ff_unit row = unit_of("1");
    uint64_t state = 1893;
    for (int round = 0; round < 20000; round++) {
        char text[128] = "1", why[200] = "";
        double si = NAN;
        for (int i = 0; i < 12; i++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            strcat(text, pieces[(state >> 33) % ROWS(pieces)]);
        }
        bool read = ff_quantity_parse(text, &row, "1", &si, why, sizeof why);
        ck_assert_msg(read ? isfinite(si) : why[0] != '\0', "%s", text);
        ff_unit unit;
        if (ff_unit_parse(text + 1, &unit, why, sizeof why))
            ck_assert(isnormal(unit.factor));
    }
}
END_TEST

static const struct {
    const char *text;
    int kind;
    double middle, low, high;
    const char *unit;
} tolerances[] = {
    {"120 mm +- 20 um", 1, 120, 119.98, 120.02, "mm"},
    {"120mm+/-0.02mm", 1, 120, 119.98, 120.02, "mm"},
    {"80 degC \xC2\xB1 10 K", 1, 80, 70, 90, "degC"},
    {"80 degC +- 10 degC", 1, 80, 70, 90, "degC"},
    {"220 N m +- 5 %", 1, 220, 209, 231, "N m"},
    {"0.3 +- 0.01", 1, 0.3, 0.29, 0.31, ""},
    {"90 % +- 1 %", 1, 90, 89, 91, "%"},
    {"-75 um to -45 um", 1, -60, -75, -45, "um"},
    {"-45 um to -0.075 mm", 1, -60, -75, -45, "um"},
    {"120 mm", 0, 0, 0, 0, ""},
    {"to", 0, 0, 0, 0, ""},
    {"120 mm +- 20", -1, 0, 0, 0, ""},
    {"120 mm +- -20 um", -1, 0, 0, 0, ""},
    {"120 mm +- 20 N", -1, 0, 0, 0, ""},
    {"120 mm +-", -1, 0, 0, 0, ""},
    {"80 degC +- 5 %", -1, 0, 0, 0, ""},
    {"1 mm to 5 %", -1, 0, 0, 0, ""},
    {"up to 3 mm", -1, 0, 0, 0, ""},
};

START_TEST(reads_tolerance)
{
    ff_tolerance t;
    char why[200] = "";
    ck_assert_int_eq(ff_tolerance_parse(tolerances[_i].text, &t, why, sizeof why),
                     tolerances[_i].kind);
    ck_assert_int_eq(why[0] != '\0', tolerances[_i].kind < 0);
    if (tolerances[_i].kind <= 0)
        return;
    ck_assert_str_eq(t.unit, tolerances[_i].unit);
    ck_assert_double_eq_tol(t.middle, tolerances[_i].middle, 1e-12);
    ck_assert_double_eq_tol(t.low, tolerances[_i].low, 1e-12);
    ck_assert_double_eq_tol(t.high, tolerances[_i].high, 1e-12);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("quantity");
    add_loop(suite, reads_tolerance, ROWS(tolerances));
    add_loop(suite, reads_quantity, ROWS(goods));
    add_loop(suite, refuses_quantity, ROWS(bads));
    add_test(suite, quotes_little_of_a_long_text);
    add_test(suite, small_buffers_are_kept);
    add_test(suite, reads_number_up_to_its_end);
    add_test(suite, reads_whole_numbers);
    add_test(suite, refuses_what_is_not_whole);
    add_test(suite, prints_in_the_units_of_the_row);
    add_test(suite, locale_changes_nothing);
    add_test(suite, random_texts);
    return run_suite(suite);
}
