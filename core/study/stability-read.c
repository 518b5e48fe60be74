/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stands under `stability:`. */
#include "private.h"
#include "stability.h"

#include "../value/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct reading {
    ff_study *study;
    ff_stability *stability;
    ff_report *report;
} reading;

enum { MOST_HALVINGS = 40 };

static bool refuse(reading *r, ff_place place, const char *hint, const char *what)
{
    return ff_error(r->report, FF_EXIT_INPUT, place, hint, "stability: %s", what);
}

static const char *keep(reading *r, const char *text)
{
    return ff_arena_text(&r->study->arena, text, strlen(text));
}

static bool check_keys(reading *r, const ff_node *map, const char *const *known, size_t count)
{
    bool good = true;
    for (size_t i = 0; i < map->count; i++) {
        size_t k = 0;
        while (k < count && strcmp(map->keys[i], known[k]) != 0)
            k++;
        const char *near = ff_nearest(map->keys[i], known, count);
        if (k == count && strncmp(map->keys[i], "x-", 2) != 0)
            good = ff_error(r->report, FF_EXIT_INPUT, map->key_places[i], NULL,
                            "stability: unknown key \"%.80s\"%s%s%s", map->keys[i],
                            near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
    }
    return good;
}

/* The axes are those of a sweep. */
static bool read_axes(reading *r, const ff_node *node)
{
    char name[] = "sweep", *keys[] = {name};
    const ff_node *axes = ff_node_get(node, "axes");
    if (!axes || axes->kind != FF_MAP || axes->count == 0)
        return refuse(r, axes ? axes->place : node->place,
                      "write axes: {duty.torque: {from: 1 N m, to: 1000 N m, points: 7, "
                      "spacing: log}}",
                      "\"axes\" is a map from paths to ranges or lists");
    ff_node copy = *axes, *items[] = {&copy};
    ff_place places[] = {axes->place};
    ff_node wrapped = {.kind = FF_MAP,
                       .place = axes->place,
                       .count = 1,
                       .items = items,
                       .keys = keys,
                       .key_places = places};
    ff_study *swept = ff_study_read(&wrapped, r->report);
    if (!swept)
        return false;
    bool chained = swept->followed < swept->axis_count;
    double time = r->study->time_limit, memory = r->study->memory_limit;
    *r->study = *swept; /* with its arena */
    r->study->time_limit = time;
    r->study->memory_limit = memory;
    free(swept);
    return !chained || refuse(r, axes->place, NULL, "cells stand alone: \"follow\" is for sweeps");
}

static bool is_range(const ff_node *axis)
{
    return axis->kind == FF_MAP && ff_node_get(axis, "from");
}

static bool read_halvings(reading *r, const ff_node *axes, const ff_node *node)
{
    ff_stability *s = r->stability;
    char why[200];
    size_t count = r->study->axis_count;
    s->halvings = ff_arena_alloc(&r->study->arena, count * sizeof *s->halvings);
    s->log = ff_arena_alloc(&r->study->arena, count * sizeof *s->log);
    for (size_t a = 0; a < count; a++) {
        const ff_node *spacing = ff_node_get(axes->items[a], "spacing");
        const ff_node *own = node && node->kind == FF_MAP ? ff_node_get(node, axes->keys[a]) : node;
        int64_t value = 0;
        s->log[a] = is_range(axes->items[a]) && spacing && !strcmp(spacing->text, "log");
        if (own &&
            (own->kind != FF_SCALAR || !ff_integer_parse(own->text, &value, why, sizeof why) ||
             value < 0 || value > MOST_HALVINGS))
            return refuse(r, own->place, "write bisect: 4, or bisect: {duty.torque: 4}",
                          "\"bisect\" wants whole numbers from 0 to 40");
        s->halvings[a] = is_range(axes->items[a]) ? (size_t)value : 0;
    }
    for (size_t i = 0; node && node->kind == FF_MAP && i < node->count; i++) {
        const ff_node *axis = ff_node_get(axes, node->keys[i]);
        if (!axis || !is_range(axis))
            return refuse(r, node->key_places[i], NULL,
                          "\"bisect\" names an axis that has \"from\" and \"to\"");
    }
    return true;
}

/* NULL-terminated; NULL after an error. */
static const char **read_names(reading *r, const ff_node *list, const char *what, size_t *count)
{
    const char **names = ff_arena_alloc(&r->study->arena, (list->count + 2) * sizeof *names);
    const ff_node *one[] = {list};
    const ff_node *const *items =
        list->kind == FF_SCALAR ? one : (const ff_node *const *)list->items;
    *count = list->kind == FF_SCALAR ? 1 : list->count;
    for (size_t i = 0; i < *count; i++) {
        const char *text = items[i]->kind == FF_SCALAR ? items[i]->text : "";
        const char *dot = strchr(text, '.');
        if (list->kind == FF_MAP || !dot || dot == text || !dot[1]) {
            ff_error(r->report, FF_EXIT_INPUT, list->place, NULL,
                     "stability: \"%s\" is a list of names such as film.h_min_lowest", what);
            return NULL;
        }
        names[i] = keep(r, text);
    }
    return names;
}

static bool read_claims(reading *r, const ff_node *node)
{
    ff_stability *s = r->stability;
    const ff_node *outputs = ff_node_get(node, "outputs");
    const ff_node *estimates = ff_node_get(node, "estimates");
    if (!outputs || (outputs->kind == FF_SEQUENCE && outputs->count == 0))
        return refuse(r, node->place, "write outputs: [film.h_min_lowest]",
                      "\"outputs\" names the scalars that must be right");
    const char **names = read_names(r, outputs, "outputs", &s->claim_count);
    if (!names)
        return false;
    s->claims = ff_arena_alloc(&r->study->arena, s->claim_count * sizeof *s->claims);
    for (size_t i = 0; i < s->claim_count; i++)
        s->claims[i].output = names[i];
    for (size_t i = 0; estimates && i < estimates->count; i++) {
        size_t k = 0;
        while (estimates->kind == FF_MAP && k < s->claim_count &&
               strcmp(s->claims[k].output, estimates->keys[i]) != 0)
            k++;
        if (estimates->kind != FF_MAP || k == s->claim_count)
            return refuse(r, estimates->place,
                          "write estimates: {film.h_min_lowest: [film.h_min_space_error]}",
                          "\"estimates\" is a map from outputs of this study to names");
        s->claims[k].estimates =
            read_names(r, estimates->items[i], "estimates", &s->claims[k].estimate_count);
        if (!s->claims[k].estimates)
            return false;
    }
    return true;
}

/* A list of knobs to double, or a map from knobs to factors. */
static bool read_knobs(reading *r, const ff_node *refine)
{
    ff_stability *s = r->stability;
    if (!refine)
        return true;
    s->knobs = ff_arena_alloc(&r->study->arena, (refine->count + 1) * sizeof *s->knobs);
    for (size_t i = 0; i < refine->count; i++) {
        const ff_node *item = refine->items[i];
        ff_knob *knob = &s->knobs[s->knob_count++];
        const char *path = refine->kind == FF_MAP ? refine->keys[i] : item->text, *end;
        knob->factor = 2;
        if (item->kind != FF_SCALAR || !strchr(path, '.') ||
            (refine->kind == FF_MAP &&
             (!ff_number_parse(item->text, &knob->factor, &end) || *end || !(knob->factor > 0))))
            return refuse(r, item->place, "write refine: [film.cells] or {motion.tolerance: 0.01}",
                          "\"refine\" is a list of parameters to double, or a map from parameters "
                          "to factors");
        knob->path = keep(r, !strncmp(path, "pipeline.", 9) ? path + 9 : path);
    }
    return refine->count > 0 ||
           refuse(r, refine->place, NULL, "\"refine\" names at least one parameter");
}

static bool read_condition(reading *r, const ff_node *item, ff_condition *c)
{
    const char *text = item->kind == FF_SCALAR ? item->text : "", *end = "";
    size_t length = strcspn(text, " <>");
    const char *at = text + length + strspn(text + length, " ");
    c->name = ff_arena_text(&r->study->arena, text, length);
    c->than = *at;
    bool good = strchr(c->name, '.') != NULL;
    if (good && *at) {
        at += 1 + strspn(at + 1, " ");
        good = (c->than == '<' || c->than == '>') && ff_number_parse(at, &c->value, &end) && !*end;
    }
    return good || refuse(r, item->place, NULL,
                          "\"physical\" is a list of lines of quality, such as motion.periodicity, "
                          "and of conditions in SI, such as \"motion.contact_loss > 0\"");
}

static bool read_kinds(reading *r, const ff_node *node)
{
    ff_stability *s = r->stability;
    const ff_node *physical = ff_node_get(node, "physical"), *range = ff_node_get(node, "range");
    if (range && !(s->range = read_names(r, range, "range", &s->range_count)))
        return false;
    if (!physical)
        return true;
    s->physical = ff_arena_alloc(&r->study->arena, (physical->count + 1) * sizeof *s->physical);
    if (physical->kind == FF_SCALAR)
        return read_condition(r, physical, &s->physical[s->physical_count++]);
    for (size_t i = 0; i < physical->count; i++)
        if (!read_condition(r, physical->items[i], &s->physical[s->physical_count++]))
            return false;
    return true;
}

static bool read_tolerance(reading *r, const ff_node *node)
{
    ff_unit one;
    char why[200];
    r->stability->tolerance = 0.01;
    ff_unit_parse("1", &one, why, sizeof why);
    return !node ||
           (node->kind == FF_SCALAR &&
            ff_quantity_parse(node->text, &one, "1", &r->stability->tolerance, why, sizeof why) &&
            r->stability->tolerance > 0) ||
           refuse(r, node->place, NULL, "\"tolerance\" is a share such as 1 %");
}

/* What is asked for in place of the file's outputs: also what judges. */
static void put_request(reading *r)
{
    ff_stability *s = r->stability;
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (!out)
        abort();
    fputs("outputs=[", out);
    for (size_t i = 0; i < s->claim_count; i++)
        fprintf(out, "%s%s", i ? ", " : "", s->claims[i].output);
    for (size_t i = 0; i < s->physical_count; i++)
        if (s->physical[i].than)
            fprintf(out, ", %s", s->physical[i].name);
    fputs("]", out);
    fclose(out);
    s->request = keep(r, text);
    free(text);
}

bool ff_stability_read(ff_study *study, const ff_node *node, ff_report *report)
{
    static const char *const known[] = {"axes",   "outputs",  "estimates", "refine",
                                        "bisect", "physical", "range",     "tolerance"};
    reading r = {.study = study, .report = report};
    if (node->kind != FF_MAP)
        return refuse(&r, node->place, NULL, "expected a map with axes, outputs and refine");
    if (!check_keys(&r, node, known, sizeof known / sizeof *known) || !read_axes(&r, node))
        return false;
    r.stability = ff_arena_alloc(&study->arena, sizeof *r.stability);
    bool good = read_halvings(&r, ff_node_get(node, "axes"), ff_node_get(node, "bisect")) &&
                read_claims(&r, node) && read_knobs(&r, ff_node_get(node, "refine")) &&
                read_kinds(&r, node) && read_tolerance(&r, ff_node_get(node, "tolerance"));
    if (good)
        put_request(&r);
    study->stability = r.stability;
    return good;
}
