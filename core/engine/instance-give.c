/* SPDX-License-Identifier: MIT */
/* Gives an instance its parameter values, its arrays, and the other instances on its wires. */
#include "instance.h"

#include "plugin/param.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

/* Returns the row of the parameter; -1 after an error. */
static int find_param(ff_instance *i, const char *name)
{
    const ff_model *model = i->stage.loaded->model;
    int row = ff_model_find_param(model, name);
    if (row >= 0)
        return row;
    const char **names = fe_alloc((model->param_count + 1) * sizeof *names);
    for (size_t k = 0; k < model->param_count; k++)
        names[k] = ff_model_param(model, k)->name;
    fe_refuse_name(i, "parameter", name, names, model->param_count);
    fe_free(names);
    return -1;
}

/* Stores the value of the parameter, and drops the values of the others in its group. */
static void keep(ff_instance *i, size_t row, ff_value value)
{
    assert(row < i->stage.loaded->model->param_count);
    const ff_model *model = i->stage.loaded->model;
    const char *group = ff_model_param(model, row)->group;
    fe_drop_object(i);
    for (size_t k = 0; k < model->param_count; k++) {
        const char *other = ff_model_param(model, k)->group;
        if (k == row || (value.size && group && other && !strcmp(group, other))) {
            ff_value_clear(&i->given[k]);
            i->given[k].size = 0;
        }
    }
    i->given[row] = value;
}

static bool set(fe_request *q)
{
    ff_instance *i = q->instance;
    int row = find_param(i, q->name);
    ff_value value = {.size = 0};
    if (row < 0)
        return false;
    const ff_param *param = ff_model_param(i->stage.loaded->model, (size_t)row);
    const ff_unit *unit = &i->stage.loaded->param_units[row];
    if (!i->names[row])
        i->names[row] = fe_pipeline_print(&i->pipeline, "%s.%s", i->stage.name, param->name);
    const char *name = i->names[row];
    if ((q->text && !fe_param_read_text(param, unit, name, q->text, &value, i->report)) ||
        (q->si && !fe_param_take(param, unit, name, q->si, q->count, &value, i->report))) {
        snprintf(i->item, sizeof i->item, "%s", param->name);
        return false;
    }
    keep(i, (size_t)row, value);
    return true;
}

ff_status ff_instance_set(ff_instance *instance, const char *param, const char *text)
{
    if (!instance || !param)
        return fe_absent(instance, "param");
    return fe_handle(&(fe_request){.instance = instance, .work = set, .name = param, .text = text});
}

ff_status ff_instance_set_reals(ff_instance *instance, const char *param, const double *si,
                                size_t count)
{
    static const double none;
    if (!instance || !param)
        return fe_absent(instance, "param");
    return fe_handle(&(fe_request){.instance = instance,
                                   .work = set,
                                   .name = param,
                                   .si = si ? si : &none,
                                   .count = si ? count : 0});
}

/* Connects a feed to an input; the input then owns the array of the feed. If only the array
   changes, the object is kept: a model depends on whether an array is connected, but not on its
   content. */
static void connect(ff_instance *i, size_t input, fe_feed feed)
{
    assert(input < i->stage.loaded->model->input_count);
    fe_feed *old = &i->feeds[input];
    bool fed = fe_is_fed(old), serves = ff_model_input(i->stage.loaded->model, input)->service;
    if (serves || fed != fe_is_fed(&feed))
        fe_drop_object(i);
    ff_guarded_free(old->array.data, fe_count(&old->array));
    *old = feed;
    old->array.shape = old->shape;
    i->stage.ran = false;
}

