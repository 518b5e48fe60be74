/* SPDX-License-Identifier: MIT */
/* The host functions that a model may call. */
#include "build.h"

#include <flankfilm/estimates.h>
#include <flankfilm/needs.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    MOST_QUALITY = 1000,
    MOST_NEEDS = 1000,
    FE_LEAVE = 2 /* result of the observer that skips a stage */
};

/* Stores the first violation of the interface, for the message. */
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
    ff_clean_text(instance->item, sizeof instance->item, item ? item : "");
    ff_clean_text(instance->text, sizeof instance->text, text ? text : "");
    return status;
}

static ff_status protect(fe_instance *instance, void (*function)(void *ctx), void *ctx);

typedef struct watch_call {
    fe_instance *instance;
    fe_log_line line;
    double fraction;
    int stop;
} watch_call;

static void log_line(void *ctx)
{
    const watch_call *call = ctx;
    const ff_observer *watch = call->instance->watch;
    fe_loop_stage *m = call->instance->member;
    if (m) {
        m->lines = fe_resize(m->lines, (m->line_count + 1) * sizeof *m->lines);
        m->lines[m->line_count++] = call->line;
    } else if (watch && watch->log) {
        watch->log(watch->ctx, call->instance->stage, call->line.level, call->line.text);
    }
}

static void host_log(void *ctx, int32_t level, const char *text)
{
    fe_instance *instance = ctx;
    watch_call call = {.instance = instance, .line = {.level = level}};
    ff_clean_text(call.line.text, sizeof call.line.text, text ? text : "");
    protect(instance, log_line, &call);
}

static void report_progress(void *ctx)
{
    watch_call *call = ctx;
    const ff_observer *watch = call->instance->watch;
    if (watch && watch->progress)
        call->stop = watch->progress(watch->ctx, call->instance->stage, call->fraction);
}

static int32_t host_progress(void *ctx, double fraction)
{
    fe_instance *instance = ctx;
    watch_call call = {.instance = instance,
                       .fraction = fraction > 0 ? fmin(fraction, 1) : 0}; /* NaN gives 0 */
    bool lacks = protect(instance, report_progress, &call) == FF_NOMEM;
    instance->left = instance->left || call.stop == FE_LEAVE;
    return lacks || call.stop;
}

/* Runs engine code that allocates memory or calls the program, so that a fault in it is not
   attributed to the plugin. The engine code must not jump across the plugin's frames, which may be
   on another thread. If memory is missing, the call fails when the plugin returns. */
static ff_status protect(fe_instance *instance, void (*function)(void *ctx), void *ctx)
{
    ff_guard_mark mark = fe_guard_enter((ff_guard_mark){.path = NULL});
    ff_status status = fe_protected(instance->heap, function, ctx);
    fe_guard_leave(mark);
    instance->no_memory = instance->no_memory || status == FF_NOMEM;
    return status;
}

typedef struct table_call {
    fe_tables *tables;
    const char *item, *text; /* the path, or the error text */
    const ff_param *rows;
    size_t count, stride;
    const ff_table *table;
    size_t row, column;
    ff_status status;
} table_call;

static void read_table(void *ctx)
{
    table_call *call = ctx;
    call->status = fe_tables_read(call->tables, call->item, call->text, call->rows, call->count,
                                  call->stride, &call->table);
}

static ff_status table_read(void *ctx, const char *item, const char *path, const ff_param *rows,
                            size_t count, size_t stride, const ff_table **table)
{
    fe_instance *instance = ctx;
    table_call call = {.tables = &instance->tables,
                       .item = item,
                       .text = path,
                       .rows = rows,
                       .count = count,
                       .stride = stride};
    ff_status status = protect(instance, read_table, &call);
    *table = status == FF_OK ? call.table : NULL;
    return status == FF_OK ? call.status : status;
}

