/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a model that drives a study may call, and the run that it makes of that. */
#include "desk.h"

#include "../plugin/guard.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_ASKED = 1000000, MOST_FILES = 100 };

const char *ff_desk_keep(ff_desk *desk, const char *text)
{
    return ff_arena_text(&desk->arena, text ? text : "", text ? strlen(text) : 0);
}

static void *take_memory(void *ctx, size_t size)
{
    ff_desk *desk = ctx;
    return ff_arena_alloc(&desk->arena, size);
}

static ff_place place_of(const ff_written *value)
{
    const ff_node *node = value ? value->place : NULL;
    return node ? node->place : FF_NOWHERE;
}

static ff_status refuse(void *ctx, ff_status status, const ff_written *where, const char *hint,
                        const char *text)
{
    ff_desk *desk = ctx;
    ff_error(desk->report, status < 0 ? FF_EXIT_INPUT : FF_EXIT_FAILED, place_of(where), hint,
             "%s: %s", desk->name, text);
    return status;
}

/* A value as a node again; the model may have left out or added some of it. */
static ff_node *node_of(ff_desk *desk, const ff_written *value)
{
    const ff_node *written = value->place;
    ff_node *node = ff_arena_alloc(&desk->arena, sizeof *node);
    *node = (ff_node){.kind = value->text   ? FF_SCALAR
                              : value->keys ? FF_MAP
                                            : FF_SEQUENCE,
                      .place = place_of(value)};
    if (value->text) {
        node->text = ff_arena_text(&desk->arena, value->text, strlen(value->text));
        node->quoted = written && written->kind == FF_SCALAR && written->quoted;
        return node;
    }
    node->count = value->count;
    node->items = ff_arena_alloc(&desk->arena, (value->count + 1) * sizeof *node->items);
    node->keys = ff_arena_alloc(&desk->arena, (value->count + 1) * sizeof *node->keys);
    node->key_places = ff_arena_alloc(&desk->arena, (value->count + 1) * sizeof *node->key_places);
    for (size_t i = 0; i < value->count; i++) {
        node->items[i] = node_of(desk, value->items[i]);
        if (!value->keys)
            continue;
        node->keys[i] = (char *)(uintptr_t)ff_desk_keep(desk, value->keys[i]);
        node->key_places[i] = written ? ff_node_key_place(written, value->keys[i]) : FF_NOWHERE;
    }
    return node;
}

static const ff_study_block *expand(void *ctx, const ff_written *map)
{
    ff_desk *desk = ctx;
    if (!map || !map->keys)
        return NULL;
    ff_study *study = ff_study_expand(node_of(desk, map), desk->report);
    if (!study)
        return NULL;
    desk->blocks = ff_resize(desk->blocks, (desk->block_count + 1) * sizeof *desk->blocks);
    ff_study_block *block = ff_arena_alloc(&desk->arena, sizeof *block);
    desk->blocks[desk->block_count++] = (ff_expanded){study, block};
    if (study->followed < study->axis_count || study->count > MOST_ASKED) {
        ff_error(desk->report, FF_EXIT_INPUT, place_of(map), NULL, "%s: %s", desk->name,
                 study->count > MOST_ASKED ? "more than 1000000 cases"
                                           : "its cases stand alone: \"follow\" is for sweeps");
        return NULL;
    }
    size_t paths = study->varied_count;
    const char **names = ff_arena_alloc(&desk->arena, paths * sizeof *names);
    ff_study_point *points = ff_arena_alloc(&desk->arena, study->count * paths * sizeof *points);
    for (size_t k = 0; k < paths; k++)
        names[k] = study->varied[k].path;
    for (size_t i = 0; i < study->count * paths; i++)
        points[i] = (ff_study_point){ff_study_assignment(study, i % paths, i / paths),
                                     ff_study_value(study, i % paths, i / paths)};
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
    ff_desk *desk = ctx;
    size_t room = desk->count;
    if (desk->count > MOST_ASKED + (desk->sweep ? desk->sweep->count : 0))
        return desk->count; /* `run` tells */
    if ((room & (room - 1)) == 0) {
        room = room ? 2 * room : 1;
        desk->cases = ff_resize(desk->cases, room * sizeof *desk->cases);
        desk->keys = ff_resize(desk->keys, room * sizeof *desk->keys);
    }
    desk->cases[desk->count] =
        (ff_asked){.label = ff_desk_keep(desk, c->label), .place = place_of(c->place)};
    ff_desk_list(desk, c, &desk->cases[desk->count]);
    memset(desk->keys[desk->count], 0, sizeof *desk->keys);
    return desk->count++;
}

