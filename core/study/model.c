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
    ff_desk *desk = ctx;
    desk->plan = (ff_study_plan){.size = sizeof desk->plan, .cases = "", .further = ""};
    return is_whole(model) ? model->plan(model->self, &desk->table, &desk->plan) : FF_BUG;
}

/* The outputs that cases are asked for, as a file would list them. */
static ff_node *request_of(ff_desk *desk)
{
    const ff_study_plan *plan = &desk->plan;
    ff_node *list = ff_arena_alloc(&desk->arena, sizeof *list);
    *list = (ff_node){.kind = FF_SEQUENCE, .count = plan->output_count};
    list->items = ff_arena_alloc(&desk->arena, (plan->output_count + 1) * sizeof *list->items);
    for (size_t i = 0; i < plan->output_count; i++) {
        const ff_node *written = plan->outputs[i]->place;
        list->items[i] = ff_arena_alloc(&desk->arena, sizeof **list->items);
        *list->items[i] =
            (ff_node){.kind = FF_SCALAR,
                      .place = written ? written->place : FF_NOWHERE,
                      .text = (char *)(uintptr_t)ff_desk_keep(desk, plan->outputs[i]->text)};
        if (i == 0)
            list->place = list->items[0]->place;
    }
    return list;
}

/* Adds the stage in which an assignment makes cases differ. */
static void add_knob(ff_desk *desk, ff_measure *m, const char *assignment)
{
    static const char prefix[] = "pipeline.";
    if (!strncmp(assignment, prefix, sizeof prefix - 1))
        assignment += sizeof prefix - 1;
    size_t length = strcspn(assignment, ".="), i = 0;
    for (const char *const *top = ff_pipeline_top_keys; *top; top++)
        m->all = m->all || (strlen(*top) == length && !strncmp(*top, assignment, length));
    while (i < m->knob_count &&
           (strlen(m->knobs[i]) != length || strncmp(m->knobs[i], assignment, length) != 0))
        i++;
    if (i == m->knob_count && length > 0)
        m->knobs[m->knob_count++] = ff_arena_text(&desk->arena, assignment, length);
}

/* What is measured beside the scalars; NULL: nothing. */
static ff_measure *measure_of(ff_desk *desk, const ff_node *request)
{
    const ff_study_plan *plan = &desk->plan;
    size_t most = desk->planned * plan->path_count + plan->stage_count + 1;
    if (!(plan->flags & FF_STUDY_COSTS))
        return NULL;
    ff_measure *m = ff_arena_alloc(&desk->arena, sizeof *m);
    *m = (ff_measure){.request = request, .along = plan->along, .repeat = desk->repeats};
    m->knobs = ff_arena_alloc(&desk->arena, most * sizeof *m->knobs);
    for (size_t i = 0; i < desk->planned; i++)
        for (size_t k = 0; k < plan->path_count; k++)
            if (*desk->list.varied[k].assignments[i])
                add_knob(desk, m, desk->list.varied[k].assignments[i]);
    for (size_t i = 0; i < plan->stage_count; i++)
        add_knob(desk, m, plan->stages[i]);
    return m;
}

/* The study of the cases that are known beforehand. */
static void lay_out_plan(ff_desk *desk, ff_study *study)
{
    const ff_node *request = request_of(desk);
    desk->measure = measure_of(desk, request);
    study->request = desk->list.request = request;
    study->extras = desk->list.extras = desk->plan.extras;
    study->extra_count = desk->list.extra_count = desk->plan.extra_count;
    study->measure = desk->list.measure = desk->measure;
    study->lay_first = desk->plan.flags & FF_STUDY_STRICT;
    const ff_study *grid = NULL;
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
    study->points = ff_arena_alloc(&desk->arena, sizeof *study->points);
    study->points[0] = study->count = desk->planned;
    study->axis_count = study->followed = study->way = 1;
}

static bool plan_is_usable(const ff_desk *desk)
{
    const ff_study_plan *p = &desk->plan;
    bool outputs = p->output_count > 0;
    for (size_t i = 0; i < p->output_count; i++)
        outputs = outputs && p->outputs[i] && p->outputs[i]->text;
    return (outputs && desk->planned > 0 && p->path_count > 0) ||
           ff_error(desk->report, FF_EXIT_PLUGIN, FF_NOWHERE, NULL,
                    "study: the plugin %s plans no cases, or no outputs of them",
                    desk->tool.pipeline->stages[0].loaded->path);
}

