/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a model that drives a study may call, and the run that it makes of that. */
#include "desk.h"

#include "../../engine/plugin/guard.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_ASKED = 1000000, MOST_FILES = 100 };

const char *study_desk_keep(study_desk *desk, const char *text)
{
    return fe_arena_text(&desk->arena, text ? text : "", text ? strlen(text) : 0);
}

static void *take_memory(void *ctx, size_t size)
{
    study_desk *desk = ctx;
    return fe_arena_alloc(&desk->arena, size);
}

static fe_place place_of(const ff_written *value)
{
    const fe_node *node = value ? value->place : NULL;
    return node ? node->place : FE_NOWHERE;
}

static ff_status refuse(void *ctx, ff_status status, const ff_written *where, const char *hint,
                        const char *text)
{
    study_desk *desk = ctx;
    fe_error(desk->report, status < 0 ? FE_EXIT_INPUT : FE_EXIT_FAILED, place_of(where), hint,
             "%s: %s", desk->name, text);
    return status;
}

/* A value as a node again; the model may have left out or added some of it. */
static fe_node *node_of(study_desk *desk, const ff_written *value)
{
    const fe_node *written = value->place;
    fe_node *node = fe_arena_alloc(&desk->arena, sizeof *node);
    *node = (fe_node){.kind = value->text   ? FE_SCALAR
                              : value->keys ? FE_MAP
                                            : FE_SEQUENCE,
                      .place = place_of(value)};
    if (value->text) {
        node->text = fe_arena_text(&desk->arena, value->text, strlen(value->text));
        node->quoted = written && written->kind == FE_SCALAR && written->quoted;
        return node;
    }
    node->count = value->count;
    node->items = fe_arena_alloc(&desk->arena, (value->count + 1) * sizeof *node->items);
    node->keys = fe_arena_alloc(&desk->arena, (value->count + 1) * sizeof *node->keys);
    node->key_places = fe_arena_alloc(&desk->arena, (value->count + 1) * sizeof *node->key_places);
    for (size_t i = 0; i < value->count; i++) {
        node->items[i] = node_of(desk, value->items[i]);
        if (!value->keys)
            continue;
        node->keys[i] = (char *)(uintptr_t)study_desk_keep(desk, value->keys[i]);
        node->key_places[i] = written ? fe_node_key_place(written, value->keys[i]) : FE_NOWHERE;
    }
    return node;
}

static const ff_study_block *expand(void *ctx, const ff_written *map)
{
    study_desk *desk = ctx;
    if (!map || !map->keys)
        return NULL;
    study_definition *study = study_expand(node_of(desk, map), desk->report);
    if (!study)
        return NULL;
    desk->blocks = fe_resize(desk->blocks, (desk->block_count + 1) * sizeof *desk->blocks);
    ff_study_block *block = fe_arena_alloc(&desk->arena, sizeof *block);
    desk->blocks[desk->block_count++] = (study_expanded){study, block};
    if (study->followed < study->axis_count || study->count > MOST_ASKED) {
        fe_error(desk->report, FE_EXIT_INPUT, place_of(map), NULL, "%s: %s", desk->name,
                 study->count > MOST_ASKED ? "more than 1000000 cases"
                                           : "its cases stand alone: \"follow\" is for sweeps");
        return NULL;
    }
    size_t paths = study->varied_count;
    const char **names = fe_arena_alloc(&desk->arena, paths * sizeof *names);
    ff_study_point *points = fe_arena_alloc(&desk->arena, study->count * paths * sizeof *points);
    for (size_t k = 0; k < paths; k++)
        names[k] = study->varied[k].path;
    for (size_t i = 0; i < study->count * paths; i++)
        points[i] = (ff_study_point){study_assignment(study, i % paths, i / paths),
                                     study_value(study, i % paths, i / paths)};
    *block = (ff_study_block){.size = sizeof *block,
                              .paths = names,
                              .lengths = study->points,
                              .path_count = paths,
                              .points = points,
                              .case_count = study->count};
    return block;
}

