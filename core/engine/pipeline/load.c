/* SPDX-License-Identifier: MIT */
/*
 * The model of a stage. A stage that chooses its model stands in the file, and in the graph, as one
 * with the parameters, inputs and outputs of all its candidates, by name; each candidate is a stage
 * of its own beside it.
 */
#include "build.h"

#include <stdlib.h>
#include <string.h>

static const char auto_ending[] = "/auto";

static const ff_param reference_row = {
    .name = "reference",
    .unit = "",
    .doc = "the law that the others are held against; without it the first set under `with`",
    .type = FF_TEXT,
};

static const ff_param own_rows[FE_OWN_ROWS] = {
    [FE_ACCURACY] = {.name = "accuracy",
                     .unit = "%",
                     .doc = "largest error, over the result, that the chosen model may promise",
                     .type = FF_REAL,
                     .flags = FF_MIN_OPEN,
                     .preset = "2 %",
                     .max = 100},
    [FE_ONLY] = {.name = "only",
                 .unit = "",
                 .doc = "the one model that may be chosen",
                 .type = FF_TEXT},
    [FE_REFINE] = {.name = "refine",
                   .unit = "",
                   .doc =
                       "settings of the numerics that stand in the file may be changed, too, and "
                       "the best model will do where none promises the accuracy",
                   .type = FF_BOOL},
};

bool ff_names_kind_only(const char *use)
{
    size_t length = strlen(use), ending = sizeof auto_ending - 1;
    return length > ending && !strcmp(use + length - ending, auto_ending);
}

bool fe_read_accuracy(fe_build *b, ff_value *value)
{
    ff_param row = own_rows[FE_ACCURACY];
    ff_unit unit;
    char why[64];
    row.choices = "measured"; /* which fe_accuracy_of has taken out; said here for messages */
    return ff_unit_parse(row.unit, &unit, why, sizeof why) &&
           ff_param_read(&row, &unit, "accuracy", b->accuracy, value, b->report);
}

void fe_check_accuracy(fe_build *b)
{
    ff_value value;
    if (b->accuracy && fe_read_accuracy(b, &value))
        ff_value_clear(&value);
}

static bool is_choosing(fe_build *b, const ff_stage *stage)
{
    if (stage->instance->candidate)
        return false;
    if (ff_names_kind_only(stage->use))
        return true;
    if (!ff_node_get(stage->node, own_rows[FE_ACCURACY].name))
        return false;
    ff_report *captured = ff_report_new();
    const ff_loaded *loaded = ff_engine_model(b->engine, stage->use, FF_NOWHERE, captured);
    ff_report_free(captured);
    return loaded && ff_model_find_param(loaded->model, own_rows[FE_ACCURACY].name) < 0;
}

void fe_leave_out(ff_pipeline *pipeline, ff_candidate *c, const char *reason)
{
    c->fits = false;
    c->reason = fe_pipeline_print(pipeline, "%s", reason);
}

static ff_stage *new_stage(fe_build *b, const ff_stage *like, const char *id)
{
    fe_arena *arena = &b->pipeline->memory->arena;
    ff_stage *stage = fe_arena_alloc(arena, sizeof *stage);
    *stage = (ff_stage){.name = like->name,
                        .place = like->place,
                        .use = id,
                        .use_place = like->use_place,
                        .node = like->node,
                        .needed = true,
                        .why = like->why};
    stage->instance = fe_arena_alloc(arena, sizeof *stage->instance);
    stage->instance->stage = stage;
    stage->instance->candidate = true;
    return stage;
}

static bool same_dims(const ff_dims *a, const ff_dims *b)
{
    bool same = a->rank == b->rank && a->first_optional == b->first_optional;
    for (uint32_t i = 0; same && i < a->rank; i++)
        same = !strcmp(a->name[i], b->name[i]);
    return same;
}

/* The tables of a stage that chooses, which grow by each candidate. */
typedef struct tables {
    fe_arena *arena;
    ff_model *model;
    ff_loaded *loaded;
    ff_param *params;
    ff_port *inputs, *outputs;
} tables;

static void *longer(const tables *t, const void *old, size_t count, size_t size)
{
    char *rows = fe_arena_alloc(t->arena, (count + 1) * size);
    if (count)
        memcpy(rows, old, count * size);
    return rows;
}

