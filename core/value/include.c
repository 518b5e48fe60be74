/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files, the files that they include, and the tree that they make together. */
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "node.h"

/* A file that is being read, and the one that includes it. */
typedef struct chain {
    const struct chain *parent;
    const char *name;
    dev_t device;
    ino_t inode;
    int level;
} chain;

/* The entry of an `include:` that names a file; place nowhere for the first file. */
typedef struct request {
    ff_tree *tree;
    ff_report *report;
    const chain *parent;
    ff_place place;
} request;

static ff_node *load(const request *q, const char *path);

static void *refuse(const request *q, const char *path, const char *why)
{
    ff_error(q->report, FF_EXIT_INPUT, q->place, NULL, "cannot read \"%s\": %s", path, why);
    return NULL;
}

static const char *reason(int number)
{
    switch (number) {
    case ENOENT:
        return "there is no such file";
    case ENOTDIR:
        return "a part of the path is no directory";
    case EACCES:
        return "permission denied";
    case ELOOP:
        return "its symbolic links go in a circle";
    case ENAMETOOLONG:
        return "the name is too long";
    default:
        return strerror(number);
    }
}

/* The whole file, or NULL with errno set; EFBIG beyond the limit. */
static char *read_all(int file, size_t *length)
{
    char *text = ff_alloc(FF_MOST_TEXT + 2);
    size_t used = 0;
    ssize_t n;
    while ((n = read(file, text + used, FF_MOST_TEXT + 1 - used)) != 0) {
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            break;
        used += (size_t)n;
    }
    if (n == 0 && used <= FF_MOST_TEXT) {
        *length = used;
        return text;
    }
    errno = n < 0 ? errno : EFBIG;
    free(text);
    return NULL;
}

/* Opens without waiting, so that a named pipe cannot hold the program up. */
static char *read_file(const request *q, const char *path, struct stat *info, size_t *length)
{
    char *text = NULL;
    const char *why = NULL;
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0 || fstat(file, info) < 0)
        why = reason(errno);
    else if (S_ISDIR(info->st_mode))
        why = "it is a directory";
    else if (!S_ISREG(info->st_mode))
        why = "it is not a regular file";
    else if (!(text = read_all(file, length)))
        why = errno == EFBIG ? "it is larger than 1 MiB" : reason(errno);
    if (file >= 0)
        close(file);
    return why ? refuse(q, path, why) : text;
}

static char *directory_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash)
        return ff_copy_text(".", 1);
    return ff_copy_text(path, slash == path ? 1 : (size_t)(slash - path));
}

/* Beside the file that names it; without a leading "./". */
static char *beside(const char *directory, const char *path)
{
    if (*path == '/' || !strcmp(directory, "."))
        return ff_copy_text(path, strlen(path));
    bool joined = directory[strlen(directory) - 1] == '/';
    return ff_print_text("%s%s%s", directory, joined ? "" : "/", path);
}

static ff_node *load_entry(const request *q, const ff_node *entry)
{
    request inner = *q;
    inner.place = entry->place;
    if (entry->kind != FF_SCALAR || *entry->text == '\0') {
        ff_error(q->report, FF_EXIT_INPUT, entry->place, NULL,
                 "expected the path of a file, found %s",
                 entry->kind == FF_SCALAR ? "nothing" : ff_kind_name(entry->kind));
        return NULL;
    }
    char *path = beside(entry->place.source->directory, entry->text);
    ff_node *node = load(&inner, path);
    free(path);
    return node;
}

/* Takes `include` out of the map and lays the named files over each other. False: one is lost. */
static bool load_includes(const request *q, ff_node *map, ff_node **base)
{
    size_t at = ff_map_find(map, "include");
    bool whole = true;
    *base = NULL;
    if (at == map->count)
        return true;
    const ff_node *list = map->items[at];
    ff_map_remove(map, at);
    if (list->kind == FF_SCALAR && *list->text == '\0')
        return true;
    size_t count = list->kind == FF_SEQUENCE ? list->count : 1;
    for (size_t i = 0; i < count; i++) {
        ff_node *node = load_entry(q, list->kind == FF_SEQUENCE ? list->items[i] : list);
        if (node)
            *base = ff_node_merge(q->tree, *base, node);
        whole = whole && node;
    }
    return whole;
}

