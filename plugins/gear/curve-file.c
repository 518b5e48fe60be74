/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured profiles as text: a header with units, then one point per line. */
#include "flank-deviations.h"

#include <flankfilm/author.h>

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { GEAR, ROLL, DEVIATION, COLUMNS };
enum { MAX_LINE = 1024, MAX_POINTS = 100000 };

static const struct {
    const char *name;
    struct {
        const char *unit;
        double factor;
    } units[6];
} columns[COLUMNS] = {
    [GEAR] = {"gear", {{"", 1}}},
    [ROLL] = {"roll_angle", {{"deg", M_PI / 180}, {"rad", 1}}},
    [DEVIATION] = {"deviation", {{"um", 1e-6}, {"µm", 1e-6}, {"mm", 1e-3}, {"m", 1}}},
};

typedef struct reader {
    const ff_host *host;
    const char *item;
    FILE *file;
    locale_t plain;
    size_t line;
    char text[MAX_LINE];
    double factor[COLUMNS];
    ff_curve *curve;
    size_t room[2];
} reader;

/* Cuts off blanks at both ends. */
static char *trim(char *text)
{
    text += strspn(text, " \t\r\n");
    size_t n = strlen(text);
    while (n > 0 && strchr(" \t\r\n", text[n - 1]))
        text[--n] = 0;
    return text;
}

/* The next line with something on it; NULL at the end or when *status says why. */
static char *next_line(reader *r, ff_status *status)
{
    *status = FF_OK;
    while (fgets(r->text, sizeof r->text, r->file)) {
        r->line++;
        if (!strchr(r->text, '\n') && !feof(r->file)) {
            *status = ff_failf(r->host, FF_INVALID, r->item,
                               "line %zu is longer than %d characters or is no text", r->line,
                               MAX_LINE - 1);
            return NULL;
        }
        char *text = trim(r->text);
        if (*text && *text != '#')
            return text;
    }
    return NULL;
}

static bool split(char *text, char *field[COLUMNS])
{
    for (int i = 0; i < COLUMNS; i++) {
        if (!text)
            return false;
        size_t n = strcspn(text, ",;\t");
        char *rest = text[n] ? text + n + 1 : NULL;
        text[n] = 0;
        field[i] = trim(text);
        text = rest;
    }
    return !text;
}

static bool read_title(char *title, int column, double *factor)
{
    char *bracket = strchr(title, '['), *unit = title + strlen(title);
    if (bracket) {
        *bracket = 0;
        unit = bracket + 1;
        unit[strcspn(unit, "]")] = 0;
    }
    if (strcmp(trim(title), columns[column].name) != 0)
        return false;
    for (int i = 0; i < 6 && columns[column].units[i].unit; i++)
        if (!strcmp(trim(unit), columns[column].units[i].unit)) {
            *factor = columns[column].units[i].factor;
            return true;
        }
    return false;
}

static ff_status read_header(reader *r)
{
    ff_status status;
    char *field[COLUMNS], *text = next_line(r, &status);
    bool read = text && split(text, field);
    for (int i = 0; i < COLUMNS && read; i++)
        read = read_title(field[i], i, &r->factor[i]);
    if (read || status != FF_OK)
        return status;
    return ff_failf(r->host, FF_INVALID, r->item,
                    "line %zu: the header must read \"gear, roll_angle [deg], deviation [um]\"",
                    r->line);
}

static ff_status add_point(reader *r, const double value[COLUMNS])
{
    if (value[GEAR] < 1 || value[GEAR] > 2 || floor(value[GEAR]) < value[GEAR])
        return ff_failf(r->host, FF_INVALID, r->item, "line %zu: gear is 1 or 2, not %g", r->line,
                        value[GEAR]);
    size_t g = (size_t)value[GEAR] - 1;
    ff_curve *c = &r->curve[g];
    if (c->count > 0 && !(value[ROLL] > c->roll[c->count - 1]))
        return ff_failf(r->host, FF_INVALID, r->item,
                        "line %zu: the roll angles of a gear must rise", r->line);
    if (c->count == MAX_POINTS)
        return ff_failf(r->host, FF_INVALID, r->item, "more than %d points", MAX_POINTS);
    if (c->count == r->room[g]) {
        r->room[g] = r->room[g] ? 2 * r->room[g] : 256;
        double *roll = realloc(c->roll, r->room[g] * sizeof *roll);
        c->roll = roll ? roll : c->roll;
        double *deviation = realloc(c->deviation, r->room[g] * sizeof *deviation);
        c->deviation = deviation ? deviation : c->deviation;
        if (!roll || !deviation)
            return FF_NOMEM;
    }
    c->roll[c->count] = value[ROLL];
    c->deviation[c->count++] = value[DEVIATION];
    return FF_OK;
}

static ff_status read_points(reader *r)
{
    ff_status status;
    char *text;
    while ((text = next_line(r, &status))) {
        char *field[COLUMNS];
        double value[COLUMNS];
        if (!split(text, field))
            return ff_failf(r->host, FF_INVALID, r->item, "line %zu: three columns are needed",
                            r->line);
        for (int i = 0; i < COLUMNS; i++) {
            char *end;
            value[i] = strtod_l(field[i], &end, r->plain) * r->factor[i];
            if (end == field[i] || *end || !isfinite(value[i]))
                return ff_failf(r->host, FF_INVALID, r->item,
                                "line %zu: \"%.40s\" is not a finite number", r->line, field[i]);
        }
        status = add_point(r, value);
        if (status != FF_OK)
            return status;
    }
    if (status == FF_OK && r->curve[0].count + r->curve[1].count == 0)
        status = ff_failf(r->host, FF_INVALID, r->item, "the file holds no point");
    return status;
}

ff_status ff_curves_read(const ff_host *host, const char *item, const char *path, ff_curve curve[2])
{
    struct stat about;
    reader r = {.host = host, .item = item, .curve = curve};
    curve[0] = curve[1] = (ff_curve){0};
    if (stat(path, &about) != 0 || !S_ISREG(about.st_mode))
        return ff_failf(host, FF_INVALID, item, "%s is not a file", path);
    r.plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!r.plain)
        return FF_NOMEM;
    r.file = fopen(path, "r");
    ff_status status =
        r.file ? read_header(&r)
               : ff_failf(host, FF_INVALID, item, "%s cannot be opened: %s", path, strerror(errno));
    if (status == FF_OK)
        status = read_points(&r);
    if (r.file)
        fclose(r.file);
    freelocale(r.plain);
    return status;
}
