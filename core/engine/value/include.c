/* SPDX-License-Identifier: MIT */
/* Reads a file and the files that it includes, and merges them into one tree. */
#include <errno.h>
#include <libgen.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "home.h"
#include "node.h"
#include "similar-file.h"
#include "tree.h"

/* The state of reading one file. */
typedef struct file {
    fe_tree *tree;
    ff_report *report;
    const struct file *parent; /* the file that includes this one, or NULL */
    ff_place place;            /* place of this file's name in the parent */
    const char *path;
    const char *hint; /* added to the message if the file cannot be read, or NULL */
    struct stat info;
    int level;
} file;

static ff_node *load(file *f);

static void *refuse(const file *f, const char *why)
{
    ff_error(f->report, FF_FAULT_INPUT, f->place, f->hint, "cannot read \"%s\": %s", f->path, why);
    return NULL;
}

/* Returns the text of the file, which the caller frees; NULL after an error. */
static char *read_file(file *f, size_t *length)
{
    if (stat(f->path, &f->info) != 0)
        return refuse(f, fe_errno_text());
    if (S_ISDIR(f->info.st_mode))
        return refuse(f, "it is a directory");
    if (!S_ISREG(f->info.st_mode)) /* reading a named pipe would block */
        return refuse(f, "it is not a regular file");
    /* allocated before the stream is opened, so that a failure leaves no open stream */
    char *text = fe_alloc(FE_MOST_TEXT + 1);
    FILE *stream = fopen(f->path, "re");
    if (!stream)
        return refuse(f, fe_errno_text());
    *length = fread(text, 1, FE_MOST_TEXT + 1, stream);
    int failed = ferror(stream) ? errno : 0;
    fclose(stream);
    errno = failed;
    const char *why = *length > FE_MOST_TEXT ? "it is larger than 1 MiB" : NULL;
    if (!why && failed)
        why = fe_errno_text();
    if (!why)
        return text;
    fe_free(text);
    return refuse(f, why);
}

/* Joins the two paths and removes a leading "./". */
char *ff_path_beside(const char *directory, const char *path)
{
    bool alone = *path == '/' || !strcmp(directory, ".");
    return fe_print_text("%s%s%s", alone ? "" : directory, alone ? "" : "/", path);
}

/* Returns the path of an example that came with the engine, in the installed or the build tree.
   NULL: there is none with that name. The caller frees it. */
static char *shipped(const char *path)
{
    if (*path == '/')
        return NULL;
    char *installed = fe_print_text("share/flankfilm/configs/%s", path);
    /* in the build tree, configs is a link to the source tree */
    char *built = fe_print_text("configs/%s", path);
    char *found = fe_installed_file(installed);
    if (!found)
        found = fe_built_file(built);
    fe_free(installed);
    fe_free(built);
    return found;
}

/* Returns the example whose name is nearest to the file name in the path; NULL: none. The caller
 * frees it. */
static char *near_example(const char *path)
{
    const char *slash = strrchr(path, '/'), *word = slash ? slash + 1 : path;
    char *below = slash ? fe_copy_text(path, (size_t)(slash - path)) : fe_copy_text(".", 1);
    char *folder = shipped(below);
    char *there = folder ? fe_print_text("%s/%s", folder, word) : NULL;
    char *hint = there ? fe_near_file(there) : NULL;
    fe_free(below);
    fe_free(folder);
    fe_free(there);
    return hint;
}

/* Suggests a file to use instead of a missing file: a file with a similar name in the same
   directory or among the examples, or the example meant by "../gears/x.yaml" in a copy of an
   example. NULL: none. The caller frees it. */
static char *hint_at(const char *whole, const char *path)
{
    const char *below = path;
    while (!strncmp(below, "../", 3))
        below += 3;
    char *found = below > path ? shipped(below) : NULL;
    char *hint = found ? fe_print_text("to include the example, write \"%s\"", below) : NULL;
    fe_free(found);
    if (!hint)
        hint = fe_near_file(whole);
    return hint ? hint : near_example(path);
}

static ff_node *load_entry(const file *f, const ff_node *entry)
{
    if (entry->kind != FF_SCALAR || *entry->text == '\0') {
        ff_error(f->report, FF_FAULT_INPUT, entry->place, NULL,
                 "expected the path of a file, found %s",
                 entry->kind == FF_SCALAR ? "nothing" : fe_kind_name(entry->kind));
        return NULL;
    }
    char *path = ff_path_beside(entry->place.source->directory, entry->text), *other, *hint = NULL;
    if (access(path, F_OK) != 0 && (other = shipped(entry->text))) {
        fe_free(path);
        path = other;
    } else if (access(path, F_OK) != 0)
        hint = hint_at(path, entry->text);
    file inner = {.tree = f->tree,
                  .report = f->report,
                  .parent = f,
                  .place = entry->place,
                  .path = path,
                  .hint = hint,
                  .level = f->level + 1};
    ff_node *node = load(&inner);
    fe_free(hint);
    fe_free(path);
    return node;
}

