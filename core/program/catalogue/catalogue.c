/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "catalogue.h"

#include <stdlib.h>
#include <string.h>

enum { DIGITS = 12 };

size_t catalogue_kind_length(const char *id)
{
    return strcspn(id, "/");
}

const char *catalogue_type_name(const ff_param *row)
{
    static const char *const names[] = {
        [FF_REAL] = "number",   [FF_INT] = "whole number", [FF_BOOL] = "true or false",
        [FF_CHOICE] = "choice", [FF_TEXT] = "text",        [FF_REALS] = "numbers",
        [FF_FILE] = "file",
    };
    return row->type == FF_REALS && row->flags & FF_WHOLE ? "whole numbers" : names[row->type];
}

void catalogue_print_type(const ff_param *row, char *out, size_t size)
{
    char choices[256] = "", word[64], count[48] = "";
    bool has_unit = *row->unit && strcmp(row->unit, "1") != 0;
    size_t used = 0;
    for (size_t i = 0;
         row->choices && used < sizeof choices && ff_word_at(row->choices, i, word, sizeof word);
         i++)
        used +=
            (size_t)snprintf(choices + used, sizeof choices - used, "%s%s", i ? ", " : "", word);
    if (row->max_count && row->min_count == row->max_count)
        snprintf(count, sizeof count, "%u ", row->max_count);
    else if (row->max_count)
        snprintf(count, sizeof count, "%u to %u ", row->min_count, row->max_count);
    if (row->type == FF_CHOICE)
        snprintf(out, size, "one of %s", choices);
    else
        snprintf(out, size, "%s%s%s%s%s%s", count, catalogue_type_name(row), has_unit ? " in " : "",
                 has_unit ? row->unit : "",
                 !*choices              ? ""
                 : row->type == FF_TEXT ? ", such as "
                                        : ", or ",
                 choices);
}

void catalogue_print_limits(const ff_param *row, char *out, size_t size)
{
    const char *low = row->flags & FF_MIN_OPEN ? "above" : "from";
    const char *high = row->flags & FF_MAX_OPEN ? "below" : "up to";
    bool limited = row->min < row->max;
    size_t at = 0;
    out[0] = '\0';
    if (limited && row->min > -1e300) {
        at = (size_t)snprintf(out, size, "%s %g", low, row->min);
        high = row->flags & FF_MAX_OPEN ? " below" : " to";
    }
    if (limited && row->max < 1e300)
        at += (size_t)snprintf(out + at, size - at, "%s %g", high, row->max);
    if (row->low < row->high)
        snprintf(out + at, size - at, "%scalibrated from %g to %g", at ? "; " : "", row->low,
                 row->high);
}

static const char *copy_clean(catalogue *c, const char *text)
{
    char *copy = text ? memory_arena_text(&c->arena, text, strlen(text)) : NULL;
    if (copy)
        ff_clean_text(copy, strlen(text) + 1, text);
    return copy;
}

void catalogue_add(catalogue *c, const char *id, const ff_loaded *loaded, const char *user,
                   const ff_report *report)
{
    const ff_message *why = loaded ? NULL : ff_report_first(report);
    c->entries = memory_resize(c->entries, (c->count + 1) * sizeof *c->entries);
    c->entries[c->count++] = (catalogue_entry){.id = copy_clean(c, id),
                                               .model = loaded ? loaded->model : NULL,
                                               .why = copy_clean(c, why ? why->text : NULL),
                                               .file = copy_clean(c, loaded ? loaded->path : NULL),
                                               .user = copy_clean(c, user)};
}

void catalogue_free(catalogue *c)
{
    free(c->entries);
    memory_arena_free(&c->arena);
    *c = (catalogue){.count = 0};
}

void catalogue_print_value(json_t *value, size_t flags, FILE *out)
{
    json_dumpf(value, out, flags | JSON_REAL_PRECISION(DIGITS));
    json_decref(value);
}
