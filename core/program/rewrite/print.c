/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file of format 1 printed as format 2: stages of laws anew, all else as it stands. */
#include "private.h"

#include "../study/yaml.h"

#include <stdlib.h>
#include <string.h>

typedef struct printing {
    const rewrite_world *world;
    const rewrite_file *file;
    FILE *out;
    FILE *remarks;   /* what is printed above the file */
    char *operating; /* lines that the operating stage lacks; NULL: none, or they are printed */
    char *oil;       /* the same of the oil */
    char *gear;      /* what is taken away from the gear */
} printing;

/* Lines joined by ", ". */
static void print_joined(const char *lines, FILE *out)
{
    for (const char *at = lines; at && *at;) {
        size_t length = strcspn(at, "\n");
        fprintf(out, "%s%.*s", at == lines ? "" : ", ", (int)length, at);
        at += length + 1;
    }
}

static void print_lines(const char *lines, int indent, FILE *out)
{
    for (const char *at = lines; at && *at;) {
        size_t length = strcspn(at, "\n");
        fprintf(out, "%*s%.*s\n", indent, "", (int)length, at);
        at += length + 1;
    }
}

static bool is_empty(const rewrite_part *part)
{
    return !part->own && !part->sets;
}

/* "{use: ..., with: {...}}" */
static void print_flow(const rewrite_part *part, FILE *out)
{
    fputc('{', out);
    print_joined(part->own, out);
    if (part->sets) {
        fputs(part->own ? ", with: {" : "with: {", out);
        print_joined(part->sets, out);
        fputc('}', out);
    }
    fputc('}', out);
}

static void print_part(const char *name, const rewrite_part *part, int indent, FILE *out)
{
    if (is_empty(part))
        return;
    fprintf(out, "%*s%s:", indent, "", name);
    if (part->sets) {
        fputc('\n', out);
        print_lines(part->own, indent + 2, out);
        fprintf(out, "%*swith:\n", indent + 2, "");
        print_lines(part->sets, indent + 4, out);
    } else {
        fputc(' ', out);
        print_flow(part, out);
        fputc('\n', out);
    }
}

/* The oil takes what it lacks along, when it is printed anyway. */
static void add_to_oil(printing *p, rewrite_part *oil)
{
    if (!oil->own || !p->oil)
        return;
    char *both = memory_print_text("%s%s", oil->own, p->oil);
    free(oil->own);
    free(p->oil);
    oil->own = both;
    p->oil = NULL;
}

/* Prints a stage of what is lacking alone. */
static void print_rest(const char *name, char **lines, int indent, FILE *out)
{
    const rewrite_part part = {.own = *lines};
    print_part(name, &part, indent, out);
    free(*lines);
    *lines = NULL;
}

/* Of several laws each keeps its name, and has a stage for its oil. */
static void print_law_of_several(printing *p, const char *name, const ff_node *node, int indent)
{
    rewrite_stages s;
    char *oil = memory_print_text("%s_oil", name);
    if (rewrite_is_viscosity(p->world, name, node))
        rewrite_split_of_several(p->world, name, oil, node, &s);
    else
        rewrite_split_density_of_several(p->world, node, &s);
    print_part(oil, &s.oil, indent, p->out);
    print_part(name, &s.viscosity, indent, p->out);
    print_part(name, &s.density, indent, p->out);
    if (s.remarks)
        fputs(s.remarks, p->remarks);
    free(oil);
    rewrite_free_stages(&s);
}

static void print_law(printing *p, const char *name, const ff_node *node, int indent)
{
    rewrite_stages s;
    if (rewrite_is_viscosity(p->world, name, node))
        rewrite_split_viscosity(p->world, node, &s);
    else
        rewrite_split_density(node, &s);
    add_to_oil(p, &s.oil);
    print_part("oil", &s.oil, indent, p->out);
    print_part("viscosity", &s.viscosity, indent, p->out);
    print_part("density", &s.density, indent, p->out);
    if (s.remarks)
        fputs(s.remarks, p->remarks);
    rewrite_free_stages(&s);
}

static bool is_law(const printing *p, const char *name, const ff_node *node)
{
    bool moves = p->world->mode == REWRITE_OIL || p->world->mode == REWRITE_EACH;
    return moves && node->kind == FF_MAP &&
           (rewrite_is_viscosity(p->world, name, node) || rewrite_is_density(p->world, name, node));
}

/* Laws that keep eta0 and rho0 have a new name alone. */
static const char *new_name(const printing *p, const char *name)
{
    if (p->world->mode != REWRITE_BARE)
        return name;
    if (!strcmp(name, p->world->viscosity))
        return "viscosity";
    return p->world->density && !strcmp(name, p->world->density) ? "density" : name;
}

