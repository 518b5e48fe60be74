/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "export-csv.h"

#include "../study/kinds/answer/number.h"

#include "../memory/file.h"
#include "../memory/memory.h"
#include "../study/cases/csv.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>

typedef struct table {
    const results_view *view;
    results_folder *folder;
    FILE *out;
} table;

static void put_text(FILE *out, const char *text)
{
    study_csv_write(out, text, strlen(text), false);
}

static void put_number(FILE *out, double value)
{
    char text[STUDY_NUMBER_SIZE];
    study_number_exact(value, text);
    fputs(text, out);
}

/* These write the next field of a row. */
static void put_field(FILE *out, const char *text)
{
    fputc(',', out);
    put_text(out, text);
}

static void put_real(FILE *out, double value)
{
    fputc(',', out);
    put_number(out, value);
}

static void put_head(FILE *out, const char *name, const char *unit)
{
    put_field(out, name);
    if (*unit)
        fprintf(out, " [%s]", unit);
}

/* Begins the next file; the folder closes the previous one. */
static bool begin_table(table *t, const char *stem)
{
    t->out = results_folder_begin(t->folder, stem, ".csv");
    return t->out != NULL;
}

static void put_axis_heads(const table *t)
{
    fputs("case", t->out);
    for (size_t a = 0; a < t->view->axis_count; a++)
        put_head(t->out, t->view->axes[a]->path, t->view->axes[a]->unit);
}

static void put_axes(const table *t, size_t index)
{
    fprintf(t->out, "%zu", index + 1);
    for (size_t a = 0; a < t->view->axis_count; a++) {
        const results_view_axis *axis = t->view->axes[a];
        size_t point = results_view_point(t->view, index, axis->dimension);
        if (axis->values)
            put_real(t->out, axis->values[point]);
        else
            put_field(t->out, axis->words[point]);
    }
}

static bool put_scalars(const table *t, size_t index)
{
    const results_view *view = t->view;
    for (size_t v = 0; v < view->variable_count; v++) {
        ff_array array;
        if (view->variables[v]->rank != 0)
            continue;
        if (!results_view_load(view, v, index, &array))
            return false;
        fputc(',', t->out);
        if (array.data)
            put_number(t->out, array.data[0]);
        results_view_release(&array);
    }
    return true;
}

static bool write_scalars(table *t)
{
    const results_view *view = t->view;
    bool good = begin_table(t, "scalars"), limits = false, range = false;
    for (size_t c = 0; c < view->case_count; c++) {
        limits = limits || view->cases[c]->limit_count > 0;
        range = range || *view->cases[c]->range;
    }
    if (!good)
        return false;
    put_axis_heads(t);
    fputs(",status,seconds [s]", t->out);
    for (size_t v = 0; v < view->variable_count; v++)
        if (view->variables[v]->rank == 0)
            put_head(t->out, view->variables[v]->name, view->variables[v]->unit);
    fprintf(t->out, "%s,verdict,reasons%s,reason,command\n", limits ? ",limits" : "",
            range ? ",range" : "");
    for (size_t c = 0; c < view->case_count && good; c++) {
        put_axes(t, c);
        put_field(t->out, view->cases[c]->status);
        put_real(t->out, view->cases[c]->seconds);
        good = put_scalars(t, c);
        if (limits) {
            put_field(t->out, view->cases[c]->limits_text);
        }
        fprintf(t->out, ",%s,", view->cases[c]->verdict);
        put_text(t->out, view->cases[c]->reasons);
        if (range) {
            put_field(t->out, view->cases[c]->range);
        }
        put_field(t->out, view->cases[c]->reason);
        put_field(t->out, view->cases[c]->command);
        fputc('\n', t->out);
    }
    return good;
}

static bool same_dims(const results_view_variable *a, const results_view_variable *b)
{
    bool same = a->stage == b->stage && a->rank == b->rank;
    for (uint32_t i = 0; same && i < a->rank; i++)
        same = !strcmp(a->dims[i], b->dims[i]);
    return same;
}

/* The columns of a table: variables with the same dimensions, and the series against which they are
 * plotted. */
