/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs studies whose later cases depend on results of earlier ones: finds the driver, lets it read
 * its keys and submit the first cases, and runs it. */
#include "kinds.h"

#include "../../run/run.h"
#include "../cases/spectrum.h"

#include <stdlib.h>
#include <string.h>

typedef struct study_driver {
    const study_kind *kind;
    study_context context;
    void *study; /* the data that the kind has read */
} study_driver;

/* Returns the outputs that the driver requests, in the form of `outputs:` in a file. */
static ff_node *request_of(study_context *context)
{
    ff_node *list = memory_arena_alloc(&context->arena, sizeof *list);
    *list = (ff_node){.kind = FF_SEQUENCE, .count = context->output_count};
    list->items = memory_arena_alloc(&context->arena, (list->count + 1) * sizeof *list->items);
    for (size_t i = 0; i < list->count; i++) {
        list->items[i] = memory_arena_alloc(&context->arena, sizeof **list->items);
        *list->items[i] = (ff_node){.kind = FF_SCALAR,
                                    .place = context->outputs[i]->place,
                                    .text = context->outputs[i]->text};
        if (i == 0)
            list->place = list->items[0]->place;
    }
    return list;
}

/* Adds the stage to which an assignment belongs, since cases differ in it. */
static void add_knob(study_context *context, study_measure *m, const char *assignment)
{
    static const char prefix[] = "pipeline.";
    if (!strncmp(assignment, prefix, sizeof prefix - 1))
        assignment += sizeof prefix - 1;
    size_t length = strcspn(assignment, ".="), i = 0;
    for (const char *const *top = ff_file_keys(); *top; top++)
        m->all = m->all || (strlen(*top) == length && !strncmp(*top, assignment, length));
    while (i < m->knob_count &&
           (strlen(m->knobs[i]) != length || strncmp(m->knobs[i], assignment, length) != 0))
        i++;
    if (i == m->knob_count && length > 0)
        m->knobs[m->knob_count++] = memory_arena_text(&context->arena, assignment, length);
}

/* Returns what is measured in addition to the scalars; NULL if nothing is. */
static study_measure *measure_of(study_context *context, const ff_node *request)
{
    size_t most = context->planned * context->path_count + context->stage_count + 1;
    if (!context->measured)
        return NULL;
    study_measure *m = memory_arena_alloc(&context->arena, sizeof *m);
    *m = (study_measure){.request = request, .along = context->along, .repeat = context->repeats};
    m->knobs = memory_arena_alloc(&context->arena, most * sizeof *m->knobs);
    for (size_t i = 0; i < context->planned; i++)
        for (size_t k = 0; k < context->path_count; k++)
            if (*context->list.varied[k].assignments[i])
                add_knob(context, m, context->list.varied[k].assignments[i]);
    for (size_t i = 0; i < context->stage_count; i++)
        add_knob(context, m, context->stages[i]);
    return m;
}

/* Sets the cases of the study to those submitted before the run. */
static void lay_out_planned(study_context *context, study_definition *study)
{
    const study_definition *grid = context->grid;
    const ff_node *request = request_of(context);
    context->planned = context->list.count;
    context->measure = measure_of(context, request);
    study->request = context->list.request = request;
    study->extras = context->list.extras = context->extras;
    study->extra_count = context->list.extra_count = context->extra_count;
    study->measure = context->list.measure = context->measure;
    study->varied = grid ? grid->varied : context->list.varied;
    study->varied_count = grid ? grid->varied_count : context->list.varied_count;
    study->refined_count = grid ? 0 : context->refined_count;
    context->list.refined_count = context->refined_count;
    study->count = context->planned;
    study->axis_count = study->followed = study->direction = grid ? grid->axis_count : 1;
    study->points = grid ? grid->points : memory_arena_alloc(&study->arena, sizeof *study->points);
    if (!grid)
        study->points[0] = context->planned;
}

static bool check_keys(const study_kind *kind, const ff_node *map, ff_report *report)
{
    size_t errors = ff_report_errors(report);
    const char **names = memory_alloc((kind->key_count + 1) * sizeof *names);
    for (size_t i = 0; i < kind->key_count; i++)
        names[i] = kind->keys[i].name;
    study_check_keys(map, kind->name, "", names, report);
    free(names);
    for (size_t i = 0; i < kind->key_count; i++) {
        const ff_param *key = &kind->keys[i];
        if (!(key->flags & FF_REQUIRED) || ff_node_get(map, key->name))
            continue;
        char *hint = memory_print_text("%s: a value, a list or a map", key->name);
        ff_error(report, FF_FAULT_INPUT, map->place, hint, "%s: \"%s\" is missing: %s", kind->name,
                 key->name, key->doc);
        free(hint);
    }
    return ff_report_errors(report) == errors;
}