static void add_tally(ff_tally *sum, const ff_tally *part)
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

static void read_records(ff_desk *desk)
{
    json_decref(desk->records);
    desk->records = ff_journal_read(desk->campaign->directory);
}

static ff_status run_cases(void *ctx, size_t begin, size_t end)
{
    ff_desk *desk = ctx;
    ff_tally tally;
    if (!desk->campaign)
        return FF_BUG; /* in `plan` */
    size_t known = desk->sweep ? desk->sweep->count : 0;
    bool many = desk->count > MOST_ASKED + known;
    if (many || desk->astray || begin < known || begin > end || end > desk->count) {
        ff_error(desk->report, FF_EXIT_PLUGIN, FF_NOWHERE, NULL, "study: the plugin %s asks for %s",
                 desk->tool.pipeline->stages[0].loaded->path,
                 many           ? "more than 1000000 cases"
                 : desk->astray ? "cases that the sweep does not have"
                                : "cases that it has not described");
        return FF_INVALID;
    }
    if (begin == end)
        return FF_OK;
    ff_guard_mark mark = ff_guard_enter(NULL, NULL, NULL);
    ff_campaign campaign = *desk->campaign;
    for (size_t i = begin; desk->sweep && i < end; i++)
        if (!desk->starts[i - known])
            desk->starts[i - known] =
                ff_chain_start(desk->sweep, desk->cases[i].of, desk->keys, desk->records);
    campaign.study = &desk->list;
    campaign.keys = desk->keys + known;
    campaign.begin = begin - known;
    campaign.end = end - known;
    bool good = ff_study_run(&campaign, &tally, desk->report);
    add_tally(desk->tally, &tally);
    if (good)
        read_records(desk);
    ff_guard_leave(mark);
    return good ? FF_OK : FF_STOPPED;
}

static const ff_study_answer *answer(void *ctx, size_t number)
{
    ff_desk *desk = ctx;
    size_t i = number < desk->count ? number : 0;
    if (!desk->campaign)
        return NULL; /* in `plan` */
    if (!desk->cases[i].answer || !*desk->cases[i].answer->key)
        desk->cases[i].answer = ff_desk_answer(desk, i);
    return desk->cases[i].answer;
}

static void say(void *ctx, int32_t indent, const char *line)
{
    ff_desk *desk = ctx;
    if (desk->campaign && desk->campaign->say)
        desk->campaign->say(desk->campaign->ctx, indent, line);
}

static void take_file(void *ctx, const char *name, const char *text)
{
    ff_desk *desk = ctx;
    if (desk->file_count == MOST_FILES)
        return;
    desk->files = ff_resize(desk->files, (desk->file_count + 1) * sizeof *desk->files);
    desk->files[desk->file_count++] =
        (ff_text_file){ff_desk_keep(desk, name), ff_desk_keep(desk, text)};
}

static void take_facts(void *ctx, const char *json)
{
    ff_desk *desk = ctx;
    json_decref(desk->facts);
    desk->facts = json_loads(json, 0, NULL);
    if (!json_is_object(desk->facts))
        ff_error(desk->report, FF_EXIT_PLUGIN, FF_NOWHERE, NULL,
                 "study: the plugin %s gives facts that are no JSON object",
                 desk->tool.pipeline->stages[0].loaded->path);
}

static void conclude(void *ctx, int32_t verdict)
{
    ff_desk *desk = ctx;
    desk->verdict = verdict;
}

void ff_desk_open(ff_desk *desk)
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
    ff_desk_open_looks(&desk->table);
}