static bool is_operating(const printing *p, const char *name)
{
    return p->operating && !strcmp(name, p->world->operating);
}

/* A map with further keys at its end. */
static void print_operating(printing *p, const char *name, const ff_node *node, int indent)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&text, &length));
    study_yaml_print(node, out);
    fclose(out);
    fprintf(p->out, "%*s%s: %.*s, ", indent, "", name, (int)length - 1, text);
    print_joined(p->operating, p->out);
    fputs("}\n", p->out);
    free(text);
    free(p->operating);
    p->operating = NULL;
}

static void print_stage(printing *p, const char *name, const ff_node *node, int indent)
{
    if (is_law(p, name, node)) {
        if (p->world->mode == REWRITE_EACH)
            print_law_of_several(p, name, node, indent);
        else
            print_law(p, name, node, indent);
    } else if (is_operating(p, name) && node->kind == FF_MAP && node->count) {
        print_operating(p, name, node, indent);
    } else {
        char *text = NULL;
        size_t length = 0;
        FILE *out = memory_require(open_memstream(&text, &length));
        fprintf(out, "%*s%s: ", indent, "", new_name(p, name));
        study_yaml_print(node, out);
        fputc('\n', out);
        fclose(out);
        rewrite_print_words(p->world, text, length, p->out);
        free(text);
    }
}

/* The begin of a line of the text; its end beyond the last. */
static const char *line_at(const char *text, uint32_t line)
{
    for (uint32_t i = 1; i < line && *text; i++) {
        text += strcspn(text, "\n");
        text += *text != 0;
    }
    return text;
}

/* Whether each key of the map begins a line of its own. */
static bool is_block(const rewrite_file *file, const ff_node *map)
{
    for (size_t i = 0; i < map->count; i++) {
        const ff_place *place = &map->key_places[i];
        const char *line = line_at(file->text, place->line);
        size_t blank = strspn(line, " ");
        if (blank + 1 != place->column || line[blank] == '{' ||
            (i && place->line <= map->key_places[i - 1].line))
            return false;
    }
    return map->count > 0 && !strchr(file->text, '&');
}

/* The end of a stage's lines, without the blank and comment lines before the next. */
static const char *end_of(const char *begin, const char *end)
{
    const char *last = begin;
    for (const char *at = begin; at < end;) {
        const char *word = at + strspn(at, " \t");
        size_t length = strcspn(at, "\n");
        if (*word != '#' && *word != '\n' && *word)
            last = at + length + (at[length] == '\n');
        at += length + (at[length] == '\n');
    }
    return last < end ? last : end;
}

static void print_text(printing *p, const char *begin, const char *end)
{
    rewrite_print_words(p->world, begin, (size_t)(end - begin), p->out);
}

/* The stages of a block map, each from its line to that of the next. */
static void print_block(printing *p, const ff_node *map, const char *begin, const char *end)
{
    int indent = (int)map->key_places[0].column - 1;
    const char *first = line_at(p->file->text, map->key_places[0].line);
    print_text(p, begin, first);
    for (size_t i = 0; i < map->count; i++) {
        const char *at = line_at(p->file->text, map->key_places[i].line);
        const char *next =
            i + 1 < map->count ? line_at(p->file->text, map->key_places[i + 1].line) : end;
        const char *stop = end_of(at, next);
        const char *name = map->keys[i];
        if (is_law(p, name, map->items[i]) ||
            (is_operating(p, name) && map->items[i]->kind == FF_MAP && map->items[i]->count)) {
            print_stage(p, name, map->items[i], indent);
        } else if (strcmp(new_name(p, name), name) != 0) {
            fprintf(p->out, "%*s%s", indent, "", new_name(p, name));
            print_text(p, at + indent + strlen(name), stop);
        } else {
            print_text(p, at, stop);
        }
        fwrite(stop, 1, (size_t)(next - stop), p->out);
    }
    print_rest(p->world->operating, &p->operating, indent, p->out);
    print_rest("oil", &p->oil, indent, p->out);
    print_rest(p->world->rough_gear, &p->gear, indent, p->out);
}

static void print_pipeline(printing *p, const ff_node *map, const char *begin, const char *end)
{
    if (map->kind != FF_MAP || (p->world->mode == REWRITE_NONE && !p->operating && !p->gear)) {
        print_text(p, begin, end);
    } else if (is_block(p->file, map)) {
        print_block(p, map, begin, end);
    } else {
        fputs("pipeline:\n", p->out);
        for (size_t i = 0; i < map->count; i++)
            print_stage(p, map->keys[i], map->items[i], 2);
        print_rest(p->world->operating, &p->operating, 2, p->out);
        print_rest("oil", &p->oil, 2, p->out);
        print_rest(p->world->rough_gear, &p->gear, 2, p->out);
    }
}

