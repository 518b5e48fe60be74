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

const ff_node *const *study_items(const ff_node *const *list, size_t *count)
{
    bool word = (*list)->kind == FF_SCALAR;
    *count = word ? 1 : (*list)->count;
    return word ? list : (const ff_node *const *)(*list)->items;
}

const char **study_read_names(study_context *context, const ff_node *list, const char *key,
                              size_t *count)
{
    const ff_node *const *items = study_items(&list, count);
    const char **names = memory_arena_alloc(&context->arena, (*count + 1) * sizeof *names);
    for (size_t i = 0; i < *count; i++) {
        const char *word = study_word(items[i]), *dot = word ? strchr(word, '.') : NULL;
        if (study_is_map(list) || !dot || dot == word || !dot[1] || strchr(word, '*')) {
            study_context_refuse(
                context, items[i], NULL,
                study_context_format(
                    context, "\"%s\" must be a list of names such as film.h_min_lowest", key));
            return NULL;
        }
        names[i] = word;
    }
    return names;
}

bool study_read_outputs(study_context *context, const ff_node *list)
{
    if (!list || !study_read_names(context, list, "outputs", &context->output_count))
        return false; /* every kind requires "outputs" */
    if (context->output_count == 0)
        return study_context_refuse(context, list, "write outputs: [film.h_min_lowest]",
                                    "\"outputs\" must name at least one");
    const ff_node *const *items = study_items(&list, &context->output_count);
    const ff_node **kept =
        memory_arena_alloc(&context->arena, context->output_count * sizeof *kept);
    memcpy(kept, items, context->output_count * sizeof *kept);
    context->outputs = kept;
    return true;
}

bool study_read_factors(study_context *context, const ff_node *node, const char ***names,
                        double **factors, size_t *count)
{
    *count = node ? node->count : 0;
    *names = memory_arena_alloc(&context->arena, (*count + 1) * sizeof **names);
    *factors = memory_arena_alloc(&context->arena, (*count + 1) * sizeof **factors);
    for (size_t i = 0; i < *count; i++) {
        const char *text = study_word(node->items[i]), *end = "";
        (*names)[i] = study_is_map(node) ? node->keys[i] : text;
        (*factors)[i] = 2;
        if (!text || !strchr((*names)[i], '.') ||
            (study_is_map(node) &&
             (!ff_number_parse(text, &(*factors)[i], &end) || *end || !((*factors)[i] > 0))))
            return study_context_refuse(context, node->items[i],
                                        "write refine: [film.cells] or {motion.tolerance: 0.01}",
                                        "\"refine\" must be a list of parameters to double, or a "
                                        "map from parameters to factors");
    }
    return !node || *count > 0 ||
           study_context_refuse(context, node, NULL, "\"refine\" must name at least one parameter");
}

study_comparison study_read_comparison(study_context *context, const char *text)
{
    const char *sign = strpbrk(text, "<>"), *limit = sign ? sign + 1 : "";
    size_t length = sign ? (size_t)(sign - text) : strlen(text);
    while (length > 0 && text[length - 1] == ' ')
        length--;
    return (study_comparison){study_context_format(context, "%.*s", (int)length, text),
                              sign ? *sign : 0, limit + strspn(limit, " ")};
}

bool study_read_share(const char *text, double *share)
{
    const char *end = text;
    bool good = text && ff_number_parse(text, share, &end);
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
