/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "evaluation.h"

#include <math.h>
#include <string.h>

bool conformance_evaluate(conformance_evaluation *e, const ff_fixture *fixture, const char *wanted)
{
    char text[400];
    *e = (conformance_evaluation){.fixture = fixture, .instance = fixture->open(fixture->ctx)};
    if (!e->instance)
        return false;
    fixture->step(fixture->ctx, "evaluate");
    ff_status status = fixture->evaluate(fixture->ctx, e->instance, wanted);
    if (status == FF_OK || status == FF_DOMAIN)
        return true;
    const char *why = fixture->why(fixture->ctx, e->instance);
    snprintf(text, sizeof text,
             "evaluate gave the status %d: %s; --pipeline FILE gives real inputs", (int)status,
             why);
    /* the model offers none of the wanted outputs */
    fixture->skip(fixture->ctx, status == FF_UNSUPPORTED && !why[0] ? NULL : text);
    conformance_close(e);
    return false;
}

void conformance_close(conformance_evaluation *e)
{
    e->fixture->close(e->fixture->ctx, e->instance);
    e->instance = NULL;
}

conformance_array conformance_array_of(const conformance_evaluation *e, const char *name)
{
    ff_array a = e->fixture->array(e->fixture->ctx, e->instance, name);
    size_t count = a.data ? 1 : 0;
    for (uint32_t i = 0; a.data && i < a.rank; i++)
        count *= a.shape[i];
    return (conformance_array){.data = a.data, .count = count};
}

double conformance_scalar_of(const conformance_evaluation *e, const char *name)
{
    conformance_array s = conformance_array_of(e, name);
    return s.count == 1 ? s.data[0] : (double)NAN;
}

bool conformance_offers(const ff_fixture *fixture, const char *output)
{
    const ff_model *m = fixture->model;
    for (size_t i = 0; i < m->output_count; i++) {
        const ff_port *row = (const void *)((const char *)m->outputs + i * m->output_stride);
        if (!strcmp(row->name, output))
            return true;
    }
    return false;
}

bool conformance_has_all(const conformance_evaluation *e, const char *names)
{
    char name[64];
    while (*names) {
        size_t length = strcspn(names, " ");
        snprintf(name, sizeof name, "%.*s", (int)length, names);
        if (!conformance_array_of(e, name).data)
            return false;
        names += length + strspn(names + length, " ");
    }
    return true;
}

bool conformance_near(const conformance_evaluation *e, const char *what, size_t at, double value,
                      double expected, double scale, double tolerance)
{
    if (isnan(value) || isnan(expected) || fabs(value - expected) <= tolerance * fabs(scale))
        return true;
    ff_check_failf(e->fixture, "%s is %.9g at point %zu, but must be %.9g", what, value, at,
                   expected);
    return false;
}

double conformance_at(conformance_array x, conformance_array y, double at)
{
    size_t i = 1;
    if (x.count < 2 || y.count != x.count || at < x.data[0] || at > x.data[x.count - 1])
        return 0;
    while (i + 1 < x.count && x.data[i] < at)
        i++;
    double step = x.data[i] - x.data[i - 1];
    if (step <= 0)
        return y.data[i];
    double share = (at - x.data[i - 1]) / step;
    return (1 - share) * y.data[i - 1] + share * y.data[i];
}

void conformance_give_scalar(const ff_fixture *fixture, const char *input, double value)
{
    fixture->give(fixture->ctx, input, 0, NULL, &value);
}

void conformance_give_series(const ff_fixture *fixture, const char *input, size_t count,
                             const double *data)
{
    fixture->give(fixture->ctx, input, 1, &count, data);
}