/* A value of an axis "oil: {a: {use: ..., grade: ...}}" as stages that are laid over. */
static void print_overlay(printing *p, const ff_node *node)
{
    rewrite_stages s;
    rewrite_split_viscosity(p->world, node, &s);
    const rewrite_part *parts[] = {&s.oil, &s.viscosity, &s.operating};
    const char *names[] = {"oil", "viscosity", p->world->operating};
    bool first = true;
    fputc('{', p->out);
    for (size_t i = 0; i < 3; i++) {
        if (is_empty(parts[i]))
            continue;
        fprintf(p->out, "%s%s: ", first ? "" : ", ", names[i]);
        print_flow(parts[i], p->out);
        first = false;
    }
    fputc('}', p->out);
    if (s.remarks)
        fputs(s.remarks, p->remarks);
    rewrite_free_stages(&s);
}

static bool is_axis_of_maps(const printing *p, const char *path, const ff_node *values)
{
    bool maps = p->world->mode == REWRITE_OIL && !strcmp(path, p->world->viscosity) &&
                values->kind != FF_SCALAR && values->count > 0 && !ff_node_get(values, "include");
    for (size_t i = 0; maps && i < values->count; i++)
        maps = values->items[i]->kind == FF_MAP;
    return maps;
}

static void print_axis(printing *p, const char *path, const ff_node *values, int indent)
{
    bool named = values->kind == FF_MAP;
    if (!is_axis_of_maps(p, path, values)) {
        print_stage(p, path, values, indent);
        return;
    }
    fprintf(p->out, "%*spipeline:\n", indent, "");
    for (size_t i = 0; i < values->count; i++) {
        fprintf(p->out, "%*s%s", indent + 2, "", named ? "" : "- ");
        if (named) {
            study_yaml_print_text(values->keys[i], false, p->out);
            fputs(": ", p->out);
        }
        print_overlay(p, values->items[i]);
        fputc('\n', p->out);
    }
}

static bool has_axis_of_maps(const printing *p, const ff_node *study)
{
    for (size_t i = 0; study->kind == FF_MAP && i < study->count; i++)
        for (size_t k = 0; study->items[i]->kind == FF_MAP && k < study->items[i]->count; k++)
            if (is_axis_of_maps(p, study->items[i]->keys[k], study->items[i]->items[k]))
                return true;
    return false;
}

static void print_study(printing *p, const ff_node *study, const char *begin, const char *end)
{
    if (!has_axis_of_maps(p, study)) {
        print_text(p, begin, end);
        return;
    }
    fputs("study:\n", p->out);
    for (size_t i = 0; i < study->count; i++) {
        const ff_node *part = study->items[i];
        if (part->kind != FF_MAP ||
            !(!strcmp(study->keys[i], "sweep") || !strcmp(study->keys[i], "zip"))) {
            print_stage(p, study->keys[i], part, 2);
            continue;
        }
        fprintf(p->out, "  %s:\n", study->keys[i]);
        for (size_t k = 0; k < part->count; k++)
            print_axis(p, part->keys[k], part->items[k], 4);
    }
}

/* What the laws of this file, or of its card, say of the temperature of the operating stage. */
static char *find_operating(const printing *p)
{
    const rewrite_world *world = p->world;
    const ff_node *stages = ff_node_get(p->file->root, "pipeline");
    bool last = p->file == &world->files[world->count - 1];
    if (!world->operating || world->oil_temperature)
        return NULL;
    for (size_t i = 0; (world->mode == REWRITE_OIL || world->mode == REWRITE_EACH) && stages &&
                       stages->kind == FF_MAP && i < stages->count;
         i++) {
        rewrite_stages s;
        if (!rewrite_is_viscosity(world, stages->keys[i], stages->items[i]))
            continue;
        rewrite_split_viscosity(world, stages->items[i], &s);
        char *own = s.operating.own;
        s.operating.own = NULL;
        rewrite_free_stages(&s);
        if (own)
            return own;
    }
    if (!last || world->temperature)
        return NULL;
    if (world->mode == REWRITE_OIL && world->card)
        return memory_print_text("oil_temperature: %s\n", world->card->temperature);
    if (world->has_losses || world->has_oil) /* the preset of format 1 */
        return memory_print_text("oil_temperature: 40 degC\n");
    return NULL;
}

