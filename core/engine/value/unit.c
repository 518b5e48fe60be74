/* SPDX-License-Identifier: MIT */
/*
 * unit     = "" | "1" | [ "1" | product ] "/" ( factor | "(" product ")" ) | product
 * product  = factor { ( " " | "." ) factor }
 * factor   = symbol [ power ],  power = [ "^" ] [ "-" ] digit
 */
#include "unit.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit-table.h"

enum { LONGEST = 63, LARGEST_POWER_IN_ALL = 60 };

static const char digits[] = "0123456789";
static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ%";

typedef struct reader {
    char text[LONGEST + 1]; /* the unit in plain spelling, see `spellings` */
    const char *at;
    int power[FF_DIMENSIONS];
    double scale;
    int ten;
    int factors;
    const char *offset_at; /* position of degC or degF in the text */
    double offset;
    int offset_power;
    char *why;
    size_t why_size;
} reader;

__attribute__((format(printf, 2, 3))) static bool refuse(const reader *r, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(r->why, r->why_size, format, args);
    va_end(args);
    return false;
}

/* Spellings used on keyboards and in papers, each with the plain spelling of the grammar. "u"
   replaces both the micro sign and the Greek letter mu. The last three are no-break and thin
   spaces. */
static const char *const spellings[][2] = {
    {"**", "^"}, {"*", "."},      {"·", "."},      {"⋅", "."},      {"⁻", "-"}, {"⁰", "0"},
    {"¹", "1"},  {"²", "2"},      {"³", "3"},      {"⁴", "4"},      {"⁵", "5"}, {"⁶", "6"},
    {"⁷", "7"},  {"⁸", "8"},      {"⁹", "9"},      {"°", "deg"},    {"µ", "u"}, {"μ", "u"},
    {"\t", " "}, {"\u00A0", " "}, {"\u2009", " "}, {"\u202F", " "},
};

/* Appends a piece of text. A blank is kept only between two factors. */
static void append(reader *r, const char *piece)
{
    size_t used = strlen(r->text);
    bool blank_before = used > 0 && r->text[used - 1] == ' ';
    if (*piece == ' ' && (used == 0 || strchr(" ./(", r->text[used - 1])))
        return;
    strcpy(r->text + used - (blank_before && strchr("./)", *piece)), piece);
}

/* Reads one character of `text` and returns its plain spelling. A one-byte character is returned
   unchanged. */
static const char *next_piece(const char **text, char byte[2])
{
    bool plain = strchr(letters, **text) || strchr(digits, **text) || strchr(" ./()^-", **text);
    for (size_t i = 0; !plain && i < sizeof spellings / sizeof *spellings; i++) {
        size_t n = strlen(spellings[i][0]);
        if (!strncmp(*text, spellings[i][0], n)) {
            *text += n;
            return spellings[i][1];
        }
    }
    byte[0] = *(*text)++;
    return byte;
}

static bool spell_plainly(reader *r, const char *text)
{
    char byte[2] = "";
    while (*text) {
        const char *piece = next_piece(&text, byte);
        if (strlen(r->text) + strlen(piece) > LONGEST)
            return refuse(r, "is not known");
        append(r, piece);
    }
    size_t used = strlen(r->text);
    if (used > 0 && r->text[used - 1] == ' ')
        r->text[used - 1] = '\0';
    return true;
}

/* Explains an error at a position where a unit is expected. */
static bool refuse_here(const reader *r)
{
    int length = 1;
    while (((unsigned char)r->at[length] & 0xC0) == 0x80)
        length++;
    if (*r->at == '\0')
        return refuse(r, "ends where another unit is expected");
    if (strchr(digits, *r->at))
        return refuse(r, "has a number where a unit is expected; a power is written \"mm2\" or "
                         "\"mm^2\"");
    if (*r->at == '(')
        return refuse(r, "has \"(\" in the wrong place; parentheses belong after \"/\", as in "
                         "\"N/(mm um)\"");
    return refuse(r, "has \"%.*s\" where a unit is expected", length, r->at);
}

static bool refuse_word(const reader *r, const char *word)
{
    const char *near = fe_symbol_nearest(word);
    bool whole = !strcmp(word, r->text);
    return refuse(r, "%s%s%s%s%s%s", whole ? "is not known" : "has the unknown part \"",
                  whole ? "" : word, whole ? "" : "\"", near ? "; did you mean \"" : "",
                  near ? near : "", near ? "\"?" : "");
}

static bool read_power(reader *r, int *power)
{
    const char *start = r->at, *at = start + (*start == '^');
    bool minus = *at == '-';
    const char *digit = at + minus;
    size_t count = strspn(digit, digits);
    *power = 1;
    if (at == start && count == 0)
        return true;
    r->at = digit + count;
    if (*r->at == '.' && r->at[1] && strchr(digits, r->at[1]))
        return refuse(r, "has a power that is not a whole number");
    if (count != 1 || *digit == '0')
        return refuse(r, "has the power \"%.*s\"; powers are whole numbers from -9 to 9, but not 0",
                      (int)(r->at - start), start);
    *power = minus ? '0' - *digit : *digit - '0';
    return true;
}

static bool multiply(reader *r, const fe_symbol *symbol, int power)
{
    for (int i = 0; i < FF_DIMENSIONS; i++) {
        r->power[i] += power * symbol->power[i];
        if (abs(r->power[i]) > LARGEST_POWER_IN_ALL)
            return refuse(r, "has too high a power in total");
    }
    for (int i = 0; i < abs(power); i++)
        r->scale = power > 0 ? r->scale * symbol->scale : r->scale / symbol->scale;
    r->ten += power * symbol->ten;
    r->factors++;
    return true;
}

