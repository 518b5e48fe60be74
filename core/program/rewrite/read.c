/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file of format 1 with all that it includes, and what they say together. */
#include "private.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_TEXT = 1 << 20 };

static const rewrite_card cards[] = {
    {"mil-l-23699-100C.yaml", "mil-l-23699.yaml", "100 degC", "917.8 kg/m3"},
    {"mil-l-27502-100C.yaml", "mil-l-27502.yaml", "100 degC", "950 kg/m3"},
    {"santotrac-50-80C.yaml", "santotrac-50.yaml", "80 degC", "850 kg/m3"},
    {"sae-30-80C.yaml", "sae-30.yaml", "80 degC", "850 kg/m3"},
    {"iso-vg-220-80C.yaml", "gear-oil-mineral.yaml", "80 degC", "848.7 kg/m3"},
    {"vg-100-naphthenic-80C.yaml", "vg-100-naphthenic.yaml", "80 degC", "858.7 kg/m3"},
    {"vg-100-paraffinic-80C.yaml", "vg-100-paraffinic.yaml", "80 degC", "840.7 kg/m3"},
    {"vg-100-pao-80C.yaml", "vg-100-pao.yaml", "80 degC", "798.7 kg/m3"},
    {"pao-b-80C.yaml", "pao-b.yaml", "80 degC", "819 kg/m3"},
    {"5p4e-100C.yaml", "5p4e.yaml", "100 degC", "1140 kg/m3"},
    {"cardiff-reference.yaml", "cardiff-reference.yaml", "100 degC", "870 kg/m3"},
};

const rewrite_card *rewrite_card_at(size_t index)
{
    return index < sizeof cards / sizeof *cards ? &cards[index] : NULL;
}

static const char *file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static const rewrite_card *find_card(const char *path)
{
    for (size_t i = 0; i < sizeof cards / sizeof *cards; i++)
        if (!strcmp(file_name(path), cards[i].old))
            return &cards[i];
    return NULL;
}

static char *read_text(const char *path)
{
    FILE *stream = fopen(path, "re");
    if (!stream)
        return NULL;
    char *text = memory_alloc(MOST_TEXT + 1);
    size_t length = fread(text, 1, MOST_TEXT, stream);
    bool whole = feof(stream) || getc(stream) == EOF;
    fclose(stream);
    text[length] = '\0';
    if (whole)
        return text;
    free(text); /* the part of a file would be printed as if it were all */
    return NULL;
}

/* The tree of the text alone: its key `include` is read under another name of the same length, so
   that all places stay. */
static const char hidden[] = "x-inclu";

static ff_tree *parse_alone(const char *text, const char *directory)
{
    char *copy = memory_copy_text(text, strlen(text));
    ff_report *captured = ff_report_new();
    for (char *at = copy; (at = strstr(at, "include:")); at++)
        if (at == copy || at[-1] == '\n')
            memcpy(at, hidden, sizeof hidden - 1);
    ff_tree *tree = ff_tree_parse("", directory, copy, captured);
    ff_report_free(captured);
    free(copy);
    return tree;
}

static bool says_one(const ff_node *root)
{
    const ff_node *format = ff_node_get(root, "format");
    return format && format->kind == FF_SCALAR && !strcmp(format->text, "1");
}

static char *directory_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? memory_copy_text(path, (size_t)(slash - path) + (slash == path))
                 : memory_copy_text(".", 1);
}

static bool has_kind(const ff_node *stage, const char *kind)
{
    const ff_node *use = ff_node_get(stage, "use");
    return use && use->kind == FF_SCALAR && !strncmp(use->text, kind, strlen(kind));
}

static bool has_lubricant(const ff_node *root)
{
    const ff_node *stages = ff_node_get(root, "pipeline");
    for (size_t i = 0; stages && stages->kind == FF_MAP && i < stages->count; i++)
        if (has_kind(stages->items[i], "lubricant/"))
            return true;
    return false;
}

/* Whether the file is of format 2, or a part of such a one. */
static bool is_new(const ff_node *root)
{
    return !says_one(root) && (ff_node_get(root, "format") || has_lubricant(root));
}

static rewrite_file *add_file(rewrite_world *world, const char *path)
{
    rewrite_file *file = &world->files[world->count++];
    *file = (rewrite_file){.path = memory_copy_text(path, strlen(path))};
    return file;
}

/* An example that came with the program, with all that it includes. */
static void read_shipped(rewrite_world *world, const char *directory, const char *path)
{
    ff_report *captured = ff_report_new();
    char *text = memory_print_text("include: [\"%s\"]\n", path);
    rewrite_file *file = add_file(world, path);
    file->tree = ff_tree_parse("", directory, text, captured);
    file->root = ff_tree_root(file->tree);
    free(text);
    ff_report_free(captured);
}

static bool read_file(rewrite_world *world, const char *path, int level);

/* What a file of format 2 includes is its own matter. */
static void note_oil(rewrite_world *world, size_t first, const char *path)
{
    bool in_cards = strstr(path, "lubricants/") != NULL;
    for (size_t i = first; i < world->count; i++)
        if (has_lubricant(world->files[i].root) && !world->files[i].old) {
            world->has_oil = world->has_oil || in_cards;
            world->shipped = world->shipped || !in_cards;
        }
}

static void read_included(rewrite_world *world, const char *directory, const char *path, int level)
{
    char *beside = ff_path_beside(directory, path);
    const rewrite_card *card = find_card(path);
    size_t count = world->count;
    if (count + 1 < REWRITE_FILES && level < 16 && !read_file(world, beside, level + 1)) {
        if (card)
            world->card = card;
        else
            read_shipped(world, directory, path);
    }
    ff_free(beside);
}

