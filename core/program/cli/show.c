/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The file as one, with all that includes and --set have made of it, and where each value comes
   from. What nobody wrote, a preset or an automatic wire, is a comment: it still may change with
   the model, and a model may tell what was given from what was not. */
#include "../terminal/terminal.h"
#include "command.h"

#include "../../engine/plugin/clean.h"
#include "../../engine/value/memory.h"

#include <stdlib.h>
#include <string.h>

enum { COLUMN = 56, STEP = 2 };

typedef struct show {
    const cli_session *session;
    const fe_stage *stage; /* whose keys are being shown; NULL: none, or it does not run */
    const char *set;       /* the model whose set under `with` is being shown; NULL: none */
    bool dead;             /* a map around it is a comment */
} show;

/* The first case of a study lies over the file; each case does so anew. */
static bool is_varied(const show *s, const fe_node *node)
{
    const study_definition *study = s->session->study;
    for (size_t k = 0; study && node->place.source && k < study->varied_count; k++) {
        const char *assignment = study_assignment(study, k, 0);
        const char *name = node->place.source->name, *file = strstr(assignment, name);
        bool included = !strncmp(assignment, "include=", 8) && *name && file &&
                        !strcmp(file + strlen(name), "\"");
        if (included || !strcmp(node->place.source->text, assignment))
            return true;
    }
    return false;
}

static const fe_bound *find_bound(const show *s, const char *path)
{
    bool applies = s->stage && s->stage->params && (!s->set || !strcmp(s->set, s->stage->use));
    int index = applies ? ff_model_find_param(s->stage->loaded->model, path) : -1;
    return index < 0 ? NULL : &s->stage->params[index];
}

/* Another layer or another of its group has taken the parameter's place. */
static bool is_displaced(const show *s, const fe_node *node, const char *path)
{
    const fe_bound *bound = find_bound(s, path);
    return bound &&
           (bound->place.source != node->place.source || bound->place.line != node->place.line ||
            bound->place.column != node->place.column);
}

/* Whether the file itself says something there. */
static bool is_live(const show *s, const fe_node *node)
{
    bool live = node->kind != FE_MAP || node->count == 0;
    for (size_t i = 0; node->kind == FE_MAP && i < node->count && !live; i++)
        live = is_live(s, node->items[i]);
    return live && !s->dead && !is_varied(s, node);
}

/* "key: value   # remark"; a line that is not live is a comment. */
static void print_line(int indent, bool live, const char *key, const char *value, const char *note)
{
    char *name = NULL, remark[600];
    size_t length = 0;
    FILE *out = fe_require(open_memstream(&name, &length));
    fe_yaml_print_text(key, false, out);
    fclose(out);
    fe_clean_text(remark, sizeof remark, note);
    int column =
        printf("%*s%s%s:%s%s", indent, "", live ? "" : "# ", name, *value ? " " : "", value);
    if (*remark)
        printf("%*s # %s", column < COLUMN ? COLUMN - column : 0, "", remark);
    putchar('\n');
    free(name);
}

/* The files that a study lays over the file, by their whole paths. */
static void print_files(const fe_node *list, FILE *out)
{
    for (size_t i = 0; i < list->count; i++) {
        const fe_node *item = list->items[i];
        const char *beside = item->place.source ? item->place.source->directory : ".";
        char *path = fe_path_beside(beside, item->text), *whole = realpath(path, NULL);
        fputs(i ? ", " : "[", out);
        fe_yaml_print_text(whole ? whole : path, true, out);
        free(whole);
        free(path);
    }
    fputc(']', out);
}

/* The text of a leaf; a file by its whole path, so that the result may stand anywhere. */
static char *leaf_text(const show *s, const fe_node *node, const char *path)
{
    const fe_bound *bound = find_bound(s, path);
    char *text = NULL, *whole = NULL;
    size_t length = 0;
    FILE *out = fe_require(open_memstream(&text, &length));
    if (bound && bound->present && bound->row->type == FF_FILE && bound->value.text)
        whole = realpath(bound->value.text, NULL);
    const char *last = strrchr(path, '.');
    if (last && !strcmp(last, ".include") && node->kind == FE_SEQUENCE && node->count > 0)
        print_files(node, out);
    else if (whole)
        fe_yaml_print_text(whole, true, out);
    else
        fe_yaml_print(node, out);
    fclose(out);
    free(whole);
    return text;
}

