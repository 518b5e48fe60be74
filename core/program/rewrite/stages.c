/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the stage of a law becomes: an oil and a law with shape parameters alone. */
#include "private.h"

#include "../study/yaml.h"

#include <stdlib.h>
#include <string.h>

/* What said in a law which oil it is. */
static const char *const of_oil[] = {"eta0",   "grade",      "base",       "nu_40",
                                     "nu_100", "density_15", "temperature"};
enum { OF_OIL = sizeof of_oil / sizeof *of_oil };

bool rewrite_is_of_oil(const char *key)
{
    for (size_t i = 0; i < OF_OIL; i++)
        if (!strcmp(key, of_oil[i]))
            return true;
    return false;
}

static bool is_law(const char *kind, const char *name, const char *known, const ff_node *node)
{
    const ff_node *use = ff_node_get(node, "use"), *with = ff_node_get(node, "with");
    if (use && use->kind == FF_SCALAR)
        return !strncmp(use->text, kind, strlen(kind));
    if (known)
        return !strcmp(name, known);
    return with && with->kind == FF_MAP && with->count &&
           !strncmp(with->keys[0], kind, strlen(kind));
}

bool rewrite_is_viscosity(const rewrite_world *world, const char *name, const ff_node *node)
{
    for (size_t i = 0; i < world->others; i++)
        if (is_law("viscosity/", name, world->other[i], node))
            return true;
    return is_law("viscosity/", name, world->viscosity, node);
}

bool rewrite_is_density(const rewrite_world *world, const char *name, const ff_node *node)
{
    return is_law("density/", name, world->density, node);
}

const ff_node *rewrite_value(const rewrite_world *world, const ff_node *node, const char *key)
{
    const ff_node *with = ff_node_get(node, "with"), *use = ff_node_get(node, "use");
    const char *law = use && use->kind == FF_SCALAR ? use->text : world->law;
    const ff_node *value = ff_node_get(node, key);
    if (!value && law && with)
        value = ff_node_get(ff_node_get(with, law), key);
    for (size_t i = 0; !value && with && with->kind == FF_MAP && i < with->count; i++)
        value = ff_node_get(with->items[i], key);
    return value;
}

/* Lines "key: value" of a part, which grow. */
typedef struct lines {
    char *text;
    size_t length;
    FILE *out;
} lines;

static void begin(lines *l)
{
    *l = (lines){0};
    l->out = memory_require(open_memstream(&l->text, &l->length));
}

/* The text; NULL without a line. */
static char *end(lines *l)
{
    fclose(l->out);
    if (l->length)
        return l->text;
    free(l->text);
    return NULL;
}

static void add_node(lines *l, const char *key, const ff_node *value)
{
    study_yaml_print_text(key, false, l->out);
    fputs(": ", l->out);
    study_yaml_print(value, l->out);
    fputc('\n', l->out);
}

static void add(lines *l, const char *key, const char *text)
{
    fprintf(l->out, "%s: %s\n", key, text);
}

/* The keys of a map that stay with the law. */
static void add_rest(lines *l, const ff_node *map, bool (*leaves)(const char *))
{
    for (size_t i = 0; i < map->count; i++)
        if (strcmp(map->keys[i], "use") != 0 && strcmp(map->keys[i], "with") != 0 &&
            !leaves(map->keys[i]))
            add_node(l, map->keys[i], map->items[i]);
}

static void add_set(lines *l, const char *law, const ff_node *set, bool (*leaves)(const char *))
{
    bool first = true;
    if (set->kind != FF_MAP) {
        add_node(l, law, set);
        return;
    }
    for (size_t i = 0; i < set->count; i++) {
        if (leaves(set->keys[i]))
            continue;
        if (first)
            fprintf(l->out, "%s: {", law);
        fputs(first ? "" : ", ", l->out);
        study_yaml_print_text(set->keys[i], false, l->out);
        fputs(": ", l->out);
        study_yaml_print(set->items[i], l->out);
        first = false;
    }
    if (!first)
        fputs("}\n", l->out);
}

static void split_law(const ff_node *node, bool (*leaves)(const char *), rewrite_part *law)
{
    const ff_node *use = ff_node_get(node, "use"), *with = ff_node_get(node, "with");
    lines own, sets;
    begin(&own);
    begin(&sets);
    if (use)
        add_node(&own, "use", use);
    add_rest(&own, node, leaves);
    for (size_t i = 0; with && with->kind == FF_MAP && i < with->count; i++)
        add_set(&sets, with->keys[i], with->items[i], leaves);
    law->own = end(&own);
    law->sets = end(&sets);
}

static bool same_text(const char *a, const char *b)
{
    while (*a || *b) {
        a += strspn(a, " ");
        b += strspn(b, " ");
        if (*a != *b)
            return false;
        a += *a != 0;
        b += *b != 0;
    }
    return true;
}

/* The sets of a `with` may say different things of what is one oil now. */
static void remark_differing(const rewrite_world *world, const ff_node *node, lines *remarks)
{
    const ff_node *with = ff_node_get(node, "with");
    for (size_t k = 0; k < OF_OIL; k++) {
        const ff_node *taken = rewrite_value(world, node, of_oil[k]);
        for (size_t i = 0; taken && with && with->kind == FF_MAP && i < with->count; i++) {
            const ff_node *other = ff_node_get(with->items[i], of_oil[k]);
            if (other && taken->kind == FF_SCALAR && other->kind == FF_SCALAR &&
                !same_text(other->text, taken->text))
                fprintf(remarks->out, "left out: %s %s of %s, since there is one oil, with %s\n",
                        of_oil[k], other->text, with->keys[i], taken->text);
        }
    }
}

