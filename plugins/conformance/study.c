/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a study owes: it comes to an end, whatever its cases give, and asks the same again. */
#include "offer.h"

#include <flankfilm/study.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CASES = 20000, MOST_POINTS = 1000, PATHS = 8, SWEPT = 6 };

/* What cases give: y = 1 + 1/x^2; nothing, with a reason; NaN; and a run that is stopped. */
typedef enum world { GOOD, FAILING, NAN_EVERYWHERE, STOPPED, WORLDS } world;
static const char *const names[WORLDS] = {"good cases", "cases that fail",
                                          "cases without a finite number", "a run that is stopped"};

/* A desk that runs nothing. */
typedef struct desk {
    ff_study_desk table;
    const ff_fixture *fixture;
    ff_study_plan plan;
    world world;
    int planning;
    double *x;     /* of each case */
    size_t *asked; /* outputs of each case of a sweep once more */
    size_t count, runs;
    char said[300]; /* the last refusal */
} desk;

static void *hand_memory(void *ctx, size_t size)
{
    void *memory = calloc(1, size + 1);
    (void)ctx;
    if (!memory)
        abort();
    return memory;
}

static char *copy_text(const char *text)
{
    char *copy = hand_memory(NULL, strlen(text));
    return strcpy(copy, text);
}

static ff_status hear_refusal(void *ctx, ff_status status, const ff_written *where,
                              const char *hint, const char *text)
{
    desk *d = ctx;
    (void)where, (void)hint;
    snprintf(d->said, sizeof d->said, "%s", text ? text : "");
    if (!text || !*text || status == FF_OK)
        ff_check_failf(d->fixture, "refused without a word, or with status %d", status);
    return status;
}

static const ff_written *entry(const ff_written *map, const char *key)
{
    for (size_t i = 0; map->keys && i < map->count; i++)
        if (!strcmp(map->keys[i], key))
            return map->items[i];
    return NULL;
}

/* Value number i of a word, a list or a range; *count of them. */
static char *value_of(const ff_written *item, size_t i, size_t *count)
{
    const ff_written *from = entry(item, "from"), *to = entry(item, "to"),
                     *points = entry(item, "points");
    char text[64];
    if (from && to && points && from->text && to->text && points->text) {
        double a = strtod(from->text, NULL), b = strtod(to->text, NULL);
        *count = (size_t)strtoul(points->text, NULL, 10);
        snprintf(text, sizeof text, "%.12g", a + (b - a) * (double)i / fmax(1, (double)*count - 1));
        return copy_text(text);
    }
    *count = item->text ? 1 : item->count;
    const ff_written *one = item->text ? item : i < item->count ? item->items[i] : NULL;
    return copy_text(one && one->text ? one->text : "");
}

static const ff_study_block *make_block(void *ctx, const ff_written *map)
{
    ff_study_block *block = hand_memory(NULL, sizeof *block);
    size_t *lengths = hand_memory(NULL, PATHS * sizeof *lengths);
    (void)ctx;
    if (!map || !map->keys || map->count == 0 || map->count > PATHS)
        return NULL;
    *block = (ff_study_block){.size = sizeof *block,
                              .paths = map->keys,
                              .lengths = lengths,
                              .path_count = map->count,
                              .case_count = 1};
    for (size_t k = 0; k < map->count; k++) {
        free(value_of(map->items[k], 0, &lengths[k]));
        block->case_count *= lengths[k];
    }
    if (block->case_count == 0 || block->case_count > MOST_POINTS)
        return NULL;
    ff_study_point *points =
        hand_memory(NULL, block->case_count * block->path_count * sizeof *points);
    for (size_t i = 0; i < block->case_count; i++)
        for (size_t k = map->count, rest = i; k-- > 0; rest /= lengths[k]) {
            char *name = value_of(map->items[k], rest % lengths[k], &(size_t){0});
            char *text = hand_memory(NULL, strlen(map->keys[k]) + strlen(name) + 2);
            sprintf(text, "%s=%s", map->keys[k], name);
            points[i * map->count + k] = (ff_study_point){text, name};
        }
    block->points = points;
    return block;
}

static bool sweeps(const desk *d)
{
    return d->plan.flags & FF_STUDY_SWEEPS;
}

