/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stores the cases that a driver submits as a study with one growing axis. */
#include "context.h"
#include "run.h"

#include "../cases/case.h"
#include "../cases/table.h"

#include <stdlib.h>
#include <string.h>

static void add_columns(study_context *context)
{
    study_definition *list = &context->list;
    list->varied_count = context->path_count;
    list->varied = memory_alloc(list->varied_count * sizeof *list->varied);
    for (size_t k = 0; k < list->varied_count; k++)
        list->varied[k].path = context->paths[k];
}

/* Makes room for one more case. */
static void make_room(study_context *context)
{
    study_definition *list = &context->list;
    if (list->count < context->room)
        return;
    if (context->room == 0)
        add_columns(context);
    size_t room = context->room = context->room ? 2 * context->room : 1;
    context->cases = memory_resize(context->cases, room * sizeof *context->cases);
    context->keys = memory_resize(context->keys, room * sizeof *context->keys);
    context->repeats = memory_resize(context->repeats, room * sizeof *context->repeats);
    if (context->measure)
        context->measure->repeat = context->repeats;
    for (size_t k = 0; k < list->varied_count; k++) {
        study_varied *column = &list->varied[k];
        column->assignments =
            memory_resize(column->assignments, room * sizeof *column->assignments);
        column->names = memory_resize(column->names, room * sizeof *column->names);
    }
}

size_t study_submit(study_context *context, const study_setting *settings, size_t repeat,
                    const char *label, const ff_node *place)
{
    study_definition *list = &context->list;
    if (list->count > STUDY_MOST_SUBMITTED)
        return list->count; /* study_run_submitted reports it */
    make_room(context);
    context->cases[list->count] =
        (study_submitted){.label = label, .place = place ? place->place : FF_NOWHERE};
    context->repeats[list->count] = repeat;
    memset(context->keys[list->count], 0, sizeof *context->keys);
    for (size_t k = 0; k < list->varied_count; k++) {
        list->varied[k].assignments[list->count] = settings[k].assignment;
        list->varied[k].names[list->count] = settings[k].name;
    }
    return list->count++;
}

static void add_counters(study_counters *sum, study_counters *part)
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
    study_tally_merge(&sum->tally, &part->tally);
}

bool study_run_submitted(study_context *context, size_t begin, size_t end)
{
    study_counters counters;
    if (context->list.count > STUDY_MOST_SUBMITTED)
        return ff_error(context->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "%s: more than 1000000 cases", context->name);
    if (begin == end)
        return true;
    study_run run = *context->run;
    run.study = &context->list;
    run.keys = context->keys;
    run.begin = begin;
    run.end = end;
    run.rows = &context->records;
    study_records_close(context->records);
    context->records = NULL;
    if (context->plan) {
        size_t left = context->plan->left;
        study_preview(&run, context->plan);
        context->counted = end;
        return context->plan->left == left;
    }
    bool good = study_execute(&run, &counters, context->report);
    add_counters(context->counters, &counters);
    return good;
}

/* Removes cases that have not run, and their keys, from the list. Called when no more cases are
   submitted. */
static void drop_cases_not_run(study_context *context)
{
    size_t left = 0;
    for (size_t i = 0; i < context->list.count; i++) {
        if (!context->keys[i][0])
            continue;
        memmove(context->keys[left], context->keys[i], sizeof *context->keys);
        for (size_t k = 0; k < context->list.varied_count; k++) {
            study_varied *column = &context->list.varied[k];
            column->assignments[left] = column->assignments[i];
            column->names[left] = column->names[i];
        }
        left++;
    }
    context->list.count = left;
}

bool study_write_submitted(study_context *context)
{
    study_run run = *context->run;
    drop_cases_not_run(context);
    run.study = &context->list;
    if (!context->grid)
        run.described = &context->list;
    return study_table_write(&run, context->keys, context->records, context->report);
}

bool study_submitted_opens(const study_context *context, size_t number, bool reported)
{
    const study_submitted *submitted = &context->cases[number];
    study_case c;
    study_case_open(&c, context->run, number, NULL);
    bool good = study_case_is_good(&c);
    if (!good && reported) {
        char *why = study_first_error(c.report);
        ff_error(context->report, FF_FAULT_INPUT, submitted->place, NULL, "%s: %s: %s",
                 context->name, submitted->label, why);
        free(why);
    }
    study_case_close(&c);
    return good;
}
