/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stands under `audit:`, and whether the pipeline has it. */
#include "audit.h"
#include "private.h"

#include "../value/unit.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_EVERY = 1000000 };

typedef struct reading {
    ff_audit *audit;
    ff_study *study;
    ff_report *report;
} reading;

static bool refuse(reading *r, ff_place place, const char *hint, const char *what)
{
    return ff_error(r->report, FF_EXIT_INPUT, place, hint, "audit: %s", what);
}

static bool check_keys(reading *r, const ff_node *map)
{
    static const char *const known[] = {"every", "seed", "outputs", "inputs"};
    enum { KNOWN = sizeof known / sizeof known[0] };
    bool good = true;
    for (size_t i = 0; i < map->count; i++) {
        const char *near = ff_nearest(map->keys[i], known, KNOWN);
        if ((near && !strcmp(near, map->keys[i])) || !strncmp(map->keys[i], "x-", 2))
            continue;
        good = ff_error(r->report, FF_EXIT_INPUT, map->key_places[i], NULL,
                        "audit: unknown key \"%.80s\"%s%s%s", map->keys[i],
                        near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
    }
    return good;
}

static bool read_count(reading *r, const ff_node *map, const char *key, int64_t least,
                       int64_t *value)
{
    const ff_node *node = ff_node_get(map, key);
    char why[200];
    if (!node || (node->kind == FF_SCALAR && ff_integer_parse(node->text, value, why, sizeof why) &&
                  *value >= least && *value <= MOST_EVERY))
        return true;
    return ff_error(r->report, FF_EXIT_INPUT, node->place, NULL,
                    "audit: \"%s\" wants a whole number from %d to %d", key, (int)least,
                    MOST_EVERY);
}

static bool read_outputs(reading *r, const ff_node *list)
{
    if (list->kind != FF_SEQUENCE || list->count == 0)
        return refuse(r, list->place, NULL, "\"outputs\" wants a list such as [film.h_min_lowest]");
    r->audit->outputs = ff_arena_alloc(&r->study->arena, list->count * sizeof *r->audit->outputs);
    for (size_t i = 0; i < list->count; i++) {
        const ff_node *item = list->items[i];
        const char *dot = item->kind == FF_SCALAR ? strchr(item->text, '.') : NULL;
        if (!dot || !dot[1] || dot[1] == '*')
            return refuse(r, item->place, NULL, "\"outputs\" wants names such as STAGE.OUTPUT");
        r->audit->outputs[r->audit->output_count++] = item->text;
    }
    return true;
}

/* "2 %" is relative; all else is a quantity, whose unit is that of the parameter. */
static bool read_input(reading *r, const char *path, const ff_node *node, ff_place key)
{
    ff_unsure *u = &r->audit->inputs[r->audit->input_count++];
    const char *end;
    double number = 0;
    *u = (ff_unsure){.path = path, .place = node->place};
    if (!strchr(path, '.'))
        return ff_error(r->report, FF_EXIT_INPUT, key, NULL,
                        "audit: inputs: \"%.80s\" is no parameter; write STAGE.PARAMETER", path);
    if (node->kind != FF_SCALAR || !ff_number_parse(node->text, &number, &end) || !(number > 0))
        return ff_error(r->report, FF_EXIT_INPUT, node->place, "write 2 %, or 5 N m",
                        "audit: inputs: %s wants its standard uncertainty, above 0", path);
    u->text = node->text;
    end += strspn(end, " ");
    if (end[0] == '%' && !end[1 + strspn(end + 1, " ")])
        u->relative = number / 100;
    return true;
}

static bool read_inputs(reading *r, const ff_node *map)
{
    bool good = true;
    if (map->kind != FF_MAP || map->count == 0)
        return refuse(r, map->place, "write inputs: {duty.torque: 2 %}",
                      "\"inputs\" wants a map from parameters to their standard uncertainty");
    r->audit->inputs = ff_arena_alloc(&r->study->arena, map->count * sizeof *r->audit->inputs);
    for (size_t i = 0; i < map->count; i++)
        good = read_input(r, map->keys[i], map->items[i], map->key_places[i]) && good;
    return good;
}

bool ff_audit_read(ff_study *study, const ff_node *node, ff_report *report)
{
    ff_audit *audit = ff_arena_alloc(&study->arena, sizeof *audit);
    reading r = {.audit = audit, .study = study, .report = report};
    const ff_node *outputs = ff_node_get(node, "outputs"), *inputs = ff_node_get(node, "inputs");
    int64_t every = 20, seed = 1;
    audit->place = node->place;
    study->audit = audit;
    if (node->kind != FF_MAP)
        return refuse(&r, node->place, "write audit: {every: 20, inputs: {duty.torque: 2 %}}",
                      "expected a map, which may be empty: {}");
    bool good = check_keys(&r, node) && read_count(&r, node, "every", 1, &every) &&
                read_count(&r, node, "seed", 0, &seed) && (!outputs || read_outputs(&r, outputs)) &&
                (!inputs || read_inputs(&r, inputs));
    audit->every = (size_t)every;
    audit->seed = (uint64_t)seed;
    return good;
}

static const ff_stage *find_stage(const ff_pipeline *pipeline, const char *path)
{
    size_t length = strcspn(path, ".");
    for (size_t i = 0; i < pipeline->count; i++)
        if (strlen(pipeline->stages[i].name) == length &&
            !strncmp(pipeline->stages[i].name, path, length))
            return &pipeline->stages[i];
    return NULL;
}

static bool is_number(const ff_bound *b)
{
    return b->present && b->row->type == FF_REAL && !b->value.text;
}

size_t ff_unsure_param(const ff_pipeline *pipeline, const char *path, const ff_stage **stage)
{
    const ff_stage *s = find_stage(pipeline, path);
    int param = s && s->needed && s->params
                    ? ff_model_find_param(s->loaded->model, strchr(path, '.') + 1)
                    : -1;
    *stage = s;
    return param >= 0 && is_number(&s->params[param]) ? (size_t)param : SIZE_MAX;
}

/* Of "2 K" and "2 degC" alike, an interval of 2 K. */
static double interval(double number, const ff_unit *unit)
{
    return ff_unit_to_si(unit, number) - ff_unit_to_si(unit, 0);
}

bool ff_unsure_width(const ff_unsure *u, const ff_stage *stage, size_t param, double *width,
                     char *why, size_t why_size)
{
    const ff_bound *b = &stage->params[param];
    const ff_unit *row = &stage->loaded->param_units[param];
    const char *end;
    double number;
    ff_unit unit;
    if (u->relative > 0) {
        *width = u->relative * (b->value.real < 0 ? -b->value.real : b->value.real);
        if (!(*width > 0))
            snprintf(why, why_size, "it is 0, so that a share of it is nothing");
        return *width > 0;
    }
    if (!ff_quantity_parse(u->text, row, b->row->unit, width, why, why_size))
        return false;
    ff_number_parse(u->text, &number, &end);
    end += strspn(end, " ");
    *width = ff_unit_parse(end, &unit, why, why_size) ? interval(number, &unit) : *width;
    return true;
}

static bool refuse_input(const ff_unsure *u, ff_report *report, const char *hint, const char *what)
{
    return ff_error(report, FF_EXIT_INPUT, u->place, hint, "audit: inputs: %s: %s", u->path, what);
}

/* Why the stage has no such number: it is not known, is not given, or is something else. */
static bool explain_param(const ff_unsure *u, const ff_stage *stage, ff_report *report)
{
    const ff_model *model = stage->loaded->model;
    const char *name = strchr(u->path, '.') + 1, *near = NULL;
    const char **names = ff_alloc((model->param_count + 1) * sizeof *names);
    int param = ff_model_find_param(model, name);
    for (size_t i = 0; i < model->param_count; i++)
        names[i] = ff_model_param(model, i)->name;
    if (param < 0)
        near = ff_nearest(name, names, model->param_count);
    free(names);
    if (param < 0)
        return ff_error(report, FF_EXIT_INPUT, u->place, NULL,
                        "audit: inputs: %s: %s (%s) has no such parameter%s%s%s", u->path,
                        stage->name, stage->use, near ? "; did you mean \"" : "", near ? near : "",
                        near ? "\"?" : "");
    const ff_bound *b = &stage->params[param];
    if (b->row->type != FF_REAL)
        return refuse_input(u, report, NULL, "only a parameter that is one real number can vary");
    const char *hint = stage->choice ? "write it on the stage, whose model is not chosen yet"
                       : b->row->group
                           ? "of parameters that stand for each other, name the one that is given"
                           : NULL;
    return refuse_input(u, report, hint,
                        "it is not given as a number, so that there is nothing to vary");
}

static bool check_input(const ff_unsure *u, const ff_pipeline *pipeline, ff_report *report)
{
    const ff_stage *stage;
    size_t param = ff_unsure_param(pipeline, u->path, &stage);
    char why[300];
    double width;
    if (!stage) {
        const char **names = ff_alloc((pipeline->count + 1) * sizeof *names), *near;
        char word[80];
        snprintf(word, sizeof word, "%.*s", (int)strcspn(u->path, "."), u->path);
        for (size_t i = 0; i < pipeline->count; i++)
            names[i] = pipeline->stages[i].name;
        near = ff_nearest(word, names, pipeline->count);
        free(names);
        return ff_error(report, FF_EXIT_INPUT, u->place, NULL,
                        "audit: inputs: there is no stage \"%s\"%s%s%s", word,
                        near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
    }
    if (!stage->needed)
        return refuse_input(u, report, NULL, "no output needs that stage");
    if (!stage->params)
        return true; /* its errors are told already */
    if (param == SIZE_MAX)
        return explain_param(u, stage, report);
    return ff_unsure_width(u, stage, param, &width, why, sizeof why) ||
           refuse_input(u, report, NULL, why);
}

static bool check_output(const char *path, const ff_pipeline *pipeline, ff_place place,
                         ff_report *report)
{
    const ff_stage *stage = find_stage(pipeline, path);
    if (!stage || !stage->needed)
        return ff_error(report, FF_EXIT_INPUT, place, NULL, "audit: outputs: %s: %s", path,
                        stage ? "no output of the file needs that stage"
                              : "there is no such stage");
    const ff_model *model = stage->loaded->model;
    const char *name = strchr(path, '.') + 1, *near;
    int output = ff_model_find_output(model, name);
    const ff_port *row = output < 0 ? NULL : ff_model_output(model, (size_t)output);
    const char *dims = row && row->dims ? row->dims : "";
    if (row && (row->service || (strchr(dims, ' ') && !strchr(dims, '?'))))
        return ff_error(report, FF_EXIT_INPUT, place, NULL,
                        "audit: outputs: %s is a %s; name scalars and series", path,
                        row->service ? "service" : "field");
    if (row)
        return true;
    const char **names = ff_alloc((model->output_count + 1) * sizeof *names);
    for (size_t i = 0; i < model->output_count; i++)
        names[i] = ff_model_output(model, i)->name;
    near = ff_nearest(name, names, model->output_count);
    free(names);
    return ff_error(report, FF_EXIT_INPUT, place, NULL,
                    "audit: outputs: %s: there is no such output%s%s%s", path,
                    near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
}

void ff_audit_check(const ff_study *study, const ff_pipeline *pipeline, ff_report *report)
{
    const ff_audit *audit = study->audit;
    bool chooses = false;
    for (size_t i = 0; i < pipeline->count; i++)
        chooses = chooses || (pipeline->stages[i].needed && pipeline->stages[i].choice);
    if (ff_study_chain_length(study) > 1)
        ff_error(report, FF_EXIT_INPUT, audit->place, NULL,
                 "audit: cases that \"follow\" each other cannot be computed once more alone");
    if (!chooses)
        ff_error(report, FF_EXIT_INPUT, audit->place,
                 "write use: KIND/auto, or give a stage an accuracy",
                 "audit: no stage of this file chooses its model, so that nothing was promised");
    for (size_t i = 0; i < audit->input_count; i++)
        check_input(&audit->inputs[i], pipeline, report);
    for (size_t i = 0; i < audit->output_count; i++)
        check_output(audit->outputs[i], pipeline, audit->place, report);
}