/* x of a case of the sweep once more. */
static double take_again(const desk *d, const ff_study_case *c)
{
    bool known = FF_HAS(c, output_count) && c->of < SWEPT;
    double x = known ? d->x[c->of] : 1;
    if (!known)
        ff_check_failf(d->fixture, "asked for no case of the sweep");
    for (size_t i = 0; known && i < c->set_count; i++) {
        if (!strchr(c->sets[i], '=') || strncmp(c->sets[i], "toy.", 4) != 0)
            ff_check_failf(d->fixture, "laid \"%s\" over a case, which has the stage toy alone",
                           c->sets[i]);
        if (!strncmp(c->sets[i], "toy.x=", 6))
            x = strtod(c->sets[i] + 6, NULL);
    }
    for (size_t i = 0; known && i < c->output_count; i++)
        if (strncmp(c->outputs[i], "toy.", 4) != 0)
            ff_check_failf(d->fixture, "asked for the output \"%s\"", c->outputs[i]);
    return x;
}

static size_t take_case(void *ctx, const ff_study_case *c)
{
    desk *d = ctx;
    double x = sweeps(d) ? take_again(d, c) : 1;
    for (size_t k = 0; k < d->plan.path_count; k++) {
        const ff_study_point *point = &c->points[k];
        const char *path = d->plan.paths[k];
        size_t length = strlen(path);
        if (!point->assignment || !point->name)
            ff_check_failf(d->fixture, "asked for a case without a text for %s", path);
        else if (*point->assignment && !strcmp(path, "toy.x")) {
            if (strncmp(point->assignment, path, length) != 0 || point->assignment[length] != '=')
                ff_check_failf(d->fixture, "asked for \"%s\" under the path %s", point->assignment,
                               path);
            x = strtod(point->name, NULL);
        }
    }
    if (!isfinite(x))
        ff_check_failf(d->fixture, "asked for toy.x = %g", x);
    if (d->count == MOST_CASES)
        ff_check_failf(d->fixture, "asked for more than %d cases of a small study", MOST_CASES);
    if (d->count < MOST_CASES) {
        d->asked[d->count] = sweeps(d) ? c->output_count : 0;
        d->x[d->count++] = x;
    }
    return d->count - 1;
}

static ff_status run_nothing(void *ctx, size_t begin, size_t end)
{
    desk *d = ctx;
    if (d->planning)
        ff_check_failf(d->fixture, "ran cases while it planned");
    else if (sweeps(d) && begin < SWEPT)
        ff_check_failf(d->fixture, "ran cases of the sweep, which have run");
    else if (begin > end || end > d->count)
        ff_check_failf(d->fixture, "ran cases up to number %zu, but has asked for %zu", end,
                       d->count);
    bool stop = d->planning || end > d->count || ++d->runs > MOST_CASES;
    if (d->runs > 2 * (size_t)MOST_CASES)
        abort(); /* it does not listen */
    return stop || d->world == STOPPED ? FF_STOPPED : FF_OK;
}

static const char *make_record(const desk *d, double x, double y)
{
    char *text = hand_memory(NULL, 600);
    if (d->world == FAILING)
        snprintf(text, 600, "{\"set\":{\"toy.x\":\"%.12g\"},\"command\":\"true\"}", x);
    else
        snprintf(text, 600,
                 "{\"set\":{\"toy.x\":\"%.12g\"},\"outputs\":{\"toy.y\":[\"m\",%s]},"
                 "\"chosen\":{\"toy\":\"toy/one\"},\"choices\":{\"toy\":{\"use\":\"toy/auto\","
                 "\"model\":\"toy/one\",\"accuracy\":0.1,\"promised\":%s,"
                 "\"settings\":{\"cells\":\"8\"}}}}",
                 x, isfinite(y) ? "1.5" : "null", isfinite(y) ? "0.05" : "null");
    return text;
}

static const ff_study_answer *make_answer(void *ctx, size_t number)
{
    desk *d = ctx;
    if (number >= d->count) {
        ff_check_failf(d->fixture, "looked at case %zu of %zu", number, d->count);
        number = 0;
    }
    bool failed = d->world == FAILING;
    double x = d->x[number], y = d->world == GOOD ? 1 + 1 / (x * x) : (double)NAN;
    ff_study_answer *a = hand_memory(NULL, sizeof *a);
    size_t count = d->plan.output_count + d->plan.extra_count + d->asked[number];
    const ff_study_output **outputs = hand_memory(NULL, (count + 1) * sizeof *outputs);
    *a = (ff_study_answer){.size = sizeof *a,
                           .key = "0123456789abcdef",
                           .status = failed ? "failed" : "ok",
                           .reason = failed ? "it was to fail" : "",
                           .work = failed ? (double)NAN : x,
                           .outputs = outputs,
                           .record = make_record(d, x, y)};
    for (size_t i = 0; i < count; i++) {
        ff_study_output *o = hand_memory(NULL, sizeof *o);
        double *values = hand_memory(NULL, sizeof *values);
        *values = y;
        *o = (ff_study_output){.size = sizeof *o, .count = 1, .along = ""};
        o->values = failed ? NULL : values;
        outputs[i] = o;
    }
    return a;
}

