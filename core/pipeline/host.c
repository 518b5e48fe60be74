/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a model may call, and what its calls come to. */
#include "build.h"

#include "../plugin/clean.h"
#include "../plugin/guard.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_QUALITY = 1000 };

/* The first breach of the interface is the one to tell. */
__attribute__((format(printf, 2, 3))) static void breach(ff_instance *instance, const char *format,
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
    ff_instance *instance = ctx;
    ff_clean_text(instance->item, sizeof instance->item, item ? item : "");
    ff_clean_text(instance->text, sizeof instance->text, text ? text : "");
    return status;
}

/* A fault in what the program makes of a log line or of progress is not the plugin's. */
static void host_log(void *ctx, int32_t level, const char *text)
{
    ff_instance *instance = ctx;
    char clean[512];
    ff_clean_text(clean, sizeof clean, text ? text : "");
    ff_guard_mark mark = ff_guard_enter(NULL, NULL, NULL);
    if (instance->watch && instance->watch->log)
        instance->watch->log(instance->watch->ctx, instance->stage, level, clean);
    ff_guard_leave(mark);
}

static int32_t host_progress(void *ctx, double fraction)
{
    ff_instance *instance = ctx;
    int stop = 0;
    double share = fraction > 0 ? fmin(fraction, 1) : 0;
    ff_guard_mark mark = ff_guard_enter(NULL, NULL, NULL);
    if (instance->watch && instance->watch->progress)
        stop = instance->watch->progress(instance->watch->ctx, instance->stage, share);
    ff_guard_leave(mark);
    return stop;
}

static const void *host_extension(void *ctx, const char *id)
{
    (void)ctx, (void)id;
    return NULL;
}

/* The machine's memory bounds what can be asked for; more is a mistake in a shape. */
static size_t most_numbers(void)
{
    long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
    return pages > 0 && bytes > 0 ? (size_t)pages * ((size_t)bytes / sizeof(double))
                                  : SIZE_MAX / sizeof(double) / 2;
}

static bool count_numbers(uint32_t rank, const size_t *shape, size_t *count)
{
    size_t most = most_numbers();
    *count = 1;
    for (uint32_t i = 0; i < rank; i++)
        if (shape[i] == 0)
            *count = 0;
    for (uint32_t i = 0; i<rank && * count> 0; i++) {
        if (shape[i] > most / *count)
            return false;
        *count *= shape[i];
    }
    return true;
}

static double *host_output(void *ctx, uint32_t index, uint32_t rank, const size_t *shape)
{
    ff_instance *instance = ctx;
    const ff_loaded *loaded = instance->stage->loaded;
    if (!instance->evaluating || index >= loaded->model->output_count) {
        breach(instance, "asked for memory of output row %u %s", index,
               instance->evaluating ? "which it does not have" : "outside of evaluate");
        return NULL;
    }
    ff_result *result = &instance->stage->results[index];
    const ff_dims *dims = &loaded->output_dims[index];
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

static void host_quality(void *ctx, const char *name, double value, double limit, int32_t verdict,
                         const char *text)
{
    ff_instance *instance = ctx;
    ff_stage *stage = instance->stage;
    char clean[512];
    if (!name || !name[0] || verdict < FF_GOOD || verdict > FF_BAD) {
        breach(instance, "gave a quality line without a name or with the unknown verdict %d",
               verdict);
        return;
    }
    if (stage->quality_count == MOST_QUALITY) {
        breach(instance, "gave more than %d quality lines", MOST_QUALITY);
        return;
    }
    if (stage->quality_count == instance->quality_room) {
        instance->quality_room = 2 * instance->quality_room + 8;
        stage->quality = ff_resize(stage->quality, instance->quality_room * sizeof *stage->quality);
    }
    ff_quality *line = &stage->quality[stage->quality_count++];
    *line = (ff_quality){.value = value, .limit = limit, .verdict = verdict};
    ff_clean_text(clean, sizeof clean, name);
    line->name = ff_print_text("%s", clean);
    if (text && text[0]) {
        ff_clean_text(clean, sizeof clean, text);
        line->text = ff_print_text("%s", clean);
    }
}

void ff_host_init(ff_instance *instance)
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
    };
}