typedef struct columns {
    size_t lead; /* the first variable */
    size_t count;
    size_t *variables;
    uint32_t *dims; /* for a series, the index of the dimension along which it runs; for a variable,
                       the rank */
    ff_array *arrays;
} columns;

static void find_columns(const results_view *view, size_t lead, columns *found)
{
    const results_view_variable *first = view->variables[lead];
    *found = (columns){.lead = lead,
                       .variables = memory_alloc(view->variable_count * sizeof *found->variables),
                       .dims = memory_alloc(view->variable_count * sizeof *found->dims),
                       .arrays = memory_alloc(view->variable_count * sizeof *found->arrays)};
    for (uint32_t d = 0; d < first->rank; d++)
        for (size_t v = 0; v < view->variable_count; v++)
            if (results_view_is_coordinate(view->variables[v], first, d) &&
                !same_dims(view->variables[v], first)) {
                found->dims[found->count] = d;
                found->variables[found->count++] = v;
            }
    for (size_t v = lead; v < view->variable_count; v++)
        if (same_dims(view->variables[v], first)) {
            found->dims[found->count] = first->rank;
            found->variables[found->count++] = v;
        }
}

static void free_columns(columns *c)
{
    free(c->variables);
    free(c->dims);
    free(c->arrays);
}

static void put_points(const table *t, const columns *c, size_t index, const size_t shape[4])
{
    uint32_t rank = t->view->variables[c->lead]->rank;
    size_t at[4] = {0}, total = 1;
    for (uint32_t d = 0; d < rank; d++)
        total *= shape[d];
    for (size_t flat = 0; flat < total; flat++) {
        size_t rest = flat;
        for (uint32_t d = rank; d-- > 0; rest /= shape[d])
            at[d] = rest % shape[d];
        put_axes(t, index);
        for (uint32_t d = 0; d < rank; d++)
            fprintf(t->out, ",%zu", at[d]);
        for (size_t k = 0; k < c->count; k++) {
            fputc(',', t->out);
            if (c->arrays[k].data)
                put_number(t->out, c->arrays[k].data[c->dims[k] < rank ? at[c->dims[k]] : flat]);
        }
        fputc('\n', t->out);
    }
}

/* Loads an array; leaves it out if its lengths differ from the lengths of the table. */
static bool load_column(const table *t, columns *c, size_t k, size_t index, const size_t shape[4])
{
    const results_view *view = t->view;
    uint32_t rank = view->variables[c->lead]->rank, from = c->dims[k] < rank ? c->dims[k] : 0;
    size_t own[4];
    bool fits = results_view_full_shape(view, c->variables[k], index, own);
    for (uint32_t d = 0; fits && d < view->variables[c->variables[k]]->rank; d++)
        fits = own[d] == shape[from + d];
    return !fits || results_view_load(view, c->variables[k], index, &c->arrays[k]);
}

static bool put_case(const table *t, columns *c, size_t index)
{
    const results_view *view = t->view;
    size_t shape[4] = {0};
    bool any = false, good = true;
    for (size_t k = 0; k < c->count; k++)
        if (c->dims[k] == view->variables[c->lead]->rank)
            any = any || results_view_full_shape(view, c->variables[k], index, shape);
    for (size_t k = 0; any && k < c->count && good; k++)
        good = load_column(t, c, k, index, shape);
    if (any && good)
        put_points(t, c, index, shape);
    for (size_t k = 0; any && k < c->count; k++)
        results_view_release(&c->arrays[k]);
    return good;
}

