/* SPDX-License-Identifier: MIT */
/* Loops closed by feedback wires: their stages, and the settings for their iteration. */
#include "build.h"

#include <stdlib.h>
#include <string.h>

static const ff_param rows[] = {
    {.name = "rounds",
     .unit = "1",
     .doc = "largest number of rounds; a loop that has not converged after these is bad",
     .type = FF_INT,
     .preset = "30",
     .min = 2,
     .max = 10000},
    {.name = "tolerance",
     .unit = "1",
     .doc = "convergence limit: change on a feedback wire between rounds, relative to the largest "
            "number on it; 0: bitwise equal",
     .type = FF_REAL,
     .flags = FF_MAX_OPEN,
     .preset = "1e-6",
     .max = 1},
    {.name = "relaxation",
     .unit = "1",
     .doc = "share of the change that the next round applies; below 1 for loops that oscillate",
     .type = FF_REAL,
     .flags = FF_MIN_OPEN,
     .preset = "1",
     .max = 1},
};
enum { ROUNDS, TOLERANCE, RELAXATION, ROWS };

const ff_param *ff_feedback_rows(size_t *count)
{
    *count = ROWS;
    return rows;
}

static void check_keys(fe_build *b, const ff_node *map)
{
    const char *names[ROWS];
    for (size_t i = 0; i < ROWS; i++)
        names[i] = rows[i].name;
    for (size_t i = 0; i < map->count; i++) {
        size_t known = 0;
        while (known < ROWS && strcmp(map->keys[i], names[known]) != 0)
            known++;
        if (known == ROWS && strncmp(map->keys[i], "x-", 2) != 0)
            ff_error(b->report, FF_FAULT_INPUT, map->key_places[i], NULL,
                     "feedback: unknown key \"%.80s\"%s", map->keys[i],
                     fe_did_you_mean(b, map->keys[i], names, ROWS));
    }
}

void fe_read_feedback(fe_build *b, const ff_node *feedback)
{
    const ff_node *map = feedback && feedback->kind == FF_MAP ? feedback : NULL;
    ff_value values[ROWS];
    char why[64];
    ff_unit unit;
    if (map)
        check_keys(b, map);
    else if (feedback)
        fe_expected(b, feedback, "feedback", "a map such as {rounds: 30, tolerance: 1e-6}");
    ff_unit_parse("1", &unit, why, sizeof why);
    for (size_t i = 0; i < ROWS; i++) {
        const ff_node *node = map ? ff_node_get(map, rows[i].name) : NULL;
        const char *name = fe_pipeline_print(b->pipeline, "feedback.%s", rows[i].name);
        if (node)
            ff_param_read(&rows[i], &unit, name, node, &values[i], b->report);
        else
            ff_param_read_preset(&rows[i], &unit, name, &values[i], b->report);
    }
    b->pipeline->feedback = (ff_feedback){.rounds = values[ROUNDS].integer,
                                          .tolerance = values[TOLERANCE].real,
                                          .relaxation = values[RELAXATION].real};
}

/* Marks the stages that this stage needs, directly or through others. */
static void mark_needs(const ff_pipeline *pipeline, size_t stage, bool *needs)
{
    for (size_t i = 0; i < pipeline->stages[stage].wire_count; i++) {
        int from = pipeline->stages[stage].wires[i].stage;
        if (from < 0 || needs[from])
            continue;
        needs[from] = true;
        mark_needs(pipeline, (size_t)from, needs);
    }
}

ff_loop *fe_loop_of(const ff_pipeline *pipeline, const ff_stage *stage)
{
    return stage->loop ? &pipeline->loops[stage->loop - pipeline->loops] : NULL;
}

/* Groups stages that need each other into loops. */
static void gather_loops(ff_pipeline *pipeline)
{
    size_t count = pipeline->count;
    bool *needs = fe_alloc(count * count * sizeof *needs);
    for (size_t i = 0; i < count; i++)
        mark_needs(pipeline, i, &needs[i * count]);
    for (size_t i = 0; i < count; i++) {
        size_t at = pipeline->order[i];
        if (pipeline->stages[at].loop || !needs[at * count + at])
            continue;
        ff_loop *loop = &pipeline->loops[pipeline->loop_count++];
        for (size_t k = 0; k < count; k++) {
            if (!needs[at * count + k] || !needs[k * count + at])
                continue;
            pipeline->stages[k].loop = loop;
            loop->count++;
        }
    }
    fe_free(needs);
}

static void refuse(fe_build *b, ff_stage *stage, ff_place place, const char *why)
{
    stage->instance->broken = true;
    ff_error(b->report, FF_FAULT_INPUT, place, NULL, "%s: it is in a loop, %s", stage->name, why);
}

/* Marks the feedback wires that close the loop of the stage, and refuses wires that a loop cannot
   have. */
static void check_member(fe_build *b, ff_stage *stage)
{
    for (size_t i = 0; i < stage->wire_count; i++) {
        ff_wire *wire = &stage->wires[i];
        wire->closes = wire->feedback && wire->stage >= 0 &&
                       b->pipeline->stages[wire->stage].loop == stage->loop;
    }
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const ff_wire *wire = fe_input_wire(stage, i);
        ff_result *given = wire->closes ? ff_feeding_result(b->pipeline, stage, i) : NULL;
        if (given)
            given->required = true;
        if (wire->stage >= 0 && ff_model_input(stage->loaded->model, i)->service &&
            b->pipeline->stages[wire->stage].loop == stage->loop)
            refuse(b, stage, wire->place,
                   "so it cannot use a service of another stage in the loop");
    }
}

/* Puts a stage, or all stages of its loop, behind the stages that it needs. */
static void put_in_order(ff_pipeline *pipeline, const size_t *sorted, size_t at, bool *there,
                         size_t *count)
{
    const ff_loop *loop = pipeline->stages[at].loop;
    if (there[at])
        return;
    for (size_t i = 0; i < pipeline->count; i++)
        there[i] = there[i] || i == at || (loop && pipeline->stages[i].loop == loop);
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        for (size_t k = 0; (i == at || (loop && stage->loop == loop)) && k < stage->wire_count; k++)
            if (stage->wires[k].stage >= 0)
                put_in_order(pipeline, sorted, (size_t)stage->wires[k].stage, there, count);
    }
    for (size_t i = 0; i < pipeline->count; i++)
        if (sorted[i] == at || (loop && pipeline->stages[sorted[i]].loop == loop))
            pipeline->order[(*count)++] = sorted[i];
}

void fe_find_loops(fe_build *b)
{
    ff_pipeline *pipeline = b->pipeline;
    size_t stages = pipeline->count, count = 0;
    bool any = false;
    for (size_t i = 0; i < stages; i++)
        for (size_t k = 0; k < pipeline->stages[i].wire_count; k++)
            any = any || (pipeline->stages[i].wires[k].feedback &&
                          pipeline->stages[i].wires[k].stage >= 0);
    if (!any)
        return;
    pipeline->loops = fe_arena_alloc(&pipeline->memory->arena, stages * sizeof *pipeline->loops);
    gather_loops(pipeline);
    for (size_t i = 0; i < stages; i++)
        if (pipeline->stages[i].loop && pipeline->stages[i].loaded)
            check_member(b, &pipeline->stages[i]);
    size_t *sorted = fe_alloc(stages * sizeof *sorted);
    bool *there = fe_alloc(stages * sizeof *there);
    memcpy(sorted, pipeline->order, stages * sizeof *sorted);
    for (size_t i = 0; i < stages; i++)
        put_in_order(pipeline, sorted, sorted[i], there, &count);
    fe_free(there);
    fe_free(sorted);
}
