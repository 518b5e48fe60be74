/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the numbers for the template's figures into the page as one JSON object: scalars over the
 * cases, the series of a few cases, and fields at some instants. Numbers are in SI, as
 * little-endian 32-bit floats in base64. Each output has its name in words and a readable unit. The
 * template decides what to draw and how. */
#include "page.h"

#include "../memory/memory.h"
#include "../results/json.h"
#include "../study/store/journal.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_SCALARS = 300000, /* in all scalars and axes of a study */
    MOST_NAMED = 200,      /* points of an axis with names */
    MOST_SERIES = 4,       /* cases whose series are in the page */
    FRAMES = 121,          /* numbers of a field */
    CELLS = 513,
    MOST_FIELDS = 12
};

/* Describes the kept points of a study's axis: their numbers (NaN for words) and, if they are few,
 * their names. */
static json_t *describe_axis(const results_view *view, const results_view_axis *axis, size_t step)
{
    const size_t count = (view->lengths[axis->dimension] + step - 1) / step;
    double *values = memory_alloc((count + 1) * sizeof *values), most = 0;
    char word[REPORT_TEXT_SIZE], name[REPORT_TEXT_SIZE];
    json_t *named = json_array();
    for (size_t i = 0; i < count; i++) {
        values[i] = report_axis_number(axis, i * step);
        most = fmax(most, fabs(values[i]));
        if (count <= MOST_NAMED)
            json_array_append_new(named,
                                  results_json_text(report_name_value(
                                      view, axis, report_axis_word(axis, i * step, word), name)));
    }
    json_t *entry = axis->values ? report_describe_unit(axis->path, axis->unit, most)
                                 : json_pack("{s:o, s:f, s:f}", "unit",
                                             results_json_text(report_axis_unit(axis)), "factor",
                                             1.0, "offset", 0.0);
    json_object_set_new(entry, "label", results_json_text(report_plain_name(axis->path, word)));
    json_object_set_new(entry, "si", results_json_text(axis->unit));
    json_object_set_new(entry, "dimension", json_integer((json_int_t)axis->dimension));
    json_object_set_new(entry, "typed", json_boolean(axis->values != NULL));
    json_object_set_new(entry, "named", named);
    json_object_set_new(entry, "values", report_pack(values, NULL, count));
    free(values);
    return entry;
}

/* Drops points of the longest dimensions until at most that many cases are left. */
static size_t choose_steps(const results_view *view, size_t most, size_t *steps)
{
    for (size_t d = 0; d < view->dimension_count; d++)
        steps[d] = 1;
    for (;;) {
        size_t kept = 1, longest = 0, points = 0;
        for (size_t d = 0; d < view->dimension_count; d++) {
            const size_t own = (view->lengths[d] + steps[d] - 1) / steps[d];
            kept *= own;
            longest = own > points ? d : longest;
            points = own > points ? own : points;
        }
        if (kept <= most || points < 2)
            return kept;
        steps[longest]++;
    }
}

/* Returns the list of the kept cases, to be freed. */
static size_t *list_cases(const results_view *view, const size_t *steps, size_t count)
{
    size_t *cases = memory_alloc((count + 1) * sizeof *cases);
    for (size_t k = 0; k < count; k++) {
        size_t rest = k, stride = 1;
        for (size_t d = view->dimension_count; d-- > 0; stride *= view->lengths[d]) {
            const size_t points = (view->lengths[d] + steps[d] - 1) / steps[d];
            cases[k] += rest % points * steps[d] * stride;
            rest /= points;
        }
    }
    return cases;
}