/* Writes all variables of a stage along the dimensions of `lead`. */
static bool write_family(table *t, size_t lead)
{
    const results_view *view = t->view;
    const results_view_variable *first = view->variables[lead];
    const char *stage = view->stages[first->stage]->name;
    char name[200];
    int length = snprintf(name, sizeof name, "%s", stage);
    for (uint32_t d = 0; d < first->rank && length < (int)sizeof name; d++)
        length += snprintf(name + length, sizeof name - (size_t)length, "-%s", first->dims[d]);
    bool good = begin_table(t, name);
    if (!good)
        return false;
    columns c;
    find_columns(view, lead, &c);
    put_axis_heads(t);
    for (uint32_t d = 0; d < first->rank; d++)
        fprintf(t->out, ",%s.%s [index]", stage, first->dims[d]);
    for (size_t k = 0; k < c.count; k++)
        put_head(t->out, view->variables[c.variables[k]]->name,
                 view->variables[c.variables[k]]->unit);
    fputc('\n', t->out);
    for (size_t i = 0; i < view->case_count && good; i++)
        good = put_case(t, &c, i);
    free_columns(&c);
    return good;
}

static bool write_quality(table *t)
{
    const results_view *view = t->view;
    if (!begin_table(t, "quality"))
        return false;
    put_axis_heads(t);
    fputs(",stage,name,value,limit,verdict,text\n", t->out);
    for (size_t c = 0; c < view->case_count; c++)
        for (size_t i = 0; i < view->cases[c]->quality_count; i++) {
            const results_view_quality *line = view->cases[c]->quality[i];
            put_axes(t, c);
            fprintf(t->out, ",%s,", view->stages[line->stage]->name);
            put_text(t->out, line->name);
            put_real(t->out, line->value);
            put_real(t->out, line->limit);
            fprintf(t->out, ",%s,", ff_verdict_name(line->verdict));
            put_text(t->out, line->text);
            fputc('\n', t->out);
        }
    return true;
}

static void put_row(FILE *out, const char *a, const char *b, const char *c, const char *d)
{
    put_text(out, a);
    put_field(out, b);
    put_field(out, c);
    put_field(out, d);
    fputc('\n', out);
}

static bool write_origin(table *t)
{
    const results_view *view = t->view;
    if (!begin_table(t, "origin"))
        return false;
    put_row(t->out, "what", "name", "value", "origin");
    put_row(t->out, "title", "", view->title, "");
    for (size_t i = 0; i < view->fact_count; i++)
        put_row(t->out, "fact", view->facts[i]->name, view->facts[i]->text, "");
    for (size_t i = 0; i < view->stage_count; i++) {
        const results_view_stage *stage = view->stages[i];
        char version[200], path[300];
        snprintf(version, sizeof version, "%s, file %s", stage->version, stage->build);
        put_row(t->out, "model", stage->name, stage->model, version);
        for (size_t k = 0; k < stage->param_count; k++) {
            snprintf(path, sizeof path, "%s.%s", stage->name, stage->params[k]->name);
            put_row(t->out, "parameter", path, stage->params[k]->text, stage->params[k]->origin);
        }
    }
    for (size_t i = 0; i < view->citation_count; i++)
        put_row(t->out, "literature", view->citations[i]->model, view->citations[i]->reference, "");
    return true;
}

/* Copies the table that a study wrote in addition to its figures, if there is one. */
static bool copy_table(table *t, const char *directory, const char *figures)
{
    char *stem = memory_print_text("%.*s", (int)strcspn(figures, "."), figures), block[4096];
    char *path = memory_print_text("%s/%s.csv", directory, stem);
    FILE *from = file_stream(AT_FDCWD, path);
    bool good = !from || begin_table(t, stem);
    for (size_t length; good && from && (length = fread(block, 1, sizeof block, from)) > 0;)
        fwrite(block, 1, length, t->out);
    if (from)
        fclose(from);
    free(path);
    free(stem);
    return good;
}

bool results_export_csv(const results_view *view, const char *directory, results_folder *folder)
{
    table t = {.view = view, .folder = folder};
    bool good = write_scalars(&t);
    for (size_t v = 0; v < view->variable_count && good; v++) {
        bool first = view->variables[v]->rank > 0;
        for (size_t earlier = 0; first && earlier < v; earlier++)
            first = !same_dims(view->variables[earlier], view->variables[v]);
        if (first)
            good = write_family(&t, v);
    }
    for (size_t i = 0; i < view->figures_count && good; i++)
        good = copy_table(&t, directory, view->figures[i]->name);
    return good && write_quality(&t) && write_origin(&t);
}