/* Reads a key with a type, from its node or its preset. */
static bool read_value(const study_kind *kind, const ff_param *key, study_key_value *value,
                       ff_report *report)
{
    char name[192], why[200];
    ff_unit unit;
    snprintf(name, sizeof name, "%s.%s", kind->name, key->name);
    ff_unit_parse(*key->unit ? key->unit : "1", &unit, why, sizeof why);
    return value->node   ? ff_param_read(key, &unit, name, value->node, &value->value, report)
           : key->preset ? ff_param_read_preset(key, &unit, name, &value->value, report)
                         : true;
}

static bool read_keys(study_driver *driver, const ff_node *map, ff_report *report)
{
    const study_kind *kind = driver->kind;
    size_t errors = ff_report_errors(report);
    study_key_value *values = memory_alloc(kind->key_count * sizeof *values);
    check_keys(kind, map, report);
    for (size_t i = 0; i < kind->key_count; i++) {
        values[i].node = ff_node_get(map, kind->keys[i].name);
        if (kind->keys[i].type != STUDY_TREE)
            read_value(kind, &kind->keys[i], &values[i], report);
    }
    bool good = ff_report_errors(report) == errors;
    driver->study = good ? kind->read(&driver->context, values) : NULL;
    for (size_t i = 0; i < kind->key_count; i++)
        ff_value_clear(&values[i].value);
    free(values);
    return driver->study != NULL;
}

static bool open_driver(study_definition *study, const ff_node *root, const study_kind *kind,
                        ff_report *report)
{
    const ff_node *node = ff_node_get(root, "study");
    study_driver *driver = study->driver = memory_alloc(sizeof *driver);
    const ff_node *map = ff_node_get(node, kind->name);
    driver->kind = kind;
    driver->context = (study_context){.name = kind->name,
                                      .root = root,
                                      .report = report,
                                      .further = "",
                                      .list = *study,
                                      .verdict = -1};
    driver->context.list.arena = (memory_arena){0};
    driver->context.list.points = &driver->context.list.count;
    driver->context.list.axis_count = driver->context.list.followed =
        driver->context.list.direction = 1;
    if (map->kind != FF_MAP)
        return ff_error(report, FF_FAULT_INPUT, map->place, NULL,
                        "%s: expected a map; flankfilm schema lists its keys", kind->name);
    if (!read_keys(driver, map, report))
        return false;
    lay_out_planned(&driver->context, study);
    for (size_t i = 0; i < node->count; i++)
        for (const char *const *own = study_keys; *own; own++)
            if (!strcmp(node->keys[i], *own) && !strstr(*own, "_limit"))
                return ff_error(report, FF_FAULT_INPUT, map->place, NULL,
                                "study: %s: a study either sweeps or %s; use two files", kind->name,
                                kind->verb);
    return true;
}

/* Returns the kind that a key names, or NULL. Unknown keys are errors. */
static const study_kind *find_kind(const ff_node *node, ff_report *report)
{
    enum { MOST = 16 };
    const char *known[MOST];
    size_t count = 0;
    const study_kind *found = NULL;
    for (const char *const *key = study_keys; *key; key++)
        known[count++] = *key;
    for (const study_kind *const *kind = study_kinds; *kind; kind++)
        known[count++] = (*kind)->name;
    known[count] = NULL;
    study_check_keys(node, "study", "", known, report);
    for (size_t i = 0; node->kind == FF_MAP && i < node->count; i++)
        for (const study_kind *const *kind = study_kinds; *kind; kind++) {
            if (strcmp(node->keys[i], (*kind)->name) != 0)
                continue;
            if (found)
                ff_error(report, FF_FAULT_INPUT, node->key_places[i], NULL,
                         "study: \"%s\" and \"%s\" exclude each other; use two files", found->name,
                         (*kind)->name);
            found = *kind;
        }
    return found;
}

study_definition *study_open(const ff_node *root, ff_report *report)
{
    const ff_node *node = ff_node_get(root, "study");
    size_t errors = ff_report_errors(report);
    const study_kind *kind = find_kind(node, report);
    if (ff_report_errors(report) > errors)
        return NULL;
    if (!kind)
        return study_read(node, report);
    study_definition *study = memory_alloc(sizeof *study);
    if (study_read_limits(study, node, report))
        open_driver(study, root, kind, report);
    return study;
}

void study_free(study_definition *study)
{
    if (study && study->driver)
        study_context_free(&study->driver->context);
    if (study)
        free(study->driver);
    study_definition_free(study);
}

/* Checks that the pipeline has the stage of "stage.name". */
static bool check_stage(const study_context *context, const ff_pipeline *pipeline, const char *path,
                        ff_report *report)
{
    const char *name;
    return ff_stage_of(pipeline, path, &name) ||
           ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                    "%s: %s: the pipeline has no stage \"%.*s\"", context->name, path,
                    (int)strcspn(path, "."), path);
}

/* Whether the driver cannot compare outputs with these dimensions. A driver can compare scalars
 * and, if it measures costs, also series; if one of two dimensions is optional, the output may be a
 * series.
 */
