/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "subject.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const void *row_at(const void *rows, size_t stride, size_t index)
{
    return (const char *)rows + stride * index;
}

const ff_param *ff_param_row(const ff_model *model, size_t index)
{
    return row_at(model->params, model->param_stride, index);
}

const ff_port *ff_input_row(const ff_model *model, size_t index)
{
    return row_at(model->inputs, model->input_stride, index);
}

const ff_port *ff_output_row(const ff_model *model, size_t index)
{
    return row_at(model->outputs, model->output_stride, index);
}

int ff_find_param(const ff_model *model, const char *name)
{
    for (size_t i = 0; i < model->param_count; i++)
        if (!strcmp(ff_param_row(model, i)->name, name))
            return (int)i;
    return -1;
}

int ff_find_input(const ff_model *model, const char *name)
{
    for (size_t i = 0; i < model->input_count; i++)
        if (!strcmp(ff_input_row(model, i)->name, name))
            return (int)i;
    return -1;
}

int ff_find_output(const ff_model *model, const char *name)
{
    for (size_t i = 0; i < model->output_count; i++)
        if (!strcmp(ff_output_row(model, i)->name, name))
            return (int)i;
    return -1;
}

bool ff_word_at(const char *words, size_t rank, char *out, size_t size)
{
    for (; words && rank > 0; rank--) {
        const char *bar = strchr(words, '|');
        words = bar ? bar + 1 : NULL;
    }
    if (words)
        snprintf(out, size, "%.*s", (int)strcspn(words, "|"), words);
    return words;
}

/* The loader has seen to it that the list can be read. */
ff_dims ff_dims_of(const ff_port *row)
{
    ff_dims dims = {.rank = 0};
    for (const char *at = row->service ? "" : row->dims; *at; at += strspn(at, " ?")) {
        size_t length = strcspn(at, " ?");
        memcpy(dims.name[dims.rank++], at, length);
        at += length;
        dims.first_optional = dims.first_optional || *at == '?';
    }
    return dims;
}

void *ff_alloc(size_t size)
{
    void *memory = calloc(1, size ? size : 1);
    if (!memory)
        abort();
    return memory;
}

enum { ZONE = 32 };

static const double canary = -7.6543210987e-123;

ff_guarded ff_guarded_new(size_t count)
{
    double *memory = ff_alloc((count + 2 * ZONE) * sizeof *memory);
    for (size_t i = 0; i < count + 2 * ZONE; i++)
        memory[i] = i >= ZONE && i < ZONE + count ? (double)NAN : canary;
    return (ff_guarded){.data = memory + ZONE, .count = count};
}

bool ff_guarded_whole(const ff_guarded *guarded)
{
    bool whole = true;
    for (size_t i = 0; i < ZONE; i++)
        whole = whole && !memcmp(&guarded->data[guarded->count + i], &canary, sizeof canary) &&
                !memcmp(guarded->data - 1 - i, &canary, sizeof canary);
    return whole;
}

void ff_guarded_free(ff_guarded *guarded)
{
    if (guarded->data)
        free(guarded->data - ZONE);
    *guarded = (ff_guarded){.data = NULL};
}
