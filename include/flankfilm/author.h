/* SPDX-License-Identifier: MIT */
/* Conveniences for plugin authors; header only. */
#ifndef FLANKFILM_AUTHOR_H
#define FLANKFILM_AUTHOR_H

#include "plugin.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

/* Pointer, row count and stride of a static table, in the order of the members of ff_model. */
#define FF_TABLE(rows) (rows), sizeof(rows) / sizeof((rows)[0]), sizeof((rows)[0])
#define FF_NO_TABLE    NULL, 0, 0

/*
 * Parameter rows with a `place`: the engine writes the value into `member` of the instance, which
 * is a struct `type`. If the C type of the member does not fit the row, the code does not compile.
 * `flags`, `group`, limits and counts are as in ff_param. `preset` and `group` may be NULL; limits
 * 0, 0 mean none.
 *
 *   static const ff_param params[] = {
 *       FF_QUANTITY("alpha", "1/GPa", barus, alpha, FF_REQUIRED, NULL, NULL, 0, 1000, 2, 50,
 *                   "slope of ln(eta) over pressure"),
 *   };
 */
#define FF_QUANTITY(name, unit, type, member, flags, preset, group, min, max, low, high, doc)      \
    FF_QUANTITY_OR(NULL, name, unit, type, member, flags, preset, group, min, max, low, high, doc)
/* `wire` is an optional input that replaces the parameter: ff_param.instead. */
#define FF_QUANTITY_UNLESS(wire, name, unit, type, member, flags, preset, group, min, max, low,    \
                           high, doc)                                                              \
    FF_ROW_UNLESS(wire, name, unit, doc, FF_REAL, flags, preset, NULL, group, min, max, low, high, \
                  0, 0, FF_PLACE(type, member, double))
/* `words`, such as "auto", are accepted instead of a number. */
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
#define FF_ONE_OF_UNLESS(wire, words, name, type, member, flags, preset, doc)                      \
    FF_ROW_UNLESS(wire, name, "", doc, FF_CHOICE, flags, preset, words, NULL, 0, 0, 0, 0, 0, 0,    \
                  FF_PLACE(type, member, int32_t))
#define FF_PHRASE_UNLESS(wire, name, type, member, flags, preset, group, doc)                      \
    FF_ROW_UNLESS(wire, name, "", doc, FF_TEXT, flags, preset, NULL, group, 0, 0, 0, 0, 0, 0,      \
                  FF_PLACE(type, member, const char *))
#define FF_PHRASE(name, type, member, flags, preset, group, doc)                                   \
    FF_PHRASE_LIKE(NULL, name, type, member, flags, preset, group, doc)
