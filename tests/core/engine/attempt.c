/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "attempt.h"

#include "failing-allocator.h"

#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

static void add_array(attempt *a, const char *name, const ff_result *result)
{
    for (size_t n = 0; n < result->count; n++)
        a->answer += (double)(name[0] + name[1]) * result->data[n];
}

/* A file whose models are known. */
static ff_status run_file(attempt *a, ff_engine *engine)
{
    ff_run *run;
    const char *name;
    const ff_result *result;
    const ff_quality *line;
    ff_status status = ff_run_open(engine, a->file, NULL, &run);
    a->opening = memory.calls;
    if (a->only_loads || status != FF_OK) {
        ff_run_close(run);
        return status;
    }
    status = ff_run_start(run, NULL);
    for (size_t i = 0; status == FF_OK && ff_run_output(run, i, &name, &result) == FF_OK; i++)
        add_array(a, name, result);
    for (size_t i = 0; status == FF_OK && ff_run_quality(run, i, &line) == FF_OK; i++)
        a->answer += 1e3 * line->limit;
    ff_run_close(run);
    return status;
}

/* Models by hand, some of which use others; the last is none. */
static ff_status use_instances(attempt *a, ff_engine *engine)
{
    enum { ONE, SUM, LAW, USER, TABLE, NONE, COUNT };
    static const char *const ids[] = {"toy/source", "toy/consumer", "toy/law",
                                      "toy/user",   "toy/reader",   "toy/no-model"};
    static const double series[] = {1, 2, 3}, weights[] = {1, 2};
    static const size_t shape[] = {3};
    const ff_array array = {.data = series, .shape = shape, .rank = 1};
    ff_instance *x[COUNT] = {NULL};
    const ff_result *result;
    ff_status s = FF_OK, wrong = FF_OK;
    for (int i = 0; i < NONE && s == FF_OK; i++)
        s = ff_instance_new(engine, ids[i], &x[i]);
    if (s == FF_OK && (s = ff_instance_set(x[ONE], "level", "2 mm")) == FF_OK &&
        (s = ff_instance_set_reals(x[ONE], "weights", weights, 2)) == FF_OK &&
        (s = ff_instance_use(x[SUM], "source", x[ONE])) == FF_OK &&
        (s = ff_instance_give(x[SUM], "more.series", &array)) == FF_OK &&
        (s = ff_instance_run(x[SUM], NULL)) == FF_OK &&
        (s = ff_instance_result(x[SUM], "sum", &result)) == FF_OK)
        add_array(a, "sum", result);
    if (s == FF_OK && (s = ff_instance_set(x[LAW], "gain", "3")) == FF_OK &&
        (s = ff_instance_use(x[USER], "law", x[LAW])) == FF_OK &&
        (s = ff_instance_run(x[USER], "value")) == FF_OK &&
        (s = ff_instance_result(x[USER], "value", &result)) == FF_OK)
        add_array(a, "user", result);
    if (s == FF_OK && (s = ff_instance_set(x[TABLE], "file", "levels.csv")) == FF_OK &&
        (s = ff_instance_run(x[TABLE], NULL)) == FF_OK &&
        (s = ff_instance_result(x[TABLE], "sum", &result)) == FF_OK)
        add_array(a, "table", result);
    if (s == FF_OK && (wrong = ff_instance_set(x[ONE], "level", "2 m/s")) != FF_NOMEM)
        wrong = ff_instance_new(engine, ids[NONE], &x[NONE]);
    for (int i = COUNT; i-- > 0;)
        ff_instance_close(x[i]);
    return s == FF_OK ? wrong : s;
}

enum { MOST_STAGES = 24, MOST_PARTS = 24 };

/* The stages of a file as instances by hand, in the order of its run. */
struct recipe {
    size_t count;
    struct recipe_stage {
        char id[64], outputs[1000];
        struct {
            char name[64], value[200];
        } params[MOST_PARTS];
        struct {
            char name[64];
            size_t from;
        } wires[MOST_PARTS];
        size_t param_count, wire_count;
    } stages[MOST_STAGES];
};

static struct recipe *recipe;

