/* SPDX-License-Identifier: MIT */
#include "rows.h"

#include "../value/memory.h"

#include <string.h>

static const void *lengthen_rows(const void *rows, size_t count, size_t *stride, size_t size)
{
    if (*stride >= size || count == 0)
        return rows;
    char *longer = fe_alloc(count * size);
    for (size_t i = 0; i < count; i++)
        memcpy(longer + i * size, (const char *)rows + i * *stride, *stride);
    *stride = size;
    return longer;
}

const ff_model *fe_model_complete(const ff_model *model)
{
    const size_t param = sizeof(ff_param), port = sizeof(ff_port);
    ff_model *whole = fe_alloc(sizeof *whole);
    memcpy(whole, model, model->size < sizeof *whole ? model->size : sizeof *whole);
    whole->size = sizeof *whole;
    if (!FF_HAS(model, column_stride))
        whole->column_count = 0;
    whole->params = lengthen_rows(whole->params, whole->param_count, &whole->param_stride, param);
    whole->columns =
        lengthen_rows(whole->columns, whole->column_count, &whole->column_stride, param);
    whole->inputs = lengthen_rows(whole->inputs, whole->input_count, &whole->input_stride, port);
    whole->outputs =
        lengthen_rows(whole->outputs, whole->output_count, &whole->output_stride, port);
    return whole;
}

bool fe_is_on_wire(const char *input, const char *wire)
{
    size_t length = strlen(wire);
    return !strncmp(input, wire, length) && (!input[length] || input[length] == '.');
}
