/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "resolved.h"

#include "../accuracy/models.h"
#include "../memory/memory.h"
#include "../run/run.h"
#include "../study/cases/yaml.h"

#include <stdlib.h>
#include <string.h>

enum { COLUMN = 56, STEP = 2 };

/* Prints "key: value   # remark". A preset or an automatic wire is printed as a comment, since
 * it may change with the model, and a model can tell given values from absent ones. */
static void print_line(int indent, bool comment, const char *key, const char *value,
                       const char *note)
{
    char *name = NULL, remark[600];
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&name, &length));
    study_yaml_print_text(key, false, out);
    fclose(out);
    ff_clean_text(remark, sizeof remark, note);
    int column =
        printf("%*s%s%s:%s%s", indent, "", comment ? "# " : "", name, *value ? " " : "", value);
    if (*remark)
        printf("%*s # %s", column < COLUMN ? COLUMN - column : 0, "", remark);
    putchar('\n');
    free(name);
}

/* Prints the absolute path of a file that a study uses. */
static void print_file(const ff_node *item, FILE *out)
{
    const char *beside = item->place.source ? item->place.source->directory : ".";
    char *path = ff_path_beside(beside, item->text), *absolute = realpath(path, NULL);
    study_yaml_print_text(absolute ? absolute : path, true, out);
    free(absolute);
    ff_free(path);
}

static void print_files(const ff_node *list, FILE *out)
{
    for (size_t i = 0; i < list->count; i++) {
        fputs(i ? ", " : "[", out);
        print_file(list->items[i], out);
    }
    fputc(']', out);
}

/* Whether the node names the table with the cases of a study; "-" is standard input. */
static bool is_table_of_cases(const ff_node *node, const char *path)
{
    return !strcmp(path, "study.cases") && node->kind == FF_SCALAR && strcmp(node->text, "-") != 0;
}

/* Returns the parameter. NULL if the stage does not run or does not have it. */
static const ff_bound *find_bound(const ff_stage *stage, const char *path)
{
    int index = stage && stage->params ? ff_model_find_param(stage->loaded->model, path) : -1;
    return index < 0 ? NULL : &stage->params[index];
}

/* Returns the value so that it can stand in a file in any folder, with absolute paths. To be
 * freed. */
static char *print_value(const ff_bound *bound, const ff_node *node, const char *path)
{
    bool file = bound && bound->present && bound->row->type == FF_FILE && bound->value.text;
    char *text = NULL, *absolute = file ? realpath(bound->value.text, NULL) : NULL;
    const char *last = strrchr(path, '.');
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&text, &length));
    if (absolute)
        study_yaml_print_text(absolute, true, out);
    else if (last && !strcmp(last, ".include") && node->kind == FF_SEQUENCE && node->count > 0)
        print_files(node, out);
    else if (is_table_of_cases(node, path))
        print_file(node, out);
    else
        study_yaml_print(node, out);
    fclose(out);
    free(absolute);
    return text;
}

/* Returns the `KIND/auto` that the file gives for an open model, instead of the reference that
 * was put in its place. */
static const ff_node *as_written(const ff_stage *stage, const ff_node *node, const char *path)
{
    bool of_choice = !strcmp(path, "use") || !strcmp(path, "reference");
    return of_choice && stage && accuracy_open_use(stage) && node->replaced ? node->replaced : node;
}

/* Prints a value. The line becomes a comment if a later layer or another parameter of the group has
 * replaced the value, or if the value is empty and removes an earlier one. */
static void print_leaf(const ff_stage *stage, const ff_node *node, const char *key,
                       const char *path, int indent)
{
    const ff_bound *bound = find_bound(stage, path);
    bool away = bound && node->replaced && node->kind == FF_SCALAR && !*node->text;
    bool replaced = bound && (bound->place.source != node->place.source ||
                              bound->place.line != node->place.line ||
                              bound->place.column != node->place.column);
    char origin[512], *text = print_value(bound, node, path);
    ff_bound_origin(&(ff_bound){.place = node->place}, origin, sizeof origin);
    char *note = memory_print_text("%s%s", origin,
                                   away       ? ", removed"
                                   : replaced ? ", replaced by a later value"
                                              : "");
    print_line(indent, replaced, key, text, note);
    free(note);
    free(text);
}

