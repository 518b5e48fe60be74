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

/*
 * Rows of parameters whose values the core writes into a member of the instance, a struct `type`. A
 * member of another C type than the row's does not compile. `flags`, `group`, limits and counts as
 * in ff_param; `preset` and `group` may be NULL, limits 0, 0.
 *
 *   static const ff_param params[] = {
 *       FF_QUANTITY("alpha", "1/GPa", barus, alpha, FF_REQUIRED, NULL, NULL, 0, 1000, 2, 50,
 *                   "slope of ln(eta) over pressure"),
 *   };
 */
#define FF_QUANTITY(name, unit, type, member, flags, preset, group, min, max, low, high, doc)      \
    FF_QUANTITY_OR(NULL, name, unit, type, member, flags, preset, group, min, max, low, high, doc)
/* `words`, "auto", are accepted beside a number. */
#define FF_QUANTITY_OR(words, name, unit, type, member, flags, preset, group, min, max, low, high, \
                       doc)                                                                        \
    FF_ROW(name, unit, doc, FF_REAL, flags, preset, words, group, min, max, low, high, 0, 0,       \
           FF_PLACE(type, member, double))
#define FF_COUNT(name, type, member, flags, preset, group, min, max, low, high, doc)               \
    FF_COUNT_OR(NULL, name, type, member, flags, preset, group, min, max, low, high, doc)
#define FF_COUNT_OR(words, name, type, member, flags, preset, group, min, max, low, high, doc)     \
    FF_ROW(name, "1", doc, FF_INT, flags, preset, words, group, min, max, low, high, 0, 0,         \
           FF_PLACE(type, member, int64_t))
#define FF_SWITCH(name, type, member, preset, doc)                                                 \
    FF_ROW(name, "", doc, FF_BOOL, 0, preset, NULL, NULL, 0, 0, 0, 0, 0, 0,                        \
           FF_PLACE(type, member, int32_t))
#define FF_ONE_OF(words, name, type, member, flags, preset, doc)                                   \
    FF_ROW(name, "", doc, FF_CHOICE, flags, preset, words, NULL, 0, 0, 0, 0, 0, 0,                 \
           FF_PLACE(type, member, int32_t))
#define FF_PHRASE(name, type, member, flags, preset, group, doc)                                   \
    FF_ROW(name, "", doc, FF_TEXT, flags, preset, NULL, group, 0, 0, 0, 0, 0, 0,                   \
           FF_PLACE(type, member, const char *))
#define FF_PATH(name, type, member, flags, group, doc)                                             \
    FF_ROW(name, "", doc, FF_FILE, flags, NULL, NULL, group, 0, 0, 0, 0, 0, 0,                     \
           FF_PLACE(type, member, const char *))
#define FF_LIST(name, unit, type, member, flags, preset, group, min, max, low, high, min_count,    \
                max_count, doc)                                                                    \
    FF_ROW(name, unit, doc, FF_REALS, flags, preset, NULL, group, min, max, low, high, min_count,  \
           max_count, FF_PLACE(type, member, ff_reals))

#define FF_ROW(name, unit, doc, kind, flags, preset, words, group, min, max, low, high, min_count, \
               max_count, place)                                                                   \
    {                                                                                              \
        name, unit, doc, kind, flags, preset, words, group, min, max, low, high, min_count,        \
            max_count, place, NULL                                                                 \
    }

#ifdef __cplusplus
extern "C++" {
template <class A, class B> struct ff_same;
template <class A> struct ff_same<A, A> {
    enum { zero = 0 };
};
}
#define FF_PLACE(type, member, c_type)                                                             \
    (offsetof(type, member) + 1 + ff_same<decltype(((type *)0)->member), c_type>::zero)
#else
#define FF_PLACE(type, member, c_type)                                                             \
    _Generic(((type *)0)->member, c_type : offsetof(type, member) + 1)
#endif

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
