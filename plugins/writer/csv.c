/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Tidy CSV: every row begins with its case and what the study varies, every column has its unit in
 * its head. scalars.csv has a row for each case; <stage>-<dimensions>.csv all outputs of a stage
 * along the same dimensions, a row for each point of each case.
 */
#include "pick.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct table {
    const ff_view *view;
    const ff_target *target;
    const ff_host *host;
    FILE *out;
    const char *name;
} table;

static void put_text(FILE *out, const char *text)
{
    bool plain = !text[strcspn(text, ",\"\n\r")];
    if (!plain)
        fputc('"', out);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text, out);
    }
    if (!plain)
        fputc('"', out);
}

static void put_number(FILE *out, double value)
{
    char text[WRITER_EXACT_SIZE];
    writer_print_exact(value, text);
    fputs(text, out);
}

static void put_head(FILE *out, const char *name, const char *unit)
{
    fputc(',', out);
    put_text(out, name);
    if (*unit)
        fprintf(out, " [%s]", unit);
}

static bool begin(table *t, const char *name)
{
    const char *path = t->target->path(t->target->ctx, name);
    t->name = name;
    t->out = path ? fopen(path, "we") : NULL;
    if (path && !t->out)
        ff_failf(t->host, FF_NOCONV, NULL, "%s could not be written: %s", name, strerror(errno));
    return t->out != NULL;
}

static ff_status end(table *t, ff_status status)
{
    if (!t->out)
        return FF_NOCONV;
    errno = 0;
    bool lost = ferror(t->out) != 0;
    lost = fclose(t->out) != 0 || lost;
    t->out = NULL;
    if (!lost || status != FF_OK)
        return status;
    return ff_failf(t->host, FF_NOCONV, NULL, "%s could not be written: %s", t->name,
                    strerror(errno ? errno : EIO));
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
        const ff_view_axis *axis = t->view->axes[a];
        size_t point = writer_point_of(t->view, index, axis->dimension);
        fputc(',', t->out);
        if (axis->values)
            put_number(t->out, axis->values[point]);
        else
            put_text(t->out, axis->words[point]);
    }
}

static ff_status put_scalars(const table *t, size_t index)
{
    const ff_view *view = t->view;
    for (size_t v = 0; v < view->variable_count; v++) {
        ff_array array;
        if (view->variables[v]->rank != 0)
            continue;
        ff_status status = view->load(view->ctx, v, index, &array);
        if (status != FF_OK)
            return status;
        fputc(',', t->out);
        if (array.data)
            put_number(t->out, array.data[0]);
        view->release(view->ctx, &array);
    }
    return FF_OK;
}

static ff_status write_scalars(table *t)
{
    const ff_view *view = t->view;
    ff_status status = FF_OK;
    if (!begin(t, "scalars.csv"))
        return FF_NOCONV;
    put_axis_heads(t);
    fputs(",status,seconds [s]", t->out);
    for (size_t v = 0; v < view->variable_count; v++)
        if (view->variables[v]->rank == 0)
            put_head(t->out, view->variables[v]->name, view->variables[v]->unit);
    fputs(",reason,command\n", t->out);
    for (size_t c = 0; c < view->case_count && status == FF_OK; c++) {
        put_axes(t, c);
        fputc(',', t->out);
        put_text(t->out, view->cases[c]->status);
        fputc(',', t->out);
        put_number(t->out, view->cases[c]->seconds);
        status = put_scalars(t, c);
        fputc(',', t->out);
        put_text(t->out, view->cases[c]->reason);
        fputc(',', t->out);
        put_text(t->out, view->cases[c]->command);
        fputc('\n', t->out);
    }
    return end(t, status);
}

/* The columns of a table: variables along the same dimensions, and the series that these are
   plotted against. */
typedef struct columns {
    size_t lead; /* the first variable */
    size_t count;
    size_t *variables;
    uint32_t *dims; /* of a series: which of the dimensions it runs along; else the rank */
    ff_array *arrays;
} columns;

