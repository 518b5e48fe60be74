/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "trace.h"

#include "record.h"

#include <flankfilm/author.h>

#include <ctype.h>
#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_POINTS = FF_SURFACE_POINTS, MAX_LINES = 2 * MAX_POINTS, MAX_LINE = 1024 };

static const struct {
    const char *name;
    double factor;
} units[] = {{"nm", 1e-9}, {"um", 1e-6}, {"µm", 1e-6}, {"\u03bcm", 1e-6}, {"mm", 1e-3}, {"m", 1}};

static const double longest = 1; /* m: no trace of a flank */

typedef struct reader {
    const ff_host *host;
    const char *item;
    FILE *file;
    locale_t plain; /* decimal points, whatever the program's locale is */
    size_t line, room;
    char text[MAX_LINE];
    char *at; /* in text */
    double factor[2];
    ff_trace *trace;
} reader;

/* Bytes that continue a character of UTF-8 do not count. */
static size_t column_of(const reader *r)
{
    size_t column = 1;
    for (const char *c = r->text; c < r->at; c++)
        column += ((unsigned char)*c & 0xc0) != 0x80;
    return column;
}

static ff_status fail_here(const reader *r, const char *why)
{
    return ff_failf(r->host, FF_INVALID, r->item, "line %zu, column %zu: %s", r->line, column_of(r),
                    why);
}

static void pass_blanks(reader *r)
{
    r->at += strspn(r->at, " \t");
}

static void cut_blanks(char *text)
{
    size_t n = strlen(text);
    while (n > 0 && strchr(" \t\r\n", text[n - 1]))
        text[--n] = 0;
}

/* The next line that says something. False at the end of the file, or when *status tells why. */
static bool next_line(reader *r, ff_status *status)
{
    *status = FF_OK;
    while (fgets(r->text, sizeof r->text, r->file)) {
        r->line++;
        r->at = r->text;
        if (!strchr(r->text, '\n') && !feof(r->file))
            *status = ff_failf(r->host, FF_INVALID, r->item,
                               "line %zu is longer than %d characters or is no text", r->line,
                               MAX_LINE - 1);
        else if (r->line > MAX_LINES)
            *status = ff_failf(r->host, FF_INVALID, r->item, "the file has more than %d lines",
                               MAX_LINES);
        if (*status != FF_OK)
            return false;
        if (r->line == 1 && !strncmp(r->at, "\xef\xbb\xbf", 3)) /* byte order mark */
            r->at += 3;
        cut_blanks(r->at);
        pass_blanks(r);
        if (*r->at && *r->at != '#')
            return true;
    }
    if (ferror(r->file))
        *status =
            ff_failf(r->host, FF_INVALID, r->item, "the file cannot be read: %s", strerror(errno));
    return false;
}

static ff_status read_title(reader *r, const char *name, double *factor)
{
    size_t length = strlen(name);
    pass_blanks(r);
    if (strncmp(r->at, name, length) != 0)
        return fail_here(r, "the header must read \"position [um], height [um]\"");
    r->at += length;
    pass_blanks(r);
    if (*r->at != '[')
        return fail_here(r, "a unit in brackets is missing, as in \"position [um]\"");
    r->at++;
    pass_blanks(r);
    size_t wide = strcspn(r->at, " \t]");
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++)
        if (wide == strlen(units[i].name) && !strncmp(r->at, units[i].name, wide)) {
            *factor = units[i].factor;
            r->at += wide;
            pass_blanks(r);
            if (*r->at++ == ']')
                return FF_OK;
        }
    return fail_here(r, "the unit must be nm, um, mm or m");
}

/* Between two columns. */
static void pass_separator(reader *r)
{
    pass_blanks(r);
    if (*r->at == ',' || *r->at == ';')
        r->at++;
    pass_blanks(r);
}

static ff_status read_header(reader *r)
{
    ff_status status;
    if (!next_line(r, &status))
        return status != FF_OK ? status
                               : ff_failf(r->host, FF_INVALID, r->item,
                                          "the file is empty; its header must read \"position "
                                          "[um], height [um]\"");
    status = read_title(r, "position", &r->factor[0]);
    pass_separator(r);
    if (status == FF_OK)
        status = read_title(r, "height", &r->factor[1]);
    if (status != FF_OK)
        return status;
    pass_blanks(r);
    return *r->at ? fail_here(r, "nothing may follow the column height") : FF_OK;
}

static ff_status read_number(reader *r, double *value)
{
    char *end;
    *value = strtod_l(r->at, &end, r->plain);
    bool ends = end != r->at && (!*end || strchr(",; \t", *end));
    if (!ends || !isfinite(*value))
        return fail_here(r, *r->at ? "this is not a finite number" : "a number is missing");
    r->at = end;
    return FF_OK;
}

