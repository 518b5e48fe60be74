/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "goals.h"

#include "../memory/memory.h"
#include "lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const ff_param row = {.name = "accuracy",
                             .unit = "%",
                             .doc = "largest error of an output, relative to its value",
                             .type = FF_REAL,
                             .flags = FF_MIN_OPEN,
                             .max = 100,
                             .choices = "measured"};

static const char all_key[] = "all", check_key[] = "check", by_twins[] = "twins";

static const ff_node *node_of(const ff_run *run)
{
    const ff_node *node = ff_node_get(ff_run_root(run), row.name);
    bool empty = node && node->kind == FF_SCALAR && !*node->text;
    return empty ? NULL : node;
}

static bool is_measured(const ff_node *node)
{
    return node->kind == FF_SCALAR && !strcmp(node->text, row.choices);
}

bool accuracy_is_requested(const ff_run *run)
{
    return node_of(run) != NULL;
}

bool accuracy_has_check(const ff_run *run)
{
    const ff_node *node = node_of(run);
    return node && node->kind == FF_MAP && ff_node_get(node, check_key);
}

bool accuracy_has_goals(const ff_run *run)
{
    const ff_node *node = node_of(run);
    const size_t others = accuracy_has_check(run) ? 1 : 0;
    return node && !is_measured(node) && (node->kind != FF_MAP || node->count > others);
}

ff_place accuracy_place(const ff_run *run)
{
    const ff_node *node = node_of(run);
    return node ? node->place : FF_NOWHERE;
}

/* True for a goal such as "0.5 K", in the unit of the output; "2 %" is a share of it. */
static bool is_absolute(const ff_node *node, const ff_port *of)
{
    const char *end;
    double number;
    return of && strcmp(of->unit, "1") != 0 && node->kind == FF_SCALAR &&
           ff_number_parse(node->text, &number, &end) && *end && !strchr(end, '%');
}

/* Reads "2 %" as 0.02, or "0.5 K" in SI; NaN for `measured`, and after an error. */
static double read_goal(const ff_node *node, const ff_port *of, const char *name, ff_report *report)
{
    ff_unit unit;
    ff_value value;
    char why[64];
    double goal = NAN;
    ff_param own = row;
    if (is_absolute(node, of)) {
        own.unit = of->unit;
        own.max = INFINITY;
    }
    if (is_measured(node) || !ff_unit_parse(own.unit, &unit, why, sizeof why))
        return NAN;
    if (!strcmp(own.unit, "K") && strstr(node->text, "deg")) /* would be read as a temperature */
        ff_error(report, FF_FAULT_INPUT, node->place, "write it in K",
                 "%s: \"%.40s\" is a temperature, and an error is a difference of two", name,
                 node->text);
    else if (ff_param_read(&own, &unit, name, node, &value, report)) {
        goal = value.real;
        ff_value_clear(&value);
    }
    return goal;
}

double accuracy_goal(const ff_run *run, const ff_stage *stage, const ff_result *result,
                     bool *absolute)
{
    const ff_node *node = node_of(run);
    const ff_port *of = NULL;
    if (node && node->kind == FF_MAP) {
        char *path = memory_print_text("%s.%s", stage->name, result->row->name);
        const ff_node *own = ff_node_get(node, path);
        node = own ? own : ff_node_get(node, all_key);
        of = own ? result->row : NULL;
        free(path);
    }
    ff_report *unused = ff_report_new();
    double goal = node ? read_goal(node, of, row.name, unused) : NAN;
    *absolute = node && is_absolute(node, of);
    ff_report_free(unused);
    return goal;
}

char *accuracy_print_goals(const ff_run *run)
{
    const ff_node *node = node_of(run);
    char *text = memory_print_text("%s", node && node->kind == FF_SCALAR ? node->text : "");
    for (size_t i = 0; node && node->kind == FF_MAP && i < node->count; i++) {
        const ff_node *item = node->items[i];
        memory_add_text(&text, "%s%s: %s", *text ? ", " : "", node->keys[i],
                        item->kind == FF_SCALAR ? item->text : "");
    }
    return text;
}

