/* SPDX-License-Identifier: MIT */
/* Numbers and quantities as users write them. */
#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit-table.h"

enum { LONGEST_QUOTE = 60 };

/* The text being read, and a buffer for the sentence that explains a failure. */
typedef struct reading {
    const char *text;
    char *why;
    size_t why_size;
} reading;

/* Returns how many bytes of the text a message quotes; does not split a character. */
static int quoted(const char *text)
{
    size_t n = strnlen(text, LONGEST_QUOTE);
    while (text[n] != '\0' && n > 0 && ((unsigned char)text[n] & 0xC0) == 0x80)
        n--;
    return (int)n;
}

/* Writes a sentence that begins with the quoted text. */
__attribute__((format(printf, 2, 3))) static bool refuse(const reading *r, const char *format, ...)
{
    char sentence[400];
    int n = quoted(r->text);
    va_list args;
    va_start(args, format);
    vsnprintf(sentence, sizeof sentence, format, args);
    va_end(args);
    snprintf(r->why, r->why_size, "\"%.*s%s\" %s", n, r->text, r->text[n] ? "..." : "", sentence);
    return false;
}

static const char *pass_blanks(const char *at)
{
    return at + strspn(at, " \t");
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Reads a number as strtod does, but decimal only and with "." in every locale. May give an
 * infinity. */
static bool read_number(const char *text, double *value, const char **end)
{
    const char *start = text + (*text == '+' || *text == '-');
    bool hexadecimal = start[0] == '0' && (start[1] == 'x' || start[1] == 'X');
    if (hexadecimal || !is_digit(start[*start == '.']))
        return false;
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    char *stop;
    *value = plain ? strtod_l(text, &stop, plain) : NAN;
    *end = plain ? stop : start;
    if (plain)
        freelocale(plain);
    return true;
}

bool ff_number_parse(const char *text, double *value, const char **end)
{
    double number;
    if (!read_number(text, &number, end) || !isfinite(number))
        return false;
    *value = number;
    return true;
}

/* Writes what a row expects: "a length (m, mm, um, nm)", or the row's own unit if the dimension
 * has no name. */
static void expect(const ff_unit *row, const char *row_text, char out[120])
{
    const char *name = fe_dimension_name(row);
    if (!name)
        snprintf(out, 120, "a quantity in %.40s", row_text);
    else if (ff_unit_is_dimensionless(row))
        snprintf(out, 120, "%s", name);
    else
        snprintf(out, 120, "%s (%s)", name, ff_unit_examples(row));
}

/* Returns advice for a mark in a number that is not allowed, such as a comma; NULL: `rest` begins
   with no such mark. */
static const char *wrong_mark(const char *rest)
{
    if (*rest == '\0' || !is_digit(rest[1]))
        return NULL;
    if (*rest == ',')
        return "write the decimal point as \".\" and no separators between thousands";
    if (*rest == '_' || *rest == '\'')
        return "write the digits without separators";
    return *rest == '.' ? "it has two decimal points" : NULL;
}

static bool refuse_dimension(const reading *r, double si, const ff_unit *unit, const ff_unit *row,
                             const char *wanted)
{
    static const ff_unit turning = {.power = {0, 0, -1, 0, 1}}, frequency = {.power = {0, 0, -1}};
    static const double turn = 2 * 3.14159265358979323846;
    const char *name = fe_dimension_name(unit);
    char tail[48] = "";
    if (ff_unit_same_dimension(unit, &turning) && ff_unit_same_dimension(row, &frequency))
        snprintf(tail, sizeof tail, "; it is %.6g rev/s", si / turn);
    if (name)
        return refuse(r, "is %s; expected %s%s", name, wanted, tail);
    return refuse(r, "is not %s", wanted);
}

static bool read_unit(const char *text, ff_unit *unit, const char *wanted, const reading *r)
{
    char clause[200] = "is a number";
    if (strcmp(text, "1") != 0 && ff_unit_parse(text, unit, clause, sizeof clause))
        return true;
    bool advised = strchr(clause, ';') != NULL;
    snprintf(r->why, r->why_size, "the unit \"%.*s\" %s%s%s", quoted(text), text, clause,
             advised ? "" : "; expected ", advised ? "" : wanted);
    return false;
}

/* Whether the text is "min^-1" for a rotational speed, where drawings mean revolutions per minute.
   For a frequency it stays 1/min. */
static bool is_per_minute(const char *text, const ff_unit *row)
{
    static const ff_unit turning = {.power = {0, 0, -1, 0, 1}};
    static const char *const names[] = {"min^-1", "min-1", "1/min", "/min"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(text, names[i]))
            return ff_unit_same_dimension(row, &turning);
    return false;
}

bool ff_quantity_parse(const char *text, const ff_unit *row, const char *row_text, double *si,
                       char *why, size_t why_size)
{
    char wanted[120];
    const char *rest;
    double number;
    ff_unit unit = {.factor = 1};
    reading r = {.text = pass_blanks(text), .why = why, .why_size = why_size};
    expect(row, row_text, wanted);
    if (*r.text == '\0') {
        snprintf(why, why_size, "the value is empty; expected %s", wanted);
        return false;
    }
    if (!read_number(r.text, &number, &rest))
        return refuse(&r, "does not begin with a decimal number; expected %s", wanted);
    const char *advice = wrong_mark(rest), *part = pass_blanks(rest);
    if (advice)
        return refuse(&r, "is not a number: %s", advice);
    if (*part == '\0' && !ff_unit_is_dimensionless(row))
        return refuse(&r, "has no unit; write for example \"%.*s %s\"", (int)(rest - r.text),
                      r.text, row_text);
    if (*part != '\0' && !read_unit(is_per_minute(part, row) ? "rpm" : part, &unit, wanted, &r))
        return false;
    double value = ff_unit_to_si(&unit, number);
    if (!isfinite(value))
        return refuse(&r, "is too large a number");
    if (!ff_unit_same_dimension(&unit, row))
        return refuse_dimension(&r, value, &unit, row, wanted);
    *si = value;
    return true;
}

/* Reads an integer. Plain digits are exact; "1e6" is read as a double, exact up to 2^53. */
static bool to_integer(const char *text, const char *end, double number, int64_t *value)
{
    char *stop;
    errno = 0;
    *value = strtoll(text, &stop, 10);
    if (stop == end)
        return errno == 0;
    if (fabs(number) > 0x1p53)
        return false;
    *value = (int64_t)number;
    return true;
}

bool ff_integer_parse(const char *text, int64_t *value, char *why, size_t why_size)
{
    reading r = {.text = pass_blanks(text), .why = why, .why_size = why_size};
    const char *end;
    double number;
    int64_t whole;
    if (!read_number(r.text, &number, &end))
        return refuse(&r, "is not a number; expected a whole number");
    if (*pass_blanks(end) != '\0' || number != floor(number))
        return refuse(&r, "is not a whole number");
    if (!to_integer(r.text, end, number, &whole))
        return refuse(&r, "is too large a number");
    *value = whole;
    return true;
}

void ff_quantity_print(double si, const ff_unit *row, const char *row_text, char *out, size_t size)
{
    bool bare = *row_text == '\0' || !strcmp(row_text, "1");
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    locale_t before = plain ? uselocale(plain) : (locale_t)0;
    snprintf(out, size, "%.6g%s%s", ff_unit_from_si(row, si), bare ? "" : " ",
             bare ? "" : row_text);
    if (plain) {
        uselocale(before);
        freelocale(plain);
    }
}