static void print_map(const ff_stage *stage, const ff_node *map, const char *prefix, int indent);

static void print_entry(const ff_stage *stage, const char *key, const ff_node *item,
                        const char *prefix, int indent)
{
    char *path = memory_print_text("%s%s%s", prefix, *prefix ? "." : "", key);
    /* the key is the id of the model to which the set belongs */
    bool set = stage && !strcmp(prefix, "with");
    bool other = set && strcmp(key, stage->use) != 0;
    if (item->kind != FF_MAP || item->count == 0) {
        print_leaf(stage, as_written(stage, item, path), key, path, indent);
    } else {
        print_line(indent, false, key, "", "");
        print_map(other ? NULL : stage, item, set ? "" : path, indent + STEP);
    }
    free(path);
}

/* Prints the entries of a map. `stage` is the stage that it belongs to; NULL: none, or one that
 * does not run. */
static void print_map(const ff_stage *stage, const ff_node *map, const char *prefix, int indent)
{
    for (size_t i = 0; i < map->count; i++)
        print_entry(stage, map->keys[i], map->items[i], prefix, indent);
}

static void print_unwritten(const ff_pipeline *pipeline, const ff_stage *stage, int indent)
{
    for (size_t i = 0; i < stage->wire_count; i++) {
        const ff_wire *wire = &stage->wires[i];
        if (wire->automatic && wire->stage >= 0)
            print_line(indent, true, wire->name, pipeline->stages[wire->stage].name, "automatic");
    }
    for (size_t i = 0; stage->params && i < stage->loaded->model->param_count; i++)
        if (stage->params[i].present && !stage->params[i].place.source)
            print_line(indent, true, stage->params[i].row->name, stage->params[i].row->preset,
                       "preset");
}

static const ff_stage *find_stage(const ff_pipeline *pipeline, const char *name)
{
    for (size_t i = 0; pipeline && i < pipeline->count; i++)
        if (!strcmp(pipeline->stages[i].name, name))
            return &pipeline->stages[i];
    return NULL;
}

static void print_pipeline(const ff_pipeline *pipeline, const ff_node *map)
{
    print_line(0, false, "pipeline", "", "");
    for (size_t i = 0; i < map->count; i++) {
        const ff_stage *stage = find_stage(pipeline, map->keys[i]);
        bool runs = stage && stage->needed;
        print_line(STEP, false, map->keys[i], map->items[i]->count ? "" : "{}",
                   stage && !runs ? stage->why : "");
        print_map(runs ? stage : NULL, map->items[i], "", 2 * STEP);
        if (runs)
            print_unwritten(pipeline, stage, 2 * STEP);
    }
}

static void print_run(const ff_run *run, const char *file)
{
    const ff_node *root = ff_run_root(run);
    char name[400];
    ff_clean_text(name, sizeof name, file);
    printf("# %s as flankfilm " CLI_VERSION
           " reads it: each value with its origin; comments are not in the file\n",
           name);
    for (size_t i = 0; i < root->count; i++)
        if (!strcmp(root->keys[i], "pipeline"))
            print_pipeline(ff_run_pipeline(run), root->items[i]);
        else
            print_entry(NULL, root->keys[i], root->items[i], "", 0);
}

/* Reads the file again, since the session's run already has the assignments of the first case. */
void cli_print_resolved(const cli_session *session, const cli_options *options)
{
    if (!session->study) {
        print_run(session->run, options->operand);
        return;
    }
    ff_run *run = run_read(session->engine, options->operand);
    run_set_all(run, options->sets, options->set_count);
    if (session->study->request)
        run_put(run, "outputs", session->study->request);
    /* values that only the cases give may be missing */
    accuracy_build(run, session->engine, false);
    if (ff_run_root(run)) /* the file could be read */
        print_run(run, options->operand);
    ff_run_close(run);
}