static bool grow(reader *r)
{
    ff_trace *t = r->trace;
    size_t room = r->room ? 2 * r->room : 1024;
    double *position = realloc(t->position, room * sizeof *position);
    t->position = position ? position : t->position;
    double *height = realloc(t->height, room * sizeof *height);
    t->height = height ? height : t->height;
    r->room = position && height ? room : r->room;
    return position && height;
}

static ff_status read_point(reader *r)
{
    ff_trace *t = r->trace;
    double position, height;
    char *start = r->at;
    ff_status status = read_number(r, &position);
    pass_separator(r);
    if (status == FF_OK)
        status = read_number(r, &height);
    if (status != FF_OK)
        return status;
    pass_blanks(r);
    if (*r->at)
        return fail_here(r, "nothing may follow the height");
    position *= r->factor[0];
    height *= r->factor[1];
    if (fabs(position) > longest || fabs(height) > longest) {
        r->at = start;
        return fail_here(r, "positions and heights are less than 1 m");
    }
    if (t->n > 0 && !(position > t->position[t->n - 1])) {
        r->at = start;
        return fail_here(r, "the positions must rise from line to line");
    }
    if (t->n == MAX_POINTS)
        return ff_failf(r->host, FF_INVALID, r->item, "the file has more than %d points",
                        MAX_POINTS);
    if (t->n == r->room && !grow(r))
        return FF_NOMEM;
    t->position[t->n] = position;
    t->height[t->n++] = height;
    return FF_OK;
}

static ff_status read_all(reader *r)
{
    ff_status status = read_header(r);
    while (status == FF_OK && next_line(r, &status))
        status = read_point(r);
    if (status == FF_OK && r->trace->n < 2)
        status = ff_failf(r->host, FF_INVALID, r->item, "the file holds fewer than 2 points");
    return status;
}

ff_status ff_trace_read(const ff_host *host, const char *item, const char *path, ff_trace *trace)
{
    struct stat about;
    ff_status status;
    reader r = {.host = host, .item = item, .trace = trace};
    *trace = (ff_trace){0};
    if (stat(path, &about) != 0 || !S_ISREG(about.st_mode))
        return ff_failf(host, FF_INVALID, item, "%s is not a file", path);
    r.plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!r.plain)
        return FF_NOMEM;
    r.file = fopen(path, "r");
    if (r.file) {
        status = read_all(&r);
        fclose(r.file);
    } else
        status = ff_failf(host, FF_INVALID, item, "%s cannot be opened: %s", path, strerror(errno));
    freelocale(r.plain);
    return status;
}

void ff_trace_free(ff_trace *trace)
{
    free(trace->position);
    free(trace->height);
    *trace = (ff_trace){0};
}

size_t ff_trace_cells(const ff_trace *t, double spacing)
{
    double cells = floor((t->position[t->n - 1] - t->position[0]) / spacing * (1 + 1e-9)) + 1;
    return cells <= FF_SURFACE_POINTS ? (size_t)cells : FF_SURFACE_POINTS + 1;
}

static bool stands_at(const ff_trace *t, double spacing, size_t n)
{
    bool stands = t->n == n;
    for (size_t i = 0; i < n && stands; i++)
        stands = fabs(t->position[i] - t->position[0] - spacing * (double)i) < 1e-6 * spacing;
    return stands;
}

/* Integral of the trace from its first point to x; *k is the interval that x was last in. */
static double integral_to(const ff_trace *t, double x, size_t *k, double *before)
{
    const double *p = t->position, *z = t->height;
    while (*k + 2 < t->n && p[*k + 1] < x) {
        *before += (p[*k + 1] - p[*k]) * (z[*k] + z[*k + 1]) / 2;
        ++*k;
    }
    double part = x - p[*k], slope = (z[*k + 1] - z[*k]) / (p[*k + 1] - p[*k]);
    return *before + part * (z[*k] + slope * part / 2);
}

void ff_trace_resample(const ff_trace *t, double spacing, size_t n, double *height)
{
    const double first = t->position[0], last = t->position[t->n - 1];
    if (stands_at(t, spacing, n)) {
        memcpy(height, t->height, n * sizeof *height);
        return;
    }
    size_t k = 0;
    double before = 0, from = first, sum = 0;
    for (size_t i = 0; i < n; i++) {
        double to = fmin(first + spacing * ((double)i + 0.5), last);
        double next = integral_to(t, to, &k, &before);
        height[i] = (next - sum) / (to - from);
        from = to;
        sum = next;
    }
}

double ff_trace_departure(const ff_trace *t, double spacing, size_t n, const double *height)
{
    double sum = 0;
    for (size_t i = 0; i < t->n; i++) {
        double at = fmin((t->position[i] - t->position[0]) / spacing, (double)(n - 1));
        size_t k = (size_t)fmin(floor(at), (double)n - 2);
        double part = at - (double)k;
        double off = height[k] + part * (height[k + 1] - height[k]) - t->height[i];
        sum += off * off;
    }
    return sqrt(sum / (double)t->n);
}