static size_t ask(void *ctx, const ff_study_case *c)
{
    study_desk *desk = ctx;
    size_t room = desk->count;
    if (desk->count > MOST_ASKED + (desk->sweep ? desk->sweep->count : 0))
        return desk->count; /* `run` tells */
    if ((room & (room - 1)) == 0) {
        room = room ? 2 * room : 1;
        desk->cases = fe_resize(desk->cases, room * sizeof *desk->cases);
        desk->keys = fe_resize(desk->keys, room * sizeof *desk->keys);
    }
    desk->cases[desk->count] =
        (study_asked){.label = study_desk_keep(desk, c->label), .place = place_of(c->place)};
    study_desk_list(desk, c, &desk->cases[desk->count]);
    memset(desk->keys[desk->count], 0, sizeof *desk->keys);
    return desk->count++;
}

static void add_tally(study_tally *sum, const study_tally *part)
{
    sum->leads = part->leads;
    sum->total += part->total;
    sum->before += part->before;
    sum->done += part->done;
    sum->failed += part->failed;
    sum->seconds += part->seconds;
    sum->savings.computed += part->savings.computed;
    sum->savings.reused += part->savings.reused;
    sum->savings.spent += part->savings.spent;
    sum->savings.saved += part->savings.saved;
}

static void read_records(study_desk *desk)
{
    json_decref(desk->records);
    desk->records = study_journal_read(desk->campaign->directory);
}

static ff_status run_cases(void *ctx, size_t begin, size_t end)
{
    study_desk *desk = ctx;
    study_tally tally;
    if (!desk->campaign)
        return FF_BUG; /* in `plan` */
    size_t known = desk->sweep ? desk->sweep->count : 0;
    bool many = desk->count > MOST_ASKED + known;
    if (many || desk->astray || begin < known || begin > end || end > desk->count) {
        fe_error(desk->report, FE_EXIT_PLUGIN, FE_NOWHERE, NULL, "study: the plugin %s asks for %s",
                 desk->tool.pipeline->stages[0].loaded->path,
                 many           ? "more than 1000000 cases"
                 : desk->astray ? "cases that the sweep does not have"
                                : "cases that it has not described");
        return FF_INVALID;
    }
    if (begin == end)
        return FF_OK;
    fe_guard_mark mark = fe_guard_enter(NULL, NULL, NULL);
    study_campaign campaign = *desk->campaign;
    for (size_t i = begin; desk->sweep && i < end; i++)
        if (!desk->starts[i - known])
            desk->starts[i - known] =
                study_chain_start(desk->sweep, desk->cases[i].of, desk->keys, desk->records);
    campaign.study = &desk->list;
    campaign.keys = desk->keys + known;
    campaign.begin = begin - known;
    campaign.end = end - known;
    bool good = study_run(&campaign, &tally, desk->report);
    add_tally(desk->tally, &tally);
    if (good)
        read_records(desk);
    fe_guard_leave(mark);
    return good ? FF_OK : FF_STOPPED;
}

static const ff_study_answer *answer(void *ctx, size_t number)
{
    study_desk *desk = ctx;
    size_t i = number < desk->count ? number : 0;
    if (!desk->campaign)
        return NULL; /* in `plan` */
    if (!desk->cases[i].answer || !*desk->cases[i].answer->key)
        desk->cases[i].answer = study_desk_answer(desk, i);
    return desk->cases[i].answer;
}

static void say(void *ctx, int32_t indent, const char *line)
{
    study_desk *desk = ctx;
    if (desk->campaign && desk->campaign->say)
        desk->campaign->say(desk->campaign->ctx, indent, line);
}

static void take_file(void *ctx, const char *name, const char *text)
{
    study_desk *desk = ctx;
    if (desk->file_count == MOST_FILES)
        return;
    desk->files = fe_resize(desk->files, (desk->file_count + 1) * sizeof *desk->files);
    desk->files[desk->file_count++] =
        (study_text_file){study_desk_keep(desk, name), study_desk_keep(desk, text)};
}

static void take_facts(void *ctx, const char *json)
{
    study_desk *desk = ctx;
    json_decref(desk->facts);
    desk->facts = json_loads(json, 0, NULL);
    if (!json_is_object(desk->facts))
        fe_error(desk->report, FE_EXIT_PLUGIN, FE_NOWHERE, NULL,
                 "study: the plugin %s gives facts that are no JSON object",
                 desk->tool.pipeline->stages[0].loaded->path);
}

static void conclude(void *ctx, int32_t verdict)
{
    study_desk *desk = ctx;
    desk->verdict = verdict;
}

