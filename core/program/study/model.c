/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies that a model drives: which one, its plan, and the study that this makes. */
#include "desk.h"

#include <stdlib.h>
#include <string.h>

static bool is_whole(const ff_study_model *model)
{
    return FF_HAS(model, run) && model->plan && model->run && model->verb;
}

static ff_status call_plan(const void *table, void *ctx)
{
    const ff_study_model *model = table;
    study_desk *desk = ctx;
    desk->plan = (ff_study_plan){.size = sizeof desk->plan, .cases = "", .further = ""};
    return is_whole(model) ? model->plan(model->self, &desk->table, &desk->plan) : FF_BUG;
}

/* The outputs that cases are asked for, as a file would list them. */
static fe_node *request_of(study_desk *desk)
{
    const ff_study_plan *plan = &desk->plan;
    fe_node *list = fe_arena_alloc(&desk->arena, sizeof *list);
    *list = (fe_node){.kind = FE_SEQUENCE, .count = plan->output_count};
    list->items = fe_arena_alloc(&desk->arena, (plan->output_count + 1) * sizeof *list->items);
    for (size_t i = 0; i < plan->output_count; i++) {
        const fe_node *written = plan->outputs[i]->place;
        list->items[i] = fe_arena_alloc(&desk->arena, sizeof **list->items);
        *list->items[i] =
            (fe_node){.kind = FE_SCALAR,
                      .place = written ? written->place : FE_NOWHERE,
                      .text = (char *)(uintptr_t)study_desk_keep(desk, plan->outputs[i]->text)};
        if (i == 0)
            list->place = list->items[0]->place;
    }
    return list;
}

/* Adds the stage in which an assignment makes cases differ. */
static void add_knob(study_desk *desk, study_measure *m, const char *assignment)
{
    static const char prefix[] = "pipeline.";
    if (!strncmp(assignment, prefix, sizeof prefix - 1))
        assignment += sizeof prefix - 1;
    size_t length = strcspn(assignment, ".="), i = 0;
    for (const char *const *top = fe_pipeline_top_keys; *top; top++)
        m->all = m->all || (strlen(*top) == length && !strncmp(*top, assignment, length));
    while (i < m->knob_count &&
           (strlen(m->knobs[i]) != length || strncmp(m->knobs[i], assignment, length) != 0))
        i++;
    if (i == m->knob_count && length > 0)
        m->knobs[m->knob_count++] = fe_arena_text(&desk->arena, assignment, length);
}

/* What is measured beside the scalars; NULL: nothing. */
static study_measure *measure_of(study_desk *desk, const fe_node *request)
{
    const ff_study_plan *plan = &desk->plan;
    size_t most = desk->planned * plan->path_count + plan->stage_count + 1;
    if (!(plan->flags & FF_STUDY_COSTS))
        return NULL;
    study_measure *m = fe_arena_alloc(&desk->arena, sizeof *m);
    *m = (study_measure){.request = request, .along = plan->along, .repeat = desk->repeats};
    m->knobs = fe_arena_alloc(&desk->arena, most * sizeof *m->knobs);
    for (size_t i = 0; i < desk->planned; i++)
        for (size_t k = 0; k < plan->path_count; k++)
            if (*desk->list.varied[k].assignments[i])
                add_knob(desk, m, desk->list.varied[k].assignments[i]);
    for (size_t i = 0; i < plan->stage_count; i++)
        add_knob(desk, m, plan->stages[i]);
    return m;
}

/* The study of the cases that are known beforehand. */
static void lay_out_plan(study_desk *desk, study_definition *study)
{
    const fe_node *request = request_of(desk);
    desk->measure = measure_of(desk, request);
    study->request = desk->list.request = request;
    study->extras = desk->list.extras = desk->plan.extras;
    study->extra_count = desk->list.extra_count = desk->plan.extra_count;
    study->measure = desk->list.measure = desk->measure;
    study->lay_first = desk->plan.flags & FF_STUDY_STRICT;
    const study_definition *grid = NULL;
    for (size_t i = 0; i < desk->block_count && desk->plan.grid; i++)
        if (desk->blocks[i].block == desk->plan.grid &&
            desk->plan.grid->case_count == desk->planned)
            grid = desk->blocks[i].study;
    if (grid) {
        study->varied = grid->varied;
        study->varied_count = grid->varied_count;
        study->points = grid->points;
        study->axis_count = study->followed = study->way = grid->axis_count;
        study->count = grid->count;
        return;
    }
    study->varied = desk->list.varied;
    study->varied_count = desk->list.varied_count;
    study->points = fe_arena_alloc(&desk->arena, sizeof *study->points);
    study->points[0] = study->count = desk->planned;
    study->axis_count = study->followed = study->way = 1;
}

