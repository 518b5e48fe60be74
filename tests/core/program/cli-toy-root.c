/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers that are off by (1/n)^2 of themselves, for work that grows with n. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { N, BLIND };
enum { VALUE, CURVE, PLACE, ROUNDS, FIELD, TRACE, CURVE_ERROR };

typedef struct root {
    const ff_host *host;
    double n;
    int64_t blind;
} root;

static const ff_param params[] = {
    {.name = "n", .unit = "1", .doc = "effort", .type = FF_REAL, .preset = "1"},
    {.name = "blind", .unit = "", .doc = "n that finds nothing", .type = FF_INT, .preset = "0"},
};

static const ff_port outputs[] = {
    {.name = "value", .unit = "m", .doc = "7 m", .dims = ""},
    {.name = "curve", .unit = "m", .doc = "a straight line", .dims = "t"},
    {.name = "place", .unit = "rad", .doc = "where the curve is known", .dims = "t"},
    {.name = "rounds", .unit = "1", .doc = "n", .dims = ""},
    {.name = "field", .unit = "m", .doc = "a field", .dims = "t x"},
    {.name = "trace", .unit = "1", .doc = "0 from 100 rounds on", .dims = ""},
    {.name = "curve_error",
     .unit = "m",
     .doc = "infinite at the start with less than 8 rounds",
     .dims = "t"},
};

static ff_status create(const ff_host *host, void **self)
{
    root *r = calloc(1, sizeof *r);
    if (!r)
        return FF_NOMEM;
    r->host = host;
    *self = r;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    root *r = self;
    if (param == N)
        r->n = value->real;
    else
        r->blind = value->integer;
    return FF_OK;
}

/* Takes processor time in proportion, without a call of the system. */
static void labour(double parts)
{
    volatile double sum = 0;
    for (double done = 0; done < 4e4 * parts; done++)
        sum = sum + done;
}

static ff_status draw(const root *r, double off)
{
    size_t count = (size_t)r->n + 1;
    double *curve = ff_put_series(r->host, CURVE, count),
           *place = ff_put_series(r->host, PLACE, count),
           *error = ff_put_series(r->host, CURVE_ERROR, count);
    if (!curve || !place || !error)
        return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        place[i] = (double)i / (double)(count - 1);
        curve[i] = (3 + place[i]) * (1 + off);
        error[i] = i == 0 && r->n < 8 ? (double)INFINITY : off * curve[i];
    }
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    root *r = self;
    double off = 1 / (r->n * r->n);
    (void)in;
    labour(r->n);
    if (r->blind && r->n == (double)r->blind)
        return ff_failf(r->host, FF_NOCONV, "n", "nothing was found");
    ff_put_scalar(r->host, VALUE, 7 * (1 + off));
    ff_put_scalar(r->host, ROUNDS, r->n);
    ff_put_scalar(r->host, TRACE, r->n < 100 ? off : 0);
    return wanted & (1 << CURVE | 1 << PLACE | 1 << CURVE_ERROR) ? draw(r, off) : FF_OK;
}

static void destroy(void *self)
{
    free(self);
}

const ff_model *flankfilm_model_v1(void)
{
    static const ff_model model = {
        .size = sizeof model,
        .abi_major = FF_ABI_MAJOR,
        .abi_minor = FF_ABI_MINOR,
        .id = "toy/root",
        .version = "1.0.0",
        .summary = "numbers with a known error",
        .reference = "",
        .bibtex = "",
        .licence = "GPL-3.0-or-later",
        .params = params,
        .param_count = sizeof params / sizeof params[0],
        .param_stride = sizeof params[0],
        .outputs = outputs,
        .output_count = sizeof outputs / sizeof outputs[0],
        .output_stride = sizeof outputs[0],
        .create = create,
        .set = set,
        .evaluate = evaluate,
        .destroy = destroy,
    };
    return &model;
}