static void fail_table(void *ctx)
{
    table_call *call = ctx;
    call->status = fe_tables_fail(call->tables, call->table, call->row, call->column, call->text);
}

static ff_status table_fail(void *ctx, const ff_table *table, size_t row, size_t column,
                            const char *text)
{
    fe_instance *instance = ctx;
    char clean[512];
    ff_clean_text(clean, sizeof clean, text ? text : "");
    table_call call = {
        .tables = &instance->tables, .text = clean, .table = table, .row = row, .column = column};
    ff_status status = protect(instance, fail_table, &call);
    if (status == FF_OK && call.status == FF_BUG)
        breach(instance, "named a table that it has not read");
    return status == FF_OK ? call.status : status;
}

static int32_t host_wanted(void *ctx, uint32_t output)
{
    fe_instance *instance = ctx;
    if (output < instance->stage->loaded->model->output_count)
        return instance->stage->results[output].wanted;
    breach(instance, "asked whether output row %u is wanted, but has no such row", output);
    return 0;
}

static int32_t host_given(void *ctx, uint32_t param)
{
    fe_instance *instance = ctx;
    if (param < instance->stage->loaded->model->param_count)
        return instance->stage->params[param].present && instance->stage->params[param].value.given;
    breach(instance, "asked whether parameter row %u was given, but has no such row", param);
    return 0;
}

/* Whether the model has a parameter, a table column ("file.time"), an input or a wire with that
   name. */
static bool has_item(const ff_model *model, const char *item)
{
    if (ff_model_find_param(model, item) >= 0 || fe_find_table(model, item) >= 0)
        return true;
    for (size_t i = 0; i < model->input_count; i++)
        if (fe_is_on_wire(ff_model_input(model, i)->name, item))
            return true;
    return false;
}

/* Returns the first word of the list that is not an output; NULL: there is none. */
static const char *unknown_output(const ff_model *model, const char *list, char *word, size_t size)
{
    for (const char *at = list; *at; at += *at == '|') {
        size_t length = strcspn(at, "|");
        snprintf(word, size, "%.*s", (int)length, at);
        if (ff_model_find_output(model, word) < 0)
            return word;
        at += length;
    }
    return NULL;
}

typedef struct serves_call {
    fe_instance *instance;
    const char *item, *outputs, *by, *text;
} serves_call;

static void free_serving(fe_serving *serving)
{
    fe_free(serving->item);
    fe_free(serving->outputs);
    fe_free(serving->by);
    fe_free(serving->text);
}

/* Stores which outputs an item affects. A later call for the same item replaces it. */
static void keep_serving(void *ctx)
{
    const serves_call *call = ctx;
    fe_instance *instance = call->instance;
    size_t i = 0;
    while (i < instance->serving_count && strcmp(instance->servings[i].item, call->item) != 0)
        i++;
    fe_serving serving = {.item = fe_copy_clean(call->item),
                          .outputs = fe_copy_clean(call->outputs),
                          .by = fe_copy_clean(call->by),
                          .text = fe_copy_clean(call->text)};
    if (i < instance->serving_count) {
        free_serving(&instance->servings[i]);
    } else {
        instance->servings = fe_resize(instance->servings, (i + 1) * sizeof *instance->servings);
        instance->serving_count++;
    }
    instance->servings[i] = serving;
}

static void host_serves(void *ctx, const char *item, const char *outputs, const char *by,
                        const char *text)
{
    fe_instance *instance = ctx;
    const ff_model *model = instance->stage->loaded->model;
    serves_call call = {instance, item ? item : "", outputs ? outputs : "", by, text};
    char word[96];
    const char *wrong = unknown_output(model, call.outputs, word, sizeof word);
    if (!has_item(model, call.item))
        breach(instance, "stated what \"%.60s\" serves, but has no such item", call.item);
    else if (by && !has_item(model, by))
        breach(instance, "stated that \"%.60s\" is replaced by \"%.60s\", but has no such item",
               call.item, by);
    else if (wrong)
        breach(instance,
               "stated that \"%.60s\" serves the output \"%.60s\", but has no such output",
               call.item, wrong);
    else
        protect(instance, keep_serving, &call);
}