static ff_node *check_root(const ff_source *source, ff_node *root, bool empty, ff_report *report)
{
    ff_place whole = {.source = source};
    if (empty || (root && root->kind == FF_SCALAR && !*root->text)) {
        ff_error(report, FF_EXIT_INPUT, whole, NULL, "there is nothing in it to read");
        return NULL;
    }
    if (!root || root->kind == FF_MAP)
        return root;
    bool tight = root->kind == FF_SCALAR && !root->quoted && strchr(root->text, ':');
    ff_error(report, FF_EXIT_INPUT, root->place,
             tight ? "a space is missing after \":\"" : "write \"key: value\"",
             "expected a map at the top, found %s", ff_kind_name(root->kind));
    return NULL;
}

/* A source and what it includes, merged. NULL when any part of it is lost. */
static ff_node *read_source(const request *q, const ff_source *source)
{
    bool empty;
    ff_node *root = ff_yaml_read(q->tree, source, 0, &empty, q->report), *base;
    root = check_root(source, root, empty, q->report);
    if (!root || !load_includes(q, root, &base))
        return NULL;
    ff_node_set_rank(root, q->tree->ranks++);
    return ff_node_merge(q->tree, base, root);
}

static bool is_open(const chain *at, const struct stat *info)
{
    for (; at; at = at->parent)
        if (at->device == info->st_dev && at->inode == info->st_ino)
            return true;
    return false;
}

/* NULL and a message when the bytes are those of another encoding. */
static const ff_source *make_source(const request *q, const char *path, const char *text,
                                    size_t length)
{
    size_t mark = length >= 3 && !memcmp(text, "\xEF\xBB\xBF", 3) ? 3 : 0;
    bool wide = length >= 2 && (!memcmp(text, "\xFF\xFE", 2) || !memcmp(text, "\xFE\xFF", 2));
    if (wide)
        return refuse(q, path, "it is UTF-16; save it as UTF-8");
    char *directory = directory_of(path);
    ff_source *source = ff_tree_source(q->tree, path, directory, text + mark, length - mark);
    free(directory);
    return source;
}

static ff_node *load(const request *q, const char *path)
{
    chain link = {.parent = q->parent, .name = path, .level = q->parent ? q->parent->level + 1 : 0};
    request inner = {.tree = q->tree, .report = q->report, .parent = &link};
    ff_node *node = NULL;
    struct stat info;
    size_t length;
    if (link.level > FF_MOST_INCLUDE_LEVELS)
        return refuse(q, path, "files include each other more than 16 levels deep");
    if (q->tree->files == FF_MOST_FILES)
        return refuse(q, path, "more than 64 files are included");
    char *text = read_file(q, path, &info, &length);
    if (!text)
        return NULL;
    q->tree->files++;
    if (is_open(q->parent, &info)) {
        ff_error(q->report, FF_EXIT_INPUT, q->place, NULL, "the file \"%s\" includes itself%s%s%s",
                 path, q->parent->parent ? " by way of \"" : "",
                 q->parent->parent ? q->parent->name : "", q->parent->parent ? "\"" : "");
        goto out;
    }
    link.device = info.st_dev;
    link.inode = info.st_ino;
    const ff_source *source = make_source(q, path, text, length);
    if (source)
        node = read_source(&inner, source);
out:
    free(text);
    return node;
}

ff_tree *ff_tree_load(const char *path, ff_report *report)
{
    ff_tree *tree = ff_alloc(sizeof *tree);
    request q = {.tree = tree, .report = report};
    tree->root = load(&q, path);
    return tree;
}

ff_tree *ff_tree_parse(const char *name, const char *directory, const char *text, ff_report *report)
{
    ff_tree *tree = ff_alloc(sizeof *tree);
    chain link = {.name = name};
    request q = {.tree = tree, .report = report, .parent = &link};
    size_t length = strlen(text);
    if (length > FF_MOST_TEXT) {
        refuse(&q, name, "it is larger than 1 MiB");
        return tree;
    }
    size_t mark = !strncmp(text, "\xEF\xBB\xBF", 3) ? 3 : 0;
    tree->files++;
    tree->root = read_source(
        &q, ff_tree_source(tree, name, directory ? directory : ".", text + mark, length - mark));
    return tree;
}
