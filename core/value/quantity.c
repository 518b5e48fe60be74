/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers and quantities as users write them. */
#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit-table.h"

enum { LONGEST_QUOTE = 60 };

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static const char *pass_digits(const char *at)
{
    while (is_digit(*at))
        at++;
    return at;
}

/* The end of the decimal number at `text`; `text` itself when there is none. */
static const char *number_end(const char *text)
{
    const char *start = text + (*text == '+' || *text == '-');
    const char *at = pass_digits(start);
    size_t digits = (size_t)(at - start);
    if (*at == '.') {
        const char *fraction = pass_digits(at + 1);
        digits += (size_t)(fraction - at) - 1;
        at = fraction;
    }
    if (digits == 0)
        return text;
    if (*at == 'e' || *at == 'E') {
        const char *power = at + 1 + (at[1] == '+' || at[1] == '-');
        if (is_digit(*power))
            at = pass_digits(power);
    }
    return at;
}

/* strtod reads the decimal point of the locale; ours is always '.'. May give an infinity. */
static double read_decimal(const char *text)
{
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    double value = plain ? strtod_l(text, NULL, plain) : NAN;
    if (plain)
        freelocale(plain);
    return value;
}

bool ff_number_parse(const char *text, double *value, const char **end)
{
    const char *stop = number_end(text);
    bool hexadecimal = stop > text && stop[-1] == '0' && (*stop == 'x' || *stop == 'X');
    if (stop == text || hexadecimal)
        return false;
    double number = read_decimal(text);
    if (!isfinite(number))
        return false;
    *value = number;
    *end = stop;
    return true;
}

/* The text in short for a message, cut between characters. */
static const char *quoted(const char *text, char out[LONGEST_QUOTE + 4])
{
    size_t n = strnlen(text, LONGEST_QUOTE);
    const char *dots = "";
    if (text[n] != '\0') {
        while (n > 0 && ((unsigned char)text[n] & 0xC0) == 0x80)
            n--;
        dots = "...";
    }
    snprintf(out, LONGEST_QUOTE + 4, "%.*s%s", (int)n, text, dots);
    return out;
}

/* "a length (m, mm, um, nm)", or the row's own unit where the dimension has no name. */
static const char *expected(const ff_unit *row, const char *row_text, char out[120])
{
    const char *name = ff_dimension_name(row);
    if (name && ff_unit_is_dimensionless(row))
        snprintf(out, 120, "%s", name);
    else if (name)
        snprintf(out, 120, "%s (%s)", name, ff_unit_examples(row));
    else
        snprintf(out, 120, "a quantity in %.40s", row_text);
    return out;
}

static const char *pass_blanks(const char *at)
{
    while (*at == ' ' || *at == '\t')
        at++;
    return at;
}

static bool refuse_number(const char *text, const char *wanted, char *why, size_t why_size)
{
    char shown[LONGEST_QUOTE + 4];
    const char *end = number_end(text);
    if (*text == '\0')
        snprintf(why, why_size, "the value is empty; expected %s", wanted);
    else if (end > text && !isfinite(read_decimal(text)))
        snprintf(why, why_size, "\"%s\" is too large a number", quoted(text, shown));
    else
        snprintf(why, why_size, "\"%s\" does not begin with a decimal number; expected %s",
                 quoted(text, shown), wanted);
    return false;
}

/* Looks for marks that people use inside numbers. `rest` stands right after the number. */
static bool refuse_mark(const char *text, const char *rest, char *why, size_t why_size)
{
    char shown[LONGEST_QUOTE + 4];
    const char *advice = NULL;
    if (*rest == ',' && is_digit(rest[1]))
        advice = "write the decimal point as \".\" and leave out marks between thousands";
    else if ((*rest == '_' || *rest == '\'') && is_digit(rest[1]))
        advice = "write the digits without marks between them";
    else if (*rest == '.' && is_digit(rest[1]))
        advice = "it has two decimal points";
    if (advice)
        snprintf(why, why_size, "\"%s\" is not a number: %s", quoted(text, shown), advice);
    return advice != NULL;
}