typedef struct needs_call {
    fe_instance *instance;
    const char *items, *outputs, *text;
} needs_call;

static void keep_need(void *ctx)
{
    const needs_call *call = ctx;
    fe_instance *instance = call->instance;
    size_t count = instance->need_count;
    instance->needs = fe_resize(instance->needs, (count + 1) * sizeof *instance->needs);
    instance->needs[count] = (fe_need){.items = fe_copy_clean(call->items),
                                       .outputs = fe_copy_clean(call->outputs),
                                       .text = fe_copy_clean(call->text)};
    instance->need_count++;
}

/* Returns the first word of the list that is no parameter, input or wire; NULL: there is none. */
static const char *unknown_item(const ff_model *model, const char *list, char *word, size_t size)
{
    for (const char *at = list; *at; at += *at == '|') {
        size_t length = strcspn(at, "|");
        snprintf(word, size, "%.*s", (int)length, at);
        if (!has_item(model, word))
            return word;
        at += length;
    }
    return NULL;
}

static void host_needs(void *ctx, const char *items, const char *outputs, const char *text)
{
    fe_instance *instance = ctx;
    const ff_model *model = instance->stage->loaded->model;
    needs_call call = {instance, items ? items : "", outputs ? outputs : "", text ? text : ""};
    char word[96];
    const char *item = unknown_item(model, call.items, word, sizeof word);
    if (item) {
        breach(instance, "stated that it needs \"%.60s\", but has no such item", item);
        return;
    }
    const char *output = unknown_output(model, call.outputs, word, sizeof word);
    if (output)
        breach(instance, "stated what the output \"%.60s\" needs, but has no such output", output);
    else if (instance->need_count == MOST_NEEDS)
        breach(instance, "stated more than %d times what outputs need", MOST_NEEDS);
    else
        protect(instance, keep_need, &call);
}

static int32_t host_reads_estimates(void *ctx)
{
    const fe_instance *instance = ctx;
    return !instance->stage->unread;
}

static const void *host_extension(void *ctx, const char *id)
{
    static const ff_table_reader tables = {sizeof tables, table_read, table_fail};
    static const ff_needs needs = {sizeof needs, host_needs};
    static const ff_estimates estimates = {sizeof estimates, host_reads_estimates};
    (void)ctx;
    return !id                            ? NULL
           : !strcmp(id, FF_TABLE_ID)     ? (const void *)&tables
           : !strcmp(id, FF_NEEDS_ID)     ? (const void *)&needs
           : !strcmp(id, FF_ESTIMATES_ID) ? &estimates
                                          : NULL;
}

void fe_forget_servings(fe_instance *instance)
{
    for (size_t i = 0; i < instance->need_count; i++) {
        fe_free(instance->needs[i].items);
        fe_free(instance->needs[i].outputs);
        fe_free(instance->needs[i].text);
    }
    fe_free(instance->needs);
    instance->needs = NULL;
    instance->need_count = 0;
    for (size_t i = 0; i < instance->serving_count; i++)
        free_serving(&instance->servings[i]);
    fe_free(instance->servings);
    instance->servings = NULL;
    instance->serving_count = 0;
}

/* False if the array would exceed the machine's memory; its shape must then be wrong. */
static bool has_room(uint32_t rank, const size_t *shape)
{
    const double surely = 1e6; /* this many certainly fit */
    double product = 1;
    for (uint32_t i = 0; i < rank; i++)
        product *= (double)shape[i];
    if (product <= surely)
        return true;
    double pages = (double)sysconf(_SC_PHYS_PAGES);
    return product <= pages * (double)sysconf(_SC_PAGESIZE) / sizeof(double);
}