/* What the file includes comes before it. False: it is not there. */
static bool read_file(rewrite_world *world, const char *path, int level)
{
    char *text = read_text(path);
    if (!text)
        return false;
    char *directory = directory_of(path);
    ff_tree *tree = parse_alone(text, directory);
    const ff_node *root = ff_tree_root(tree), *named = ff_node_get(root, hidden);
    bool list = named && named->kind == FF_SEQUENCE;
    for (size_t i = 0; named && i < (list ? named->count : 1); i++) {
        const ff_node *entry = list ? named->items[i] : named;
        size_t count = world->count;
        if (entry->kind == FF_SCALAR && *entry->text) {
            read_included(world, directory, entry->text, level);
            if (!is_new(root))
                note_oil(world, count, entry->text);
        }
    }
    free(directory);
    if (world->count < REWRITE_FILES) {
        rewrite_file *file = add_file(world, path);
        file->text = text;
        file->tree = tree;
        file->root = root;
        file->old = says_one(root);
        file->current = is_new(root);
        return true;
    }
    ff_tree_free(tree);
    free(text);
    return true;
}

static const char *scalar(const ff_node *map, const char *key)
{
    const ff_node *node = ff_node_get(map, key);
    return node && node->kind == FF_SCALAR && *node->text ? node->text : NULL;
}

/* What the fragment of a law says of its oil, later ones over earlier. */
static void note_law(rewrite_world *world, const ff_node *node)
{
    const ff_node *value;
    world->law = scalar(node, "use") ? scalar(node, "use") : world->law;
    if ((value = rewrite_value(world, node, "eta0")) && value->kind == FF_SCALAR)
        world->eta0 = value->text;
    if ((value = rewrite_value(world, node, "temperature")) && value->kind == FF_SCALAR)
        world->temperature = value->text;
    if (rewrite_value(world, node, "grade") || rewrite_value(world, node, "nu_40"))
        world->has_grade = true;
}

/* What the stage says that is no law. */
static void note_other(rewrite_world *world, const char *name, const ff_node *node)
{
    if (has_kind(node, "operating/"))
        world->operating = name;
    if (world->operating && !strcmp(name, world->operating) && scalar(node, "oil_temperature"))
        world->oil_temperature = scalar(node, "oil_temperature");
    if (has_kind(node, "surface/"))
        world->has_surface = true;
    const char *rough = ff_node_get(node, "roughness_rq")   ? "roughness_rq"
                        : ff_node_get(node, "roughness_ra") ? "roughness_ra"
                                                            : NULL;
    if (rough) {
        world->rough_gear = name;
        world->roughness = rough;
    }
    if (has_kind(node, "losses/"))
        world->has_losses = true;
    if (has_kind(node, "lubricant/") && scalar(node, "temperature"))
        world->temperature = scalar(node, "temperature");
}

/* A viscosity law beside the first one. */
static void note_other_law(rewrite_world *world, const char *name)
{
    if (!world->viscosity)
        return;
    for (size_t i = 0; i < world->others; i++)
        if (!strcmp(name, world->other[i]))
            return;
    if (world->others < REWRITE_LAWS)
        world->other[world->others++] = name;
}

static void note_law_stage(rewrite_world *world, const char *name, const ff_node *node)
{
    const ff_node *value;
    if (rewrite_is_viscosity(world, name, node)) {
        if (!world->viscosity || strcmp(name, world->viscosity) != 0)
            note_other_law(world, name);
        world->viscosity = world->viscosity ? world->viscosity : name;
        note_law(world, node);
    } else if (rewrite_is_density(world, name, node)) {
        world->density = world->density ? world->density : name;
        if ((value = rewrite_value(world, node, "rho0")) && value->kind == FF_SCALAR)
            world->rho0 = value->text;
    }
}

static void note_stages(rewrite_world *world)
{
    if (world->card || world->shipped) {
        world->viscosity = "oil";
        world->density = "rho";
    }
    for (size_t k = 0; k < world->count; k++) {
        const ff_node *stages = ff_node_get(world->files[k].root, "pipeline");
        const rewrite_file *file = &world->files[k];
        for (size_t i = 0; stages && stages->kind == FF_MAP && i < stages->count; i++) {
            const ff_node *node = stages->items[i];
            if (file->text || has_kind(node, "operating/") || has_kind(node, "losses/"))
                note_other(world, stages->keys[i], node);
            if (file->text && !file->current)
                note_law_stage(world, stages->keys[i], node);
        }
        world->has_oil = world->has_oil || (file->old && has_lubricant(file->root));
    }
}

static rewrite_mode find_mode(const rewrite_world *world)
{
    bool warm = world->temperature || world->oil_temperature;
    if (!world->viscosity || world->has_oil)
        return REWRITE_NONE;
    if (world->others)
        return world->card || world->shipped ? REWRITE_NONE : REWRITE_EACH;
    if (world->has_grade || world->card || world->shipped || (world->eta0 && warm))
        return REWRITE_OIL;
    return REWRITE_BARE;
}

bool rewrite_read(rewrite_world *world, const char *path)
{
    bool old = false;
    *world = (rewrite_world){0};
    if (!read_file(world, path, 0))
        return false;
    for (size_t i = 0; i < world->count; i++)
        old = old || world->files[i].old;
    if (old)
        note_stages(world);
    world->mode = find_mode(world);
    return old;
}

void rewrite_close(rewrite_world *world)
{
    for (size_t i = 0; i < world->count; i++) {
        ff_tree_free(world->files[i].tree);
        free(world->files[i].text);
        free(world->files[i].path);
    }
}
