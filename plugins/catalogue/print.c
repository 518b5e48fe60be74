/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "print.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DIGITS = 12 };

bool can_assess(const ff_model *model)
{
    return FF_HAS(model, assess) && model->assess;
}

size_t kind_length(const char *id)
{
    return strcspn(id, "/");
}

const char *type_name(const ff_param *row)
{
    static const char *const names[] = {
        [FF_REAL] = "number",        [FF_INT] = "whole number",
        [FF_BOOL] = "true or false", [FF_CHOICE] = "choice",
        [FF_TEXT] = "text",          [FF_REALS] = "numbers",
        [FF_FILE] = "file",          [FF_TREE] = "value, list or map",
    };
    return row->type == FF_REALS && row->flags & FF_WHOLE ? "whole numbers" : names[row->type];
}

void type_print(const ff_param *row, char *out, size_t size)
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
        snprintf(out, size, "%s%s%s%s%s%s", count, type_name(row), has_unit ? " in " : "",
                 has_unit ? row->unit : "", *choices ? ", or " : "", choices);
}

void limits_print(const ff_param *row, char *out, size_t size)
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

static char *print_args(const char *words, va_list args)
{
    char *text = NULL;
    if (vasprintf(&text, words, args) < 0)
        abort();
    return text;
}

char *format(const char *words, ...)
{
    va_list args;
    va_start(args, words);
    char *text = print_args(words, args);
    va_end(args);
    return text;
}

int put(const ff_catalogue *catalogue, const char *words, ...)
{
    va_list args;
    va_start(args, words);
    char *text = print_args(words, args);
    va_end(args);
    int length = (int)strlen(text);
    catalogue->put(catalogue->ctx, text);
    free(text);
    return length;
}

ff_status put_json(const ff_catalogue *catalogue, json_t *value, size_t flags)
{
    char *text = json_dumps(value, flags | JSON_REAL_PRECISION(DIGITS));
    json_decref(value);
    if (text)
        catalogue->put(catalogue->ctx, text);
    ff_status status = text ? FF_OK : FF_NOMEM;
    free(text);
    return status;
}

json_t *json_text(const char *text)
{
    return text ? json_string(text) : json_null();
}

json_t *json_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}
