/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The literature behind a run, as BibTeX: that of every model that runs, each entry once. */
#include "command.h"
#include "text.h"

#include "../plugin/clean.h"
#include "../value/memory.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

typedef struct entry {
    const char *text; /* from "@" to its last brace */
    size_t length;
    char *users; /* models and their stages: "kind/name (stage), ..." */
} entry;

typedef struct list {
    entry *entries;
    size_t count;
} list;

/* Past the brace that closes the first one; the end of the text without one. */
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

/* "@article{key": what makes two entries the same, in any case of its letters. */
static bool same_key(const char *a, const char *b)
{
    const char *x = strchr(a, '{'), *y = strchr(b, '{');
    for (; x && y && tolower((unsigned char)*x) == tolower((unsigned char)*y); x++, y++)
        if (*x == ',' || !*x)
            return true;
    return false;
}

static void add_user(entry *e, const char *user)
{
    if (strstr(e->users, user))
        return;
    char *longer = ff_print_text("%s%s%s", e->users, *e->users ? ", " : "", user);
    free(e->users);
    e->users = longer;
}

static void add_entries(list *l, const char *bibtex, const char *user)
{
    for (const char *at = strchr(bibtex, '@'), *end; at; at = strchr(end, '@')) {
        end = end_of_entry(at);
        size_t i = 0;
        while (i < l->count && !same_key(l->entries[i].text, at))
            i++;
        if (i == l->count) {
            l->entries = ff_resize(l->entries, ++l->count * sizeof *l->entries);
            l->entries[i] = (entry){at, (size_t)(end - at), ff_copy_text("", 0)};
        }
        add_user(&l->entries[i], user);
    }
}

/* Models without BibTeX are named, so that nobody takes the list for complete. */
static void add_model(list *l, const ff_model *model, const char *stage)
{
    char *user = ff_print_text("%s%s%s%s", model->id, *stage ? " (" : "", stage, *stage ? ")" : "");
    if (strchr(model->bibtex, '@'))
        add_entries(l, model->bibtex, user);
    else
        printf("%% %s names no literature as BibTeX: %s\n\n", user,
               *model->reference ? model->reference : "none at all");
    free(user);
}

/* Models that a study puts into a stage. */
static void add_varied(list *l, ff_session *session)
{
    const ff_study *study = session->study;
    for (size_t k = 0; study && k < study->varied_count; k++) {
        const ff_varied *varied = &study->varied[k];
        size_t length = strlen(varied->path), points = study->points[varied->axis];
        bool use = length > 4 && !strcmp(varied->path + length - 4, ".use");
        for (size_t i = 0; use && i < points; i++) {
            const char *id = ff_varied_value(varied, i);
            const ff_loaded *loaded =
                ff_names_kind_only(id)
                    ? NULL
                    : ff_library_load(session->library, id, FF_NOWHERE, session->report);
            if (loaded)
                add_model(l, loaded->model, "study");
        }
    }
}

static void print_all(const list *l)
{
    printf("%% flankfilm itself\n"
           "@software{flankfilm, title={flankfilm: gear vibration and elastohydrodynamic "
           "lubrication of spur gears}, version={" FF_VERSION "}}\n");
    for (size_t i = 0; i < l->count; i++)
        printf("\n%% %s\n%.*s\n", l->entries[i].users, (int)l->entries[i].length,
               l->entries[i].text);
}

int ff_cite(const ff_options *options)
{
    ff_session session;
    list l = {.count = 0};
    int code = FF_EXIT_OK;
    bool good = ff_session_open(&session, options, false) &&
                ff_choose_models(&session); /* what is not known before is not cited */
    for (size_t i = 0; good && i < session.pipeline->count; i++) {
        const ff_stage *stage = &session.pipeline->stages[session.pipeline->order[i]];
        if (stage->needed)
            add_model(&l, stage->loaded->model, stage->name);
    }
    if (good)
        add_varied(&l, &session);
    if (good && ff_report_errors(session.report) == 0)
        print_all(&l);
    else
        code = ff_refuse(session.report, options, "nothing is cited");
    for (size_t i = 0; i < l.count; i++)
        free(l.entries[i].users);
    free(l.entries);
    ff_session_close(&session);
    return code;
}
