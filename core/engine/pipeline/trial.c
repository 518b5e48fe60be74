/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "trial.h"

#include "build.h"

#include "../plugin/param.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct fe_trial {
    fe_stage stage;
    fe_instance instance;
    char *id;
    int output;
    ff_value *standing; /* of each parameter: held, or its preset */
    enum { ABSENT, PRESET, HELD } * origin;
};

static void read_presets(fe_trial *t, fe_report *report)
{
    const fe_loaded *loaded = t->stage.loaded;
    for (size_t i = 0; i < loaded->model->param_count; i++) {
        const ff_param *row = ff_model_param(loaded->model, i);
        t->stage.params[i].row = row;
        if (row->preset &&
            fe_param_read_preset(row, &loaded->param_units[i], row->name, &t->standing[i], report))
            t->origin[i] = PRESET;
    }
}

fe_trial *fe_trial_new(fe_library *library, const char *id, const char *interface,
                       fe_report *report)
{
    const fe_loaded *loaded = fe_library_load(library, id, FE_NOWHERE, report);
    int output = loaded ? ff_model_find_service(loaded->model, interface) : -1;
    if (!loaded)
        return NULL;
    if (output < 0 || loaded->model->input_count) {
        fe_error(report, FE_EXIT_INPUT, FE_NOWHERE, NULL, "%s cannot be fitted: it %s%s", id,
                 output < 0 ? "offers no service " : "needs other stages",
                 output < 0 ? interface : "");
        return NULL;
    }
    size_t params = loaded->model->param_count;
    fe_trial *t = fe_alloc(sizeof *t);
    *t = (fe_trial){
        .id = fe_copy_text(id, strlen(id)),
        .output = output,
        .standing = fe_alloc((params + 1) * sizeof *t->standing),
        .origin = fe_alloc((params + 1) * sizeof *t->origin),
    };
    t->stage = (fe_stage){.name = t->id,
                          .use = t->id,
                          .loaded = loaded,
                          .params = fe_alloc((params + 1) * sizeof *t->stage.params),
                          .instance = &t->instance};
    t->instance.stage = &t->stage;
    read_presets(t, report);
    return t;
}

const fe_loaded *fe_trial_model(const fe_trial *t)
{
    return t->stage.loaded;
}

bool fe_trial_hold(fe_trial *t, size_t param, const fe_node *node, fe_report *report)
{
    const fe_loaded *loaded = t->stage.loaded;
    const ff_param *row = ff_model_param(loaded->model, param);
    fe_value_clear(&t->standing[param]);
    bool good = fe_param_read(row, &loaded->param_units[param], row->name, node,
                              &t->standing[param], report);
    t->origin[param] = good ? HELD : ABSENT;
    return good;
}

double fe_trial_held(const fe_trial *t, size_t param)
{
    const ff_value *value = &t->standing[param];
    bool number = t->stage.params[param].row->type == FF_REAL && !value->text;
    return t->origin[param] != ABSENT && number ? value->real : NAN;
}

/* Whether a member of the group has a value that is no preset. */
static bool group_is_taken(const fe_trial *t, const char *group, const double *values)
{
    for (size_t i = 0; i < t->stage.loaded->model->param_count; i++) {
        const ff_param *row = t->stage.params[i].row;
        if (row->group && !strcmp(row->group, group) && (!isnan(values[i]) || t->origin[i] == HELD))
            return true;
    }
    return false;
}

static void close_instance(fe_trial *t)
{
    fe_close_instance(&t->stage);
    t->instance = (fe_instance){.stage = &t->stage};
}

const char *fe_trial_why(const fe_trial *t)
{
    return t->instance.text;
}

const void *fe_trial_open(fe_trial *t, const double *values, fe_report *report)
{
    fe_stage *stage = &t->stage;
    const ff_model *model = stage->loaded->model;
    close_instance(t);
    for (size_t i = 0; i < model->param_count; i++) {
        fe_bound *bound = &stage->params[i];
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

void fe_trial_free(fe_trial *t)
{
    if (!t)
        return;
    close_instance(t);
    for (size_t i = 0; i < t->stage.loaded->model->param_count; i++)
        fe_value_clear(&t->standing[i]);
    fe_free(t->standing);
    fe_free(t->origin);
    fe_free(t->stage.params);
    fe_free(t->id);
    fe_free(t);
}