static void add_param(tables *t, const ff_param *row, const ff_unit *unit)
{
    size_t n = t->model->param_count++;
    t->params = longer(t, t->params, n, sizeof *t->params);
    t->loaded->param_units = longer(t, t->loaded->param_units, n, sizeof *unit);
    t->params[n] = *row;
    t->loaded->param_units[n] = *unit;
}

static void add_params(tables *t, const ff_loaded *from)
{
    for (size_t i = 0; i < from->model->param_count; i++) {
        ff_param row = *ff_model_param(from->model, i);
        row.flags &= ~(uint32_t)FF_REQUIRED;
        row.preset = row.group = row.instead = NULL; /* each candidate has its own */
        if (ff_model_find_param(t->model, row.name) < 0)
            add_param(t, &row, &from->param_units[i]);
        t->model->params = t->params;
    }
}

static void add_inputs(tables *t, const ff_loaded *from)
{
    for (size_t i = 0; i < from->model->input_count; i++) {
        const ff_port *row = ff_model_input(from->model, i);
        int known = ff_model_find_input(t->model, row->name);
        size_t n = t->model->input_count;
        if (known >= 0) {
            t->inputs[known].flags &= row->flags; /* optional when it is for all of them */
            continue;
        }
        t->model->input_count++;
        t->model->inputs = t->inputs = longer(t, t->inputs, n, sizeof *row);
        t->loaded->input_units = longer(t, t->loaded->input_units, n, sizeof(ff_unit));
        t->loaded->input_dims = longer(t, t->loaded->input_dims, n, sizeof(ff_dims));
        t->inputs[n] = *row;
        t->loaded->input_units[n] = from->input_units[i];
        t->loaded->input_dims[n] = from->input_dims[i];
    }
}

/* The name of an output that the tables have with another unit or dimensions; NULL: there is none.
 */
static const char *clash(const tables *t, const ff_loaded *from)
{
    for (size_t i = 0; i < from->model->output_count; i++) {
        const ff_port *row = ff_model_output(from->model, i);
        int known = ff_model_find_output(t->model, row->name);
        if (known >= 0 &&
            (!row->service != !t->outputs[known].service ||
             (row->service && strcmp(row->service, t->outputs[known].service) != 0) ||
             !ff_unit_same_dimension(&t->loaded->output_units[known], &from->output_units[i]) ||
             !same_dims(&t->loaded->output_dims[known], &from->output_dims[i])))
            return row->name;
    }
    return NULL;
}

static void add_outputs(tables *t, const ff_loaded *from)
{
    for (size_t i = 0; i < from->model->output_count; i++) {
        const ff_port *row = ff_model_output(from->model, i);
        size_t n = t->model->output_count;
        if (ff_model_find_output(t->model, row->name) >= 0)
            continue;
        t->model->output_count++;
        t->model->outputs = t->outputs = longer(t, t->outputs, n, sizeof *row);
        t->loaded->output_units = longer(t, t->loaded->output_units, n, sizeof(ff_unit));
        t->loaded->output_dims = longer(t, t->loaded->output_dims, n, sizeof(ff_dims));
        t->outputs[n] = *row;
        t->loaded->output_units[n] = from->output_units[i];
        t->loaded->output_dims[n] = from->output_dims[i];
    }
}

static tables begin_tables(fe_build *b, ff_stage *stage)
{
    tables t = {.arena = &b->pipeline->memory->arena};
    ff_unit unit;
    char why[64];
    t.model = fe_arena_alloc(t.arena, sizeof *t.model);
    t.loaded = fe_arena_alloc(t.arena, sizeof *t.loaded);
    t.loaded->model = t.model;
    t.loaded->path = fe_pipeline_print(b->pipeline, "%s", stage->use);
    *t.model = (ff_model){.size = sizeof *t.model,
                          .abi_major = FF_ABI_MAJOR,
                          .id = stage->use,
                          .version = "",
                          .summary = "",
                          .reference = "",
                          .bibtex = "",
                          .licence = "",
                          .param_stride = sizeof(ff_param),
                          .input_stride = sizeof(ff_port),
                          .output_stride = sizeof(ff_port)};
    for (size_t i = 0; i < FE_OWN_ROWS; i++) {
        ff_unit_parse(own_rows[i].unit, &unit, why, sizeof why);
        add_param(&t, &own_rows[i], &unit);
    }
    t.model->params = t.params;
    return t;
}

