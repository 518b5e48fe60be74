/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "candidate.h"

#include "build.h"
#include "tool.h"

#include "../plugin/param.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct fe_candidate {
    fe_stage stage;
    fe_instance instance;
    char *id;
    int output;
    ff_value *standing; /* of each parameter: held, or its preset */
    enum { ABSENT, PRESET, HELD } * origin;
};

static void read_presets(fe_candidate *c, fe_report *report)
{
    const fe_loaded *loaded = c->stage.loaded;
    for (size_t i = 0; i < loaded->model->param_count; i++) {
        const ff_param *row = ff_model_param(loaded->model, i);
        c->stage.params[i].row = row;
        if (row->preset &&
            fe_param_read_preset(row, &loaded->param_units[i], row->name, &c->standing[i], report))
            c->origin[i] = PRESET;
    }
}

fe_candidate *fe_candidate_new(fe_library *library, const char *id, const char *interface,
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
    fe_candidate *c = fe_alloc(sizeof *c);
    *c = (fe_candidate){
        .id = fe_copy_text(id, strlen(id)),
        .output = output,
        .standing = fe_alloc((params + 1) * sizeof *c->standing),
        .origin = fe_alloc((params + 1) * sizeof *c->origin),
    };
    c->stage = (fe_stage){.name = c->id,
                          .use = c->id,
                          .loaded = loaded,
                          .params = fe_alloc((params + 1) * sizeof *c->stage.params),
                          .instance = &c->instance};
    c->instance.stage = &c->stage;
    read_presets(c, report);
    return c;
}

const fe_loaded *fe_candidate_model(const fe_candidate *c)
{
    return c->stage.loaded;
}

bool fe_candidate_hold(fe_candidate *c, size_t param, const fe_node *node, fe_report *report)
{
    const fe_loaded *loaded = c->stage.loaded;
    const ff_param *row = ff_model_param(loaded->model, param);
    fe_value_clear(&c->standing[param]);
    bool good = fe_param_read(row, &loaded->param_units[param], row->name, node,
                              &c->standing[param], report);
    c->origin[param] = good ? HELD : ABSENT;
    return good;
}

double fe_candidate_held(const fe_candidate *c, size_t param)
{
    const ff_value *value = &c->standing[param];
    bool number = c->stage.params[param].row->type == FF_REAL && !value->text;
    return c->origin[param] != ABSENT && number ? value->real : NAN;
}

/* Whether a member of the group has a value that is no preset. */
static bool group_is_taken(const fe_candidate *c, const char *group, const double *values)
{
    for (size_t i = 0; i < c->stage.loaded->model->param_count; i++) {
        const ff_param *row = c->stage.params[i].row;
        if (row->group && !strcmp(row->group, group) && (!isnan(values[i]) || c->origin[i] == HELD))
            return true;
    }
    return false;
}

static void close_instance(fe_candidate *c)
{
    fe_close_instance(&c->stage);
    c->instance = (fe_instance){.stage = &c->stage};
}

const char *fe_candidate_why(const fe_candidate *c)
{
    return c->instance.text;
}

const void *fe_candidate_open(fe_candidate *c, const double *values, fe_report *report)
{
    fe_stage *stage = &c->stage;
    const ff_model *model = stage->loaded->model;
    close_instance(c);
    for (size_t i = 0; i < model->param_count; i++) {
        fe_bound *bound = &stage->params[i];
        bool given = !isnan(values[i]);
        bound->value = c->standing[i];
        if (given)
            bound->value = (ff_value){.size = sizeof bound->value, .real = values[i], .given = 1};
        bound->present = given || c->origin[i] == HELD ||
                         (c->origin[i] == PRESET &&
                          !(bound->row->group && group_is_taken(c, bound->row->group, values)));
    }
    fe_build b = {.report = report};
    fe_open_instance(&b, stage);
    if (!c->instance.alive)
        return NULL;
    fe_call call = fe_call_begin(stage, "service");
    const void *table = model->service(c->instance.self, (uint32_t)c->output);
    if (fe_call_end(&call, FF_OK, report) && !table)
        fe_blame(stage, report, "gave no table for its service");
    return table;
}

void fe_candidate_free(fe_candidate *c)
{
    if (!c)
        return;
    close_instance(c);
    for (size_t i = 0; i < c->stage.loaded->model->param_count; i++)
        fe_value_clear(&c->standing[i]);
    free(c->standing);
    free(c->origin);
    free(c->stage.params);
    free(c->id);
    free(c);
}
