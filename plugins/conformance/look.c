/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "look.h"

#include <math.h>
#include <string.h>

bool look_open(look *l, const ff_bench *bench, const char *wanted)
{
    char text[400];
    *l = (look){.bench = bench, .instance = bench->open(bench->ctx)};
    if (!l->instance)
        return false;
    bench->doing(bench->ctx, "evaluate");
    ff_status status = bench->evaluate(bench->ctx, l->instance, wanted);
    if (status == FF_OK || status == FF_DOMAIN)
        return true;
    const char *why = bench->why(bench->ctx, l->instance);
    snprintf(text, sizeof text,
             "evaluate gave the status %d: %s; --pipeline FILE gives real inputs", (int)status,
             why);
    /* of what is wanted it offers nothing */
    bench->untried(bench->ctx, status == FF_UNSUPPORTED && !why[0] ? NULL : text);
    look_close(l);
    return false;
}

void look_close(look *l)
{
    l->bench->close(l->bench->ctx, l->instance);
    l->instance = NULL;
}

series look_at(const look *l, const char *name)
{
    ff_array a = l->bench->array(l->bench->ctx, l->instance, name);
    size_t count = a.data ? 1 : 0;
    for (uint32_t i = 0; a.data && i < a.rank; i++)
        count *= a.shape[i];
    return (series){.data = a.data, .count = count};
}

double look_scalar(const look *l, const char *name)
{
    series s = look_at(l, name);
    return s.count == 1 ? s.data[0] : (double)NAN;
}

bool look_offers(const ff_bench *bench, const char *output)
{
    const ff_model *m = bench->model;
    for (size_t i = 0; i < m->output_count; i++) {
        const ff_port *row = (const void *)((const char *)m->outputs + i * m->output_stride);
        if (!strcmp(row->name, output))
            return true;
    }
    return false;
}

bool look_all(const look *l, const char *names)
{
    char name[64];
    while (*names) {
        size_t length = strcspn(names, " ");
        snprintf(name, sizeof name, "%.*s", (int)length, names);
        if (!look_at(l, name).data)
            return false;
        names += length + strspn(names + length, " ");
    }
    return true;
}

bool look_near(const look *l, const char *what, size_t at, double value, double expected,
               double scale, double tolerance)
{
    if (isnan(value) || isnan(expected) || fabs(value - expected) <= tolerance * fabs(scale))
        return true;
    ff_faultf(l->bench, "%s is %.9g at point %zu, but must be %.9g", what, value, at, expected);
    return false;
}

void give_scalar(const ff_bench *bench, const char *input, double value)
{
    bench->give(bench->ctx, input, 0, NULL, &value);
}

void give_series(const ff_bench *bench, const char *input, size_t count, const double *data)
{
    bench->give(bench->ctx, input, 1, &count, data);
}
