/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the literature of models as BibTeX, each entry once. */
#include "catalogue.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

typedef struct entry {
    const char *text; /* from "@" to its closing brace */
    size_t length;
    char *users; /* models with their stages: "kind/name (stage), ..." */
} entry;

typedef struct list {
    entry *entries;
    size_t count;
} list;

/* Returns the end of the entry: after the brace that closes its first one, or the end of the
   text. */
static const char *end_of_entry(const char *text)
{
    int depth = 0;
    for (; *text; text++) {
        depth += *text == '{';
        if (*text == '}' && --depth <= 0)
            return text + 1;
    }
    return text;
}

/* Returns whether two entries have the same key, "@article{key", ignoring the case of letters. */
static bool is_same_entry(const char *a, const char *b)
{
    const char *x = strchr(a, '{'), *y = strchr(b, '{');
    for (; x && y && tolower((unsigned char)*x) == tolower((unsigned char)*y); x++, y++)
        if (*x == ',' || !*x)
            return true;
    return false;
}

static void add_user(entry *e, const char *user)
{
    if (!strstr(e->users, user))
        memory_add_text(&e->users, "%s%s", *e->users ? ", " : "", user);
}

static void add_entries(list *l, const char *bibtex, const char *user)
{
    for (const char *at = strchr(bibtex, '@'), *end; at; at = strchr(end, '@')) {
        end = end_of_entry(at);
        size_t i = 0;
        while (i < l->count && !is_same_entry(l->entries[i].text, at))
            i++;
        if (i == l->count) {
            l->entries = memory_resize(l->entries, ++l->count * sizeof *l->entries);
            l->entries[i] = (entry){at, (size_t)(end - at), memory_copy_text("", 0)};
        }
        add_user(&l->entries[i], user);
    }
}

/* Adds the entries of a model. Models without BibTeX are listed by name, since the list would
   otherwise look complete. */
static void add_model(list *l, const catalogue_entry *used)
{
    const ff_model *model = used->model;
    bool stage = *used->user;
    char *user =
        memory_print_text("%s%s%s%s", model->id, stage ? " (" : "", used->user, stage ? ")" : "");
    if (strchr(model->bibtex, '@'))
        add_entries(l, model->bibtex, user);
    else
        printf("%% %s does not name any literature as BibTeX: %s\n\n", user,
               *model->reference ? model->reference : "none at all");
    free(user);
}

static void print_all(const list *l, const char *version, const char *commit)
{
    printf(
        "%% flankfilm itself\n"
        "@software{flankfilm, title={flankfilm: gear vibration and elastohydrodynamic lubrication "
        "of spur gears}, version={%s}",
        version);
    if (*commit)
        printf(", note={commit %s}", commit);
    puts("}");
    for (size_t i = 0; i < l->count; i++)
        printf("\n%% %s\n%.*s\n", l->entries[i].users, (int)l->entries[i].length,
               l->entries[i].text);
}

void catalogue_print_bibtex(const catalogue *c, const char *version, const char *commit)
{
    list l = {.count = 0};
    for (size_t i = 0; i < c->count; i++)
        if (c->entries[i].model)
            add_model(&l, &c->entries[i]);
    print_all(&l, version, commit);
    for (size_t i = 0; i < l.count; i++)
        free(l.entries[i].users);
    free(l.entries);
}