static void refuse_dimension(const char *text, double si, const ff_unit *unit, const ff_unit *row,
                             const char *wanted, char *why, size_t why_size)
{
    static const ff_unit turning = {.power = {0, 0, -1, 0, 1}}, frequency = {.power = {0, 0, -1}};
    static const double turn = 2 * 3.14159265358979323846;
    const char *name = ff_dimension_name(unit);
    char shown[LONGEST_QUOTE + 4], tail[48] = "";
    if (ff_unit_same_dimension(unit, &turning) && ff_unit_same_dimension(row, &frequency))
        snprintf(tail, sizeof tail, "; it is %.6g rev/s", si / turn);
    if (name)
        snprintf(why, why_size, "\"%s\" is %s; expected %s%s", quoted(text, shown), name, wanted,
                 tail);
    else
        snprintf(why, why_size, "\"%s\" is not %s", quoted(text, shown), wanted);
}

static bool bare_number(const char *text, const ff_unit *row, const char *row_text, char *why,
                        size_t why_size)
{
    char shown[LONGEST_QUOTE + 4];
    if (ff_unit_is_dimensionless(row))
        return true;
    snprintf(why, why_size, "\"%s\" has no unit; write for example \"%s %s\"", quoted(text, shown),
             shown, row_text);
    return false;
}

static bool read_unit_part(const char *part, ff_unit *unit, const char *wanted, char *why,
                           size_t why_size)
{
    char shown[LONGEST_QUOTE + 4], clause[160];
    if (!strcmp(part, "1"))
        snprintf(clause, sizeof clause, "is a second number");
    else if (ff_unit_parse(part, unit, clause, sizeof clause))
        return true;
    bool listed = strchr(clause, ';') != NULL;
    snprintf(why, why_size, "the unit \"%s\" %s%s%s", quoted(part, shown), clause,
             listed ? "" : "; expected ", listed ? "" : wanted);
    return false;
}

bool ff_quantity_parse(const char *text, const ff_unit *row, const char *row_text, double *si,
                       char *why, size_t why_size)
{
    char kept[LONGEST_QUOTE + 4], wanted[120];
    const char *rest;
    double number;
    ff_unit unit = {.factor = 1};

    text = pass_blanks(text);
    expected(row, row_text, wanted);
    if (!ff_number_parse(text, &number, &rest))
        return refuse_number(text, wanted, why, why_size);
    if (refuse_mark(text, rest, why, why_size))
        return false;
    const char *part = pass_blanks(rest);
    if (*part == '\0') {
        if (!bare_number(text, row, row_text, why, why_size))
            return false;
    } else if (!read_unit_part(part, &unit, wanted, why, why_size))
        return false;
    double value = ff_unit_to_si(&unit, number);
    if (!ff_unit_same_dimension(&unit, row)) {
        refuse_dimension(text, value, &unit, row, wanted, why, why_size);
        return false;
    }
    if (!isfinite(value)) {
        snprintf(why, why_size, "\"%s\" is too large a number", quoted(text, kept));
        return false;
    }
    *si = value;
    return true;
}

/* Plain digits are exact; "1e6" goes by way of a double, exact up to 2^53. */
static bool read_integer(const char *text, const char *end, double number, int64_t *value)
{
    const double exact = 9007199254740992.;
    if (pass_digits(text + (*text == '+' || *text == '-')) == end) {
        errno = 0;
        *value = strtoll(text, NULL, 10);
        return errno == 0;
    }
    *value = fabs(number) <= exact ? (int64_t)number : 0;
    return fabs(number) <= exact;
}

bool ff_integer_parse(const char *text, int64_t *value, char *why, size_t why_size)
{
    char shown[LONGEST_QUOTE + 4];
    const char *end;
    double number;
    int64_t whole;
    text = pass_blanks(text);
    bool read = ff_number_parse(text, &number, &end);
    if (!read && !isfinite(read_decimal(text)) && number_end(text) > text)
        snprintf(why, why_size, "\"%s\" is too large a number", quoted(text, shown));
    else if (!read)
        snprintf(why, why_size, "\"%s\" is not a number; expected a whole number",
                 quoted(text, shown));
    else if (*pass_blanks(end) != '\0' || number != floor(number))
        snprintf(why, why_size, "\"%s\" is not a whole number", quoted(text, shown));
    else if (!read_integer(text, end, number, &whole))
        snprintf(why, why_size, "\"%s\" is too large a number", quoted(text, shown));
    else {
        *value = whole;
        return true;
    }
    return false;
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
