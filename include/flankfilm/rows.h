/* SPDX-License-Identifier: MIT */
/* Access to the tables of a model, for programs and for plugins that examine other models; header
   only. */
#ifndef FLANKFILM_ROWS_H
#define FLANKFILM_ROWS_H

#include "author.h"

#include <string.h>

/* The row with this index, addressed by the stride in the descriptor; the index must be in
   range. */
FF_UNUSED static const ff_param *ff_model_param(const ff_model *model, size_t index)
{
    const void *row = (const char *)model->params + index * model->param_stride;
    return (const ff_param *)row;
}

/* The columns of the tables that the model reads. */
FF_UNUSED static size_t ff_model_columns(const ff_model *model)
{
    return FF_HAS(model, column_stride) ? model->column_count : 0;
}

FF_UNUSED static const ff_param *ff_model_column(const ff_model *model, size_t index)
{
    const void *row = (const char *)model->columns + index * model->column_stride;
    return (const ff_param *)row;
}

FF_UNUSED static const ff_port *ff_model_input(const ff_model *model, size_t index)
{
    const void *row = (const char *)model->inputs + index * model->input_stride;
    return (const ff_port *)row;
}

FF_UNUSED static const ff_port *ff_model_output(const ff_model *model, size_t index)
{
    const void *row = (const char *)model->outputs + index * model->output_stride;
    return (const ff_port *)row;
}

/* Index of the row with this name, or -1. */
FF_UNUSED static int ff_model_find_param(const ff_model *model, const char *name)
{
    for (size_t i = 0; i < model->param_count; i++)
        if (!strcmp(ff_model_param(model, i)->name, name))
            return (int)i;
    return -1;
}

FF_UNUSED static int ff_model_find_input(const ff_model *model, const char *name)
{
    for (size_t i = 0; i < model->input_count; i++)
        if (!strcmp(ff_model_input(model, i)->name, name))
            return (int)i;
    return -1;
}

FF_UNUSED static int ff_model_find_output(const ff_model *model, const char *name)
{
    for (size_t i = 0; i < model->output_count; i++)
        if (!strcmp(ff_model_output(model, i)->name, name))
            return (int)i;
    return -1;
}

/* Index of the output that offers the service with this interface id, or -1. */
FF_UNUSED static int ff_model_find_service(const ff_model *model, const char *interface)
{
    for (size_t i = 0; i < model->output_count; i++) {
        const char *service = ff_model_output(model, i)->service;
        if (service && !strcmp(service, interface))
            return (int)i;
    }
    return -1;
}

/* The cost that the model declares, in s; 0: none. */
FF_UNUSED static double ff_model_cost(const ff_model *model)
{
    return FF_HAS(model, cost) && model->cost > 0 ? model->cost : 0;
}

/* Copies word number `rank` of "a|b|c" into `out`. Returns 0 if there is no such word. */
FF_UNUSED static int ff_word_at(const char *words, size_t rank, char *out, size_t size)
{
    for (; words && rank > 0; rank--) {
        words = strchr(words, '|');
        words = words ? words + 1 : NULL;
    }
    if (words)
        snprintf(out, size, "%.*s", (int)strcspn(words, "|"), words);
    return words != NULL;
}

#endif
