/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "axis.h"
#include "number.h"
#include "result.h"
#include "wrap.h"

#include "../plugin/clean.h"
#include "../value/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 40, VALUE = 30 }; /* widest columns */

/* One result: what it is, its value, and where or what that means. */
typedef struct row {
    char name[160], value[96], text[320];
} row;

typedef struct paper {
    FILE *stream;
    bool colour;
    const char *heading; /* waits until something stands below it */
    row *rows;           /* of a section, until their widths are known */
    size_t count;
} paper;

static const double noise = 1e-9; /* relative; figures show 5 digits at most */

static const char *const units[] = {"rad", "s", NULL}; /* of "where", the better first */

static const char *paint(const paper *page, const char *code)
{
    return page->colour ? code : "";
}

static void print_verdict(const paper *page, int verdict, const char *text)
{
    const char *code = verdict == FF_GOOD       ? "\033[32m"
                       : verdict == FF_DOUBTFUL ? "\033[33m"
                                                : "\033[31m";
    fprintf(page->stream, "%s%s%s", paint(page, code), text, paint(page, "\033[0m"));
}

static void start_line(paper *page)
{
    if (page->heading)
        fprintf(page->stream, "\n%s%s%s\n", paint(page, "\033[1m"), page->heading,
                paint(page, "\033[0m"));
    page->heading = NULL;
}

static int widest(int so_far, const char *text, int limit)
{
    int columns = ff_columns(text);
    return columns > so_far && columns <= limit ? columns : so_far;
}

static void flush_rows(paper *page)
{
    int name = 0, value = 0;
    for (size_t i = 0; i < page->count; i++) {
        name = widest(name, page->rows[i].name, NAME);
        value = widest(value, page->rows[i].value, VALUE);
    }
    for (size_t i = 0; i < page->count; i++) {
        const row *r = &page->rows[i];
        start_line(page);
        int used = fprintf(page->stream, "  %-*s  %-*s  ", name, r->name, value, r->value);
        ff_print_wrapped(page->stream, r->text, used, name + value + 6);
    }
    free(page->rows);
    page->rows = NULL;
    page->count = 0;
}

static row *add_row(paper *page, const ff_result *result)
{
    page->rows = ff_resize(page->rows, (page->count + 1) * sizeof *page->rows);
    row *r = &page->rows[page->count++];
    *r = (row){.value = "(none)"};
    snprintf(r->name, sizeof r->name, "%s", result->row->name);
    snprintf(r->text, sizeof r->text, "%s", result->row->doc ? result->row->doc : "");
    return r;
}

static int worst_verdict(const ff_stage *stage)
{
    int worst = -1;
    for (size_t i = 0; i < stage->quality_count; i++)
        if (stage->quality[i].verdict > worst)
            worst = stage->quality[i].verdict;
    return worst;
}

static void print_stages(paper *page, const ff_pipeline *pipeline)
{
    page->heading = "Stages";
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        if (!stage->ran && stage->status == FF_OK)
            continue;
        start_line(page);
        fprintf(page->stream, "  %-16s  %-32s", stage->name, stage->use);
        ff_readable time = ff_readable_unit("s", stage->seconds);
        if (stage->seconds > 0) /* a law by itself takes no time */
            fprintf(page->stream, "  %6.3g %-2s  ", stage->seconds * time.factor, time.unit);
        int worst = worst_verdict(stage);
        if (stage->status != FF_OK)
            print_verdict(page, stage->status == FF_DOMAIN ? FF_DOUBTFUL : FF_BAD,
                          ff_status_name(stage));
        else if (worst >= 0)
            print_verdict(page, worst, ff_verdict_name(worst));
        fputc('\n', page->stream);
    }
}

static const char *space_before(const char *unit)
{
    return *unit ? " " : "";
}

/* Ranks of the least and the greatest value. */
static void find_extremes(const ff_result *result, size_t *least, size_t *greatest)
{
    *least = *greatest = 0;
    for (size_t i = 1; i < result->count; i++) {
        if (result->data[i] < result->data[*least])
            *least = i;
        if (result->data[i] > result->data[*greatest])
            *greatest = i;
    }
}

/* Writes numbers of one quantity; what is noise beside the greatest of them is 0. */
static void print_range(const ff_result *result, double a, double b, bool constant, char *out,
                        size_t size)
{
    double most = fmax(fabs(a), fabs(b));
    ff_readable unit = ff_readable_unit(result->row->unit, most);
    a = fabs(a) < noise * most ? 0 : a * unit.factor;
    b = fabs(b) < noise * most ? 0 : b * unit.factor;
    if (constant)
        snprintf(out, size, "%.5g%s%s", b, space_before(unit.unit), unit.unit);
    else
        snprintf(out, size, "%.4g to %.4g%s%s", a, b, space_before(unit.unit), unit.unit);
}

