/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "text.h"

#include "../plugin/clean.h"
#include "../plugin/param.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool ff_colour(FILE *stream)
{
    const char *refusal = getenv("NO_COLOR");
    const char *terminal = getenv("TERM");
    return isatty(fileno(stream)) && !(refusal && *refusal) &&
           !(terminal && strcmp(terminal, "dumb") == 0);
}

/* Characters, not bytes, of UTF-8. */
static int columns_of(const char *text, size_t length)
{
    int columns = 0;
    for (size_t i = 0; i < length; i++)
        columns += ((unsigned char)text[i] & 0xC0) != 0x80;
    return columns;
}

void ff_print_wrapped(const char *text, int column, int indent)
{
    const char *gap = "";
    while (*text) {
        size_t length = strcspn(text, " \n");
        int columns = columns_of(text, length);
        if (*gap && column + 1 + columns > FF_WIDTH) {
            printf("\n%*s", indent, "");
            column = indent;
            gap = "";
        }
        printf("%s%.*s", gap, (int)length, text);
        column += columns + (*gap ? 1 : 0);
        gap = " ";
        text += length;
        text += strspn(text, " \n");
    }
    putchar('\n');
}

void ff_print_cut(const char *text, int column)
{
    size_t length = strlen(text);
    bool fits = column + columns_of(text, length) <= FF_WIDTH;
    while (!fits && length > 0 && column + columns_of(text, length) + 3 > FF_WIDTH)
        length--;
    printf("%.*s%s\n", (int)length, text, fits ? "" : "...");
}

void ff_origin(const ff_bound *bound, char *out, size_t size)
{
    const ff_place *place = &bound->place;
    if (!place->source)
        snprintf(out, size, "%s", bound->proposed ? "proposed" : "preset");
    else if (place->line == 0 || strcmp(place->source->name, "--set") == 0)
        snprintf(out, size, "%s", place->source->name);
    else
        snprintf(out, size, "%s:%u", place->source->name, place->line);
}

const char *ff_param_type_name(const ff_param *row)
{
    static const char *const names[] = {
        [FF_REAL] = "number",        [FF_INT] = "whole number",
        [FF_BOOL] = "true or false", [FF_CHOICE] = "choice",
        [FF_TEXT] = "text",          [FF_REALS] = "numbers",
        [FF_FILE] = "file",          [FF_TREE] = "value, list or map",
    };
    return row->type == FF_REALS && row->flags & FF_WHOLE ? "whole numbers" : names[row->type];
}

void ff_param_type_print(const ff_param *row, char *out, size_t size)
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
        snprintf(out, size, "%s%s%s%s%s%s", count, ff_param_type_name(row), has_unit ? " in " : "",
                 has_unit ? row->unit : "", *choices ? ", or " : "", choices);
}

void ff_param_limits_print(const ff_param *row, char *out, size_t size)
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
