/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "accept.h"

#include <stdlib.h>
#include <string.h>

static bool is_reported(const ff_report *report, ff_place place)
{
    for (size_t i = 0; i < ff_report_count(report); i++) {
        const ff_message *m = ff_report_at(report, i);
        if (m->severity == FF_WARNING && m->place.source == place.source &&
            m->place.line == place.line && m->place.column == place.column)
            return true;
    }
    return false;
}

/* Returns whether a line belongs to the stage named in a key. */
static bool is_of_stage(const char *line, const char *key)
{
    const size_t length = strcspn(key, ".");
    return !strncmp(line, key, length) && line[length] == '.';
}

/* Warns of a key that names no line of its stage. A stage without lines gives no information. */
static void check_key(const char *key, ff_place place, json_t *lines, ff_report *report)
{
    const char *line, **names = memory_alloc((json_object_size(lines) + 1) * sizeof *names);
    const size_t stage = strcspn(key, ".");
    size_t count = 0;
    json_t *unused;
    json_object_foreach(lines, line, unused)
    {
        if (is_of_stage(line, key))
            names[count++] = line + stage + 1;
    }
    if (count > 0 && !json_object_get(lines, key) && !is_reported(report, place)) {
        const char *nearest = ff_nearest(key + stage + 1, names, count);
        ff_warn(report, place, "accept: %.*s has no line \"%s\" in this run%s%s%s", (int)stage, key,
                key + stage + 1, nearest ? "; did you mean \"" : "", nearest ? nearest : "",
                nearest ? "\"?" : "");
    }
    free(names);
}

void accept_check_lines(const ff_node *accept, json_t *lines, ff_report *report)
{
    for (size_t k = 0; accept && accept->kind == FF_MAP && k < accept->count; k++)
        check_key(accept->keys[k], accept->key_places[k], lines, report);
}

void accept_check_pipeline(const ff_pipeline *pipeline, ff_report *report)
{
    const ff_node *accept = NULL;
    json_t *lines = json_object();
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        accept = stage->accept ? stage->accept : accept;
        for (size_t i = 0; stage->ran && i < stage->quality_count; i++) {
            char *name = memory_print_text("%s.%s", stage->name, stage->quality[i].name);
            json_object_set_new(lines, name, json_true());
            free(name);
        }
    }
    accept_check_lines(accept, lines, report);
    json_decref(lines);
}
