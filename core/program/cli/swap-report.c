/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "swap-report.h"

#include "../terminal/terminal.h"

#include "../accuracy/models.h"
#include "../memory/memory.h"
#include "../run/run.h"

#include <stdlib.h>
#include <string.h>

/* A sentence under construction. */
typedef struct sentence {
    char *text;
    size_t count; /* items of the list at its end */
} sentence;

static void add_to_list(sentence *s, const char *begin, const char *text)
{
    memory_add_text(&s->text, "%s%s", s->count ? ", " : begin, text);
    s->count++;
}

/* Adds the parameters that the file gives: "z, p0 (card.yaml:33)". */
static void add_taken(sentence *s, const ff_stage *stage)
{
    char last[512] = "";
    s->count = 0;
    for (size_t i = 0; i < stage->loaded->model->param_count; i++) {
        const ff_bound *bound = &stage->params[i];
        char origin[512];
        if (!bound->present || !bound->place.source)
            continue;
        ff_bound_origin(bound, origin, sizeof origin);
        if (*last && strcmp(last, origin) != 0)
            memory_add_text(&s->text, " (%s)", last);
        snprintf(last, sizeof last, "%s", origin);
        add_to_list(s, "; it takes from the file ", bound->row->name);
    }
    if (s->count)
        memory_add_text(&s->text, " (%s)", last);
    else
        memory_add_text(&s->text, "; it takes no parameter from the file");
}

static void add_wires(sentence *s, const ff_pipeline *pipeline, const ff_stage *stage)
{
    s->count = 0;
    for (size_t i = 0; i < stage->wire_count; i++)
        if (stage->wires[i].stage >= 0)
            add_to_list(s, "; it is fed by ", pipeline->stages[stage->wires[i].stage].name);
}

static void add_lost(sentence *s, const ff_model *model, const ff_node *map)
{
    for (size_t i = 0; map && map->kind == FF_MAP && i < map->count; i++) {
        const char *key = map->keys[i];
        if (!strcmp(key, "use") || !strcmp(key, "with") || !strncmp(key, "x-", 2) ||
            ff_model_find_param(model, key) >= 0 || ff_model_find_input(model, key) >= 0)
            continue;
        add_to_list(s, "; it cannot take ", key);
    }
}

static void print_swap(const ff_pipeline *pipeline, const ff_stage *stage, const char *former)
{
    sentence s = {.text =
                      memory_print_text("%s: %s in place of %s", stage->name, stage->use, former)};
    add_taken(&s, stage);
    add_wires(&s, pipeline, stage);
    s.count = 0;
    add_lost(&s, stage->loaded->model, ff_node_get(ff_node_get(stage->node, "with"), former));
    terminal_print_wrapped(s.text, 0, 2);
    free(s.text);
}

void cli_print_swaps(const cli_session *session, const cli_options *options)
{
    ff_run *written = NULL; /* the file without --set */
    for (size_t i = 0; i < options->set_count; i++) {
        const char *set = options->sets[i], *equals = strchr(set, '='), *rest = "";
        size_t length = equals ? (size_t)(equals - set) : 0;
        char *path = memory_copy_text(set, length);
        const ff_stage *stage = ff_stage_of(session->pipeline, path, &rest);
        if (stage && stage->needed && stage->loaded && stage->params && !accuracy_open_use(stage) &&
            !strcmp(rest, "use")) {
            written = written ? written : run_read(session->engine, options->operand);
            const ff_node *stages = ff_node_get(ff_run_root(written), "pipeline");
            const ff_node *use = ff_node_get(ff_node_get(stages, stage->name), "use");
            if (use && use->kind == FF_SCALAR && strcmp(use->text, stage->use) != 0)
                print_swap(session->pipeline, stage, use->text);
        }
        free(path);
    }
    ff_run_close(written);
}
