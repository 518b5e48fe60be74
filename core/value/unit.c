/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * unit     = "" | "1" | [ "1" | product ] "/" ( factor | "(" product ")" ) | product
 * product  = factor { ( space | "." | "*" | "·" ) factor }
 * factor   = symbol [ power ],  power = [ "^" | "**" ] [ "-" ] digit | superscript
 */
#include "unit.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit-table.h"

enum { LONGEST_WORD = 31, LARGEST_POWER = 9, LARGEST_SUM = 60 };

typedef struct reader {
    const char *text, *at;
    int power[FF_DIMENSIONS];
    double scale;
    int ten;
    int factors;
    const char *offset_word; /* degC, degF where it stands in the text */
    size_t offset_length;
    double offset;
    int offset_power;
    char *why;
    size_t why_size;
} reader;

static bool refuse(const reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

static bool refuse(const reader *r, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (r->why_size > 0)
        vsnprintf(r->why, r->why_size, format, args);
    va_end(args);
    return false;
}

static size_t begins(const char *at, const char *word)
{
    size_t n = strlen(word);
    return strncmp(at, word, n) ? 0 : n;
}

/* Bytes of the one of `words` that stands at `at`, or 0. */
static size_t one_of(const char *at, const char *const *words)
{
    for (; *words; words++) {
        size_t n = begins(at, *words);
        if (n > 0)
            return n;
    }
    return 0;
}

static size_t space_at(const char *at)
{
    /* no-break, thin and narrow no-break spaces come with text copied from papers */
    static const char *const spaces[] = {" ", "\t", "\xC2\xA0", "\xE2\x80\x89", "\xE2\x80\xAF",
                                         NULL};
    return one_of(at, spaces);
}

static size_t dot_at(const char *at)
{
    static const char *const dots[] = {".", "*", "·", "⋅", NULL};
    return begins(at, "**") ? 0 : one_of(at, dots);
}

static size_t letter_at(const char *at)
{
    static const char *const signs[] = {"°", "µ", "μ", "%", NULL};
    bool ascii = (*at >= 'a' && *at <= 'z') || (*at >= 'A' && *at <= 'Z');
    return ascii ? 1 : one_of(at, signs);
}

static bool digit_at(const char *at)
{
    return *at >= '0' && *at <= '9';
}

/* Bytes of the UTF-8 character at `at`. */
static int char_at(const char *at)
{
    int n = 1;
    while (((unsigned char)at[n] & 0xC0) == 0x80)
        n++;
    return n;
}

static void pass_spaces(reader *r)
{
    for (size_t n; (n = space_at(r->at)) > 0;)
        r->at += n;
}

static size_t superscript_at(const char *at, int *digit)
{
    static const char *const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    for (int i = 0; i < 10; i++) {
        size_t n = begins(at, digits[i]);
        if (n > 0) {
            *digit = i;
            return n;
        }
    }
    return 0;
}

/* Reads the digits of a power; 0 stands for none that can be used. */
static int read_digits(reader *r, bool raised)
{
    int power = 0, digit = 0;
    for (;;) {
        size_t n = raised ? superscript_at(r->at, &digit) : digit_at(r->at);
        if (n == 0)
            return power;
        if (!raised)
            digit = *r->at - '0';
        power = power > LARGEST_POWER ? power : 10 * power + digit;
        r->at += n;
    }
}

static bool read_power(reader *r, int *power)
{
    const char *start = r->at;
    size_t mark = begins(r->at, "**") ? 2 : begins(r->at, "^");
    int digit;
    size_t raised_minus = begins(r->at, "⁻");
    bool raised = raised_minus > 0 || superscript_at(r->at, &digit) > 0;
    bool minus = raised_minus > 0 || r->at[mark] == '-';

    *power = 1;
    if (mark == 0 && !raised && !digit_at(r->at + minus))
        return true;
    r->at += raised ? raised_minus : mark + minus;
    if (mark > 0 && !minus)
        r->at += begins(r->at, "+");
    *power = read_digits(r, raised);
    if (r->at[0] == '.' && digit_at(r->at + 1))
        return refuse(r, "has a power that is not a whole number");
    if (*power == 0 || *power > LARGEST_POWER)
        return refuse(r, "has the power \"%.*s\"; powers are whole numbers from -9 to 9 without 0",
                      (int)(r->at - start), start);
    if (minus)
        *power = -*power;
    return true;
}

static bool no_symbol(const reader *r)
{
    if (*r->at == '\0')
        return refuse(r, "ends where one more unit should stand");
    if (digit_at(r->at))
        return refuse(r, "has a number where a unit should stand; a power is written \"mm2\" or "
                         "\"mm^2\"");
    if (*r->at == '(')
        return refuse(r, "has \"(\" in the wrong place; parentheses belong after \"/\", as in "
                         "\"N/(mm um)\"");
    return refuse(r, "has \"%.*s\" where a unit should stand", char_at(r->at), r->at);
}

static bool unknown(const reader *r, const char *start, size_t length)
{
    char word[LONGEST_WORD + 1];
    bool whole = start == r->text && start[length] == '\0';
    if (length > LONGEST_WORD)
        return refuse(r, "is not known");
    memcpy(word, start, length);
    word[length] = '\0';
    const char *near = ff_symbol_nearest(word);
    if (near && whole)
        return refuse(r, "is not known; did you mean \"%s\"?", near);
    if (near)
        return refuse(r, "has the unknown part \"%s\"; did you mean \"%s\"?", word, near);
    return whole ? refuse(r, "is not known") : refuse(r, "has the unknown part \"%s\"", word);
}

static bool multiply(reader *r, const ff_symbol *symbol, int power)
{
    for (int i = 0; i < FF_DIMENSIONS; i++) {
        r->power[i] += power * symbol->power[i];
        if (abs(r->power[i]) > LARGEST_SUM)
            return refuse(r, "has too high a power in all");
    }
    for (int i = 0; i < abs(power); i++)
        r->scale = power > 0 ? r->scale * symbol->scale : r->scale / symbol->scale;
    r->ten += power * symbol->ten;
    r->factors++;
    return true;
}

/* A factor ends at a separator, a slash, a parenthesis or the end. */
static bool check_end(const reader *r)
{
    if (*r->at == '\0' || *r->at == '/' || *r->at == ')' || space_at(r->at) || dot_at(r->at))
        return true;
    if (*r->at == '-')
        return refuse(r, "has \"-\" between units; write a space, as in \"N m\"");
    if (letter_at(r->at))
        return refuse(r, "needs a space after the power");
    if (*r->at == '(')
        return no_symbol(r);
    return refuse(r, "has \"%.*s\" in it, which no unit has", char_at(r->at), r->at);
}

static bool read_factor(reader *r, int sign)
{
    const char *start = r->at;
    ff_symbol symbol;
    int power;
    for (size_t n; (n = letter_at(r->at)) > 0;)
        r->at += n;
    size_t length = (size_t)(r->at - start);
    if (length == 0)
        return no_symbol(r);
    if (!ff_symbol_find(start, length, &symbol))
        return unknown(r, start, length);
    if (!read_power(r, &power) || !check_end(r))
        return false;
    if (symbol.offset != 0) {
        r->offset_word = start;
        r->offset_length = length;
        r->offset = symbol.offset;
        r->offset_power = sign * power;
    }
    return multiply(r, &symbol, sign * power);
}

static bool read_product(reader *r, int sign)
{
    for (;;) {
        if (!read_factor(r, sign))
            return false;
        pass_spaces(r);
        size_t dot = dot_at(r->at);
        r->at += dot;
        pass_spaces(r);
        if (dot == 0 && (*r->at == '\0' || *r->at == '/' || *r->at == ')'))
            return true;
    }
}

/* Something follows a complete "a/b": says how to write what may be meant. */
static bool refuse_tail(const reader *r, const char *slash, const char *below_end)
{
    int above = (int)(slash - r->text);
    const char *below = slash + 1;
    const char *rest = r->at;
    while (above > 0 && r->text[above - 1] == ' ')
        above--;
    while (*below == ' ')
        below++;
    int below_length = (int)(below_end - below);
    if (*rest == ')')
        return refuse(r, "has a \")\" without \"(\"");
    rest += *rest == '/' ? 1 : (int)dot_at(rest);
    while (*rest == ' ')
        rest++;
    bool simple = *below != '(' && !strpbrk(rest, "/()") && *rest && strlen(r->text) < 60;
    if (!simple)
        return refuse(r, "must have one \"/\" with one unit or one pair of parentheses after it, "
                         "as in \"N/(mm um)\"");
    if (*r->at == '/')
        return refuse(r, "has two \"/\"; write \"%.*s/(%.*s %s)\"", above, r->text, below_length,
                      below, rest);
    bool bare = above == 0 || (above == 1 && *r->text == '1');
    return refuse(r, "is ambiguous; write \"%.*s/(%.*s %s)\" or \"%.*s%s%s/%.*s\"", above, r->text,
                  below_length, below, rest, bare ? 0 : above, r->text, bare ? "" : " ", rest,
                  below_length, below);
}

static bool read_below(reader *r)
{
    const char *slash = r->at++;
    pass_spaces(r);
    if (*r->at == '(') {
        r->at++;
        pass_spaces(r);
        if (!read_product(r, -1))
            return false;
        if (*r->at != ')')
            return refuse(r, *r->at ? "has a second \"/\" inside the parentheses"
                                    : "has a \"(\" without \")\"");
        r->at++;
    } else if (!read_factor(r, -1))
        return false;
    const char *end = r->at;
    pass_spaces(r);
    return *r->at == '\0' || refuse_tail(r, slash, end);
}

static bool read_unit(reader *r)
{
    if (*r->at == '\0')
        return true;
    if (*r->at == '1') {
        const char *one = r->at++;
        pass_spaces(r);
        if (*r->at == '\0')
            return true;
        if (*r->at != '/')
            r->at = one;
    }
    if (*r->at != '/' && !read_product(r, 1))
        return false;
    if (*r->at == ')')
        return refuse(r, "has a \")\" without \"(\"");
    return *r->at == '\0' || read_below(r);
}

/* 10^ten * scale, correctly rounded when scale is a whole number and ten is moderate. */
static double scaled(double scale, int ten)
{
    double tens = pow(10, abs(ten));
    return ten < 0 ? scale / tens : scale * tens;
}

static bool finish(const reader *r, ff_unit *unit)
{
    if (r->offset_word && (r->factors > 1 || r->offset_power != 1)) {
        int length = (int)r->offset_length;
        const char *after = r->offset_word + length;
        if (strlen(r->text) > 60)
            return refuse(r, "has %.*s in a product; write K", length, r->offset_word);
        return refuse(r,
                      "has %.*s in a product, where only differences make sense; write \"%.*sK%s\"",
                      length, r->offset_word, (int)(r->offset_word - r->text), r->text, after);
    }
    for (int i = 0; i < FF_DIMENSIONS; i++)
        unit->power[i] = (int8_t)r->power[i];
    unit->factor = scaled(r->scale, r->ten);
    unit->offset = r->offset;
    return isnormal(unit->factor) || refuse(r, "is beyond what numbers can hold");
}

bool ff_unit_parse(const char *text, ff_unit *unit, char *why, size_t why_size)
{
    reader r = {.text = text, .scale = 1, .why = why, .why_size = why_size};
    *unit = (ff_unit){.factor = 1};
    for (size_t n; (n = space_at(r.text)) > 0;)
        r.text += n;
    r.at = r.text;
    return read_unit(&r) && finish(&r, unit);
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

/* n when the factor is 1/n for a whole n, else 0. A factor such as 1e-3 is itself rounded; to
   divide by 1000 rounds only once. */
static double inverse(const ff_unit *unit)
{
    double n = unit->factor < 1 ? round(1 / unit->factor) : 0;
    return n > 0 && 1 / n == unit->factor ? n : 0;
}

double ff_unit_to_si(const ff_unit *unit, double number)
{
    double n = inverse(unit);
    return (n > 0 ? number / n : number * unit->factor) + unit->offset;
}

double ff_unit_from_si(const ff_unit *unit, double si)
{
    double n = inverse(unit);
    return n > 0 ? (si - unit->offset) * n : (si - unit->offset) / unit->factor;
}