/* Merges the named files into *base, which may be NULL. False if one cannot be read. */
static bool load_named(const file *f, const ff_node *named, ff_node **base)
{
    bool list = named->kind == FF_SEQUENCE, whole = true;
    for (size_t i = 0; i < (list ? named->count : 1); i++) {
        ff_node *node = load_entry(f, list ? named->items[i] : named);
        if (node)
            *base = fe_node_merge(f->tree, *base, node);
        whole = whole && node;
    }
    return whole;
}

/* Removes `include` from the map and reads the files that it names. False if one cannot be read. */
static bool load_includes(const file *f, ff_node *map, ff_node **base)
{
    size_t at = fe_map_find(map, "include");
    *base = NULL;
    if (at == map->count)
        return true;
    const ff_node *named = map->items[at];
    fe_map_remove(map, at);
    return fe_node_is_empty(named) || load_named(f, named, base);
}

bool fe_check_format(ff_report *report, const ff_node *format)
{
    if (!strcmp(format->text, FE_FORMAT))
        return true;
    bool first = !strcmp(format->text, "1");
    return ff_error(
        report, FF_FAULT_INPUT, format->place,
        first ? "the new names are listed in docs/lubricants.md, \"From format 1\"" : NULL,
        "format: expected " FE_FORMAT ", the only format that this version reads, found \"%.40s\"",
        format->text);
}

/* Reads a source and the files that it includes. NULL if any part of it cannot be read. */
static ff_node *read_source(const file *f, const ff_source *source)
{
    ff_node *root = fe_yaml_read(f->tree, source, source->text, f->report), *base;
    ff_place whole = {.source = source};
    if (root && fe_node_is_empty(root)) {
        ff_error(f->report, FF_FAULT_INPUT, whole,
                 "it begins with \"format: " FE_FORMAT "\"; stages stand under \"pipeline:\"",
                 "the file is empty");
        return NULL;
    }
    if (root && root->kind != FF_MAP) {
        ff_error(f->report, FF_FAULT_INPUT, root->place, "write \"key: value\"",
                 "expected a map at the top, found %s", fe_kind_name(root->kind));
        return NULL;
    }
    if (!root)
        return NULL;
    /* Stops here for another format, whose keys would only cause useless errors. An included file
       may omit `format`. */
    const ff_node *format = ff_node_get(root, "format");
    if (format && format->kind == FF_SCALAR && !fe_check_format(f->report, format))
        return NULL;
    if (!load_includes(f, root, &base))
        return NULL;
    fe_node_set_rank(root, f->tree->ranks++);
    return fe_node_merge(f->tree, base, root);
}

static bool includes_itself(const file *f)
{
    for (const file *at = f->parent; at; at = at->parent)
        if (at->info.st_dev == f->info.st_dev && at->info.st_ino == f->info.st_ino)
            return true;
    return false;
}

static ff_node *load(file *f)
{
    size_t length;
    ff_node *node = NULL;
    if (f->level > FE_MOST_INCLUDE_LEVELS)
        return refuse(f, "files include each other more than 16 levels deep");
    if (f->tree->files == FE_MOST_FILES)
        return refuse(f, "more than 64 files are included");
    char *text = read_file(f, &length);
    if (!text)
        return NULL;
    f->tree->files++;
    if (includes_itself(f)) {
        bool direct = !f->parent->parent;
        ff_error(f->report, FF_FAULT_INPUT, f->place, NULL, "the file \"%s\" includes itself%s%s%s",
                 f->path, direct ? "" : " by way of \"", direct ? "" : f->parent->path,
                 direct ? "" : "\"");
    } else {
        char *directory = fe_copy_text(f->path, strlen(f->path));
        node = read_source(f, fe_tree_source(f->tree, f->path, dirname(directory), text, length));
        fe_free(directory);
    }
    fe_free(text);
    return node;
}

bool fe_node_include(fe_tree *tree, const ff_node *named, ff_report *report)
{
    const file f = {.tree = tree, .report = report, .path = "--set"};
    return load_named(&f, named, &tree->root);
}

fe_tree *fe_tree_load(const char *path, ff_report *report)
{
    fe_tree *tree = fe_alloc(sizeof *tree);
    char *hint = access(path, F_OK) == 0 ? NULL : fe_near_file(path);
    tree->root = load(&(file){.tree = tree, .report = report, .path = path, .hint = hint});
    fe_free(hint);
    return tree;
}

fe_tree *fe_tree_parse(const char *name, const char *directory, const char *text, ff_report *report)
{
    fe_tree *tree = fe_alloc(sizeof *tree);
    file f = {.tree = tree, .report = report, .path = name};
    size_t length = strlen(text);
    if (length > FE_MOST_TEXT)
        refuse(&f, "it is larger than 1 MiB");
    else
        tree->root =
            read_source(&f, fe_tree_source(tree, name, directory ? directory : ".", text, length));
    tree->files++;
    return tree;
}