static void add_scalar(report_data *d, json_t *scalars, size_t variable, const size_t *cases,
                       size_t count)
{
    const results_view *view = d->page->view;
    report_scalar f = report_load_scalar(d->page, variable);
    const char *asked = report_limit_asked(view, variable);
    if (f.low <= f.high) {
        json_t *entry = report_describe(d, variable, fmax(fabs(f.low), fabs(f.high)));
        json_object_set_new(entry, "sense", json_integer(report_sense_of(d->page, variable)));
        if (asked)
            json_object_set_new(entry, "limit",
                                json_pack("{s:o, s:o}", "at",
                                          study_json_real(report_limit_bound(view, variable)),
                                          "name", results_json_text(asked)));
        json_object_set_new(scalars, view->variables[variable]->name,
                            report_pack(f.values, cases, count));
    }
    free(f.values);
}

/* Adds the scalars: one number each for a run, one for each kept case for a study. */
static void add_scalars(report_data *d, json_t *all)
{
    const results_view *view = d->page->view;
    size_t scalars = 0, *steps = memory_alloc((view->dimension_count + 1) * sizeof *steps);
    for (size_t v = 0; v < view->variable_count; v++)
        scalars += view->variables[v]->rank == 0;
    const size_t room = MOST_SCALARS / (scalars + view->axis_count + 1),
                 count = choose_steps(view,
                                      room > 40000  ? 40000
                                      : room > 3000 ? room
                                                    : 3000,
                                      steps);
    size_t *cases = list_cases(view, steps, count);
    json_t *values = json_object(), *lengths = json_array(), *kept_steps = json_array(),
           *axes = json_array();
    char *standing = memory_alloc(count + 1);
    d->page->thinned = d->page->thinned || count < view->case_count;
    for (size_t v = 0; v < view->variable_count; v++)
        if (view->variables[v]->rank == 0 && !report_is_bar(view->variables[v]))
            add_scalar(d, values, v, cases, count);
    for (size_t k = 0; k < count; k++)
        standing[k] = (char)('0' + report_standing(view, cases[k]));
    for (size_t i = 0; i < view->dimension_count; i++) {
        json_array_append_new(
            lengths, json_integer((json_int_t)((view->lengths[i] + steps[i] - 1) / steps[i])));
        json_array_append_new(kept_steps, json_integer((json_int_t)steps[i]));
    }
    for (size_t a = 0; a < view->axis_count; a++)
        json_array_append_new(axes,
                              describe_axis(view, view->axes[a], steps[view->axes[a]->dimension]));
    json_object_set_new(all, "axes", axes);
    json_object_set_new(all, "lengths", lengths);
    json_object_set_new(all, "steps", kept_steps);
    json_object_set_new(all, "scalars", values);
    json_object_set_new(all, "standing", json_string(standing));
    free(standing);
    free(cases);
    free(steps);
}

/* Returns whether a case has kept a series; a repeat in a trade-off has none. */
static bool has_series(const results_view *view, size_t index)
{
    size_t shape[4];
    for (size_t v = 0; v < view->variable_count; v++)
        if (view->variables[v]->rank == 1 && results_view_full_shape(view, v, index, shape))
            return true;
    return false;
}

/* Returns whether a case succeeded, has series, and differs from the first one only along the
 * longest dimension (with `all`: along any). */
static bool is_choice(const results_view *view, size_t index, bool all)
{
    size_t longest = 0;
    if (strcmp(view->cases[index]->status, "ok") != 0 || !has_series(view, index))
        return false;
    for (size_t d = 1; d < view->dimension_count; d++)
        longest = view->lengths[d] > view->lengths[longest] ? d : longest;
    for (size_t d = 0; d < view->dimension_count && !all; d++)
        if (d != longest && results_view_point(view, index, d) > 0)
            return false;
    return true;
}

/* Chooses the case of a run. For a study, chooses a few cases, spread evenly over the successful
 * ones, all from one chain if it has enough. `good` is the number of candidates. */
