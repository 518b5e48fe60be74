/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was fitted, for people. */
#include "laws.h"

#include <math.h>
#include <string.h>

enum { NAME = 28, PARAM = 18, VALUE = 20 };

FF_PRINTF(2, 3) static void put(const ff_comparison_request *r, const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    r->put(r->ctx, text);
}

static void print_data(const ff_comparison_request *r)
{
    r->put(r->ctx, r->fit->source);
    put(r, ": %zu rows", r->fit->row_count);
    for (size_t k = 0; k < r->fitter->column_count; k++) {
        const ff_param *row = fit_column(r, k);
        char first[64], last[64];
        double low, high;
        if (!r->fit->columns[k])
            continue;
        fit_range(r, k, &low, &high);
        r->quantity(r->ctx, row, low, first, sizeof first);
        r->quantity(r->ctx, row, high, last, sizeof last);
        put(r, ", %s %s", row->name, first);
        if (strcmp(first, last) != 0)
            put(r, " to %s", last);
    }
    put(r, "\n\n");
}

static bool was_asked(const comparison *c)
{
    for (size_t i = 0; i < c->count; i++)
        if (c->laws[i].told && !c->laws[i].why && !isnan(c->laws[i].found.asked))
            return true;
    return false;
}

static void print_table(const comparison *c, const ff_comparison_request *r)
{
    const fitted *best = fit_best(c);
    bool asked = was_asked(c);
    put(r, "%-*s %5s %9s %22s %9s%s\n", NAME, "law", "found", "rms", "largest",
        r->fitter->criterion, asked ? "  at that point" : "");
    for (size_t i = 0; i < c->count; i++) {
        const fitted *f = &c->laws[i];
        char largest[64], value[64];
        if (!f->told || f->why)
            continue;
        snprintf(largest, sizeof largest, "%+.3g %% in line %u", 100 * f->found.largest,
                 r->lines[f->found.largest_row]);
        put(r, "%-*s %5zu %7.3g %% %22s %+9.1f", NAME, f->law->id, f->found.free_count,
            100 * f->found.rms, largest, f->found.criterion - best->found.criterion);
        r->quantity(r->ctx, fit_column(r, r->fitter->quantity), f->found.asked, value,
                    sizeof value);
        put(r, "%s%s\n", asked ? "  " : "", asked ? value : "");
    }
}

static void print_value(const ff_comparison_request *r, const fitted *f, size_t param)
{
    const ff_fit_value *value = &f->values[param];
    const ff_param *row = f->law->params[param]->row;
    char text[64], low[64], high[64];
    if (isnan(value->value) || value->how == FF_FIT_UNSAID)
        return;
    r->quantity(r->ctx, row, value->value, text, sizeof text);
    put(r, "  %-*s %-*s", PARAM, row->name, VALUE, text);
    if (value->how == FF_FIT_AT_LIMIT) {
        put(r, " at its limit");
    } else if (value->how == FF_FIT_HELD) {
        put(r, " held");
    } else {
        r->quantity(r->ctx, row, value->low, low, sizeof low);
        r->quantity(r->ctx, row, value->high, high, sizeof high);
        put(r, " %s to %s", low, high);
    }
    put(r, "\n");
}

/* The notes of a law, each on lines of its own. */
static void print_notes(const ff_comparison_request *r, const char *note)
{
    while (*note) {
        char line[600];
        size_t length = strcspn(note, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, note);
        put(r, "  ");
        r->wrap(r->ctx, line, 2, 4);
        note += length + (note[length] == '\n');
    }
}

void fit_print(const comparison *c, const ff_comparison_request *r)
{
    print_data(r);
    print_table(c, r);
    put(r, "\n95 %% confidence:\n");
    for (size_t i = 0; i < c->count; i++) {
        const fitted *f = &c->laws[i];
        if (!f->told || f->why)
            continue;
        put(r, "\n%s\n", f->law->id);
        for (size_t k = 0; k < f->law->param_count; k++)
            print_value(r, f, k);
        print_notes(r, f->note);
    }
}