static bool load_model(fe_build *b, ff_stage *stage)
{
    stage->loaded = ff_engine_model(b->engine, stage->use, stage->use_place, b->report);
    if (!stage->loaded)
        return false;
    const ff_model *model = stage->loaded->model;
    stage->results =
        fe_arena_alloc(&b->pipeline->memory->arena, model->output_count * sizeof *stage->results);
    for (size_t i = 0; i < model->output_count; i++)
        stage->results[i].row = ff_model_output(model, i);
    return true;
}

/* Adds the model `id` and its tables; false when it is left out. */
static bool add_candidate(fe_build *b, ff_stage *stage, const char *id, tables *t)
{
    ff_choice *choice = stage->choice;
    fe_build capturing = *b;
    capturing.report = ff_report_new();
    ff_candidate *c = &choice->candidates[choice->count++];
    const char *other = NULL;
    *c = (ff_candidate){.stage = new_stage(b, stage, id), .fits = true, .proposals = ""};
    if (!load_model(&capturing, c->stage))
        fe_leave_out(b->pipeline, c, ff_report_first(capturing.report)->text);
    else if (!ff_model_assesses(c->stage->loaded->model))
        fe_leave_out(b->pipeline, c, "it does not assess itself");
    else if ((other = clash(t, c->stage->loaded)))
        fe_leave_out(b->pipeline, c,
                     fe_pipeline_print(b->pipeline,
                                       "its output \"%s\" is not in the form that others give",
                                       other));
    ff_report_free(capturing.report);
    if (!c->fits)
        return false;
    add_params(t, c->stage->loaded);
    add_inputs(t, c->stage->loaded);
    add_outputs(t, c->stage->loaded);
    return true;
}

static bool load_candidates(fe_build *b, ff_stage *stage)
{
    fe_arena *arena = &b->pipeline->memory->arena;
    size_t count, kind = strcspn(stage->use, "/") + 1;
    const char *const *ids = ff_engine_ids(b->engine, &count);
    bool all = ff_names_kind_only(stage->use), some = false;
    if (stage->instance->broken)
        return false;
    tables t = begin_tables(b, stage);
    stage->choice = fe_arena_alloc(arena, sizeof *stage->choice);
    stage->choice->use = stage->use;
    stage->choice->candidates =
        fe_arena_alloc(arena, (count + 1) * sizeof *stage->choice->candidates);
    for (size_t i = 0; all && i < count; i++)
        if (!strncmp(ids[i], stage->use, kind))
            some = add_candidate(b, stage, ids[i], &t) || some;
    if (!all)
        some = add_candidate(b, stage, stage->use, &t);
    if (!some) {
        stage->instance->broken = true;
        stage->choice = NULL;
        return ff_error(b->report, FF_FAULT_INPUT, stage->use_place, NULL,
                        all ? "%s: no installed model of the kind %.*s can say how well it would do"
                            : "%s: %.*s cannot say how well it would do: no accuracy can be asked "
                              "of it",
                        stage->name, all ? (int)kind - 1 : 100, stage->use);
    }
    for (size_t i = 0; i < t.model->output_count; i++)
        stage->choice->serves = stage->choice->serves || t.outputs[i].service;
    if (stage->choice->serves && ff_model_find_param(t.model, reference_row.name) < 0)
        add_param(&t, &reference_row, &(ff_unit){0});
    t.model->params = t.params;
    stage->loaded = t.loaded;
    stage->results = fe_arena_alloc(arena, t.model->output_count * sizeof *stage->results);
    for (size_t i = 0; i < t.model->output_count; i++)
        stage->results[i].row = ff_model_output(t.model, i);
    return true;
}

bool fe_load_stage(fe_build *b, ff_stage *stage)
{
    if (stage->loaded || !stage->use)
        return stage->loaded != NULL;
    return is_choosing(b, stage) ? load_candidates(b, stage) : load_model(b, stage);
}
