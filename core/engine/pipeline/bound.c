/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes values of parameters as a user would. */
#include "build.h"

#include "../plugin/clean.h"

#include <stdio.h>
#include <string.h>

static void print_list(const ff_value *value, const fe_unit *unit, const char *unit_text, char *out,
                       size_t size)
{
    enum { SHOWN = 8 };
    char one[64];
    size_t at = (size_t)snprintf(out, size, "[");
    for (size_t i = 0; i < value->count && i < SHOWN && at < size; i++) {
        fe_quantity_print(value->reals[i], unit, unit_text, one, sizeof one);
        at += (size_t)snprintf(out + at, size - at, "%s%s", i ? ", " : "", one);
    }
    if (value->count > SHOWN && at < size)
        at += (size_t)snprintf(out + at, size - at, ", ... %zu in all", value->count);
    if (at < size)
        snprintf(out + at, size - at, "]");
}

void fe_bound_print(const fe_stage *stage, size_t param, char *out, size_t size)
{
    const fe_bound *bound = &stage->params[param];
    const ff_value *value = &bound->value;
    const fe_unit *unit = &stage->loaded->param_units[param];
    if (value->text)
        fe_clean_text(out, size, value->text);
    else if (bound->row->type == FF_REALS)
        print_list(value, unit, bound->row->unit, out, size);
    else if (bound->row->type == FF_REAL)
        fe_quantity_print(value->real, unit, bound->row->unit, out, size);
    else if (bound->row->type == FF_BOOL)
        snprintf(out, size, "%s", value->integer ? "true" : "false");
    else
        snprintf(out, size, "%lld", (long long)value->integer);
}

void fe_bound_origin(const fe_bound *bound, char *out, size_t size)
{
    const fe_place *place = &bound->place;
    if (!place->source)
        snprintf(out, size, "%s", bound->proposed ? "proposed" : "preset");
    else if (place->line == 0 || strcmp(place->source->name, "--set") == 0)
        snprintf(out, size, "%s", place->source->name);
    else
        snprintf(out, size, "%s:%u", place->source->name, place->line);
}