static double default_density(const char *base)
{
    return base && !strcmp(base, "PAO")     ? 850
           : base && !strcmp(base, "ester") ? 975
           : base && !strcmp(base, "PAG")   ? 1050
                                            : 890;
}

static const char *text_of(const ff_node *node)
{
    return node && node->kind == FF_SCALAR ? node->text : NULL;
}

/* eta0 was that at the temperature of the law, or of the operating stage. */
static void add_one_point(const rewrite_world *world, const char *eta0, lines *oil, lines *remarks)
{
    const char *T = world->oil_temperature ? world->oil_temperature
                    : world->temperature   ? world->temperature
                                           : world->card->temperature;
    const char *rho0 = world->rho0 ? world->rho0 : world->card ? world->card->density : NULL;
    add(oil, "use", "lubricant/measured");
    add(oil, "eta0", eta0);
    add(oil, "at", T);
    if (rho0)
        add(oil, "density", rho0);
    else
        fputs("missing: density of the oil at the temperature of eta0\n", remarks->out);
}

static void add_oil(const rewrite_world *world, const ff_node *node, lines *oil, lines *remarks)
{
    const ff_node *value[OF_OIL];
    enum { ETA0, GRADE, BASE, NU_40, NU_100, DENSITY_15 };
    for (size_t i = 0; i < OF_OIL; i++)
        value[i] = rewrite_value(world, node, of_oil[i]);
    bool one_point = text_of(value[ETA0]) && !value[GRADE] && !value[NU_40] &&
                     (world->temperature || world->oil_temperature || world->card);
    if (value[GRADE])
        add(oil, "use", "lubricant/grade");
    else if (value[NU_40])
        add(oil, "use", "lubricant/measured");
    else if (one_point)
        add_one_point(world, text_of(value[ETA0]), oil, remarks);
    for (size_t i = GRADE; i <= DENSITY_15; i++)
        if (value[i])
            add_node(oil, of_oil[i], value[i]);
    if (value[NU_40] && !value[DENSITY_15]) {
        char text[40];
        snprintf(text, sizeof text, "%g kg/m3", default_density(text_of(value[BASE])));
        add(oil, "density_15", text);
    }
}

/* A temperature of the law goes to the operating stage, where there is one. */
static void move_temperature(const rewrite_world *world, const ff_node *node, lines *oil,
                             lines *operating, lines *remarks)
{
    const char *T = text_of(rewrite_value(world, node, "temperature"));
    if (!T)
        return;
    if (!world->operating)
        add(oil, "temperature", T);
    else if (!world->oil_temperature)
        add(operating, "oil_temperature", T);
    else if (!same_text(T, world->oil_temperature))
        fprintf(
            remarks->out,
            "left out: temperature %s of the law; %s says oil_temperature %s, which holds now\n", T,
            world->operating, world->oil_temperature);
}

void rewrite_split_viscosity(const rewrite_world *world, const ff_node *node, rewrite_stages *to)
{
    lines oil, operating, remarks;
    *to = (rewrite_stages){0};
    begin(&oil);
    begin(&operating);
    begin(&remarks);
    add_oil(world, node, &oil, &remarks);
    move_temperature(world, node, &oil, &operating, &remarks);
    remark_differing(world, node, &remarks);
    split_law(node, rewrite_is_of_oil, &to->viscosity);
    to->oil.own = end(&oil);
    to->operating.own = end(&operating);
    to->remarks = end(&remarks);
}

/* A value of the law's own, which must not have an oil beside it. */
static void add_without_oil(lines *law, const char *key, const ff_node *value)
{
    if (value) {
        add_node(law, key, value);
        add(law, "oil", "none");
    }
}

void rewrite_split_of_several(const rewrite_world *world, const char *name, const char *oil,
                              const ff_node *node, rewrite_stages *to)
{
    bool has_oil = rewrite_value(world, node, "grade") || rewrite_value(world, node, "nu_40");
    rewrite_world alone = *world;
    lines law, remarks;
    alone.temperature = alone.oil_temperature = alone.rho0 = NULL;
    begin(&law);
    begin(&remarks);
    rewrite_split_viscosity(&alone, node, to);
    if (to->viscosity.own)
        fputs(to->viscosity.own, law.out);
    free(to->viscosity.own);
    if (has_oil) {
        add(&law, "oil", oil);
        fputs(to->remarks ? to->remarks : "", remarks.out);
    } else {
        free(to->oil.own);
        to->oil.own = NULL;
        add_without_oil(&law, "eta0", rewrite_value(world, node, "eta0"));
        if (rewrite_value(world, node, "temperature"))
            fprintf(remarks.out, "left out: temperature of %s, whose eta0 holds at one\n", name);
    }
    free(to->remarks);
    to->viscosity.own = end(&law);
    to->remarks = end(&remarks);
}

static bool is_rho0(const char *key)
{
    return !strcmp(key, "rho0");
}

void rewrite_split_density(const ff_node *node, rewrite_stages *to)
{
    *to = (rewrite_stages){0};
    split_law(node, is_rho0, &to->density);
}

void rewrite_split_density_of_several(const rewrite_world *world, const ff_node *node,
                                      rewrite_stages *to)
{
    lines law;
    rewrite_split_density(node, to);
    begin(&law);
    fputs(to->density.own ? to->density.own : "", law.out);
    add_without_oil(&law, "rho0", rewrite_value(world, node, "rho0"));
    free(to->density.own);
    to->density.own = end(&law);
}

void rewrite_free_stages(rewrite_stages *s)
{
    rewrite_part *parts[] = {&s->oil, &s->viscosity, &s->density, &s->operating};
    for (size_t i = 0; i < 4; i++) {
        free(parts[i]->own);
        free(parts[i]->sets);
    }
    free(s->remarks);
}