double *ff_result_fill(ff_stage *stage, size_t output, uint32_t rank, const size_t *shape)
{
    ff_result *result = &stage->results[output];
    const ff_dims *dims = &stage->loaded->output_dims[output];
    uint32_t absent = dims->first_optional && rank < dims->rank;
    size_t count = 1;
    for (uint32_t i = 0; i < rank; i++) {
        count *= result->shape[i] = shape[i];
        result->dims[i] = dims->name[i + absent];
    }
    double *data = ff_guarded_new(count);
    result->rank = rank;
    result->count = count;
    result->data = data;
    return data;
}

typedef struct output_call {
    ff_stage *stage;
    uint32_t index, rank;
    const size_t *shape;
    double *data;
} output_call;

static void fill_result(void *ctx)
{
    output_call *call = ctx;
    call->data = ff_result_fill(call->stage, call->index, call->rank, call->shape);
}

static double *host_output(void *ctx, uint32_t index, uint32_t rank, const size_t *shape)
{
    fe_instance *instance = ctx;
    const ff_loaded *loaded = instance->stage->loaded;
    if (!instance->evaluating || index >= loaded->model->output_count) {
        breach(instance, "asked for memory of output row %u%s", index,
               instance->evaluating ? ", but has no such row" : " outside of evaluate");
        return NULL;
    }
    const ff_result *result = &instance->stage->results[index];
    const ff_dims *dims = &loaded->output_dims[index];
    const char *name = result->row->name;
    output_call call = {.stage = instance->stage, .index = index, .rank = rank, .shape = shape};
    if (result->row->service)
        breach(instance, "asked for memory of the service \"%s\"", name);
    else if (result->data)
        breach(instance, "gave the output \"%s\" twice", name);
    else if (!fe_rank_fits(dims, rank) || (rank && !shape))
        breach(instance, "gave the output \"%s\" with %u dimensions, but its row says \"%s\"", name,
               rank, result->row->dims);
    else if (!has_room(rank, shape) ||
             fe_protected(instance->heap, fill_result, &call) == FF_NOMEM) {
        instance->no_room = true;
        if (!instance->text[0])
            snprintf(instance->text, sizeof instance->text,
                     "there is not enough memory for the output \"%s\"", name);
    }
    const bool knows = loaded->model->abi_minor >= 3; /* before 1.3, all memory was zeroed */
    for (size_t k = 0; call.data && knows && !result->wanted && k < result->count; k++)
        call.data[k] = NAN;
    return call.data;
}

typedef struct quality_call {
    ff_stage *stage;
    const char *name, *text;
    double value, limit;
    int verdict;
} quality_call;

static void add_quality(void *ctx)
{
    const quality_call *call = ctx;
    ff_add_quality(call->stage, call->name, call->value, call->limit, call->verdict, call->text);
}

static void host_quality(void *ctx, const char *name, double value, double limit, int32_t verdict,
                         const char *text)
{
    fe_instance *instance = ctx;
    ff_stage *stage = instance->stage;
    if (!name || !name[0] || verdict < FF_GOOD || verdict > FF_RANGE) {
        breach(instance, "gave a quality line without a name or with the unknown verdict %d",
               verdict);
    } else if (stage->quality_count == MOST_QUALITY) {
        breach(instance, "gave more than %d quality lines", MOST_QUALITY);
    } else {
        quality_call call = {stage, name, text, value, limit, verdict};
        protect(instance, add_quality, &call);
    }
}

void fe_host_init(fe_instance *instance)
{
    instance->heap = fe_heap_in_use();
    instance->no_memory = false;
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
        .serves = host_serves,
    };
}

void fe_forget_results(ff_stage *stage)
{
    for (size_t i = 0; stage->results && i < stage->loaded->model->output_count; i++) {
        ff_guarded_free(stage->results[i].data, stage->results[i].count);
        stage->results[i].data = NULL;
    }
    fe_forget_quality(stage);
}
