/* SPDX-License-Identifier: MIT */
/* Writes parameter values as a user writes them. */
#include "build.h"

#include <stdio.h>
#include <string.h>

static void print_list(const ff_value *value, const ff_unit *unit, const char *unit_text, char *out,
                       size_t size)
{
    enum { SHOWN = 8 };
    char one[64];
    size_t at = (size_t)snprintf(out, size, "[");
    for (size_t i = 0; i < value->count && i < SHOWN && at < size; i++) {
        ff_quantity_print(value->reals[i], unit, unit_text, one, sizeof one);
        at += (size_t)snprintf(out + at, size - at, "%s%s", i ? ", " : "", one);
    }
    if (value->count > SHOWN && at < size)
        at += (size_t)snprintf(out + at, size - at, ", ... %zu in all", value->count);
    if (at < size)
        snprintf(out + at, size - at, "]");
}

void ff_bound_print(const ff_stage *stage, size_t param, char *out, size_t size)
{
    const ff_bound *bound = &stage->params[param];
    const ff_value *value = &bound->value;
    const ff_unit *unit = &stage->loaded->param_units[param];
    if (value->text)
        ff_clean_text(out, size, value->text);
    else if (bound->row->type == FF_REALS)
        print_list(value, unit, bound->row->unit, out, size);
    else if (bound->row->type == FF_REAL)
        ff_quantity_print(value->real, unit, bound->row->unit, out, size);
    else if (bound->row->type == FF_BOOL)
        snprintf(out, size, "%s", value->integer ? "true" : "false");
    else
        snprintf(out, size, "%lld", (long long)value->integer);
}

void ff_bound_origin(const ff_bound *bound, char *out, size_t size)
{
    const ff_place *place = &bound->place;
    if (!place->source)
        snprintf(out, size, "%s", "preset");
    else if (place->line == 0 || strcmp(place->source->name, "--set") == 0)
        snprintf(out, size, "%s", place->source->name);
    else
        snprintf(out, size, "%s:%u", place->source->name, place->line);
}
