/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "text.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void study_line_add(study_line *line, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = vsnprintf(line->text + line->used, sizeof line->text - line->used, format, args);
    va_end(args);
    line->used += length > 0 ? (size_t)length : 0;
    if (line->used >= sizeof line->text)
        line->used = sizeof line->text - 1;
}

void study_line_print(const study_context *context, study_line *line, int indent)
{
    study_context_print_line(context, indent, line->text);
    line->used = 0;
    line->text[0] = '\0';
}

bool study_read_number(const char *text, double *number, const char **end)
{
    char *stop;
    size_t sign = strspn(text, "+-");
    *number = strtod(text, &stop);
    *end = stop;
    return stop != text && strspn(text + sign, "0123456789.") > 0;
}

bool study_read_share(const char *text, double *share)
{
    const char *end = text;
    bool good = text && study_read_number(text, share, &end);
    end += good ? strspn(end, " ") : 0;
    if (good && *end == '%')
        *share /= 100, end++;
    return good && *end == '\0';
}

bool study_read_quantity(study_context *context, const ff_node *node, const char *name,
                         const char *hint, study_quantity *q)
{
    char why[200];
    const char *word = study_word(node);
    if (!word || !ff_number_parse(word, &q->number, &q->text))
        return ff_error(context->report, FF_FAULT_INPUT, node ? node->place : FF_NOWHERE, hint,
                        "%s: %.80s: expected a number with its unit", context->name, name);
    q->text += strspn(q->text, " ");
    return ff_unit_parse(q->text, &q->unit, why, sizeof why) ||
           ff_error(context->report, FF_FAULT_INPUT, node->place, NULL,
                    "%s: %.80s: the unit \"%.40s\" %s", context->name, name, q->text, why);
}

const char *study_text_of(const json_t *map, const char *key)
{
    const char *text = json_string_value(json_object_get(map, key));
    return text ? text : "";
}

double study_number_of(const json_t *map, const char *key)
{
    return study_json_number(json_object_get(map, key));
}