static void write_stage(struct recipe_stage *to, const ff_stage *stage, const size_t *rank)
{
    const ff_model *model = stage->loaded->model;
    snprintf(to->id, sizeof to->id, "%s", model->id);
    for (size_t i = 0; i < model->output_count; i++)
        if (stage->results[i].data)
            strcat(strcat(to->outputs, " "), model->outputs[i].name);
    for (size_t i = 0; i < model->param_count; i++)
        if (stage->params[i].present && stage->params[i].place.source && !stage->params[i].wire) {
            snprintf(to->params[to->param_count].name, 64, "%s", model->params[i].name);
            ff_bound_print(stage, i, to->params[to->param_count++].value, 200);
        }
    for (size_t i = 0; i < stage->wire_count; i++)
        if (stage->wires[i].stage >= 0) {
            snprintf(to->wires[to->wire_count].name, 64, "%s", stage->wires[i].name);
            to->wires[to->wire_count++].from = rank[stage->wires[i].stage];
        }
}

/* Writes the recipe from a good run of the file. */
static void write_recipe(void *ctx)
{
    const attempt *plan = ctx;
    const ff_engine_options options = {sizeof options, &plan->plugins, 1};
    ff_engine *engine;
    ff_run *run;
    ff_engine_new(&options, &engine);
    ff_run_open(engine, plan->file, NULL, &run);
    const ff_pipeline *p = ff_run_pipeline(run);
    size_t rank[MOST_STAGES] = {0};
    if (!p || p->count > MOST_STAGES || ff_run_start(run, NULL) != FF_OK)
        return;
    for (size_t i = 0; i < p->count; i++) {
        const ff_stage *stage = &p->stages[p->order[i]];
        rank[p->order[i]] = recipe->count;
        if (stage->needed)
            write_stage(&recipe->stages[recipe->count++], stage, rank);
    }
}

/* In a process of its own, so that no model is there yet in the others. */
bool attempt_prepare(const attempt *plan)
{
    int protection = PROT_READ | PROT_WRITE, flags = MAP_SHARED | MAP_ANONYMOUS;
    if (plan->how != STAGES)
        return true;
    recipe = mmap(NULL, sizeof *recipe, protection, flags, -1, 0);
    if (recipe == MAP_FAILED)
        return false;
    if (fork() == 0) {
        attempt a = *plan;
        _exit(ff_protected(write_recipe, &a) != FF_OK);
    }
    wait(NULL);
    return recipe->count > 0;
}

/* Sets up and runs one instance; a stage that offers services alone is made. */
static ff_status use_stage(attempt *a, const struct recipe_stage *r, ff_instance *const *all,
                           ff_instance *x)
{
    ff_status s = FF_OK;
    char outputs[sizeof r->outputs];
    snprintf(outputs, sizeof outputs, "%s", r->outputs);
    for (size_t i = 0; i < r->param_count && s == FF_OK; i++)
        s = ff_instance_set(x, r->params[i].name, r->params[i].value);
    for (size_t i = 0; i < r->wire_count && s == FF_OK; i++)
        s = ff_instance_use(x, r->wires[i].name, all[r->wires[i].from]);
    if (s != FF_OK)
        return s;
    s = *outputs ? ff_instance_run(x, outputs) : ff_instance_ready(x);
    if (s == FF_OK && ff_instance_carry(x, x) == FF_OK)
        s = ff_instance_run(x, outputs);
    for (const char *name = strtok(outputs, " "); name && s == FF_OK; name = strtok(NULL, " ")) {
        const ff_result *result;
        s = ff_instance_result(x, name, &result);
        if (s == FF_OK)
            add_array(a, name, result);
    }
    return s;
}

static ff_status use_stages(attempt *a, ff_engine *engine)
{
    ff_instance *x[MOST_STAGES] = {NULL};
    ff_status s = FF_OK;
    for (size_t i = 0; i < recipe->count && s == FF_OK; i++)
        s = ff_instance_new(engine, recipe->stages[i].id, &x[i]);
    a->opening = memory.calls;
    for (size_t i = 0; i < recipe->count && s == FF_OK; i++)
        s = use_stage(a, &recipe->stages[i], x, x[i]);
    for (size_t i = recipe->count; i-- > 0;)
        ff_instance_close(x[i]);
    return s;
}

/* The status of the run; the answer has the length of the message, too. */
static ff_status run(attempt *a)
{
    const ff_engine_options options = {sizeof options, &a->plugins, 1};
    ff_engine *engine;
    ff_status status = ff_engine_new(&options, &engine);
    if (status != FF_OK)
        return status;
    if (a->how == INSTANCES)
        status = use_instances(a, engine);
    else if (a->how == STAGES)
        status = use_stages(a, engine);
    else
        status = run_file(a, engine);
    a->answer += 1e6 * (double)strlen(ff_engine_message(engine));
    ff_engine_close(engine);
    return status;
}

attempt attempt_run(const attempt *plan)
{
    attempt a = *plan;
    memory.calls = 0;
    a.status = run(&a);
    a.calls = memory.calls;
    return a;
}