static const char *turn_knob(void *ctx, size_t number, const char *path, double factor)
{
    const desk *d = ctx;
    char text[64];
    if (number >= d->count || strcmp(path, "toy.x") != 0)
        return NULL;
    snprintf(text, sizeof text, "%.12g", d->x[number] * factor);
    return copy_text(text);
}

/* The case of every sweep: a stage that chooses its model. */
static const ff_study_look *look(void *ctx, size_t number)
{
    static const ff_param params[] = {
        {.name = "x", .unit = "m", .doc = "", .type = FF_REAL},
        {.name = "cells", .unit = "", .doc = "", .type = FF_INT, .flags = FF_TUNABLE}};
    static const ff_port outputs[] = {{.name = "y", .unit = "m", .doc = "", .dims = ""},
                                      {.name = "s", .unit = "m", .doc = "", .dims = "t"},
                                      {.name = "t", .unit = "s", .doc = "", .dims = "t"}};
    static const ff_model model = {.size = sizeof model,
                                   .id = "toy/auto",
                                   .params = FF_TABLE(params),
                                   .outputs = FF_TABLE(outputs)};
    static const uint8_t numbers[] = {1, 0}, wanted[] = {2, 0, 0};
    static const ff_study_stage toy = {.size = sizeof toy,
                                       .name = "toy",
                                       .model = &model,
                                       .runs = 1,
                                       .chooses = 1,
                                       .numbers = numbers,
                                       .wanted = wanted};
    static const ff_study_stage *const stages[] = {&toy};
    static const char *const asked[] = {"toy.y"};
    static const ff_study_look seen = {.size = sizeof seen,
                                       .reason = "",
                                       .stages = stages,
                                       .stage_count = 1,
                                       .outputs = asked,
                                       .output_count = 1};
    const desk *d = ctx;
    if (number >= d->count || (d->planning && number > 0))
        ff_check_failf(d->fixture, "looked at case %zu before it could", number);
    return &seen;
}

static const char *shift(void *ctx, size_t number, const char *path, const char *by, double times,
                         const char **why)
{
    const desk *d = ctx;
    char *text = hand_memory(NULL, 64);
    *why = "there is no such number";
    if (number >= d->count || strcmp(path, "toy.x") != 0)
        return NULL;
    snprintf(text, 64, "%.12g m", d->x[number] * (1 + times * strtod(by, NULL) / 100));
    return text;
}

static void hear_line(void *ctx, int32_t indent, const char *line)
{
    const desk *d = ctx;
    (void)indent;
    if (!line || strchr(line, '\n'))
        ff_check_failf(d->fixture, "said no line, or more than one");
}

static void hear_file(void *ctx, const char *name, const char *text)
{
    const desk *d = ctx;
    if (!name || !text || !*name || strchr(name, '/'))
        ff_check_failf(d->fixture, "gave a file without a plain name or a text");
}

static void hear_facts(void *ctx, const char *json)
{
    const desk *d = ctx;
    if (!json || *json != '{')
        ff_check_failf(d->fixture, "gave facts that are no JSON object");
    for (bool quoted = false; json && *json; json++) {
        quoted = quoted != (*json == '"');
        if (!quoted && (!strncmp(json, "nan", 3) || !strncmp(json, "inf", 3)))
            ff_check_failf(d->fixture, "gave a number in its facts that is not finite");
    }
}

static void hear_verdict(void *ctx, int32_t verdict)
{
    const desk *d = ctx;
    if (verdict < FF_GOOD || verdict > FF_BAD)
        ff_check_failf(d->fixture, "concluded with the unknown verdict %d", verdict);
}