static bool give(fe_request *q)
{
    ff_instance *i = q->instance;
    const ff_model *model = i->stage.loaded->model;
    int input = ff_model_find_input(model, q->name);
    const ff_array *array = q->array;
    fe_feed feed = {.from = NULL};
    size_t count = 1;
    if (input < 0 || ff_model_input(model, (size_t)input)->service)
        return fe_refuse(i, q->name, "it has no input \"%.80s\" that takes an array", q->name);
    const ff_dims *dims = &i->stage.loaded->input_dims[input];
    if (!array || !array->data) {
        connect(i, (size_t)input, feed);
        return true;
    }
    if (!fe_rank_fits(dims, array->rank))
        return fe_refuse(i, q->name,
                         "an array of %u dimensions is given for \"%s\"; it takes \"%s\"",
                         array->rank, q->name, ff_model_input(model, (size_t)input)->dims);
    for (uint32_t k = 0; k < array->rank; k++) {
        feed.shape[k] = array->shape ? array->shape[k] : SIZE_MAX;
        if (__builtin_mul_overflow(count, feed.shape[k], &count)) {
            count = SIZE_MAX;
            break;
        }
    }
    if (array->rank && count > PTRDIFF_MAX / sizeof *feed.array.data)
        return fe_refuse(i, q->name, "the array for \"%s\" has an impossible number of elements",
                         q->name);
    double *copy = ff_guarded_new(count);
    if (count)
        memcpy(copy, array->data, count * sizeof *copy);
    feed.array = (ff_array){.data = copy, .rank = array->rank};
    connect(i, (size_t)input, feed);
    return true;
}

ff_status ff_instance_give(ff_instance *instance, const char *input, const ff_array *array)
{
    if (!instance || !input)
        return fe_absent(instance, "input");
    return fe_handle(
        &(fe_request){.instance = instance, .work = give, .name = input, .array = array});
}

static bool uses(const ff_instance *i, const ff_instance *other)
{
    bool found = i == other;
    for (size_t k = 0; k < i->stage.loaded->model->input_count && !found; k++)
        found = i->feeds[k].from && uses(i->feeds[k].from, other);
    return found;
}

/* Connects an output or service of the other instance, or disconnects the input. */
static bool use(fe_request *q)
{
    ff_instance *i = q->instance, *from = q->other;
    const ff_model *model = i->stage.loaded->model;
    fe_build b = {.pipeline = &i->pipeline, .report = i->report};
    bool known = false;
    for (size_t k = 0; k < model->input_count; k++)
        known = known || fe_is_on_wire(ff_model_input(model, k)->name, q->name);
    if (!known)
        return fe_refuse(i, q->name, "it has no wire \"%.80s\"", q->name);
    if (from && from->engine != i->engine)
        return fe_refuse(i, q->name, "%s belongs to another engine", from->stage.use);
    if (from && uses(from, i))
        return fe_refuse(i, q->name, "%s cannot feed it, since it uses it", from->stage.use);
    const char *why = from ? fe_wire_misfit(&b, &i->stage, q->name, from->stage.loaded) : NULL;
    if (why)
        return fe_refuse(i, q->name, "%s cannot feed its wire \"%s\": it %s", from->stage.use,
                         q->name, why);
    for (size_t k = 0; k < model->input_count; k++) {
        const ff_port *row = ff_model_input(model, k);
        if (!fe_is_on_wire(row->name, q->name))
            continue;
        int output = from ? fe_find_offer(from->stage.loaded, row) : -1;
        connect(i, k, (fe_feed){.from = output < 0 ? NULL : from, .output = output});
    }
    return true;
}

ff_status ff_instance_use(ff_instance *instance, const char *wire, ff_instance *from)
{
    if (!instance || !wire)
        return fe_absent(instance, "wire");
    return fe_handle(&(fe_request){.instance = instance, .work = use, .name = wire, .other = from});
}

static bool serve(fe_request *q)
{
    ff_instance *i = q->instance;
    int input = ff_model_find_input(i->stage.loaded->model, q->name);
    if (input < 0 || !ff_model_input(i->stage.loaded->model, (size_t)input)->service)
        return fe_refuse(i, q->name, "it has no service input \"%.80s\"", q->name);
    connect(i, (size_t)input, (fe_feed){.table = q->table});
    return true;
}

ff_status ff_instance_serve(ff_instance *instance, const char *wire, const void *table)
{
    if (!instance || !wire)
        return fe_absent(instance, "wire");
    return fe_handle(
        &(fe_request){.instance = instance, .work = serve, .name = wire, .table = table});
}