/* True for a scalar or a series, and for an output whose optional dimension may be absent. Errors
 * of fields and of error estimates are not measured. */
static bool may_have_goal(const ff_stage *stage, const ff_result *result)
{
    const char *dims = result->row->dims;
    return result->requested && !result->row->service &&
           (!strchr(dims, ' ') || strchr(dims, '?')) && !accuracy_is_estimate(stage, result);
}

static void free_names(char **names, size_t count)
{
    for (size_t i = 0; i < count; i++)
        free(names[i]);
    free(names);
}

/* Names of the outputs that may have a goal, in an array for free_names. */
static char **list_names(const ff_pipeline *pipeline, size_t *count)
{
    size_t most = 0;
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[i].loaded)
            most += pipeline->stages[i].loaded->model->output_count;
    char **names = memory_alloc((most + 1) * sizeof *names);
    *count = 0;
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        for (size_t k = 0;
             stage->loaded && stage->results && k < stage->loaded->model->output_count; k++)
            if (may_have_goal(stage, &stage->results[k]))
                names[(*count)++] =
                    memory_print_text("%s.%s", stage->name, stage->results[k].row->name);
    }
    return names;
}

bool accuracy_has_outputs(const ff_pipeline *pipeline)
{
    size_t count;
    char **names = list_names(pipeline, &count);
    free_names(names, count);
    return count > 0;
}

static bool check_name(const ff_node *map, size_t item, char *const *names, size_t count,
                       ff_report *report)
{
    for (size_t i = 0; i < count; i++)
        if (!strcmp(names[i], map->keys[item]))
            return true;
    const char *nearest = ff_nearest(map->keys[item], (const char *const *)names, count);
    char *hint = nearest ? memory_print_text("did you mean \"%s\"?", nearest) : NULL;
    ff_error(report, FF_FAULT_INPUT, map->key_places[item], hint,
             "accuracy: \"%.100s\" is not a scalar or series that \"outputs\" requests, or it is "
             "an error estimate",
             map->keys[item]);
    free(hint);
    return false;
}

static void check_word(const ff_node *node, ff_report *report)
{
    if (node->kind != FF_SCALAR || strcmp(node->text, by_twins) != 0)
        ff_error(report, FF_FAULT_INPUT, node->place, "write check: twins",
                 "accuracy.check: the only possible value is \"twins\"");
}

/* The output's row; it exists. */
static const ff_port *port_of(const ff_pipeline *pipeline, const char *path)
{
    const char *name;
    const ff_stage *stage = ff_stage_of(pipeline, path, &name);
    return ff_model_output(stage->loaded->model,
                           (size_t)ff_model_find_output(stage->loaded->model, name));
}

bool accuracy_check(ff_run *run)
{
    const ff_pipeline *pipeline = ff_run_pipeline(run);
    const ff_node *node = node_of(run);
    ff_report *report = ff_run_report(run);
    size_t errors = ff_report_errors(report), count;
    if (!node)
        return true;
    char **names = list_names(pipeline, &count);
    if (node->kind != FF_MAP)
        read_goal(node, NULL, row.name, report);
    for (size_t i = 0; node->kind == FF_MAP && i < node->count; i++)
        if (!strcmp(node->keys[i], all_key))
            read_goal(node->items[i], NULL, all_key, report);
        else if (!strcmp(node->keys[i], check_key))
            check_word(node->items[i], report);
        else if (check_name(node, i, names, count, report))
            read_goal(node->items[i], port_of(pipeline, node->keys[i]), node->keys[i], report);
    if (count == 0 && ff_report_errors(report) == errors)
        ff_warn(report, node->place,
                "accuracy: this changes nothing, since no scalar or series is requested");
    free_names(names, count);
    return ff_report_errors(report) == errors;
}