/* With a sweep, its cases have run. */
static bool make_plan(desk *d, const ff_study_model *study)
{
    if (study->plan(study->self, &d->table, &d->plan) != FF_OK)
        return false;
    for (size_t i = 0; sweeps(d) && i < SWEPT; i++)
        d->x[d->count++] = (double)(i + 1);
    if (FF_HAS(study, check) && study->check &&
        study->check(study->self, &d->table, sweeps(d) ? SWEPT : 0) != FF_OK)
        return false;
    d->planning = 0;
    if (!sweeps(d) && (d->count == 0 || d->plan.output_count == 0))
        ff_check_failf(d->fixture, "plans no cases, or no outputs of them");
    return true;
}

/* Plans and runs a study in the world; the cases that it asked for stay in d. False: it has no
   plan, and said so. */
static bool play(const ff_fixture *fixture, desk *d, world in)
{
    char doing[100];
    snprintf(doing, sizeof doing, "planning and running a study of %s", names[in]);
    fixture->step(fixture->ctx, doing);
    *d = (desk){.fixture = fixture, .world = in, .planning = 1};
    d->x = hand_memory(NULL, MOST_CASES * sizeof *d->x);
    d->asked = hand_memory(NULL, MOST_CASES * sizeof *d->asked);
    d->table = (ff_study_desk){.size = sizeof d->table,
                               .ctx = d,
                               .memory = hand_memory,
                               .refuse = hear_refusal,
                               .expand = make_block,
                               .ask = take_case,
                               .run = run_nothing,
                               .answer = make_answer,
                               .turn = turn_knob,
                               .say = hear_line,
                               .file = hear_file,
                               .facts = hear_facts,
                               .conclude = hear_verdict,
                               .look = look,
                               .shift = shift};
    d->plan = (ff_study_plan){.size = sizeof d->plan, .cases = "", .further = ""};
    void *subject = fixture->open(fixture->ctx);
    if (!subject)
        return false;
    uint32_t output = 0;
    const ff_port *rows = fixture->model->outputs;
    while (output < fixture->model->output_count &&
           !(rows[output].service && !strcmp(rows[output].service, FF_STUDY_ID)))
        output++;
    const ff_study_model *study = fixture->service(fixture->ctx, subject, output);
    if (!study || !study->plan || !study->run || !study->verb) {
        ff_check_failf(fixture, "lacks plan, run or verb in its table");
        return false;
    }
    if (!make_plan(d, study)) {
        if (!d->said[0] && !*fixture->why(fixture->ctx, subject))
            ff_check_failf(fixture, "plans nothing, and does not say why");
        fixture->skip(fixture->ctx, d->said);
        return false;
    }
    ff_status status = study->run(study->self, &d->table);
    if (in == STOPPED && status == FF_OK)
        ff_check_failf(fixture, "comes to a result although its run was stopped");
    return true;
}

static void asks(const ff_fixture *fixture)
{
    desk first, second;
    fixture->set(fixture->ctx, "outputs", "[toy.y]");
    fixture->set(fixture->ctx, "axes", "{toy.x: {from: 1, to: 4, points: 4}}");
    fixture->set(fixture->ctx, "reference", "{toy.x: 64, refine: [toy.x]}");
    fixture->set(fixture->ctx, "candidates", "[{toy.x: [1, 2, 4, 8]}]");
    fixture->set(fixture->ctx, "refine", "[toy.x]");
    fixture->set(fixture->ctx, "bisect", "3");
    fixture->set(fixture->ctx, "every", "2");
    fixture->set(fixture->ctx, "inputs", "{toy.x: 2 %}");
    for (int in = GOOD; in < WORLDS; in++)
        if (!play(fixture, &first, (world)in))
            return;
    play(fixture, &first, GOOD);
    if (!play(fixture, &second, GOOD))
        return;
    if (first.count != second.count ||
        memcmp(first.x, second.x, first.count * sizeof *first.x) != 0)
        ff_check_failf(fixture, "asks for other cases when it is run again");
}

static const ff_check checks[] = {
    {"asks", "ends whatever its cases give, and asks the same again", asks},
};

const ff_conformance conformance_offer = {
    .size = sizeof conformance_offer, .checks = FF_TABLE(checks), .service = FF_STUDY_ID};

const ff_model conformance_model = {
    .size = sizeof conformance_model,
    .abi_major = FF_ABI_MAJOR,
    .id = "conformance/study",
    .version = "1.0.0",
    .summary = "what a study keeps: an end, and the same questions to the same answers",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .outputs = FF_TABLE(conformance_outputs),
    .create = conformance_create,
    .service = conformance_service,
};