/* The cases of the file's sweep are the first. */
static bool take_sweep(ff_desk *desk, ff_study *study, const ff_node *node)
{
    if (!ff_study_read_axes(study, node, true, desk->report))
        return false;
    size_t room = 1;
    while (room < study->count)
        room *= 2;
    desk->cases = ff_resize(desk->cases, room * sizeof *desk->cases);
    desk->keys = ff_resize(desk->keys, room * sizeof *desk->keys);
    memset(desk->keys, 0, room * sizeof *desk->keys);
    for (desk->count = 0; desk->count < study->count; desk->count++)
        desk->cases[desk->count] = (ff_asked){.of = desk->count, .label = ""};
    desk->plan.path_count = desk->plan.extra_count = 0;
    desk->sweep = study;
    return true;
}

static bool open_model(ff_study *study, const ff_node *node, const char *key, ff_library *library,
                       ff_report *report)
{
    ff_desk *desk = study->desk = ff_alloc(sizeof *desk);
    desk->report = report;
    desk->name = ff_desk_keep(desk, key);
    desk->verdict = -1;
    desk->list = *study; /* its limits */
    desk->list.points = &desk->list.count;
    desk->list.axis_count = desk->list.followed = desk->list.way = 1;
    ff_desk_open(desk);
    const ff_tool_choice choice = {.option = "study",
                                   .interface = FF_STUDY_ID,
                                   .name = desk->name,
                                   .node = ff_node_get(node, key)};
    if (choice.node->kind != FF_MAP)
        return ff_error(report, FF_EXIT_INPUT, choice.node->place, NULL,
                        "%s: expected a map; flankfilm models lists what may stand there", key);
    if (!ff_tool_open(&desk->tool, library, &choice, report))
        return false;
    desk->model = desk->tool.table;
    if (!ff_tool_call(&desk->tool, "plan", call_plan, desk, report))
        return false;
    desk->planned = desk->count;
    if (desk->plan.flags & FF_STUDY_SWEEPS)
        return take_sweep(desk, study, node);
    if (!plan_is_usable(desk))
        return false;
    lay_out_plan(desk, study);
    for (size_t i = 0; i < node->count; i++)
        for (const char *const *own = ff_study_keys; *own; own++)
            if (!strcmp(node->keys[i], *own) && !strstr(*own, "_limit"))
                return ff_error(report, FF_EXIT_INPUT, choice.node->place, NULL,
                                "study: %s: a study either sweeps or %s: write two files", key,
                                desk->model->verb);
    return true;
}

