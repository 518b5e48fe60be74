/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cases that the model of a study asks for, as a study of one axis that grows. */
#include "desk.h"

#include <stdlib.h>
#include <string.h>

/* A path to which no case assigns anything so far; its column. */
static size_t add_column(study_desk *desk, const char *path)
{
    study_definition *list = &desk->list;
    list->varied = fe_resize(list->varied, (list->varied_count + 1) * sizeof *list->varied);
    study_varied *column = &list->varied[list->varied_count];
    *column = (study_varied){.path = path,
                             .assignments = fe_alloc(desk->room * sizeof *column->assignments),
                             .names = fe_alloc(desk->room * sizeof *column->names)};
    for (size_t i = 0; i <= list->count; i++)
        column->assignments[i] = column->names[i] = "";
    return list->varied_count++;
}

/* Of what is laid over the cases of a sweep. */
static size_t find_column(study_desk *desk, const char *assignment)
{
    size_t length = strcspn(assignment, "=");
    for (size_t k = desk->sweep->varied_count; k < desk->list.varied_count; k++)
        if (strlen(desk->list.varied[k].path) == length &&
            !strncmp(desk->list.varied[k].path, assignment, length))
            return k;
    return add_column(desk, fe_arena_text(&desk->arena, assignment, length));
}

/* For one more case. */
static void make_room(study_desk *desk)
{
    study_definition *list = &desk->list;
    bool first = desk->room == 0;
    if (list->count < desk->room)
        return;
    desk->room = first ? 1 : 2 * desk->room;
    desk->starts = fe_resize(desk->starts, desk->room * sizeof *desk->starts);
    desk->repeats = fe_resize(desk->repeats, desk->room * sizeof *desk->repeats);
    list->starts = desk->sweep ? desk->starts : NULL;
    if (desk->measure)
        desk->measure->repeat = desk->repeats;
    for (size_t k = 0; k < list->varied_count; k++) {
        study_varied *column = &list->varied[k];
        column->assignments =
            fe_resize(column->assignments, desk->room * sizeof *column->assignments);
        column->names = fe_resize(column->names, desk->room * sizeof *column->names);
    }
    for (size_t k = 0; first && desk->sweep && k < desk->sweep->varied_count; k++)
        add_column(desk, desk->sweep->varied[k].path);
    for (size_t k = 0; first && !desk->sweep && k < desk->plan.path_count; k++)
        add_column(desk, desk->plan.paths[k]);
}

static void put(study_desk *desk, size_t column, const char *assignment, const char *name)
{
    desk->list.varied[column].assignments[desk->list.count] = assignment;
    desk->list.varied[column].names[desk->list.count] = name;
}

/* A list in brackets. */
static const char *request_of(study_desk *desk, const ff_study_case *c)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = fe_require(open_memstream(&text, &length));
    fputs("outputs=[", out);
    for (size_t i = 0; i < c->output_count; i++)
        fprintf(out, "%s%s", i ? ", " : "", c->outputs[i]);
    fputc(']', out);
    fclose(out);
    const char *kept = study_desk_keep(desk, text);
    free(text);
    return kept;
}

/* Puts what is laid over the case in its column. */
static void lay_over(study_desk *desk, const char *assignment)
{
    size_t column = find_column(desk, assignment);
    put(desk, column, assignment, assignment + strcspn(assignment, "=") + 1);
}

/* A case of the sweep: its own values, then what is laid over them. */
static void take_again(study_desk *desk, const ff_study_case *c, study_asked *asked)
{
    bool whole = FF_HAS(c, output_count);
    size_t of = whole ? c->of : 0, outputs = whole ? c->output_count : 0;
    desk->astray = desk->astray || of >= desk->sweep->count;
    asked->of = desk->astray ? 0 : of;
    for (size_t k = 0; k < desk->sweep->varied_count; k++)
        put(desk, k, study_assignment(desk->sweep, k, asked->of),
            study_value(desk->sweep, k, asked->of));
    for (size_t i = 0; whole && i < c->set_count; i++)
        lay_over(desk, study_desk_keep(desk, c->sets[i]));
    asked->outputs = fe_arena_alloc(&desk->arena, (outputs + 1) * sizeof *asked->outputs);
    for (size_t i = 0; i < outputs; i++)
        asked->outputs[asked->output_count++] = study_desk_keep(desk, c->outputs[i]);
    if (outputs)
        lay_over(desk, request_of(desk, c));
}

void study_desk_list(study_desk *desk, const ff_study_case *c, study_asked *asked)
{
    size_t paths = desk->sweep ? 0 : desk->plan.path_count;
    make_room(desk);
    desk->starts[desk->list.count] = NULL;
    desk->repeats[desk->list.count] = c->repeat;
    for (size_t k = 0; k < desk->list.varied_count; k++)
        put(desk, k, "", "");
    for (size_t k = 0; k < paths && k < desk->list.varied_count; k++)
        put(desk, k, study_desk_keep(desk, c->points[k].assignment),
            study_desk_keep(desk, c->points[k].name));
    if (desk->sweep)
        take_again(desk, c, asked);
    desk->list.count++;
}

void study_desk_drop_idle(study_desk *desk)
{
    size_t left = 0;
    for (size_t i = 0; i < desk->list.count; i++) {
        if (!desk->keys[i][0])
            continue;
        memmove(desk->keys[left], desk->keys[i], sizeof *desk->keys);
        for (size_t k = 0; k < desk->list.varied_count; k++) {
            study_varied *column = &desk->list.varied[k];
            column->assignments[left] = column->assignments[i];
            column->names[left] = column->names[i];
        }
        left++;
    }
    desk->list.count = left;
}

void study_desk_unlist(study_desk *desk)
{
    for (size_t k = 0; k < desk->list.varied_count; k++) {
        free(desk->list.varied[k].assignments);
        free(desk->list.varied[k].names);
    }
    for (size_t i = 0; desk->sweep && i < desk->list.count; i++)
        json_decref(desk->starts[i]);
    free(desk->list.varied);
    free(desk->starts);
    free(desk->repeats);
}
