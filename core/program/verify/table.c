/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes a file for a model that reads a table, with the columns that the model declares. */
#include "private.h"

#include "../memory/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

enum { USUAL_ROWS = 6, MOST_ROWS = 1000 };

static size_t count_rows(const ff_model *model)
{
    size_t rows = USUAL_ROWS;
    for (size_t k = 0; k < ff_model_columns(model); k++) {
        const ff_param *column = ff_model_column(model, k);
        rows = column->min_count > rows ? column->min_count : rows;
        rows = column->max_count && column->max_count < rows ? column->max_count : rows;
    }
    return rows < MOST_ROWS ? rows : MOST_ROWS;
}

static void draw_column(const ff_param *column, size_t rows, verify_random *random, double *numbers)
{
    for (size_t i = 0; i < rows; i++)
        numbers[i] = verify_draw_number(column, random, VERIFY_CALIBRATED);
    if (column->flags & FF_INCREASING)
        memory_sort(numbers, rows, sizeof *numbers);
}

/* Writes the required columns, and a random choice of the others. */
static void write_table(FILE *file, const ff_model *model, verify_random *random)
{
    size_t columns = 0, rows = count_rows(model);
    double *numbers = memory_alloc(ff_model_columns(model) * rows * sizeof *numbers);
    for (size_t k = 0; k < ff_model_columns(model); k++) {
        const ff_param *column = ff_model_column(model, k);
        if (!(column->flags & FF_REQUIRED) && verify_below(random, 2))
            continue;
        draw_column(column, rows, random, &numbers[columns * rows]);
        fprintf(file, "%s%s [%s]", columns++ ? ", " : "", column->name, column->unit);
    }
    fputc('\n', file);
    for (size_t i = 0; i < rows; i++)
        for (size_t k = 0; k < columns; k++)
            fprintf(file, "%.17g%s", numbers[k * rows + i], k + 1 < columns ? ", " : "\n");
    free(numbers);
}

const char *verify_make_table(verify_context *context)
{
    const ff_model *model = context->model;
    if (!context->table && ff_model_columns(model)) {
        int memory = memfd_create("table.csv", MFD_CLOEXEC);
        context->table = memory < 0 ? NULL : fdopen(memory, "w");
    }
    if (!context->table || ftruncate(fileno(context->table), 0) != 0)
        return NULL;
    rewind(context->table);
    write_table(context->table, model, &context->random);
    fflush(context->table);
    return memory_print_text("/proc/self/fd/%d", fileno(context->table));
}
