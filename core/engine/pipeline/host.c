/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of the host that a model may call. */
#include "build.h"

#include "../plugin/clean.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_QUALITY = 1000 };

/* Keeps the first breach of the interface for the message. */
__attribute__((format(printf, 2, 3))) static void breach(fe_instance *instance, const char *format,
                                                         ...)
{
    va_list args;
    va_start(args, format);
    if (!instance->fault[0])
        vsnprintf(instance->fault, sizeof instance->fault, format, args);
    va_end(args);
}

static ff_status host_fail(void *ctx, ff_status status, const char *item, const char *text)
{
    fe_instance *instance = ctx;
    fe_tables_forget(&instance->tables);
    fe_clean_text(instance->item, sizeof instance->item, item ? item : "");
    fe_clean_text(instance->text, sizeof instance->text, text ? text : "");
    return status;
}

/* The watch belongs to the program: a fault in it is not the plugin's. */
static void host_log(void *ctx, int32_t level, const char *text)
{
    fe_instance *instance = ctx;
    char clean[512];
    fe_clean_text(clean, sizeof clean, text ? text : "");
    fe_guard_mark mark = fe_guard_enter(NULL, NULL, NULL);
    if (instance->watch && instance->watch->log)
        instance->watch->log(instance->watch->ctx, instance->stage, level, clean);
    fe_guard_leave(mark);
}

static int32_t host_progress(void *ctx, double fraction)
{
    fe_instance *instance = ctx;
    int stop = 0;
    double share = fraction > 0 ? fmin(fraction, 1) : 0; /* NaN: 0 */
    fe_guard_mark mark = fe_guard_enter(NULL, NULL, NULL);
    if (instance->watch && instance->watch->progress)
        stop = instance->watch->progress(instance->watch->ctx, instance->stage, share);
    fe_guard_leave(mark);
    return stop;
}

static ff_status table_read(void *ctx, const char *item, const char *path, const ff_param *rows,
                            size_t count, size_t stride, const ff_table **table)
{
    fe_instance *instance = ctx;
    fe_guard_mark mark = fe_guard_enter(NULL, NULL, NULL);
    ff_status status = fe_tables_read(&instance->tables, item, path, rows, count, stride, table);
    fe_guard_leave(mark);
    return status;
}

static ff_status table_fail(void *ctx, const ff_table *table, size_t row, size_t column,
                            const char *text)
{
    fe_instance *instance = ctx;
    char clean[512];
    fe_clean_text(clean, sizeof clean, text ? text : "");
    fe_guard_mark mark = fe_guard_enter(NULL, NULL, NULL);
    ff_status status = fe_tables_fail(&instance->tables, table, row, column, clean);
    fe_guard_leave(mark);
    if (status == FF_BUG)
        breach(instance, "named a table that it has not read");
    return status;
}

static const void *host_extension(void *ctx, const char *id)
{
    static const ff_table_reader tables = {sizeof tables, table_read, table_fail};
    (void)ctx;
    return id && !strcmp(id, FF_TABLE_ID) ? &tables : NULL;
}

static int32_t host_wanted(void *ctx, uint32_t output)
{
    fe_instance *instance = ctx;
    if (output < instance->stage->loaded->model->output_count)
        return instance->stage->results[output].wanted;
    breach(instance, "asked whether output row %u is wanted, which it does not have", output);
    return 0;
}

static int32_t host_given(void *ctx, uint32_t param)
{
    fe_instance *instance = ctx;
    if (param < instance->stage->loaded->model->param_count)
        return instance->stage->params[param].present && instance->stage->params[param].value.given;
    breach(instance, "asked whether parameter row %u was given, which it does not have", param);
    return 0;
}

/* False for more numbers than the memory of the machine holds: the shape is wrong. */
static bool count_numbers(uint32_t rank, const size_t *shape, size_t *count)
{
    double most = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE) / sizeof(double);
    double product = 1;
    *count = 1;
    for (uint32_t i = 0; i < rank; i++) {
        product *= (double)shape[i];
        *count *= shape[i];
    }
    return product <= most;
}

static double *host_output(void *ctx, uint32_t index, uint32_t rank, const size_t *shape)
{
    fe_instance *instance = ctx;
    const fe_loaded *loaded = instance->stage->loaded;
    if (!instance->evaluating || index >= loaded->model->output_count) {
        breach(instance, "asked for memory of output row %u %s", index,
               instance->evaluating ? "which it does not have" : "outside of evaluate");
        return NULL;
    }
    fe_result *result = &instance->stage->results[index];
    const fe_dims *dims = &loaded->output_dims[index];
    const char *name = result->row->name;
    size_t count;
    if (result->row->service)
        breach(instance, "asked for memory of the service \"%s\"", name);
    else if (result->data)
        breach(instance, "gave the output \"%s\" twice", name);
    else if (rank > dims->rank || rank + dims->first_optional < dims->rank || (rank && !shape))
        breach(instance, "gave the output \"%s\" with %u dimensions, but its row says \"%s\"", name,
               rank, result->row->dims);
    else if (!count_numbers(rank, shape, &count) ||
             !(result->data = calloc(count ? count : 1, sizeof *result->data))) {
        if (!instance->text[0])
            snprintf(instance->text, sizeof instance->text,
                     "there is not enough memory for the output \"%s\"", name);
    } else {
        result->rank = rank;
        result->count = count;
        for (uint32_t i = 0; i < rank; i++)
            result->shape[i] = shape[i];
    }
    return result->data;
}

static char *clean_copy(const char *text)
{
    char clean[512];
    fe_clean_text(clean, sizeof clean, text);
    return fe_print_text("%s", clean);
}

void fe_add_quality(fe_stage *stage, const char *name, double value, double limit, int verdict,
                    const char *text)
{
    stage->quality = fe_resize(stage->quality, (stage->quality_count + 1) * sizeof *stage->quality);
    stage->quality[stage->quality_count++] =
        (fe_quality){.name = clean_copy(name),
                     .value = value,
                     .limit = limit,
                     .verdict = verdict,
                     .text = text && text[0] ? clean_copy(text) : NULL};
}

static void host_quality(void *ctx, const char *name, double value, double limit, int32_t verdict,
                         const char *text)
{
    fe_instance *instance = ctx;
    fe_stage *stage = instance->stage;
    if (!name || !name[0] || verdict < FF_GOOD || verdict > FF_BAD) {
        breach(instance, "gave a quality line without a name or with the unknown verdict %d",
               verdict);
    } else if (stage->quality_count == MOST_QUALITY) {
        breach(instance, "gave more than %d quality lines", MOST_QUALITY);
    } else {
        fe_add_quality(stage, name, value, limit, verdict, text);
    }
}

void fe_host_init(fe_instance *instance)
{
    instance->host = (ff_host){
        .size = sizeof instance->host,
        .abi_minor = FF_ABI_MINOR,
        .ctx = instance,
        .fail = host_fail,
        .log = host_log,
        .output = host_output,
        .quality = host_quality,
        .progress = host_progress,
        .extension = host_extension,
        .wanted = host_wanted,
        .given = host_given,
    };
}

void fe_forget_results(fe_stage *stage)
{
    for (size_t i = 0; stage->results && i < stage->loaded->model->output_count; i++) {
        free(stage->results[i].data);
        stage->results[i].data = NULL;
    }
    for (size_t i = 0; i < stage->quality_count; i++) {
        free(stage->quality[i].name);
        free(stage->quality[i].text);
    }
    free(stage->quality);
    stage->quality = NULL;
    stage->quality_count = 0;
}
