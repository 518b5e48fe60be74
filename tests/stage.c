/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "stage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct {
    int at, calls;
} stopping;

static void print_log(void *ctx, const ff_stage *s, int32_t level, const char *text)
{
    (void)ctx;
    fprintf(stderr, "%s: %s%s\n", s->use, level == FF_LOG_WARNING ? "warning: " : "", text);
}

static int32_t count_progress(void *ctx, const ff_stage *s, double fraction)
{
    (void)ctx, (void)s, (void)fraction;
    return ++stopping.calls == stopping.at;
}

static const ff_observer logging = {.size = sizeof logging, .log = print_log};
static const ff_observer counting = {
    .size = sizeof counting, .log = print_log, .progress = count_progress};

static ff_engine *engine;

static ff_status require(ff_status status, int good)
{
    if (good)
        return status;
    fputs(engine ? ff_engine_message(engine) : "out of memory", stderr);
    exit(2);
}

stage *stage_open(const char *id)
{
    const char *directory = getenv("FLANKFILM_TEST_PLUGINS");
    stage *s;
    if (!directory)
        directory = "plugins";
    const ff_engine_options options = {sizeof options, &directory, 1};
    ff_status status = engine ? FF_OK : ff_engine_new(&options, &engine);
    require(status, status == FF_OK);
    status = ff_instance_new(engine, id, &s);
    require(status, status == FF_OK);
    ff_instance_observe(s, &logging);
    return s;
}

void stage_close(stage *s)
{
    ff_instance_close(s);
}

void stage_set(stage *s, const char *param, double si)
{
    stage_set_reals(s, param, 1, &si);
}

void stage_set_reals(stage *s, const char *param, size_t count, const double *si)
{
    ff_status status = ff_instance_set_reals(s, param, si, count);
    require(status, status == FF_OK);
}

void stage_set_text(stage *s, const char *param, const char *text)
{
    ff_status status = ff_instance_set(s, param, text);
    require(status, status == FF_OK);
}

ff_status stage_try_text(stage *s, const char *param, const char *text)
{
    return ff_instance_set(s, param, text);
}

void stage_link(stage *s, const char *wire, stage *from)
{
    ff_status status = ff_instance_use(s, wire, from);
    require(status, status == FF_OK);
}

void stage_give(stage *s, const char *row, uint32_t rank, const size_t *shape, const double *data)
{
    const ff_array array = {.data = data, .shape = shape, .rank = rank};
    ff_status status = ff_instance_give(s, row, &array);
    require(status, status == FF_OK);
}

void stage_give_series(stage *s, const char *row, size_t count, const double *data)
{
    stage_give(s, row, 1, &count, data);
}

void stage_give_scalar(stage *s, const char *row, double value)
{
    stage_give(s, row, 0, NULL, &value);
}

ff_status stage_ready(stage *s)
{
    ff_status status = ff_instance_ready(s);
    return require(status, status != FF_BUG);
}

ff_status stage_run(stage *s)
{
    return stage_run_wanted(s, NULL);
}

ff_status stage_run_wanted(stage *s, const char *outputs)
{
    stopping.calls = 0;
    ff_status status = ff_instance_run(s, outputs);
    return require(status, status != FF_BUG);
}

int stage_carry(stage *to, stage *from)
{
    return ff_instance_carry(to, from) == FF_OK;
}

static const ff_result *result(const stage *s, const char *output)
{
    const ff_result *r;
    if (ff_instance_result(s, output, &r) == FF_OK)
        return r;
    fprintf(stderr, "%s: output %s was not given\n", ff_instance_stage(s)->use, output);
    exit(2);
}

int stage_has(const stage *s, const char *output)
{
    const ff_result *r;
    return ff_instance_result(s, output, &r) == FF_OK;
}

size_t stage_count(const stage *s, const char *output)
{
    return result(s, output)->count;
}

const double *stage_get(const stage *s, const char *output, size_t *count)
{
    const ff_result *r = result(s, output);
    if (count)
        *count = r->count;
    if (r->count > 0)
        return r->data;
    fprintf(stderr, "%s: output %s is empty\n", ff_instance_stage(s)->use, output);
    exit(2);
}

const size_t *stage_shape(const stage *s, const char *output, uint32_t *rank)
{
    const ff_result *r = result(s, output);
    if (rank)
        *rank = r->rank;
    return r->shape;
}

double stage_scalar(const stage *s, const char *output)
{
    return stage_get(s, output, NULL)[0];
}

const void *stage_service(stage *s, const char *id)
{
    const void *table;
    ff_status status = ff_instance_service(s, id, &table);
    require(status, status >= 0);
    return table;
}

const char *stage_why(const stage *s)
{
    return ff_instance_reason(s);
}

const char *stage_why_item(const stage *s)
{
    return ff_instance_item(s);
}

static const ff_quality *find_quality(const stage *s, const char *name)
{
    const ff_quality *line;
    for (size_t i = 0; ff_instance_quality(s, i, &line) == FF_OK; i++)
        if (!strcmp(line->name, name))
            return line;
    return NULL;
}

int stage_has_quality(const stage *s, const char *name)
{
    return find_quality(s, name) != NULL;
}

static const ff_quality *quality(const stage *s, const char *name)
{
    const ff_quality *line = find_quality(s, name);
    if (line)
        return line;
    fprintf(stderr, "%s: no quality line %s\n", ff_instance_stage(s)->use, name);
    exit(2);
}

double stage_quality(const stage *s, const char *name)
{
    return quality(s, name)->value;
}

double stage_quality_limit(const stage *s, const char *name)
{
    return quality(s, name)->limit;
}

int stage_verdict(const stage *s)
{
    int32_t verdict;
    ff_instance_verdict(s, &verdict);
    return verdict;
}

void stage_stop_at(stage *s, int call)
{
    stopping.at = call;
    ff_instance_observe(s, call ? &counting : &logging);
}