static bool is_too_much(const study_context *context, const char *dims)
{
    bool series = *dims != '\0', field = strchr(dims, ' ') && !strchr(dims, '?');
    return context->measured ? field : series;
}

static void check_output(const study_context *context, const ff_pipeline *pipeline,
                         const ff_node *asked, ff_report *report)
{
    const ff_stage *stage;
    const ff_result *result = run_output(pipeline, asked->text, &stage);
    if (result && result->row->dims && is_too_much(context, result->row->dims))
        ff_error(report, FF_FAULT_INPUT, asked->place,
                 context->measured ? NULL : "name a scalar, such as a mean or an extreme value",
                 context->measured ? "%s: %s is a field; name scalars and series"
                                   : "%s: %s is a series or a field, which cannot be compared",
                 context->name, asked->text);
}

void study_check(const study_definition *study, const ff_pipeline *pipeline, ff_report *report)
{
    const study_context *context = study->driver ? &study->driver->context : NULL;
    size_t scaled = 0;
    study_spectrum_check(study, pipeline, report);
    for (size_t i = 0; context && study->request && i < study->request->count; i++)
        check_output(context, pipeline, study->request->items[i], report);
    for (size_t i = 0; context && i < context->name_count; i++)
        check_stage(context, pipeline, context->names[i], report);
    for (size_t i = 0; context && i < context->knob_count; i++) {
        size_t param = SIZE_MAX;
        if (check_stage(context, pipeline, context->knobs[i], report))
            study_find_number(pipeline, context->knobs[i], &param);
        scaled += param != SIZE_MAX;
    }
    if (study->driver && study->driver->study && study->driver->kind->check)
        study->driver->kind->check(study->driver->study, pipeline, report);
    if (context && context->knobs && scaled == 0)
        ff_warn(report, FF_NOWHERE,
                "%s: no parameter is refined, so verdicts rest only on the quality lines",
                context->name);
}

bool study_open_cases(const study_run *run, ff_report *report)
{
    study_context *context = &run->study->driver->context;
    ff_place wrong = FF_NOWHERE; /* only the first error at each place is reported */
    bool good = true;
    context->report = report;
    context->run = run;
    for (size_t i = 0; i < context->opened; i++) {
        const ff_place place = context->cases[i].place;
        if (context->repeats[i] > 0 || (wrong.source && wrong.source == place.source &&
                                        wrong.line == place.line && wrong.column == place.column))
            continue;
        if (!study_submitted_opens(context, i, true)) {
            good = false;
            wrong = place;
        }
    }
    return good;
}

static void give_answer(study_driver *driver)
{
    study_answer answer = {.context = &driver->context, .file = driver->kind->file};
    driver->kind->reduce(driver->study, &answer);
    study_answer_close(&answer);
}

bool study_drive(const study_run *run, study_counters *counters, ff_report *report)
{
    study_driver *driver = run->study->driver;
    study_context *context = &driver->context;
    study_run own = *run;
    *counters = (study_counters){.leads = true};
    if (context->measured)
        own.jobs = 1;
    context->counters = counters;
    bool good = study_open_cases(&own, report) && driver->kind->cases(driver->study);
    if (good)
        give_answer(driver);
    good = good && study_write_submitted(context) && study_context_write(context, run->directory);
    context->run = NULL;
    return good && ff_report_errors(report) == 0;
}

/* Counts what a run would do. The driver proceeds as in a run until it needs a case that is not
 * done. The cases submitted before the run are counted in any case. */
void study_plan_run(const study_run *run, study_plan *plan)
{
    study_driver *driver = run->study->driver;
    study_context *context = driver ? &driver->context : NULL;
    ff_report *unheard = ff_report_new();
    study_run own = *run;
    *plan = (study_plan){.seconds = -1};
    if (!driver || run->shards > 1) {
        study_preview(run, plan);
    } else {
        context->report = unheard;
        context->run = &own;
        context->plan = plan;
        if (!driver->kind->cases(driver->study) && context->counted < context->planned)
            study_run_submitted(context, context->counted, context->planned);
        context->plan = NULL;
        context->run = NULL;
    }
    ff_report_free(unheard);
}

const char *study_compared(const study_definition *study, size_t i, size_t *index)
{
    const study_context *context = study->driver ? &study->driver->context : NULL;
    if (!context || i >= context->compared_count)
        return NULL;
    *index = context->first_compared + i;
    return context->compared[i];
}

const char *study_cases(const study_definition *study)
{
    return study->driver && study->driver->context.grid ? "grid cells" : "cases";
}

const char *study_kind_name(const study_definition *study)
{
    return study->driver ? study->driver->kind->name : "";
}

const char *study_further(const study_definition *study)
{
    return study->driver ? study->driver->context.further : "";
}

const study_context *study_found(const study_definition *study)
{
    return study->driver ? &study->driver->context : NULL;
}