/* Builds the cases that are known beforehand: what is wrong shows before anything runs. What was
   said at a place need not be said of its other cases. */
static bool open_cases(const ff_desk *desk, const ff_campaign *campaign)
{
    ff_place wrong = FF_NOWHERE;
    bool good = true;
    for (size_t i = 0; i < desk->planned; i++) {
        const ff_asked *asked = &desk->cases[i];
        const ff_place place = asked->place;
        ff_case c;
        if (desk->repeats[i] > 0 || (wrong.source && wrong.source == place.source &&
                                     wrong.line == place.line && wrong.column == place.column))
            continue;
        ff_case_open(&c, campaign, i);
        if (!ff_case_is_good(&c)) {
            char *why = ff_first_error(c.report);
            good = ff_error(desk->report, FF_EXIT_INPUT, place, NULL, "%s: %s: %s", desk->name,
                            asked->label, why);
            free(why);
            wrong = place;
        }
        ff_case_close(&c);
    }
    return good;
}

/* A plain name that is none of the study's own. */
static bool check_name(const ff_desk *desk, const char *name)
{
    bool plain = *name && *name != '.' &&
                 name[strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-.")] == '\0';
    bool own = !strcmp(name, "table.csv") || !strcmp(name, ff_study_description) ||
               !strncmp(name, "journal", 7);
    return (plain && !own) || ff_error(desk->report, FF_EXIT_PLUGIN, FF_NOWHERE, NULL,
                                       "study: the plugin %s gives a file the name \"%.80s\"",
                                       desk->tool.pipeline->stages[0].loaded->path, name);
}

/* The table of the cases that ran and, where they are no grid, what the study is. */
static bool write_table(ff_desk *desk)
{
    ff_campaign campaign = *desk->campaign;
    ff_desk_drop_idle(desk);
    campaign.study = &desk->list;
    if (!desk->plan.grid)
        campaign.described = &desk->list;
    return ff_describe(&campaign, desk->report) &&
           ff_table_write(&campaign, desk->keys, desk->report);
}

static ff_status call_run(const void *table, void *ctx)
{
    const ff_study_model *model = table;
    ff_desk *desk = ctx;
    return model->run(model->self, &desk->table);
}

/* The cases that the others go with, and their table. */
static bool run_sweep(ff_desk *desk, ff_tally *tally)
{
    ff_campaign campaign = *desk->campaign;
    campaign.keys = desk->keys;
    bool good = ff_study_run(&campaign, tally, desk->report);
    if (good)
        read_records(desk);
    return good;
}

bool ff_study_drive(const ff_campaign *campaign, ff_tally *tally, ff_report *report)
{
    ff_desk *desk = campaign->study->desk;
    ff_campaign own = *campaign;
    bool strict = desk->plan.flags & FF_STUDY_STRICT;
    ff_tally beside = {.leads = true};
    *tally = beside;
    if (campaign->study->measure)
        own.jobs = 1;
    desk->report = report;
    desk->campaign = &own;
    desk->tally = desk->sweep ? &beside : tally;
    bool good = (!desk->sweep || run_sweep(desk, tally)) &&
                (!strict || open_cases(desk, campaign)) &&
                ff_tool_call(&desk->tool, "run", call_run, desk, report) &&
                (desk->sweep || write_table(desk));
    for (size_t i = 0; good && i < desk->file_count; i++)
        good = check_name(desk, desk->files[i].name) &&
               ff_put_file(campaign->directory, desk->files[i].name, desk->files[i].text,
                           "the journal has all cases; the same command writes the file", report);
    desk->campaign = NULL;
    return good && ff_report_errors(report) == 0;
}

const json_t *ff_study_facts(const ff_study *study)
{
    return study->desk->facts;
}

int ff_study_verdict(const ff_study *study)
{
    return study->desk->verdict;
}

char *ff_study_files(const ff_study *study)
{
    const ff_desk *desk = study->desk;
    char *text = ff_print_text("%s", "");
    for (size_t i = 0; i < desk->file_count; i++) {
        char *longer = ff_print_text("%s%s, ", text, desk->files[i].name);
        free(text);
        text = longer;
    }
    return text;
}
