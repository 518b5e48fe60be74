/* SPDX-License-Identifier: MIT */
#include "build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct ff_trial {
    ff_stage stage;
    fe_instance instance;
    char *id;
    int output;
    ff_value *standing; /* of each parameter: held, or its preset */
    enum { ABSENT, PRESET, HELD } * origin;
};

static void read_presets(ff_trial *t, ff_report *report)
{
    const ff_loaded *loaded = t->stage.loaded;
    for (size_t i = 0; i < loaded->model->param_count; i++) {
        const ff_param *row = ff_model_param(loaded->model, i);
        t->stage.params[i].row = row;
        if (row->preset &&
            ff_param_read_preset(row, &loaded->param_units[i], row->name, &t->standing[i], report))
            t->origin[i] = PRESET;
    }
}

ff_trial *ff_trial_new(ff_library *library, const char *id, const char *interface,
                       ff_report *report)
{
    const ff_loaded *loaded = ff_library_load(library, id, FF_NOWHERE, report);
    int output = loaded ? ff_model_find_service(loaded->model, interface) : -1;
    if (!loaded)
        return NULL;
    if (output < 0 || loaded->model->input_count) {
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "%s cannot be fitted: it %s%s", id,
                 output < 0 ? "offers no service " : "needs other stages",
                 output < 0 ? interface : "");
        return NULL;
    }
    size_t params = loaded->model->param_count;
    ff_trial *t = fe_alloc(sizeof *t);
    *t = (ff_trial){
        .id = fe_copy_text(id, strlen(id)),
        .output = output,
        .standing = fe_alloc((params + 1) * sizeof *t->standing),
        .origin = fe_alloc((params + 1) * sizeof *t->origin),
    };
    t->stage = (ff_stage){.name = t->id,
                          .use = t->id,
                          .loaded = loaded,
                          .params = fe_alloc((params + 1) * sizeof *t->stage.params),
                          .instance = &t->instance};
    t->instance.stage = &t->stage;
    read_presets(t, report);
    return t;
}

const ff_loaded *ff_trial_model(const ff_trial *t)
{
    return t->stage.loaded;
}

static void close_instance(ff_trial *t)
{
    fe_close_instance(&t->stage);
    t->instance = (fe_instance){.stage = &t->stage};
}

bool ff_trial_hold(ff_trial *t, size_t param, const ff_node *node, ff_report *report)
{
    const ff_loaded *loaded = t->stage.loaded;
    const ff_param *row = ff_model_param(loaded->model, param);
    close_instance(t); /* it may hold the value */
    ff_value_clear(&t->standing[param]);
    bool good = ff_param_read(row, &loaded->param_units[param], row->name, node,
                              &t->standing[param], report);
    t->origin[param] = good ? HELD : ABSENT;
    return good;
}

double ff_trial_held(const ff_trial *t, size_t param)
{
    const ff_value *value = &t->standing[param];
    bool number = t->stage.params[param].row->type == FF_REAL && !value->text;
    return t->origin[param] != ABSENT && number ? value->real : NAN;
}

/* Whether a member of the group has a value that is no preset. */
static bool group_is_taken(const ff_trial *t, const char *group, const double *values)
{
    for (size_t i = 0; i < t->stage.loaded->model->param_count; i++) {
        const ff_param *row = t->stage.params[i].row;
        if (row->group && !strcmp(row->group, group) && (!isnan(values[i]) || t->origin[i] == HELD))
            return true;
    }
    return false;
}

const char *ff_trial_why(const ff_trial *t)
{
    return t->instance.text;
}

const void *ff_trial_open(ff_trial *t, const double *values, ff_report *report)
{
    ff_stage *stage = &t->stage;
    const ff_model *model = stage->loaded->model;
    close_instance(t);
    for (size_t i = 0; i < model->param_count; i++) {
        ff_bound *bound = &stage->params[i];
        bool given = !isnan(values[i]);
        bound->value = t->standing[i];
        if (given)
            bound->value = (ff_value){.size = sizeof bound->value, .real = values[i], .given = 1};
        bound->present = given || t->origin[i] == HELD ||
                         (t->origin[i] == PRESET &&
                          !(bound->row->group && group_is_taken(t, bound->row->group, values)));
    }
    fe_build b = {.report = report};
    fe_open_instance(&b, stage);
    return t->instance.alive ? fe_fetch_service(stage, (uint32_t)t->output, report) : NULL;
}

void ff_trial_free(ff_trial *t)
{
    if (!t)
        return;
    close_instance(t);
    for (size_t i = 0; i < t->stage.loaded->model->param_count; i++)
        ff_value_clear(&t->standing[i]);
    fe_free(t->standing);
    fe_free(t->origin);
    fe_free(t->stage.params);
    fe_free(t->id);
    fe_free(t);
}
