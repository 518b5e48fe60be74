/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cases that the model of a study has asked for, as a study of one axis. */
#include "desk.h"

#include <stdlib.h>
#include <string.h>

/* What the case assigns to a path, the last time that it does; "": nothing. */
static const char *assigned(const ff_asked *asked, const char *path)
{
    size_t length = strlen(path);
    for (size_t i = asked->set_count; i-- > 0;)
        if (!strncmp(asked->sets[i], path, length) && asked->sets[i][length] == '=')
            return asked->sets[i];
    return "";
}

/* Its names, to be filled in as its assignments are. */
static const char **add_path(ff_study *study, const char *path, ff_arena *arena)
{
    ff_varied *varied = &study->varied[study->varied_count++];
    const char **names = ff_arena_alloc(arena, (study->count + 1) * sizeof *names);
    *varied = (ff_varied){.path = path, .names = names};
    varied->assignments = ff_arena_alloc(arena, (study->count + 1) * sizeof *varied->assignments);
    return names;
}

/* {path: null} of what is laid over the cases. */
static json_t *paths_over(const ff_desk *desk, const size_t *numbers, size_t count)
{
    json_t *paths = json_object();
    for (size_t i = 0; i < count; i++) {
        const ff_asked *asked = &desk->cases[numbers[i]];
        for (size_t k = 0; k < asked->set_count; k++) {
            char *path = ff_copy_text(asked->sets[k], strcspn(asked->sets[k], "="));
            json_object_set_new(paths, path, json_null());
            free(path);
        }
    }
    return paths;
}

/* The sweep's own values, then what is laid over them. */
static void lay_over(ff_desk *desk, const size_t *numbers, ff_study *study, ff_arena *arena)
{
    const ff_study *sweep = desk->sweep;
    json_t *paths = paths_over(desk, numbers, study->count), *none;
    json_t **starts = ff_arena_alloc(arena, (study->count + 1) * sizeof *starts);
    const char *path;
    study->varied = ff_arena_alloc(arena, (sweep->varied_count + json_object_size(paths) + 1) *
                                              sizeof *study->varied);
    study->varied_count = 0;
    for (size_t k = 0; k < sweep->varied_count; k++) {
        const char **names = add_path(study, sweep->varied[k].path, arena);
        for (size_t i = 0; i < study->count; i++) {
            size_t of = desk->cases[numbers[i]].of;
            study->varied[k].assignments[i] = ff_study_assignment(sweep, k, of);
            names[i] = ff_study_value(sweep, k, of);
        }
    }
    json_object_foreach(paths, path, none)
    {
        size_t k = study->varied_count;
        const char **names = add_path(study, ff_arena_text(arena, path, strlen(path)), arena);
        for (size_t i = 0; i < study->count; i++) {
            const char *text = assigned(&desk->cases[numbers[i]], path);
            study->varied[k].assignments[i] = text;
            names[i] = *text ? text + strlen(path) + 1 : "";
        }
    }
    json_decref(paths);
    for (size_t i = 0; i < study->count; i++) {
        starts[i] = ff_chain_start(sweep, desk->cases[numbers[i]].of, desk->keys, desk->records);
        json_array_append_new(desk->starts, starts[i]); /* NULL: that is no value */
    }
    study->starts = starts;
}

void ff_desk_lay_out(ff_desk *desk, const size_t *numbers, size_t count, ff_study *study,
                     ff_arena *arena)
{
    size_t paths = desk->plan.path_count;
    *study = *desk->base;
    study->points = ff_arena_alloc(arena, sizeof *study->points);
    study->points[0] = study->count = count;
    study->axis_count = study->followed = study->way = 1;
    if (desk->sweep) {
        lay_over(desk, numbers, study, arena);
        return;
    }
    study->varied = ff_arena_alloc(arena, paths * sizeof *study->varied);
    study->varied_count = 0;
    for (size_t k = 0; k < paths; k++) {
        const char **names = add_path(study, desk->plan.paths[k], arena);
        for (size_t i = 0; i < count; i++) {
            study->varied[k].assignments[i] = desk->cases[numbers[i]].points[k].assignment;
            names[i] = desk->cases[numbers[i]].points[k].name;
        }
    }
    if (!study->measure)
        return;
    ff_measure *measure = ff_arena_alloc(arena, sizeof *measure);
    size_t *repeat = ff_arena_alloc(arena, count * sizeof *repeat);
    for (size_t i = 0; i < count; i++)
        repeat[i] = desk->cases[numbers[i]].repeat;
    *measure = *study->measure;
    measure->repeat = repeat;
    study->measure = measure;
}

/* A list in brackets. */
static const char *request_of(ff_desk *desk, const ff_study_case *c)
{
    char *list = ff_print_text("outputs=[");
    for (size_t i = 0; i < c->output_count; i++) {
        char *longer = ff_print_text("%s%s%s", list, i ? ", " : "", c->outputs[i]);
        free(list);
        list = longer;
    }
    char *whole = ff_print_text("%s]", list);
    const char *kept = ff_desk_keep(desk, whole);
    free(list);
    free(whole);
    return kept;
}

void ff_desk_take_again(ff_desk *desk, const ff_study_case *c, ff_asked *asked)
{
    desk->astray = desk->astray || c->of >= desk->sweep->count;
    asked->of = desk->astray ? 0 : c->of;
    asked->sets = ff_arena_alloc(&desk->arena, (c->set_count + 1) * sizeof *asked->sets);
    for (size_t i = 0; i < c->set_count; i++)
        asked->sets[asked->set_count++] = ff_desk_keep(desk, c->sets[i]);
    asked->outputs = ff_arena_alloc(&desk->arena, (c->output_count + 1) * sizeof *asked->outputs);
    for (size_t i = 0; i < c->output_count; i++)
        asked->outputs[asked->output_count++] = ff_desk_keep(desk, c->outputs[i]);
    if (c->output_count)
        asked->sets[asked->set_count++] = request_of(desk, c);
}