/* `examples`, such as "ISO VG 46|ISO VG 220", are texts that the model accepts. */
#define FF_PHRASE_LIKE(examples, name, type, member, flags, preset, group, doc)                    \
    FF_ROW(name, "", doc, FF_TEXT, flags, preset, examples, group, 0, 0, 0, 0, 0, 0,               \
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
    FF_ROW_UNLESS(NULL, name, unit, doc, kind, flags, preset, words, group, min, max, low, high,   \
                  min_count, max_count, place)
#define FF_ROW_UNLESS(wire, name, unit, doc, kind, flags, preset, words, group, min, max, low,     \
                      high, min_count, max_count, place)                                           \
    {                                                                                              \
        name, unit, doc, kind, flags, preset, words, group, min, max, low, high, min_count,        \
            max_count, place, wire                                                                 \
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

/* The arguments of one call of host->serves; it is made if `holds`, a condition on the settings. */
typedef struct ff_serving {
    int holds;
    const char *item, *outputs, *by, *text;
} ff_serving;

FF_UNUSED static void ff_serve(const ff_host *host, const ff_serving *rows, size_t count)
{
    for (size_t i = 0; i < count && FF_HAS(host, serves); i++)
        if (rows[i].holds)
            host->serves(host->ctx, rows[i].item, rows[i].outputs, rows[i].by, rows[i].text);
}

/* Writes a scalar output. */
FF_UNUSED static ff_status ff_put_scalar(const ff_host *host, uint32_t output, double value)
{
    double *data = host->output(host->ctx, output, 0, NULL);
    if (!data)
        return FF_NOMEM;
    *data = value;
    return FF_OK;
}

/* Allocates a one-dimensional output. */
FF_UNUSED static double *ff_put_series(const ff_host *host, uint32_t output, size_t count)
{
    return host->output(host->ctx, output, 1, &count);
}

/* The value of gear or surface i, 0 or 1, from a list with one value for both or one for each. NaN
   if the list was not given. */
FF_UNUSED static double ff_of_both(const ff_reals *list, int i)
{
    return list->count == 0 ? NAN : list->data[list->count > 1 ? i : 0];
}

/*
 * For C only: macros that define a descriptor, by named members, and the exported function.
 *
 * FF_MODEL defines the descriptor `name` of a model. Its instance is a struct `type` with a member
 * `const ff_host *host`; the generated create allocates it, zeroed. If nothing else is to be freed,
 * write `.destroy = free`.
 *
 *   FF_MODEL(steady_model, steady, .id = "operating/steady", .version = "1.0.0", ...,
 *            .params = FF_TABLE(params), .evaluate = evaluate, .destroy = free);
 *   FF_EXPORT_MODELS(&steady_model);
 */
#define FF_MODEL(name, type, ...)                                                                  \
    static ff_status name##_create(const ff_host *host, void **self)                               \
    {                                                                                              \
        type *ff_self = calloc(1, sizeof *ff_self);                                                \
        if (!ff_self)                                                                              \
            return FF_NOMEM;                                                                       \
        ff_self->host = host;                                                                      \
        *self = ff_self;                                                                           \
        return FF_OK;                                                                              \
    }                                                                                              \
    const ff_model name = {FF_HEAD(type, name##_create), __VA_ARGS__}

/* The descriptor members that are equal for all models. */
#define FF_HEAD(type, maker)                                                                       \
    .size = sizeof(ff_model), .abi_major = FF_ABI_MAJOR, .abi_minor = FF_ABI_MINOR,                \
    .self_size = sizeof(type), .create = maker

/*
 * FF_MODEL for models that offer exactly one service. The instance has a member `service` in
 * addition to `host`; the generated create fills it with `table`. Laws, with laws.h:
 *
 *   FF_VISCOSITY_LAW(barus_law, barus, eval, .id = "viscosity/barus", ..., .cost = 1e-3);
 */
#define FF_VISCOSITY_LAW(name, type, eval, ...)                                                    \
    FF_SERVICE_MODEL(name, type, "viscosity", FF_VISCOSITY_ID, "the viscosity law",                \
                     ((ff_viscosity){sizeof(ff_viscosity), NULL, eval}), __VA_ARGS__)
#define FF_DENSITY_LAW(name, type, eval, ...)                                                      \
    FF_SERVICE_MODEL(name, type, "density", FF_DENSITY_ID, "the law",                              \
                     ((ff_density){sizeof(ff_density), NULL, eval}), __VA_ARGS__)
#define FF_RHEOLOGY_LAW(name, type, flow, shear, ...)                                              \
    FF_SERVICE_MODEL(name, type, "rheology", FF_RHEOLOGY_ID, "the law",                            \
                     ((ff_rheology){sizeof(ff_rheology), NULL, flow, shear}), __VA_ARGS__)

#define FF_SERVICE_MODEL(law, type, output, interface, text, table, ...)                           \
    static ff_status law##_create(const ff_host *host, void **self)                                \
    {                                                                                              \
        type *ff_self = calloc(1, sizeof *ff_self);                                                \
        if (!ff_self)                                                                              \
            return FF_NOMEM;                                                                       \
        ff_self->host = host;                                                                      \
        ff_self->service = table;                                                                  \
        ff_self->service.self = ff_self;                                                           \
        *self = ff_self;                                                                           \
        return FF_OK;                                                                              \
    }                                                                                              \
    static const void *law##_service(void *self, uint32_t row)                                     \
    {                                                                                              \
        return row == 0 ? &((type *)self)->service : NULL;                                         \
    }                                                                                              \
    static const ff_port law##_output[] = {                                                        \
        {.name = output, .unit = "", .doc = text, .dims = "", .service = interface}};              \
    const ff_model law = {FF_HEAD(type, law##_create), .outputs = FF_TABLE(law##_output),          \
                          .service = law##_service, .destroy = free, __VA_ARGS__}

/* A rheology that also offers flankfilm.rheology/2. The instance has a member `service_2` in
   addition to `service`. */
#define FF_RHEOLOGY_2_LAW(law, type, flow, shear, rate, ...)                                       \
    static ff_status law##_create(const ff_host *host, void **self)                                \
    {                                                                                              \
        type *ff_self = calloc(1, sizeof *ff_self);                                                \
        if (!ff_self)                                                                              \
            return FF_NOMEM;                                                                       \
        ff_self->host = host;                                                                      \
        ff_self->service = (ff_rheology){sizeof(ff_rheology), ff_self, flow, shear};               \
        ff_self->service_2 = (ff_rheology_2){sizeof(ff_rheology_2), ff_self, rate};                \
        *self = ff_self;                                                                           \
        return FF_OK;                                                                              \
    }                                                                                              \
    static const void *law##_service(void *self, uint32_t row)                                     \
    {                                                                                              \
        type *ff_self = self;                                                                      \
        return row == 0 ? (const void *)&ff_self->service                                          \
                        : (row == 1 ? &ff_self->service_2 : NULL);                                 \
    }                                                                                              \
    static const ff_port law##_output[] = {                                                        \
        {.name = "rheology", .unit = "", .doc = "the law", .dims = "", .service = FF_RHEOLOGY_ID}, \
        {.name = "rate",                                                                           \
         .unit = "",                                                                               \
         .doc = "shear rate over shear stress",                                                    \
         .dims = "",                                                                               \
         .service = FF_RHEOLOGY_2_ID}};                                                            \
    const ff_model law = {FF_HEAD(type, law##_create), .outputs = FF_TABLE(law##_output),          \
                          .service = law##_service, .destroy = free, __VA_ARGS__}

/* Defines the exported function, for one or more descriptors. */
#define FF_EXPORT_MODELS(...)                                                                      \
    const ff_model *const *flankfilm_models_v1(void)                                               \
    {                                                                                              \
        static const ff_model *const models[] = {__VA_ARGS__, NULL};                               \
        return models;                                                                             \
    }                                                                                              \
    FF_EXPORT const ff_model *const *flankfilm_models_v1(void)

#endif
