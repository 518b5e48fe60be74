/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "private.h"

#include "../memory/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

__attribute__((format(printf, 2, 3))) static void breach(verify_instance *instance,
                                                         const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (!instance->breach[0])
        vsnprintf(instance->breach, sizeof instance->breach, format, args);
    va_end(args);
}

static ff_status host_fail(void *ctx, ff_status status, const char *item, const char *text)
{
    verify_instance *instance = ctx;
    snprintf(instance->item, sizeof instance->item, "%s", item ? item : "");
    snprintf(instance->text, sizeof instance->text, "%s", text ? text : "");
    return status;
}

static void host_log(void *ctx, int32_t level, const char *text)
{
    (void)level;
    if (!text)
        breach(ctx, "logged no text");
}

/* Lengths that the rows of the stage share are the business of the caller. */
static double *host_output(void *ctx, uint32_t index, uint32_t rank, const size_t *shape)
{
    verify_instance *instance = ctx;
    const ff_model *model = instance->context->model;
    size_t count = 1;
    if (!instance->evaluating || index >= model->output_count) {
        breach(instance, "asked for memory of output row %u %s", index,
               instance->evaluating ? "which it does not have" : "outside of evaluate");
        return NULL;
    }
    const ff_dims *dims = &instance->context->loaded->output_dims[index];
    const char *name = ff_model_output(model, index)->name;
    if (instance->outputs[index].data)
        breach(instance, "gave the output \"%s\" twice", name);
    else if (rank > dims->rank || rank + dims->first_optional < dims->rank)
        breach(instance, "gave the output \"%s\" with %u dimensions", name, rank);
    for (uint32_t i = 0; i < rank && !instance->breach[0]; i++)
        count *= instance->shapes[index][i] = shape[i];
    if (instance->breach[0] || count > (size_t)1 << 27)
        return NULL;
    instance->ranks[index] = rank;
    instance->outputs[index] = verify_guarded_new(count);
    memset(instance->outputs[index].data, 0, count * sizeof(double));
    return instance->outputs[index].data;
}

static void host_quality(void *ctx, const char *name, double value, double limit, int32_t verdict,
                         const char *text)
{
    (void)value, (void)limit, (void)text;
    if (!name || !name[0] || verdict < FF_GOOD || verdict > FF_BAD)
        breach(ctx, "gave a quality line without a name or with an unknown verdict");
}

static int32_t host_progress(void *ctx, double fraction)
{
    verify_instance *instance = ctx;
    (void)fraction;
    if (instance->stop_at > 0 && verify_now() > instance->stop_at)
        instance->asked_to_stop = true;
    return instance->asked_to_stop;
}

/* A table that cannot be read is a failure of the instance, too. */
static ff_status table_status(verify_instance *instance, ff_status status)
{
    char why[300];
    if (status == FF_BUG)
        breach(instance,
               "asked for an impossible table, or reported a fault in one that it has not read");
    if (!instance->tables.errors)
        return status;
    ff_tables_print(&instance->tables, why, sizeof why);
    return host_fail(instance, status, instance->tables.item, why);
}

static ff_status table_read(void *ctx, const char *item, const char *path, const ff_param *rows,
                            size_t count, size_t stride, const ff_table **table)
{
    verify_instance *instance = ctx;
    return table_status(instance,
                        ff_tables_read(&instance->tables, item, path, rows, count, stride, table));
}

static ff_status table_fail(void *ctx, const ff_table *table, size_t row, size_t column,
                            const char *text)
{
    verify_instance *instance = ctx;
    return table_status(instance,
                        ff_tables_fail(&instance->tables, table, row, column, text ? text : ""));
}

static const void *host_extension(void *ctx, const char *id)
{
    static const ff_table_reader tables = {sizeof tables, table_read, table_fail};
    (void)ctx;
    return id && !strcmp(id, FF_TABLE_ID) ? &tables : NULL;
}

bool verify_is_wanted(const verify_instance *instance, size_t output)
{
    const ff_model *model = instance->context->model;
    if (output < 64)
        return instance->wanted >> output & 1;
    return instance->wanted == verify_data_outputs(model) &&
           !ff_model_output(model, output)->service;
}

static int32_t host_wanted(void *ctx, uint32_t output)
{
    verify_instance *instance = ctx;
    if (output < instance->context->model->output_count)
        return verify_is_wanted(instance, output);
    breach(instance, "asked whether output row %u is wanted, which it does not have", output);
    return 0;
}

static int32_t host_given(void *ctx, uint32_t param)
{
    verify_instance *instance = ctx;
    if (param < instance->context->model->param_count)
        return instance->values[param].size && instance->values[param].given;
    breach(instance, "asked whether parameter row %u was given, which it does not have", param);
    return 0;
}

static void host_serves(void *ctx, const char *item, const char *outputs, const char *by,
                        const char *text)
{
    (void)ctx, (void)item, (void)outputs, (void)by, (void)text; /* of no instance by itself */
}

