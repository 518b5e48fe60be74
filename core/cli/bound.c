/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bound.h"

#include "../plugin/clean.h"

#include <stdio.h>
#include <string.h>

void ff_origin(const ff_bound *bound, char *out, size_t size)
{
    const ff_place *place = &bound->place;
    if (!place->source)
        snprintf(out, size, "preset");
    else if (place->line == 0 || strcmp(place->source->name, "--set") == 0)
        snprintf(out, size, "%s", place->source->name);
    else
        snprintf(out, size, "%s:%u", place->source->name, place->line);
}

static size_t print_list(const ff_value *value, const ff_unit *unit, const char *unit_text,
                         char *out, size_t size)
{
    enum { SHOWN = 8 };
    size_t at = (size_t)snprintf(out, size, "[");
    for (size_t i = 0; i < value->count && i < SHOWN && at < size; i++) {
        char one[64];
        ff_quantity_print(value->reals[i], unit, unit_text, one, sizeof one);
        at += (size_t)snprintf(out + at, size - at, "%s%s", i ? ", " : "", one);
    }
    if (value->count > SHOWN && at < size)
        at += (size_t)snprintf(out + at, size - at, ", ... %zu in all", value->count);
    if (at < size)
        at += (size_t)snprintf(out + at, size - at, "]");
    return at;
}

bool ff_bound_print(const ff_stage *stage, size_t param, char *out, size_t size)
{
    const ff_bound *bound = &stage->params[param];
    const ff_value *value = &bound->value;
    const ff_unit *unit = &stage->loaded->param_units[param];
    if (!bound->present)
        return false;
    switch (bound->row->type) {
    case FF_REAL:
        if (value->text)
            ff_clean_text(out, size, value->text);
        else
            ff_quantity_print(value->real, unit, bound->row->unit, out, size);
        break;
    case FF_INT:
        if (value->text)
            ff_clean_text(out, size, value->text);
        else
            snprintf(out, size, "%lld", (long long)value->integer);
        break;
    case FF_BOOL:
        snprintf(out, size, "%s", value->integer ? "true" : "false");
        break;
    case FF_REALS:
        print_list(value, unit, bound->row->unit, out, size);
        break;
    default:
        ff_clean_text(out, size, value->text ? value->text : "");
    }
    return true;
}

const char *ff_param_type_name(const ff_param *row)
{
    switch (row->type) {
    case FF_REAL:
        return "number";
    case FF_INT:
        return "whole number";
    case FF_BOOL:
        return "true or false";
    case FF_CHOICE:
        return "choice";
    case FF_TEXT:
        return "text";
    case FF_REALS:
        return row->flags & FF_WHOLE ? "whole numbers" : "numbers";
    case FF_FILE:
        return "file";
    default:
        return "?";
    }
}

/* "a|b|c" as "a, b, c" */
static void print_choices(const char *choices, char *out, size_t size)
{
    size_t at = 0;
    for (const char *c = choices; *c && at + 3 < size; c++) {
        out[at++] = *c == '|' ? ',' : *c;
        if (*c == '|')
            out[at++] = ' ';
    }
    out[at] = '\0';
}

void ff_param_type_print(const ff_param *row, char *out, size_t size)
{
    char choices[256] = "", count[48] = "";
    bool has_unit = row->unit && *row->unit && strcmp(row->unit, "1") != 0;
    if (row->choices)
        print_choices(row->choices, choices, sizeof choices);
    if (row->type == FF_CHOICE) {
        snprintf(out, size, "one of %s", choices);
        return;
    }
    if (row->type == FF_REALS && row->max_count && row->min_count == row->max_count)
        snprintf(count, sizeof count, "%u ", row->max_count);
    else if (row->type == FF_REALS && row->max_count)
        snprintf(count, sizeof count, "%u to %u ", row->min_count, row->max_count);
    snprintf(out, size, "%s%s%s%s%s%s", count, ff_param_type_name(row), has_unit ? " in " : "",
             has_unit ? row->unit : "", *choices ? ", or " : "", choices);
}

void ff_param_limits_print(const ff_param *row, char *out, size_t size)
{
    size_t at = 0;
    out[0] = '\0';
    if (row->min < row->max) {
        const char *low = row->flags & FF_MIN_OPEN ? "above" : "from";
        const char *high = row->flags & FF_MAX_OPEN ? "below" : "to";
        if (row->min > -1e300)
            at = (size_t)snprintf(out, size, "%s %g", low, row->min);
        if (row->max < 1e300 && at < size)
            at += (size_t)snprintf(out + at, size - at, "%s%s %g", at ? " " : "",
                                   at || row->flags & FF_MAX_OPEN ? high : "up to", row->max);
    }
    if (row->low < row->high && at < size)
        snprintf(out + at, size - at, "%scalibrated from %g to %g", at ? "; " : "", row->low,
                 row->high);
}