static size_t choose_cases(const results_view *view, size_t chosen[MOST_SERIES], size_t *good)
{
    size_t seen = 0, line = 0, count = 0;
    *good = 0;
    for (size_t c = 0; c < view->case_count; c++) {
        *good += is_choice(view, c, true);
        line += is_choice(view, c, false);
    }
    const bool all = line < MOST_SERIES;
    const size_t from = all ? *good : line, wanted = from < MOST_SERIES ? from : MOST_SERIES;
    for (size_t c = 0; c < view->case_count && count < wanted; c++) {
        if (!is_choice(view, c, all))
            continue;
        if (wanted == 1 || seen * (wanted - 1) >= count * (from - 1))
            chosen[count++] = c;
        seen++;
    }
    if (!view->study && count == 0) /* a failed run may have kept some series */
        chosen[count++] = 0;
    return count;
}

/* Adds the series of the chosen cases, and the points of their paths of contact. */
static void add_all_series(report_data *d, json_t *all)
{
    const results_view *view = d->page->view;
    size_t chosen[MOST_SERIES], good;
    const size_t count = choose_cases(view, chosen, &good);
    json_t *cases = json_array(), *series = json_array();
    for (size_t k = 0; k < count; k++) {
        char name[REPORT_TEXT_SIZE];
        report_name_case(view, chosen[k], name);
        json_array_append_new(cases, report_data_case(d->page, chosen[k], name));
        for (size_t v = 0; v < view->variable_count; v++)
            if (view->variables[v]->rank == 1 && !report_is_bar(view->variables[v]))
                report_data_series(d, series, v, chosen[k], k);
    }
    json_object_set_new(all, "cases", cases);
    json_object_set_new(all, "well", json_integer((json_int_t)good));
    json_object_set_new(all, "series", series);
}

/* The fields of one stage, which all have the same shape. */
typedef struct fields {
    size_t variables[MOST_FIELDS], count, frames, cells;
    size_t extremes[2 * MOST_FIELDS]; /* the instants of their extremes */
} fields;

/* Returns the index of point k when `kept` points are spread evenly over `count`. */
static size_t sample_index(size_t k, size_t kept, size_t count)
{
    return kept > 1 ? k * (count - 1) / (kept - 1) : 0;
}

/* Lists the kept instants: some spread evenly, and the instants of the extremes. */
static size_t choose_frames(const fields *m, size_t *chosen)
{
    bool *kept = memory_alloc(m->frames * sizeof *kept);
    const size_t even = m->frames < FRAMES ? m->frames : FRAMES;
    size_t count = 0;
    for (size_t k = 0; k < even; k++)
        kept[sample_index(k, even, m->frames)] = true;
    for (size_t i = 0; i < 2 * m->count; i++)
        kept[m->extremes[i]] = true;
    for (size_t k = 0; k < m->frames; k++)
        if (kept[k])
            chosen[count++] = k;
    free(kept);
    return count;
}

/* Adds a field; leaves it out if its shape differs from the shape of the first field. */
static void take_field(report_data *d, fields *m, size_t variable)
{
    ff_array array = report_load(d->page, (int)variable, 0);
    const bool good =
        array.data && array.rank == 2 && report_array_size(&array) > 0 &&
        (m->count == 0 || (array.shape[0] == m->frames && array.shape[1] == m->cells));
    if (good) {
        const report_extremes found = report_find_extremes(&array);
        double size = 0; /* from the middle of the contact: the gap is wide outside */
        m->frames = array.shape[0];
        m->cells = array.shape[1];
        for (size_t k = 0; k < m->frames; k++) {
            const double middle = fabs(array.data[k * m->cells + m->cells / 2]);
            size = fmax(size, isfinite(middle) ? middle : 0);
        }
        report_describe(d, variable, size);
        m->extremes[2 * m->count] = found.greatest / m->cells;
        m->extremes[2 * m->count + 1] = found.least / m->cells;
        m->variables[m->count++] = variable;
    }
    report_release(d->page, &array);
}

/* Packs a series along an axis of the fields, or its indices if there is none, with the name of its
 * output. */
