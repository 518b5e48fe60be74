/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions with which drivers read their keys and print lines. */
#include "context.h"

#include <stdarg.h>
#include <stdlib.h>

void study_context_free(study_context *context)
{
    for (size_t k = 0; k < context->list.varied_count; k++) {
        free(context->list.varied[k].assignments);
        free(context->list.varied[k].names);
    }
    for (size_t i = 0; i < context->expanded_count; i++)
        study_definition_free(context->expanded[i]);
    for (size_t i = 0; i < context->file_count; i++)
        free(context->files[i].text);
    study_records_close(context->records);
    json_decref(context->facts);
    free(context->list.varied);
    free(context->expanded);
    free(context->repeats);
    free(context->cases);
    free(context->keys);
    memory_arena_free(&context->arena);
}

char *study_context_format(study_context *context, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, again);
    size_t size = length > 0 ? (size_t)length + 1 : 1;
    char *text = memory_arena_alloc(&context->arena, size);
    vsnprintf(text, size, format, args);
    va_end(again);
    va_end(args);
    return text;
}

bool study_context_refuse(study_context *context, const ff_node *where, const char *hint,
                          const char *text)
{
    return ff_error(context->report, FF_FAULT_INPUT, where ? where->place : FF_NOWHERE, hint,
                    "%s: %s", context->name, text);
}

const study_definition *study_context_expand(study_context *context, const ff_node *map)
{
    study_definition *study = study_expand(map, context->report);
    if (!study)
        return NULL;
    context->expanded =
        memory_resize(context->expanded, (context->expanded_count + 1) * sizeof *context->expanded);
    context->expanded[context->expanded_count++] = study;
    if (study->followed == study->axis_count)
        return study;
    study_context_refuse(context, map, NULL, "its cases are independent; \"follow\" is for sweeps");
    return NULL;
}

const char *study_word(const ff_node *node)
{
    return node && node->kind == FF_SCALAR ? node->text : NULL;
}

bool study_is_map(const ff_node *node)
{
    return node && node->kind == FF_MAP;
}

void study_context_print_line(const study_context *context, int indent, const char *line)
{
    if (context->run->print_line)
        context->run->print_line(context->run->ctx, indent, line);
}

FILE *study_context_file(study_context *context, const char *name)
{
    study_result_file *file = &context->files[context->file_count++];
    file->name = name;
    return memory_require(open_memstream(&file->text, &file->length));
}

bool study_context_write(const study_context *context, const char *directory)
{
    bool good = true;
    for (size_t i = 0; good && i < context->file_count; i++)
        good = study_write_file(directory, context->files[i].name, context->files[i].text,
                                "the journal has all cases; the same command writes the file",
                                context->report);
    return good;
}