static bool plan_is_usable(const study_desk *desk)
{
    const ff_study_plan *p = &desk->plan;
    bool outputs = p->output_count > 0;
    for (size_t i = 0; i < p->output_count; i++)
        outputs = outputs && p->outputs[i] && p->outputs[i]->text;
    return (outputs && desk->planned > 0 && p->path_count > 0) ||
           fe_error(desk->report, FE_EXIT_PLUGIN, FE_NOWHERE, NULL,
                    "study: the plugin %s plans no cases, or no outputs of them",
                    desk->tool.pipeline->stages[0].loaded->path);
}

/* The cases of the file's sweep are the first. */
static bool take_sweep(study_desk *desk, study_definition *study, const fe_node *node)
{
    if (!study_read_axes(study, node, true, desk->report))
        return false;
    size_t room = 1;
    while (room < study->count)
        room *= 2;
    desk->cases = fe_resize(desk->cases, room * sizeof *desk->cases);
    desk->keys = fe_resize(desk->keys, room * sizeof *desk->keys);
    memset(desk->keys, 0, room * sizeof *desk->keys);
    for (desk->count = 0; desk->count < study->count; desk->count++)
        desk->cases[desk->count] = (study_asked){.of = desk->count, .label = ""};
    desk->plan.path_count = desk->plan.extra_count = 0;
    desk->sweep = study;
    return true;
}

static bool open_model(study_definition *study, const fe_node *node, const char *key,
                       fe_library *library, fe_report *report)
{
    study_desk *desk = study->desk = fe_alloc(sizeof *desk);
    desk->report = report;
    desk->name = study_desk_keep(desk, key);
    desk->verdict = -1;
    desk->list = *study; /* its limits */
    desk->list.points = &desk->list.count;
    desk->list.axis_count = desk->list.followed = desk->list.way = 1;
    study_desk_open(desk);
    const fe_tool_choice choice = {.option = "study",
                                   .interface = FF_STUDY_ID,
                                   .name = desk->name,
                                   .node = fe_node_get(node, key)};
    if (choice.node->kind != FE_MAP)
        return fe_error(report, FE_EXIT_INPUT, choice.node->place, NULL,
                        "%s: expected a map; flankfilm models lists what may stand there", key);
    if (!fe_tool_open(&desk->tool, library, &choice, report))
        return false;
    desk->model = desk->tool.table;
    if (!fe_tool_call(&desk->tool, "plan", call_plan, desk, report))
        return false;
    desk->planned = desk->count;
    if (desk->plan.flags & FF_STUDY_SWEEPS)
        return take_sweep(desk, study, node);
    if (!plan_is_usable(desk))
        return false;
    lay_out_plan(desk, study);
    for (size_t i = 0; i < node->count; i++)
        for (const char *const *own = study_keys; *own; own++)
            if (!strcmp(node->keys[i], *own) && !strstr(*own, "_limit"))
                return fe_error(report, FE_EXIT_INPUT, choice.node->place, NULL,
                                "study: %s: a study either sweeps or %s: write two files", key,
                                desk->model->verb);
    return true;
}

/* The installed models that a key can name, as keys; to be freed. */
static const char **names_of(fe_library *library, size_t *count)
{
    const char *kind = strchr(FF_STUDY_ID, '.') + 1;
    size_t length = strcspn(kind, "/"), ids;
    const char *const *all = fe_library_ids(library, &ids);
    const char **names = fe_alloc((ids + 1) * sizeof *names);
    *count = 0;
    for (size_t i = 0; i < ids; i++)
        if (!strncmp(all[i], kind, length + 1))
            names[(*count)++] = all[i] + length + 1;
    return names;
}

static bool is_among(const char *word, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!strcmp(word, words[i]))
            return true;
    return false;
}

/* The key that names a model, NULL: none does. Unknown keys are errors. */
static const char *find_model(const fe_node *node, fe_library *library, fe_report *report)
{
    size_t count, own = 0;
    const char **names = names_of(library, &count), *found = NULL;
    while (study_keys[own])
        own++;
    const char **known = fe_alloc((own + count + 1) * sizeof *known);
    memcpy(known, study_keys, own * sizeof *known);
    memcpy(known + own, names, count * sizeof *known);
    study_check_keys(node, "", known, report);
    for (size_t i = 0; node->kind == FE_MAP && i < node->count; i++) {
        if (!is_among(node->keys[i], names, count))
            continue;
        if (found)
            fe_error(report, FE_EXIT_INPUT, node->key_places[i], NULL,
                     "study: \"%s\" and \"%s\" exclude each other: write two files", found,
                     node->keys[i]);
        found = node->keys[i];
    }
    free(names);
    free(known);
    return found;
}

study_definition *study_open(const fe_node *node, fe_library *library, fe_report *report)
{
    size_t errors = fe_report_errors(report);
    const char *key = find_model(node, library, report);
    if (fe_report_errors(report) > errors)
        return NULL;
    if (!key)
        return study_read(node, report);
    study_definition *study = fe_alloc(sizeof *study);
    if (study_read_limits(study, node, report))
        open_model(study, node, key, library, report);
    return study;
}

