/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "candidate.h"

#include "build.h"
#include "tool.h"

#include "../plugin/param.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct ff_candidate {
    ff_stage stage;
    ff_instance instance;
    char *id;
    int output;
    ff_value *standing; /* of each parameter: held, or its preset */
    enum { ABSENT, PRESET, HELD } * origin;
};

static void read_presets(ff_candidate *c, ff_report *report)
{
    const ff_loaded *loaded = c->stage.loaded;
    for (size_t i = 0; i < loaded->model->param_count; i++) {
        const ff_param *row = ff_model_param(loaded->model, i);
        c->stage.params[i].row = row;
        if (row->preset &&
            ff_param_read_preset(row, &loaded->param_units[i], row->name, &c->standing[i], report))
            c->origin[i] = PRESET;
    }
}

ff_candidate *ff_candidate_new(ff_library *library, const char *id, const char *interface,
                               ff_report *report)
{
    const ff_loaded *loaded = ff_library_load(library, id, FF_NOWHERE, report);
    int output = loaded ? ff_model_find_service(loaded->model, interface) : -1;
    if (!loaded)
        return NULL;
    if (output < 0 || loaded->model->input_count) {
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "%s cannot be fitted: it %s%s", id,
                 output < 0 ? "offers no service " : "needs other stages",
                 output < 0 ? interface : "");
        return NULL;
    }
    size_t params = loaded->model->param_count;
    ff_candidate *c = ff_alloc(sizeof *c);
    *c = (ff_candidate){
        .id = ff_copy_text(id, strlen(id)),
        .output = output,
        .standing = ff_alloc((params + 1) * sizeof *c->standing),
        .origin = ff_alloc((params + 1) * sizeof *c->origin),
    };
    c->stage = (ff_stage){.name = c->id,
                          .use = c->id,
                          .loaded = loaded,
                          .params = ff_alloc((params + 1) * sizeof *c->stage.params),
                          .instance = &c->instance};
    c->instance.stage = &c->stage;
    read_presets(c, report);
    return c;
}

const ff_loaded *ff_candidate_model(const ff_candidate *c)
{
    return c->stage.loaded;
}

bool ff_candidate_hold(ff_candidate *c, size_t param, const ff_node *node, ff_report *report)
{
    const ff_loaded *loaded = c->stage.loaded;
    const ff_param *row = ff_model_param(loaded->model, param);
    ff_value_clear(&c->standing[param]);
    bool good = ff_param_read(row, &loaded->param_units[param], row->name, node,
                              &c->standing[param], report);
    c->origin[param] = good ? HELD : ABSENT;
    return good;
}

double ff_candidate_held(const ff_candidate *c, size_t param)
{
    const ff_value *value = &c->standing[param];
    bool number = c->stage.params[param].row->type == FF_REAL && !value->text;
    return c->origin[param] != ABSENT && number ? value->real : NAN;
}

/* Whether a member of the group has a value that is no preset. */
static bool group_is_taken(const ff_candidate *c, const char *group, const double *values)
{
    for (size_t i = 0; i < c->stage.loaded->model->param_count; i++) {
        const ff_param *row = c->stage.params[i].row;
        if (row->group && !strcmp(row->group, group) && (!isnan(values[i]) || c->origin[i] == HELD))
            return true;
    }
    return false;
}

static void close_instance(ff_candidate *c)
{
    ff_close_instance(&c->stage);
    c->instance = (ff_instance){.stage = &c->stage};
}

const char *ff_candidate_why(const ff_candidate *c)
{
    return c->instance.text;
}

const void *ff_candidate_open(ff_candidate *c, const double *values, ff_report *report)
{
    ff_stage *stage = &c->stage;
    const ff_model *model = stage->loaded->model;
    close_instance(c);
    for (size_t i = 0; i < model->param_count; i++) {
        ff_bound *bound = &stage->params[i];
        bool given = !isnan(values[i]);
        bound->value = c->standing[i];
        if (given)
            bound->value = (ff_value){.size = sizeof bound->value, .real = values[i], .given = 1};
        bound->present = given || c->origin[i] == HELD ||
                         (c->origin[i] == PRESET &&
                          !(bound->row->group && group_is_taken(c, bound->row->group, values)));
    }
    ff_build b = {.report = report};
    ff_open_instance(&b, stage);
    if (!c->instance.alive)
        return NULL;
    ff_call call = ff_call_begin(stage, "service");
    const void *table = model->service(c->instance.self, (uint32_t)c->output);
    if (ff_call_end(&call, FF_OK, report) && !table)
        ff_blame(stage, report, "gave no table for its service");
    return table;
}

void ff_candidate_free(ff_candidate *c)
{
    if (!c)
        return;
    close_instance(c);
    for (size_t i = 0; i < c->stage.loaded->model->param_count; i++)
        ff_value_clear(&c->standing[i]);
    free(c->standing);
    free(c->origin);
    free(c->stage.params);
    free(c->id);
    free(c);
}