static void print_leaf(const show *s, const fe_node *node, const char *key, const char *path,
                       int indent)
{
    char origin[512];
    bool varied = is_varied(s, node), displaced = is_displaced(s, node, path);
    fe_bound_origin(&(fe_bound){.place = node->place}, origin, sizeof origin);
    char *text = leaf_text(s, node, path);
    char *note = fe_print_text("%s%s", varied ? "study, first case" : origin,
                               displaced ? ", replaced by a later one" : "");
    print_line(indent, !s->dead && !varied && !displaced, key, text, note);
    free(note);
    free(text);
}

static void print_map(const show *s, const fe_node *map, const char *prefix, int indent);

static void print_item(const show *s, const fe_node *item, const char *key, const char *path,
                       int indent)
{
    if (item->kind != FE_MAP || item->count == 0) {
        print_leaf(s, item, key, path, indent);
        return;
    }
    const show around = {s->session, s->stage, s->set, !is_live(s, item)};
    print_line(indent, !around.dead, key, "", "");
    if (s->set || strcmp(path, "with") != 0)
        print_map(&around, item, path, indent + STEP);
    for (size_t i = 0; !s->set && !strcmp(path, "with") && i < item->count; i++) {
        const show inner = {s->session, s->stage, item->keys[i], around.dead};
        print_item(&inner, item->items[i], item->keys[i], "", indent + STEP);
    }
}

static void print_map(const show *s, const fe_node *map, const char *prefix, int indent)
{
    for (size_t i = 0; i < map->count; i++) {
        char *path = fe_print_text("%s%s%s", prefix, *prefix ? "." : "", map->keys[i]);
        print_item(s, map->items[i], map->keys[i], path, indent);
        free(path);
    }
}

static void print_unwritten(const fe_pipeline *pipeline, const fe_stage *stage, int indent)
{
    for (size_t i = 0; i < stage->wire_count; i++) {
        const fe_wire *wire = &stage->wires[i];
        if (wire->automatic && wire->stage >= 0)
            print_line(indent, false, wire->name, pipeline->stages[wire->stage].name, "automatic");
    }
    for (size_t i = 0; stage->params && i < stage->loaded->model->param_count; i++)
        if (stage->params[i].present && !stage->params[i].place.source)
            print_line(indent, false, stage->params[i].row->name, stage->params[i].row->preset,
                       "preset");
}

static void print_pipeline(show *s, const fe_node *map)
{
    const fe_pipeline *pipeline = s->session->pipeline;
    printf("pipeline:\n");
    for (size_t i = 0; i < map->count; i++) {
        const fe_stage *stage = NULL;
        for (size_t k = 0; k < pipeline->count; k++)
            if (!strcmp(pipeline->stages[k].name, map->keys[i]))
                stage = &pipeline->stages[k];
        s->stage = stage && stage->needed ? stage : NULL;
        s->dead = !is_live(s, map->items[i]);
        print_line(STEP, !s->dead, map->keys[i], map->items[i]->count ? "" : "{}",
                   stage && !stage->needed ? stage->why : "");
        print_map(s, map->items[i], "", 2 * STEP);
        if (s->stage)
            print_unwritten(pipeline, stage, 2 * STEP);
        s->dead = false;
    }
    s->stage = NULL;
}

static void print_file(const cli_session *session, const cli_options *options)
{
    const fe_node *root = fe_tree_root(session->tree);
    show s = {.session = session};
    char name[400];
    fe_clean_text(name, sizeof name, options->operand);
    printf("# %s as flankfilm " CLI_VERSION
           " reads it: each value with its origin, and in comments "
           "what is not written\n",
           name);
    for (size_t i = 0; i < root->count; i++)
        if (!strcmp(root->keys[i], "pipeline"))
            print_pipeline(&s, root->items[i]);
        else
            print_item(&s, root->items[i], root->keys[i], "", 0);
}

int cli_show(const cli_options *options)
{
    cli_session session;
    int code = FE_EXIT_OK;
    if (cli_session_open(&session, options, false)) {
        fe_report_print(session.report, stderr, terminal_colour(stderr)); /* warnings */
        print_file(&session, options);
    } else {
        code = cli_refuse(session.report, options, "nothing was shown");
    }
    cli_session_close(&session);
    return code;
}