static json_t *pack_along(report_data *d, json_t *made, const char *name, uint32_t dim,
                          const fields *m, const size_t *chosen, size_t count)
{
    const results_view *view = d->page->view;
    const int axis = report_find_axis(view, m->variables[0], dim, 0);
    ff_array along = report_load(d->page, axis, 0);
    if (along.data) {
        report_describe(d, (size_t)axis, report_magnitude(&along));
        json_object_set_new(made, name, results_json_text(view->variables[axis]->name));
    }
    json_t *packed = report_pack(along.data, chosen, count);
    report_release(d->page, &along);
    return packed;
}

/* Describes the fields of a stage at the kept instants and cells. */
static json_t *describe_fields(report_data *d, size_t stage, const fields *m)
{
    const results_view *view = d->page->view;
    size_t *rows = memory_alloc(m->frames * sizeof *rows);
    const size_t frames = choose_frames(m, rows), cells = m->cells < CELLS ? m->cells : CELLS;
    size_t *columns = memory_alloc(cells * sizeof *columns),
           *both = memory_alloc(frames * cells * sizeof *both);
    for (size_t i = 0; i < cells; i++)
        columns[i] = sample_index(i, cells, m->cells);
    for (size_t k = 0; k < frames; k++)
        for (size_t i = 0; i < cells; i++)
            both[k * cells + i] = rows[k] * m->cells + columns[i];
    d->page->thinned = d->page->thinned || frames < m->frames || cells < m->cells;
    json_t *values = json_object(),
           *made =
               json_pack("{s:o, s:I, s:I, s:I}", "stage",
                         results_json_text(view->stages[stage]->name), "frames", (json_int_t)frames,
                         "cells", (json_int_t)cells, "instants", (json_int_t)m->frames);
    json_object_set_new(made, "at", pack_along(d, made, "time", 0, m, rows, frames));
    json_object_set_new(made, "x", pack_along(d, made, "place", 1, m, columns, cells));
    for (size_t i = 0; i < m->count; i++) {
        ff_array array = report_load(d->page, (int)m->variables[i], 0);
        if (array.data)
            json_object_set_new(values, view->variables[m->variables[i]]->output,
                                report_pack(array.data, both, frames * cells));
        report_release(d->page, &array);
    }
    json_object_set_new(made, "values", values);
    free(rows);
    free(columns);
    free(both);
    return made;
}

/* Adds the fields of a run, stage by stage. */
static void add_fields(report_data *d, json_t *all)
{
    const results_view *view = d->page->view;
    json_t *list = json_array();
    size_t left = MOST_FIELDS;
    for (size_t s = 0; s < view->stage_count && !view->study; s++) {
        fields m = {.count = 0};
        for (size_t v = 0; v < view->variable_count && m.count < left; v++)
            if (view->variables[v]->stage == s && view->variables[v]->rank == 2)
                take_field(d, &m, v);
        if (m.count > 0)
            json_array_append_new(list, describe_fields(d, s, &m));
        left -= m.count;
    }
    json_object_set_new(all, "fields", list);
}

void report_write_data(report_page *page)
{
    const results_view *view = page->view;
    report_data d = {page, json_object()};
    json_t *stages = json_array();
    for (size_t s = 0; s < view->stage_count; s++)
        json_array_append_new(stages, results_json_text(view->stages[s]->name));
    json_t *all = json_pack("{s:b, s:b, s:b, s:o}", "study", (int)view->study, "sample",
                            (int)report_is_sample(view), "described",
                            (int)(view->figures_count > 0), "stages", stages);
    add_scalars(&d, all);
    add_all_series(&d, all);
    add_fields(&d, all);
    json_object_set_new(all, "outputs", d.outputs);
    fputs("<script type=\"application/json\" id=\"data\">", page->out);
    report_put_json(page->out, all);
    fputs("</script>\n", page->out);
}