static ff_status wire(verify_instance *instance, const verify_setup *setup)
{
    const ff_model *model = instance->context->model;
    ff_status status = FF_OK;
    for (size_t i = 0; i < model->input_count && model->wire && status == FF_OK; i++) {
        const char *service = ff_model_input(model, i)->service;
        const void *table = service ? setup->services[i] : NULL;
        if (table || (!service && setup->inputs[i].data))
            status = model->wire(instance->self, (uint32_t)i, table);
    }
    return status;
}

/* Fills in the members behind `place`, unless they are known to lie outside of the instance. */
static ff_status place(verify_instance *instance, const verify_setup *setup)
{
    const ff_model *model = instance->context->model;
    instance->room = verify_allocation_room(instance->self);
    if (!instance->self)
        breach(instance, "gave no instance to take its parameters");
    else if (instance->room && instance->room < model->self_size)
        breach(instance, "gives an instance of %zu bytes, but its self_size is %zu", instance->room,
               model->self_size);
    if (instance->breach[0])
        return FF_BUG;
    for (size_t i = 0; i < model->param_count; i++)
        if (ff_model_param(model, i)->place)
            ff_param_place(ff_model_param(model, i), instance->self,
                           setup->values[i].size ? &setup->values[i] : NULL);
    return FF_OK;
}

ff_status verify_instance_create(verify_instance *instance, const verify_setup *setup)
{
    const ff_model *model = setup->context->model;
    *instance = (verify_instance){
        .context = setup->context,
        .values = setup->values,
        .outputs = memory_alloc((model->output_count + 1) * sizeof *instance->outputs),
        .shapes = memory_alloc((model->output_count + 1) * sizeof *instance->shapes),
        .ranks = memory_alloc((model->output_count + 1) * sizeof *instance->ranks),
    };
    instance->host = (ff_host){.size = sizeof instance->host,
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
                               .serves = host_serves};
    ff_status status = model->create(&instance->host, &instance->self);
    instance->created = status == FF_OK;
    return status;
}

ff_status verify_instance_open(verify_instance *instance, const verify_setup *setup)
{
    const ff_model *model = setup->context->model;
    ff_status status = verify_instance_create(instance, setup);
    if (status == FF_OK && model->self_size)
        status = place(instance, setup);
    for (size_t i = 0; i < model->param_count && status == FF_OK; i++)
        if (setup->values[i].size && !ff_model_param(model, i)->place)
            status = model->set(instance->self, (uint32_t)i, &setup->values[i]);
    if (status == FF_OK)
        status = wire(instance, setup);
    const char *missing = verify_setup_missing(setup);
    if (status == FF_OK && missing) {
        snprintf(instance->text, sizeof instance->text, "%s is needed", missing);
        return FF_INVALID;
    }
    return status == FF_OK && model->ready ? model->ready(instance->self) : status;
}

static void forget(verify_instance *instance)
{
    for (size_t i = 0; instance->outputs && i < instance->context->model->output_count; i++)
        verify_guarded_free(&instance->outputs[i]);
}

ff_status verify_instance_evaluate(verify_instance *instance, uint64_t wanted,
                                   const verify_setup *setup)
{
    forget(instance);
    instance->text[0] = instance->item[0] = 0;
    instance->wanted = wanted;
    instance->evaluating = true;
    ff_status status = instance->context->model->evaluate(instance->self, wanted, setup->inputs);
    instance->evaluating = false;
    return status;
}

void verify_instance_close(verify_instance *instance)
{
    if (instance->created && instance->context->model->destroy)
        instance->context->model->destroy(instance->self);
    instance->created = false;
    ff_tables_free(&instance->tables);
    forget(instance);
    free(instance->outputs);
    free(instance->shapes);
    free(instance->ranks);
    instance->outputs = NULL;
    instance->shapes = NULL;
    instance->ranks = NULL;
}

verify_setup *verify_open_accepted(verify_context *context, verify_instance *instance, bool quietly)
{
    enum { TRIES = 400 };
    verify_setup *setup = context->given;
    for (int i = 0; i < TRIES; i++) {
        if (!context->given)
            setup = verify_setup_new(context);
        if (!context->given)
            verify_setup_draw_params(setup, &context->random, VERIFY_CALIBRATED);
        if (!context->given && verify_setup_lacks(setup)) {
            if (!quietly)
                verify_skip_lacking(setup);
            return NULL;
        }
        verify_step(context, "create, set and ready");
        if (verify_instance_open(instance, setup) == FF_OK)
            return setup;
        verify_instance_close(instance);
        if (context->given)
            break;
    }
    if (!quietly)
        verify_skip(context,
                    "no parameters were found that it accepts%s%s; --pipeline FILE gives some",
                    instance->text[0] ? ": " : "", instance->text);
    return NULL;
}

bool verify_outputs_agree(verify_context *c, const verify_instance *a, const verify_instance *b,
                          const char *when)
{
    for (size_t i = 0; i < c->model->output_count; i++) {
        const verify_guarded *x = &a->outputs[i], *y = &b->outputs[i];
        if (!x->data && !y->data)
            continue;
        if (!x->data || !y->data || x->count != y->count ||
            memcmp(x->data, y->data, x->count * sizeof(double)) != 0)
            return verify_fail(c, "the output \"%s\" differs %s",
                               ff_model_output(c->model, i)->name, when);
    }
    return true;
}