/* Rough flanks have a roughness of their own: that of the gear, which stands in an included file,
   is taken away. */
static char *find_gear(const printing *p)
{
    const rewrite_world *world = p->world;
    const ff_node *stages = ff_node_get(p->file->root, "pipeline");
    bool last = p->file == &world->files[world->count - 1];
    if (!last || !world->has_surface || !world->rough_gear ||
        ff_node_get(stages, world->rough_gear))
        return NULL;
    return memory_print_text("%s: \n", world->roughness);
}

/* The temperature of a card goes to the oil where there is no operating stage. */
static char *find_oil(const printing *p)
{
    const rewrite_world *world = p->world;
    bool last = p->file == &world->files[world->count - 1];
    if (!last || world->mode != REWRITE_OIL || world->operating || world->temperature ||
        !world->card)
        return NULL;
    return memory_print_text("temperature: %s\n", world->card->temperature);
}

static void print_key(printing *p, const ff_node *root, size_t i, const char *begin,
                      const char *end)
{
    const char *key = root->keys[i];
    const ff_node *value = root->items[i];
    if (!strcmp(key, "format")) {
        fputs("format: 2\n", p->out);
        const char *rest = end_of(begin, end);
        fwrite(rest, 1, (size_t)(end - rest), p->out);
    } else if (!strcmp(key, "pipeline")) {
        print_pipeline(p, value, begin, end);
    } else if (!strcmp(key, "study")) {
        print_study(p, value, begin, end);
    } else {
        print_text(p, begin, end);
    }
}

static void print_top(printing *p)
{
    const ff_node *root = p->file->root;
    const char *text = p->file->text, *all = text + strlen(text);
    if (!is_block(p->file, root)) {
        fputs("# left as it is: write each key of the file, and each stage, on a line of its own\n",
              p->out);
        print_text(p, text, all);
        return;
    }
    print_text(p, text, line_at(text, root->key_places[0].line));
    for (size_t i = 0; i < root->count; i++) {
        const char *begin = line_at(text, root->key_places[i].line);
        const char *end = i + 1 < root->count ? line_at(text, root->key_places[i + 1].line) : all;
        print_key(p, root, i, begin, end);
    }
    if (p->operating || p->oil || p->gear) { /* the file has no stages of its own */
        fputs("pipeline:\n", p->out);
        print_rest(p->world->operating, &p->operating, 2, p->out);
        print_rest("oil", &p->oil, 2, p->out);
        print_rest(p->world->rough_gear, &p->gear, 2, p->out);
    }
}

/* The stages of laws that are left to the user. */
static void remark_left(printing *p)
{
    const ff_node *stages = ff_node_get(p->file->root, "pipeline");
    if (p->file->current || !stages || stages->kind != FF_MAP)
        return;
    for (size_t i = 0; i < stages->count; i++) {
        if (!rewrite_is_viscosity(p->world, stages->keys[i], stages->items[i]))
            continue;
        fprintf(p->remarks,
                "left as it is, one of several viscosity laws: %s (line %u); write a stage of the "
                "kind lubricant for its oil, and here the line oil: STAGE\n",
                stages->keys[i], (unsigned)stages->key_places[i].line);
    }
}

void rewrite_print_file(const rewrite_world *world, const rewrite_file *file, FILE *out)
{
    char *body = NULL, *remarks = NULL;
    size_t length = 0, remark_length = 0;
    printing p = {.world = world, .file = file};
    p.out = memory_require(open_memstream(&body, &length));
    p.remarks = memory_require(open_memstream(&remarks, &remark_length));
    p.operating = find_operating(&p);
    p.oil = find_oil(&p);
    p.gear = find_gear(&p);
    if (world->others && world->mode == REWRITE_NONE)
        remark_left(&p);
    if (world->mode == REWRITE_EACH && file == &world->files[world->count - 1])
        fputs("several viscosity laws: what takes one takes its oil, too; write there, where it is "
              "asked for, oil: NAME_oil or oil: none\n",
              p.remarks);
    rewrite_world plain =
        *world; /* a file of format 2 is printed as it is, but for what it lacks */
    if (file->current) {
        plain.mode = REWRITE_NONE;
        p.world = &plain;
    }
    print_top(&p);
    fclose(p.out);
    fclose(p.remarks);
    for (const char *at = remarks; *at;) {
        size_t line = strcspn(at, "\n");
        fprintf(out, "# %.*s\n", (int)line, at);
        at += line + (at[line] == '\n');
    }
    fwrite(body, 1, length, out);
    free(p.operating);
    free(p.oil);
    free(p.gear);
    free(remarks);
    free(body);
}