/* The installed models that a key can name, as keys; to be freed. */
static const char **names_of(ff_library *library, size_t *count)
{
    const char *kind = strchr(FF_STUDY_ID, '.') + 1;
    size_t length = strcspn(kind, "/"), ids;
    const char *const *all = ff_library_ids(library, &ids);
    const char **names = ff_alloc((ids + 1) * sizeof *names);
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
static const char *find_model(const ff_node *node, ff_library *library, ff_report *report)
{
    size_t count, own = 0;
    const char **names = names_of(library, &count), *found = NULL;
    while (ff_study_keys[own])
        own++;
    const char **known = ff_alloc((own + count + 1) * sizeof *known);
    memcpy(known, ff_study_keys, own * sizeof *known);
    memcpy(known + own, names, count * sizeof *known);
    ff_study_check_keys(node, "", known, report);
    for (size_t i = 0; node->kind == FF_MAP && i < node->count; i++) {
        if (!is_among(node->keys[i], names, count))
            continue;
        if (found)
            ff_error(report, FF_EXIT_INPUT, node->key_places[i], NULL,
                     "study: \"%s\" and \"%s\" exclude each other: write two files", found,
                     node->keys[i]);
        found = node->keys[i];
    }
    free(names);
    free(known);
    return found;
}

ff_study *ff_study_open(const ff_node *node, ff_library *library, ff_report *report)
{
    size_t errors = ff_report_errors(report);
    const char *key = find_model(node, library, report);
    if (ff_report_errors(report) > errors)
        return NULL;
    if (!key)
        return ff_study_read(node, report);
    ff_study *study = ff_alloc(sizeof *study);
    if (ff_study_read_limits(study, node, report))
        open_model(study, node, key, library, report);
    return study;
}

void ff_desk_free(ff_desk *desk)
{
    if (!desk)
        return;
    ff_tool_close(&desk->tool);
    for (size_t i = 0; i < desk->block_count; i++)
        ff_study_free(desk->blocks[i].study);
    ff_desk_forget(desk);
    json_decref(desk->records);
    ff_desk_unlist(desk);
    json_decref(desk->facts);
    free(desk->blocks);
    free(desk->cases);
    free(desk->keys);
    free(desk->files);
    ff_arena_free(&desk->arena);
    free(desk);
}

const ff_stage *ff_knob_of(const ff_pipeline *pipeline, const char *path, size_t *param)
{
    const char *name;
    const ff_stage *stage = ff_stage_of(pipeline, path, &name);
    const bool ready = stage && stage->needed && stage->loaded && stage->params;
    const int found = ready ? ff_model_find_param(stage->loaded->model, name) : -1;
    const ff_bound *b = found < 0 ? NULL : &stage->params[found];
    const bool number = b && (b->row->type == FF_INT || b->row->type == FF_REAL);
    *param = number && b->present && !b->value.text ? (size_t)found : SIZE_MAX;
    return stage;
}

/* Whether the pipeline has the stage of what the plan names. */
static bool check_stage(const ff_desk *desk, const ff_pipeline *pipeline, const char *path,
                        ff_report *report)
{
    const char *name;
    return ff_stage_of(pipeline, path, &name) ||
           ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                    "%s: %s: the pipeline has no stage \"%.*s\"", desk->name, path,
                    (int)strcspn(path, "."), path);
}

/* An optional first dimension may be absent. */
static bool is_too_much(const ff_desk *desk, const char *dims)
{
    bool series = *dims != '\0', field = strchr(dims, ' ') && !strchr(dims, '?');
    return desk->plan.flags & FF_STUDY_SCALARS ? series : field;
}

static ff_status call_check(const void *table, void *ctx)
{
    const ff_study_model *model = table;
    ff_desk *desk = ctx;
    return model->check(model->self, &desk->table, desk->sweep ? desk->sweep->count : 0);
}

/* What the model itself has to say of it. */
static void ask_model(ff_desk *desk, const ff_pipeline *pipeline, ff_report *report)
{
    if (!desk || !FF_HAS(desk->model, check) || !desk->model->check)
        return;
    desk->report = report;
    desk->first = pipeline;
    ff_tool_call(&desk->tool, "check", call_check, desk, report);
    desk->first = NULL;
}

void ff_study_check(const ff_study *study, const ff_pipeline *pipeline, ff_report *report)
{
    const ff_desk *desk = study->desk;
    const ff_study_plan *plan = desk ? &desk->plan : NULL;
    const bool scalars = plan && plan->flags & FF_STUDY_SCALARS;
    size_t turned = 0;
    ask_model(study->desk, pipeline, report);
    for (size_t i = 0; study->request && i < study->request->count; i++) {
        const ff_node *asked = study->request->items[i];
        const char *name;
        const ff_stage *stage = ff_stage_of(pipeline, asked->text, &name);
        const ff_model *model = stage && stage->results ? stage->loaded->model : NULL;
        int output = model ? ff_model_find_output(model, name) : -1;
        const ff_port *row = output >= 0 ? stage->results[output].row : NULL;
        if (row && row->dims && is_too_much(desk, row->dims))
            ff_error(report, FF_EXIT_INPUT, asked->place,
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
            ff_knob_of(pipeline, plan->knobs[i], &param);
        turned += param != SIZE_MAX;
    }
    if (plan && plan->knobs && turned == 0)
        ff_warn(report, FF_NOWHERE,
                "%s: no number is refined, so that verdicts rest on the quality alone", desk->name);
}

const char *ff_study_cases(const ff_study *study)
{
    return study->desk && *study->desk->plan.cases ? study->desk->plan.cases : "cases";
}

const char *ff_study_further(const ff_study *study)
{
    return study->desk ? study->desk->plan.further : "";
}

bool ff_study_sweeps(const ff_study *study)
{
    return !study->desk || study->desk->sweep;
}

const char *ff_study_name(const ff_study *study)
{
    return study->desk ? study->desk->name : "";
}
