/* SPDX-License-Identifier: MIT */
/* Reads values with the tolerances of a drawing. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <flankfilm/engine.h>

/* A number with its unit. */
typedef struct part {
    double number;
    char text[64];
    ff_unit unit;
} part;

/* Returns the tolerance mark between the two parts, such as "+-"; *pass is the start of the second
 * part. NULL: there is no mark. */
static const char *find_mark(const char *text, const char **pass)
{
    static const char *const marks[] = {"+-", "+/-", "\xc2\xb1", " to "};
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++) {
        const char *at = strstr(text, marks[i]);
        if (at) {
            *pass = at + strlen(marks[i]);
            return at;
        }
    }
    return NULL;
}

/* Reads a number with a unit, "20 um", up to `end`. False if it does not begin with a number or its
   unit is unknown. */
static bool read_part(const char *at, const char *end, part *p)
{
    char why[200];
    const char *rest;
    at += strspn(at, " \t");
    if (!ff_number_parse(at, &p->number, &rest) || rest > end)
        return false;
    rest += strspn(rest, " \t");
    while (end > rest && (end[-1] == ' ' || end[-1] == '\t'))
        end--;
    size_t length = end > rest ? (size_t)(end - rest) : 0;
    if (length >= sizeof p->text)
        return false;
    memcpy(p->text, rest, length);
    p->text[length] = '\0';
    return ff_unit_parse(p->text, &p->unit, why, sizeof why);
}

static int refuse(const char *text, const char *what, char *why, size_t size)
{
    snprintf(why, size, "\"%.60s\" %s", text, what);
    return -1;
}

int ff_tolerance_parse(const char *text, ff_tolerance *t, char *why, size_t why_size)
{
    static const char example[] =
        "is not a value with a tolerance, such as \"120 mm +- 20 um\" or \"-75 um to -45 um\"";
    const char *pass, *mark = find_mark(text, &pass);
    part value, other;
    if (!mark)
        return 0;
    if (!read_part(text, mark, &value) || !read_part(pass, pass + strlen(pass), &other))
        return refuse(text, example, why, why_size);
    bool range = *mark == ' ', share = !strcmp(other.text, "%") && strcmp(value.text, "%") != 0 &&
                                       !ff_unit_is_dimensionless(&value.unit);
    if (!share && !ff_unit_same_dimension(&value.unit, &other.unit))
        return refuse(text, "has two units that do not agree", why, why_size);
    if (!range && other.number < 0)
        return refuse(text, "has a tolerance below 0", why, why_size);
    if (range && share)
        return refuse(text, "has two units that do not agree", why, why_size);
    if (share && value.unit.offset != 0)
        return refuse(text,
                      "has a percentage of a temperature, which depends on the zero of its scale",
                      why, why_size);
    snprintf(t->unit, sizeof t->unit, "%s", value.text);
    if (range) {
        double end = ff_unit_from_si(&value.unit, ff_unit_to_si(&other.unit, other.number));
        t->low = fmin(value.number, end);
        t->high = fmax(value.number, end);
        t->middle = (t->low + t->high) / 2;
        return 1;
    }
    double half = share ? other.number / 100 * fabs(value.number)
                        : other.number * (other.unit.factor / value.unit.factor);
    t->middle = value.number;
    t->low = value.number - half;
    t->high = value.number + half;
    return 1;
}