static bool read_factor(reader *r, int sign)
{
    const char *start = r->at;
    char word[LONGEST + 1];
    fe_symbol symbol;
    int power;
    size_t length = strspn(start, letters);
    if (length == 0)
        return refuse_here(r);
    memcpy(word, start, length);
    word[length] = '\0';
    if (!fe_symbol_find(word, &symbol))
        return refuse_word(r, word);
    r->at += length;
    if (!read_power(r, &power))
        return false;
    if (*r->at == '-')
        return refuse(r, "has \"-\" between units; write a space, as in \"N m\"");
    if (*r->at && strchr(letters, *r->at))
        return refuse(r, "needs a space after the power");
    if (!strchr(" ./)", *r->at))
        return refuse_here(r);
    if (symbol.offset != 0) {
        r->offset_at = start;
        r->offset = symbol.offset;
        r->offset_power = sign * power;
    }
    return multiply(r, &symbol, sign * power);
}

static bool read_product(reader *r, int sign)
{
    while (read_factor(r, sign)) {
        if (strchr("/)", *r->at))
            return true;
        r->at++;
    }
    return false;
}

/* Explains an error in the text that follows a complete "a/b", and suggests how to write its
   probable meaning. */
static bool refuse_tail(const reader *r, const char *slash)
{
    int above = (int)(slash - r->text), below = (int)(r->at - slash) - 1;
    const char *rest = r->at + 1;
    if (*r->at == ')')
        return refuse(r, "has a \")\" without \"(\"");
    if (slash[1] == '(' || !*rest || strpbrk(rest, "/()"))
        return refuse(r, "must have one \"/\" with one unit or one pair of parentheses after it, "
                         "as in \"N/(mm um)\"");
    if (*r->at == '/')
        return refuse(r, "has two \"/\"; write \"%.*s/(%.*s %s)\"", above, r->text, below,
                      slash + 1, rest);
    bool bare = above == 0 || (above == 1 && *r->text == '1');
    return refuse(r, "is ambiguous; write \"%.*s/(%.*s %s)\" or \"%.*s%s%s/%.*s\"", above, r->text,
                  below, slash + 1, rest, bare ? 0 : above, r->text, bare ? "" : " ", rest, below,
                  slash + 1);
}

static bool read_below(reader *r)
{
    const char *slash = r->at++;
    if (*r->at == '(') {
        r->at++;
        if (!read_product(r, -1))
            return false;
        if (*r->at != ')')
            return refuse(r, *r->at ? "has a second \"/\" inside the parentheses"
                                    : "has a \"(\" without \")\"");
        r->at++;
    } else if (!read_factor(r, -1))
        return false;
    return *r->at == '\0' || refuse_tail(r, slash);
}

static bool read_unit(reader *r)
{
    if (*r->text == '\0' || !strcmp(r->text, "1"))
        return true;
    r->at = r->text + !strncmp(r->text, "1/", 2);
    if (*r->at != '/' && !read_product(r, 1))
        return false;
    if (*r->at == ')')
        return refuse(r, "has a \")\" without \"(\"");
    return *r->at == '\0' || read_below(r);
}

static bool finish(const reader *r, ff_unit *unit)
{
    if (r->offset_at && (r->factors > 1 || r->offset_power != 1)) {
        int length = 4; /* "degC" has four letters */
        return refuse(
            r, "has %.*s in a product, where only differences make sense; write \"%.*sK%s\"",
            length, r->offset_at, (int)(r->offset_at - r->text), r->text, r->offset_at + length);
    }
    for (int i = 0; i < FF_DIMENSIONS; i++)
        unit->power[i] = (int8_t)r->power[i];
    /* correctly rounded if scale is a whole number and `ten` is not large */
    double tens = pow(10, abs(r->ten));
    unit->factor = r->ten < 0 ? r->scale / tens : r->scale * tens;
    unit->offset = r->offset;
    return isnormal(unit->factor) || refuse(r, "is too large or too small for a number");
}

bool ff_unit_parse(const char *text, ff_unit *unit, char *why, size_t why_size)
{
    reader r = {.scale = 1, .why = why, .why_size = why_size};
    *unit = (ff_unit){.factor = 1};
    return spell_plainly(&r, text) && read_unit(&r) && finish(&r, unit);
}

bool ff_unit_same_dimension(const ff_unit *a, const ff_unit *b)
{
    return !memcmp(a->power, b->power, sizeof a->power);
}

bool ff_unit_is_si(const ff_unit *unit)
{
    return unit->factor == 1 && unit->offset == 0;
}

bool ff_unit_is_dimensionless(const ff_unit *unit)
{
    static const ff_unit none;
    return ff_unit_same_dimension(unit, &none);
}

/* Returns n if the factor is 1/n with a whole n, else 0. A factor such as 1e-3 is itself rounded,
   so dividing by 1000 avoids one rounding error. */
static double inverse(const ff_unit *unit)
{
    double n = unit->factor < 1 ? round(1 / unit->factor) : 0;
    return n > 0 && 1 / n == unit->factor ? n : 0;
}

double ff_unit_to_si(const ff_unit *unit, double number)
{
    assert(unit->factor > 0);
    double n = inverse(unit);
    return (n > 0 ? number / n : number * unit->factor) + unit->offset;
}

double ff_unit_from_si(const ff_unit *unit, double si)
{
    double n = inverse(unit);
    return n > 0 ? (si - unit->offset) * n : (si - unit->offset) / unit->factor;
}

int fe_unit_compare(const ff_unit *unit, double si, double limit)
{
    double limit_si = ff_unit_to_si(unit, limit);
    if (isfinite(limit_si) && fabs(si - limit_si) <= 4 * DBL_EPSILON * fabs(limit_si))
        return 0;
    return si < limit_si ? -1 : 1;
}