void study_desk_open(study_desk *desk)
{
    desk->table = (ff_study_desk){
        .size = sizeof desk->table,
        .ctx = desk,
        .memory = take_memory,
        .refuse = refuse,
        .expand = expand,
        .ask = ask,
        .run = run_cases,
        .answer = answer,
        .say = say,
        .file = take_file,
        .facts = take_facts,
        .conclude = conclude,
    };
    study_desk_open_looks(&desk->table);
}

/* Builds the cases that are known beforehand: what is wrong shows before anything runs. What was
   said at a place need not be said of its other cases. */
static bool open_cases(const study_desk *desk, const study_campaign *campaign)
{
    fe_place wrong = FE_NOWHERE;
    bool good = true;
    for (size_t i = 0; i < desk->planned; i++) {
        const study_asked *asked = &desk->cases[i];
        const fe_place place = asked->place;
        study_case c;
        if (desk->repeats[i] > 0 || (wrong.source && wrong.source == place.source &&
                                     wrong.line == place.line && wrong.column == place.column))
            continue;
        study_case_open(&c, campaign, i);
        if (!study_case_is_good(&c)) {
            char *why = study_first_error(c.report);
            good = fe_error(desk->report, FE_EXIT_INPUT, place, NULL, "%s: %s: %s", desk->name,
                            asked->label, why);
            free(why);
            wrong = place;
        }
        study_case_close(&c);
    }
    return good;
}

/* A plain name that is none of the study's own. */
static bool check_name(const study_desk *desk, const char *name)
{
    bool plain = *name && *name != '.' &&
                 name[strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-.")] == '\0';
    bool own = !strcmp(name, "table.csv") || !strcmp(name, study_description) ||
               !strncmp(name, "journal", 7);
    return (plain && !own) || fe_error(desk->report, FE_EXIT_PLUGIN, FE_NOWHERE, NULL,
                                       "study: the plugin %s gives a file the name \"%.80s\"",
                                       desk->tool.pipeline->stages[0].loaded->path, name);
}

/* The table of the cases that ran and, where they are no grid, what the study is. */
static bool write_table(study_desk *desk)
{
    study_campaign campaign = *desk->campaign;
    study_desk_drop_idle(desk);
    campaign.study = &desk->list;
    if (!desk->plan.grid)
        campaign.described = &desk->list;
    return study_describe(&campaign, desk->report) &&
           study_table_write(&campaign, desk->keys, desk->report);
}

static ff_status call_run(const void *table, void *ctx)
{
    const ff_study_model *model = table;
    study_desk *desk = ctx;
    return model->run(model->self, &desk->table);
}

/* The cases that the others go with, and their table. */
static bool run_sweep(study_desk *desk, study_tally *tally)
{
    study_campaign campaign = *desk->campaign;
    campaign.keys = desk->keys;
    bool good = study_run(&campaign, tally, desk->report);
    if (good)
        read_records(desk);
    return good;
}

bool study_drive(const study_campaign *campaign, study_tally *tally, fe_report *report)
{
    study_desk *desk = campaign->study->desk;
    study_campaign own = *campaign;
    bool strict = desk->plan.flags & FF_STUDY_STRICT;
    study_tally beside = {.leads = true};
    *tally = beside;
    if (campaign->study->measure)
        own.jobs = 1;
    desk->report = report;
    desk->campaign = &own;
    desk->tally = desk->sweep ? &beside : tally;
    bool good = (!desk->sweep || run_sweep(desk, tally)) &&
                (!strict || open_cases(desk, campaign)) &&
                fe_tool_call(&desk->tool, "run", call_run, desk, report) &&
                (desk->sweep || write_table(desk));
    for (size_t i = 0; good && i < desk->file_count; i++)
        good =
            check_name(desk, desk->files[i].name) &&
            study_put_file(campaign->directory, desk->files[i].name, desk->files[i].text,
                           "the journal has all cases; the same command writes the file", report);
    desk->campaign = NULL;
    return good && fe_report_errors(report) == 0;
}

const json_t *study_facts(const study_definition *study)
{
    return study->desk->facts;
}

int study_verdict(const study_definition *study)
{
    return study->desk->verdict;
}

char *study_files(const study_definition *study)
{
    const study_desk *desk = study->desk;
    char *text = fe_print_text("%s", "");
    for (size_t i = 0; i < desk->file_count; i++) {
        char *longer = fe_print_text("%s%s, ", text, desk->files[i].name);
        free(text);
        text = longer;
    }
    return text;
}
