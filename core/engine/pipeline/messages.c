/* SPDX-License-Identifier: MIT */
/* Texts that are valid as long as the pipeline, and phrases shared by several messages. */
#include "build.h"

#include "../value/tree.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

char *fe_pipeline_print(ff_pipeline *pipeline, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *text = fe_print_list(format, args);
    va_end(args);
    char *kept = fe_arena_text(&pipeline->memory->arena, text, strlen(text));
    fe_free(text);
    return kept;
}

const char *fe_join(ff_pipeline *pipeline, const char *list, const char *word)
{
    return fe_pipeline_print(pipeline, "%s%s%s", list, *list ? ", " : "", word);
}

const char *fe_did_you_mean(fe_build *b, const char *word, const char *const *words, size_t count)
{
    const char *near = ff_nearest(word, words, count);
    return near && strcmp(near, word) != 0
               ? fe_pipeline_print(b->pipeline, "; did you mean \"%s\"?", near)
               : "";
}

const char *fe_found(const ff_node *node)
{
    return node->kind == FF_SCALAR && !node->text[0] ? "nothing" : fe_kind_name(node->kind);
}

bool fe_expected(fe_build *b, const ff_node *node, const char *where, const char *what)
{
    return ff_error(b->report, FF_FAULT_INPUT, node->place, NULL, "%s: expected %s, found %s",
                    where, what, fe_found(node));
}

const char *fe_place_text(ff_pipeline *pipeline, ff_place place)
{
    if (!place.source || place.line == 0 || !strcmp(place.source->name, "--set"))
        return place.source ? place.source->name : "preset";
    return fe_pipeline_print(pipeline, "%s:%u:%u", place.source->name, place.line, place.column);
}

void fe_hand_on(const ff_message *m, ff_report *report)
{
    if (m->severity == FF_ERROR)
        ff_error(report, m->fault, m->place, m->hint, "%s", m->text);
    else
        ff_warn(report, m->place, "%s", m->text);
}

char *fe_copy_clean(const char *text)
{
    char clean[512];
    ff_clean_text(clean, sizeof clean, text ? text : "");
    return fe_copy_text(clean, strlen(clean));
}