void study_desk_free(study_desk *desk)
{
    if (!desk)
        return;
    fe_tool_close(&desk->tool);
    for (size_t i = 0; i < desk->block_count; i++)
        study_free(desk->blocks[i].study);
    study_desk_forget(desk);
    json_decref(desk->records);
    study_desk_unlist(desk);
    json_decref(desk->facts);
    free(desk->blocks);
    free(desk->cases);
    free(desk->keys);
    free(desk->files);
    fe_arena_free(&desk->arena);
    free(desk);
}

const fe_stage *study_knob_of(const fe_pipeline *pipeline, const char *path, size_t *param)
{
    const char *name;
    const fe_stage *stage = fe_stage_of(pipeline, path, &name);
    const bool ready = stage && stage->needed && stage->loaded && stage->params;
    const int found = ready ? ff_model_find_param(stage->loaded->model, name) : -1;
    const fe_bound *b = found < 0 ? NULL : &stage->params[found];
    const bool number = b && (b->row->type == FF_INT || b->row->type == FF_REAL);
    *param = number && b->present && !b->value.text ? (size_t)found : SIZE_MAX;
    return stage;
}

/* Whether the pipeline has the stage of what the plan names. */
static bool check_stage(const study_desk *desk, const fe_pipeline *pipeline, const char *path,
                        fe_report *report)
{
    const char *name;
    return fe_stage_of(pipeline, path, &name) ||
           fe_error(report, FE_EXIT_INPUT, FE_NOWHERE, NULL,
                    "%s: %s: the pipeline has no stage \"%.*s\"", desk->name, path,
                    (int)strcspn(path, "."), path);
}

/* An optional first dimension may be absent. */
static bool is_too_much(const study_desk *desk, const char *dims)
{
    bool series = *dims != '\0', field = strchr(dims, ' ') && !strchr(dims, '?');
    return desk->plan.flags & FF_STUDY_SCALARS ? series : field;
}

static ff_status call_check(const void *table, void *ctx)
{
    const ff_study_model *model = table;
    study_desk *desk = ctx;
    return model->check(model->self, &desk->table, desk->sweep ? desk->sweep->count : 0);
}

/* What the model itself has to say of it. */
static void ask_model(study_desk *desk, const fe_pipeline *pipeline, fe_report *report)
{
    if (!desk || !FF_HAS(desk->model, check) || !desk->model->check)
        return;
    desk->report = report;
    desk->first = pipeline;
    fe_tool_call(&desk->tool, "check", call_check, desk, report);
    desk->first = NULL;
}

void study_check(const study_definition *study, const fe_pipeline *pipeline, fe_report *report)
{
    const study_desk *desk = study->desk;
    const ff_study_plan *plan = desk ? &desk->plan : NULL;
    const bool scalars = plan && plan->flags & FF_STUDY_SCALARS;
    size_t turned = 0;
    ask_model(study->desk, pipeline, report);
    for (size_t i = 0; study->request && i < study->request->count; i++) {
        const fe_node *asked = study->request->items[i];
        const char *name;
        const fe_stage *stage = fe_stage_of(pipeline, asked->text, &name);
        const ff_model *model = stage && stage->results ? stage->loaded->model : NULL;
        int output = model ? ff_model_find_output(model, name) : -1;
        const ff_port *row = output >= 0 ? stage->results[output].row : NULL;
        if (row && row->dims && is_too_much(desk, row->dims))
            fe_error(report, FE_EXIT_INPUT, asked->place,
                     scalars ? "name a scalar, such as a mean or an extreme value" : NULL,
                     scalars ? "%s: %s is a series or a field, which cannot be compared"
                             : "%s: %s is a field; name scalars and series",
                     desk->name, asked->text);
    }
    for (size_t i = 0; plan && i < plan->name_count; i++)
        check_stage(desk, pipeline, plan->names[i], report);
    for (size_t i = 0; plan && i < plan->knob_count; i++) {
        size_t param = SIZE_MAX;
        if (check_stage(desk, pipeline, plan->knobs[i], report))
            study_knob_of(pipeline, plan->knobs[i], &param);
        turned += param != SIZE_MAX;
    }
    if (plan && plan->knobs && turned == 0)
        fe_warn(report, FE_NOWHERE,
                "%s: no number is refined, so that verdicts rest on the quality alone", desk->name);
}

const char *study_cases(const study_definition *study)
{
    return study->desk && *study->desk->plan.cases ? study->desk->plan.cases : "cases";
}

const char *study_further(const study_definition *study)
{
    return study->desk ? study->desk->plan.further : "";
}

bool study_sweeps(const study_definition *study)
{
    return !study->desk || study->desk->sweep;
}

const char *study_name(const study_definition *study)
{
    return study->desk ? study->desk->name : "";
}