void ff_forget_results(ff_stage *stage)
{
    for (size_t i = 0; stage->results && i < stage->loaded->model->output_count; i++) {
        ff_result *result = &stage->results[i];
        free(result->data);
        result->data = NULL;
        result->rank = 0;
        result->count = 0;
    }
    for (size_t i = 0; i < stage->quality_count; i++) {
        free(stage->quality[i].name);
        free(stage->quality[i].text);
    }
    stage->quality_count = 0;
}

void ff_instance_hush(ff_instance *instance)
{
    instance->item[0] = instance->text[0] = instance->fault[0] = 0;
}

ff_place ff_item_place(const ff_stage *stage, const char *item, const char **name)
{
    const ff_model *model = stage->loaded->model;
    int param = ff_model_find_param(model, item);
    *name = item;
    if (param >= 0) {
        ff_place place = stage->params[param].place;
        return place.source ? place : stage->place;
    }
    for (size_t i = 0; i < stage->wire_count; i++) {
        const ff_wire *wire = &stage->wires[i];
        size_t length = strlen(wire->name);
        if (!strncmp(item, wire->name, length) && (!item[length] || item[length] == '.'))
            return wire->place;
    }
    if (ff_model_find_output(model, item) < 0)
        *name = NULL;
    return stage->place;
}

typedef struct verdict {
    int exit_code;
    const char *reason; /* when the model gives none */
} verdict;

static verdict verdict_on(ff_status status)
{
    switch (status) {
    case FF_NOCONV:
        return (verdict){FF_EXIT_FAILED, "it found no solution, and gave no reason"};
    case FF_STOPPED:
        return (verdict){FF_EXIT_FAILED, "it was stopped"};
    case FF_NOMEM:
        return (verdict){FF_EXIT_FAILED, "it ran out of memory"};
    case FF_INVALID:
        return (verdict){FF_EXIT_INPUT,
                         "it cannot use a parameter or an input, and gave no reason"};
    case FF_UNSUPPORTED:
        return (verdict){FF_EXIT_INPUT, "it does not serve this request, and gave no reason"};
    default:
        return (verdict){FF_EXIT_PLUGIN, "and gave no reason"};
    }
}

bool ff_judge(const ff_stage *stage, const char *action, ff_status status, ff_report *report)
{
    const ff_instance *instance = stage->instance;
    const char *path = stage->loaded->path, *name = NULL;
    ff_place place = stage->place;
    verdict v = verdict_on(status);
    const char *text = instance->text[0] ? instance->text : v.reason;
    if (instance->fault[0])
        return ff_error(report, FF_EXIT_PLUGIN, stage->use_place, NULL, "%s: the plugin %s %s",
                        stage->name, path, instance->fault);
    if (status == FF_OK)
        return true;
    if (instance->item[0])
        place = ff_item_place(stage, instance->item, &name);
    if (status == FF_DOMAIN) {
        ff_warn(report, place, "%s: %s", stage->name,
                instance->text[0] ? instance->text
                                  : "values were computed outside the range of the model");
        return true;
    }
    if (v.exit_code == FF_EXIT_PLUGIN && status == FF_BUG)
        return ff_error(report, FF_EXIT_PLUGIN, stage->use_place, NULL,
                        "%s: the plugin %s found a fault of its own during %s: %s", stage->name,
                        path, action, text);
    if (v.exit_code == FF_EXIT_PLUGIN)
        return ff_error(report, FF_EXIT_PLUGIN, stage->use_place, NULL,
                        "%s: the plugin %s gave the unknown status %d during %s: %s", stage->name,
                        path, status, action, text);
    return ff_error(report, v.exit_code, place, NULL, "%s%s%s (%s): %s", stage->name,
                    name ? "." : "", name ? name : "", stage->use, text);
}