/* Where the extremes of a series lie. */
static void print_where(const ff_pipeline *pipeline, const ff_stage *stage, size_t output,
                        size_t least, size_t greatest, char *out, size_t size)
{
    const ff_result *result = &stage->results[output];
    const char *dim = ff_result_dim(stage, output, 0);
    ff_axis axis;
    if (!ff_axis_find(pipeline, stage, dim, result->count, result, units, &axis)) {
        snprintf(out, size, "min at %s %zu, max at %zu of %zu", dim, least + 1, greatest + 1,
                 result->count);
        return;
    }
    double a = axis.data[least], b = axis.data[greatest];
    ff_readable unit = ff_readable_unit(axis.unit, fmax(fabs(a), fabs(b)));
    snprintf(out, size, "min at %.4g, max at %.4g%s%s (%s)", a * unit.factor, b * unit.factor,
             space_before(unit.unit), unit.unit, axis.name);
}

static void print_shape(const ff_stage *stage, size_t output, char *out, size_t size)
{
    const ff_result *result = &stage->results[output];
    size_t at = 0;
    for (uint32_t i = 0; i < result->rank && at < size; i++)
        at += (size_t)snprintf(out + at, size - at, "%s%zu %s", i ? " by " : "", result->shape[i],
                               ff_result_dim(stage, output, i));
}

static void add_result(paper *page, const ff_pipeline *pipeline, const ff_stage *stage,
                       size_t output)
{
    const ff_result *result = &stage->results[output];
    row *r = add_row(page, result);
    size_t least, greatest;
    if (result->count == 0)
        return;
    find_extremes(result, &least, &greatest);
    double a = result->data[least], b = result->data[greatest];
    bool constant = b - a <= noise * fmax(fabs(a), fabs(b));
    bool from_end_to_end = least == 0 && greatest + 1 == result->count;
    print_range(result, a, b, constant, r->value, sizeof r->value);
    if (result->rank == 1 && !constant && !from_end_to_end)
        print_where(pipeline, stage, output, least, greatest, r->text, sizeof r->text);
    else if (result->rank > 1)
        print_shape(stage, output, r->text, sizeof r->text);
}

/* Of each stage the requested results, and the scalars that were computed besides. */
static void print_results(paper *page, const ff_pipeline *pipeline)
{
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[pipeline->order[s]];
        page->heading = stage->name;
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            const ff_result *result = &stage->results[i];
            if (result->data && (result->asked || result->rank == 0))
                add_result(page, pipeline, stage, i);
        }
        flush_rows(page);
    }
}

static void print_quality(paper *page, const ff_pipeline *pipeline)
{
    page->heading = "To be looked at";
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[pipeline->order[s]];
        for (size_t i = 0; i < stage->quality_count; i++) {
            const ff_quality *line = &stage->quality[i];
            if (line->verdict == FF_GOOD)
                continue;
            const char *verdict = ff_verdict_name(line->verdict);
            start_line(page);
            int used = fprintf(page->stream, "  %s.%s = %.3g, held to %.3g: ", stage->name,
                               line->name, line->value, line->limit);
            print_verdict(page, line->verdict, verdict);
            if (line->text && *line->text)
                used += fprintf(page->stream, ", ");
            ff_print_wrapped(page->stream, line->text ? line->text : "",
                             used + (int)strlen(verdict), 4);
        }
    }
}

/* Remarks of the models; their warnings stand in the report. */
static void print_log(paper *page, const json_t *log)
{
    size_t i;
    const json_t *entry;
    page->heading = "Notes";
    json_array_foreach(log, i, entry)
    {
        const char *stage = json_string_value(json_object_get(entry, "stage"));
        const char *level = json_string_value(json_object_get(entry, "level"));
        const char *text = json_string_value(json_object_get(entry, "text"));
        if (!stage || !level || !text || strcmp(level, "info") != 0)
            continue;
        start_line(page);
        ff_print_wrapped(page->stream, text, fprintf(page->stream, "  %s: ", stage), 4);
    }
}

void ff_result_summary(const ff_outcome *outcome, const char *folder, FILE *stream, bool colour)
{
    paper page = {.stream = stream, .colour = colour};
    char title[400];
    ff_clean_text(title, sizeof title,
                  outcome->pipeline->title ? outcome->pipeline->title : outcome->file);
    fprintf(stream, "%s%s%s\n", paint(&page, "\033[1m"), title, paint(&page, "\033[0m"));
    print_stages(&page, outcome->pipeline);
    print_results(&page, outcome->pipeline);
    print_quality(&page, outcome->pipeline);
    print_log(&page, outcome->log);
    if (folder)
        fprintf(stream, "\nresults in %s\n", folder);
}