static bool find_columns(const ff_view *view, size_t lead, columns *found)
{
    const ff_view_variable *first = view->variables[lead];
    *found = (columns){.lead = lead,
                       .variables = calloc(view->variable_count, sizeof *found->variables),
                       .dims = calloc(view->variable_count, sizeof *found->dims),
                       .arrays = calloc(view->variable_count, sizeof *found->arrays)};
    if (!found->variables || !found->dims || !found->arrays)
        return false;
    for (uint32_t d = 0; d < first->rank; d++)
        for (size_t v = 0; v < view->variable_count; v++)
            if (writer_is_coordinate(view->variables[v], first, d) &&
                !writer_same_dims(view->variables[v], first)) {
                found->dims[found->count] = d;
                found->variables[found->count++] = v;
            }
    for (size_t v = lead; v < view->variable_count; v++)
        if (writer_same_dims(view->variables[v], first)) {
            found->dims[found->count] = first->rank;
            found->variables[found->count++] = v;
        }
    return true;
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

/* An array of other lengths than the table has is left out. */
static ff_status load_column(const table *t, columns *c, size_t k, size_t index,
                             const size_t shape[4])
{
    const ff_view *view = t->view;
    uint32_t rank = view->variables[c->lead]->rank, from = c->dims[k] < rank ? c->dims[k] : 0;
    size_t own[4];
    bool fits = writer_full_shape(view, c->variables[k], index, own);
    for (uint32_t d = 0; fits && d < view->variables[c->variables[k]]->rank; d++)
        fits = own[d] == shape[from + d];
    return fits ? view->load(view->ctx, c->variables[k], index, &c->arrays[k]) : FF_OK;
}

static ff_status put_case(const table *t, columns *c, size_t index)
{
    const ff_view *view = t->view;
    size_t shape[4] = {0};
    bool any = false;
    ff_status status = FF_OK;
    for (size_t k = 0; k < c->count; k++)
        if (c->dims[k] == view->variables[c->lead]->rank)
            any = any || writer_full_shape(view, c->variables[k], index, shape);
    for (size_t k = 0; any && k < c->count && status == FF_OK; k++)
        status = load_column(t, c, k, index, shape);
    if (any && status == FF_OK)
        put_points(t, c, index, shape);
    for (size_t k = 0; any && k < c->count; k++)
        view->release(view->ctx, &c->arrays[k]);
    return status;
}

/* All variables of a stage along the dimensions of `lead`. */
static ff_status write_family(table *t, size_t lead)
{
    const ff_view *view = t->view;
    const ff_view_variable *first = view->variables[lead];
    const char *stage = view->stages[first->stage]->name;
    char name[200];
    int length = snprintf(name, sizeof name, "%s", stage);
    for (uint32_t d = 0; d < first->rank && length < (int)sizeof name; d++)
        length += snprintf(name + length, sizeof name - (size_t)length, "-%s", first->dims[d]);
    if (length + 5 > (int)sizeof name)
        return ff_failf(t->host, FF_UNSUPPORTED, NULL, "the name of the stage %s is too long",
                        stage);
    strcpy(name + length, ".csv");
    columns c;
    ff_status status = find_columns(view, lead, &c) ? FF_OK : FF_NOMEM;
    if (status == FF_OK && begin(t, name)) {
        put_axis_heads(t);
        for (uint32_t d = 0; d < first->rank; d++) {
            fprintf(t->out, ",%s.%s", stage, first->dims[d]);
            fputs(" [index]", t->out);
        }
        for (size_t k = 0; k < c.count; k++)
            put_head(t->out, view->variables[c.variables[k]]->name,
                     view->variables[c.variables[k]]->unit);
        fputc('\n', t->out);
        for (size_t i = 0; i < view->case_count && status == FF_OK; i++)
            status = put_case(t, &c, i);
        status = end(t, status);
    } else if (status == FF_OK) {
        status = FF_NOCONV;
    }
    free_columns(&c);
    return status;
}

static ff_status write_quality(table *t)
{
    const ff_view *view = t->view;
    if (!begin(t, "quality.csv"))
        return FF_NOCONV;
    put_axis_heads(t);
    fputs(",stage,name,value,limit,verdict,text\n", t->out);
    for (size_t c = 0; c < view->case_count; c++)
        for (size_t i = 0; i < view->cases[c]->quality_count; i++) {
            const ff_view_quality *line = view->cases[c]->quality[i];
            put_axes(t, c);
            fprintf(t->out, ",%s,", view->stages[line->stage]->name);
            put_text(t->out, line->name);
            fputc(',', t->out);
            put_number(t->out, line->value);
            fputc(',', t->out);
            put_number(t->out, line->limit);
            fprintf(t->out, ",%s,", writer_verdict_word(line->verdict));
            put_text(t->out, line->text);
            fputc('\n', t->out);
        }
    return end(t, FF_OK);
}

static void put_row(FILE *out, const char *a, const char *b, const char *c, const char *d)
{
    const char *const cells[] = {a, b, c, d};
    for (size_t i = 0; i < 4; i++) {
        if (i)
            fputc(',', out);
        put_text(out, cells[i]);
    }
    fputc('\n', out);
}

static ff_status write_origin(table *t)
{
    const ff_view *view = t->view;
    if (!begin(t, "origin.csv"))
        return FF_NOCONV;
    put_row(t->out, "what", "name", "value", "origin");
    put_row(t->out, "title", "", view->title, "");
    for (size_t i = 0; i < view->fact_count; i++)
        put_row(t->out, "fact", view->facts[i]->name, view->facts[i]->text, "");
    for (size_t i = 0; i < view->stage_count; i++) {
        const ff_view_stage *stage = view->stages[i];
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
    return end(t, FF_OK);
}

static ff_status write_all(void *self, const ff_view *view, const ff_target *target)
{
    const writer_self *writer = self;
    table t = {.view = view, .target = target, .host = writer->host};
    ff_status status = write_scalars(&t);
    for (size_t v = 0; v < view->variable_count && status == FF_OK; v++) {
        bool first = view->variables[v]->rank > 0;
        for (size_t earlier = 0; first && earlier < v; earlier++)
            first = !writer_same_dims(view->variables[earlier], view->variables[v]);
        if (first)
            status = write_family(&t, v);
        if (writer->host->progress(writer->host->ctx, (double)v / (double)view->variable_count))
            return FF_STOPPED;
    }
    if (status == FF_OK)
        status = write_quality(&t);
    return status == FF_OK ? write_origin(&t) : status;
}

static ff_status create(const ff_host *host, void **self)
{
    return writer_create(host, &(ff_writer){.suffix = "", .write = write_all}, self);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "writer/csv",
    .version = "1.0.0",
    .summary = "results as tables of comma-separated values, units in their heads",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_NO_TABLE,
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(writer_outputs),
    .create = create,
    .service = writer_service,
    .destroy = writer_destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
