/* SPDX-License-Identifier: MIT */
/* Suggests a meaning for a key that a model does not have, from the names and docs in the models'
   tables. */
#include "build.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

/* Whether the text contains the whole word. */
static bool has_word(const char *text, const char *word, size_t length)
{
    for (const char *at = text; *at; at++) {
        bool begins = at == text || !isalnum((unsigned char)at[-1]);
        if (begins && !strncasecmp(at, word, length) && !isalnum((unsigned char)at[length]))
            return true;
    }
    return false;
}

/* Whether the text contains all words of a key such as "helix_angle". */
static bool has_words(const char *text, const char *key)
{
    for (const char *at = key; *at; at += *at != 0) {
        size_t length = strcspn(at, "_- .");
        if (length && !has_word(text, at, length))
            return false;
        at += length;
    }
    return true;
}

/* Returns the parameter whose name has all words of the key or, if `explained`, whose doc has them;
   NULL: there is none. */
static const ff_param *find_by_words(const ff_model *model, const char *key, bool explained)
{
    for (size_t i = 0; i < model->param_count; i++) {
        const ff_param *row = ff_model_param(model, i);
        char name[128];
        snprintf(name, sizeof name, "%s", row->name);
        for (char *at = name; *at; at++)
            *at = *at == '_' ? ' ' : *at;
        if (has_words(explained ? row->doc : name, key))
            return row;
    }
    return NULL;
}

const char *fe_hint_of_key(fe_build *b, const ff_stage *stage, const ff_model *model,
                           const char *key)
{
    const ff_param *row = find_by_words(model, key, false);
    row = row ? row : find_by_words(model, key, true);
    if (row)
        return fe_pipeline_print(b->pipeline, "perhaps \"%s\" is meant: %s", row->name, row->doc);
    for (size_t i = 0; i < b->pipeline->count; i++) {
        const ff_stage *other = &b->pipeline->stages[i];
        row = other != stage && other->loaded ? find_by_words(other->loaded->model, key, false)
                                              : NULL;
        if (row)
            return fe_pipeline_print(b->pipeline, "perhaps \"%s\" of %s (%s) is meant: %s",
                                     row->name, other->name, other->use, row->doc);
    }
    return NULL;
}
