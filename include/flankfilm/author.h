/* SPDX-License-Identifier: MIT */
/* Conveniences for plugin authors; header only. */
#ifndef FLANKFILM_AUTHOR_H
#define FLANKFILM_AUTHOR_H

#include "plugin.h"

#include <stdarg.h>
#include <stdio.h>

/* Pointer, row count and stride of a static table, in the order of the fields of ff_model. */
#define FF_TABLE(rows) (rows), sizeof(rows) / sizeof((rows)[0]), sizeof((rows)[0])
#define FF_NO_TABLE    NULL, 0, 0

#define FF_BIT(output) (UINT64_C(1) << (output))

#if defined(__GNUC__)
#define FF_UNUSED       __attribute__((unused))
#define FF_PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define FF_UNUSED
#define FF_PRINTF(f, a)
#endif

/* host->fail with a printf format. */
FF_UNUSED FF_PRINTF(4, 5) static ff_status
    ff_failf(const ff_host *host, ff_status status, const char *item, const char *format, ...)
{
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return host->fail(host->ctx, status, item, text);
}

/* Gives a scalar output. */
FF_UNUSED static ff_status ff_put_scalar(const ff_host *host, uint32_t output, double value)
{
    double *data = host->output(host->ctx, output, 0, NULL);
    if (!data)
        return FF_NOMEM;
    *data = value;
    return FF_OK;
}

/* Memory of a one-dimensional output. */
FF_UNUSED static double *ff_put_series(const ff_host *host, uint32_t output, size_t count)
{
    return host->output(host->ctx, output, 1, &count);
}

/* assess of a law, whose error those judge who use it: with the seconds that a million points
   take, and what it is good for in a line, or "". */
FF_UNUSED static ff_status ff_assess_law(double cost, const char *reason, ff_assessment *assessment)
{
    assessment->applies = FF_APPLIES;
    assessment->cost = cost;
    assessment->reason = reason;
    return FF_OK;
}

#endif
