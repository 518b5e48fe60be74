/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Packs the numbers of series for the template's figures, with the names and units of the outputs.
 */
#include "page.h"

#include "../memory/memory.h"
#include "../results/json.h"
#include "../study/store/journal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_POINTS = 2800, /* points of a series; four for each column of pixels */
    MOST_WHOLE = 50000  /* points of a series that is kept whole */
};

static void put_base64(const unsigned char *bytes, size_t size, char *out)
{
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const unsigned bits = (unsigned)bytes[i] << 16 |
                              (left > 1 ? (unsigned)bytes[i + 1] << 8 : 0) |
                              (left > 2 ? bytes[i + 2] : 0u);
        *out++ = letters[bits >> 18];
        *out++ = letters[bits >> 12 & 63];
        *out++ = left > 1 ? letters[bits >> 6 & 63] : '=';
        *out++ = left > 2 ? letters[bits & 63] : '=';
    }
    *out = '\0';
}

json_t *report_pack(const double *values, const size_t *chosen, size_t count)
{
    unsigned char *bytes = memory_alloc(4 * count + 1);
    char *text = memory_alloc(4 * ((4 * count + 2) / 3) + 1);
    for (size_t i = 0; i < count; i++) {
        const size_t at = chosen ? chosen[i] : i;
        const float number = (float)(values ? values[at] : (double)at);
        uint32_t bits;
        memcpy(&bits, &number, sizeof bits);
        for (int b = 0; b < 4; b++)
            bytes[4 * i + (size_t)b] = (unsigned char)(bits >> (8 * b));
    }
    put_base64(bytes, 4 * count, text);
    json_t *packed = json_string(text);
    free(text);
    free(bytes);
    return packed;
}

json_t *report_describe_unit(const char *name, const char *si, double magnitude)
{
    const study_readable unit = report_unit_for(name, si, magnitude);
    return json_pack("{s:s, s:f, s:f}", "unit", unit.unit, "factor", unit.factor, "offset",
                     unit.offset);
}

json_t *report_describe(report_data *d, size_t variable, double magnitude)
{
    const results_view *view = d->page->view;
    const results_view_variable *of = view->variables[variable];
    char words[REPORT_TEXT_SIZE];
    json_t *entry = json_object_get(d->outputs, of->name);
    if (entry)
        return entry;
    entry = report_describe_unit(of->output, of->unit, magnitude);
    json_object_set_new(entry, "stage", results_json_text(view->stages[of->stage]->name));
    json_object_set_new(entry, "output", results_json_text(of->output));
    json_object_set_new(entry, "label", results_json_text(report_output_words(of, words)));
    json_object_set_new(entry, "si", results_json_text(of->unit));
    json_object_set_new(entry, "asked", json_boolean(of->flags & RESULTS_VIEW_ASKED));
    json_object_set_new(d->outputs, of->name, entry);
    return entry;
}

/* Keeps the first, lowest, highest and last of a group of points and the start of each gap, in
 * their order. */
static size_t keep_extremes(const double *y, size_t from, size_t to, size_t *kept)
{
    size_t low = from, high = from, count = 0;
    for (size_t i = from; i < to; i++) {
        low = isnan(y[low]) || y[i] < y[low] ? i : low;
        high = isnan(y[high]) || y[i] > y[high] ? i : high;
    }
    for (size_t i = from; i < to; i++)
        if (i == from || i == low || i == high || i == to - 1 || (isnan(y[i]) && !isnan(y[i - 1])))
            kept[count++] = i;
    return count;
}

/* Writes the indices of the points that are kept. A long curve keeps the extremes of each group of
 * points. Series without a rising axis, such as those of an atlas, must keep the same points, so
 * they are kept whole as far as there is room. */
static size_t choose_points(const double *x, const double *y, size_t count, size_t *kept)
{
    size_t run = count / (MOST_POINTS / 4) + 1, used = 0;
    bool rises = count > (x ? MOST_POINTS : MOST_WHOLE);
    for (size_t i = 1; x && i < count && rises && count <= MOST_WHOLE; i++)
        rises = x[i] >= x[i - 1];
    for (size_t i = 0; i < count; i += rises ? run : 1) {
        const size_t end = rises && i + run < count ? i + run : rises ? count : i + 1;
        used += keep_extremes(y, i, end, kept + used);
    }
    return used;
}

double report_magnitude(const ff_array *array)
{
    const report_extremes found = report_find_extremes(array);
    return fmax(0, fmax(fabs(found.low), fabs(found.high))); /* 0 if no number is known */
}

/* For a share such as a friction coefficient, adds its extremes among the points with load. */
static void add_ends(json_t *series, const results_view_variable *of, const ff_array *y)
{
    const size_t count = report_array_size(y);
    if (*of->whole && of->extremes[0] < count && of->extremes[1] < count)
        json_object_set_new(series, "ends",
                            json_pack("[o, o]", study_json_real(y->data[of->extremes[0]]),
                                      study_json_real(y->data[of->extremes[1]])));
}

void report_data_series(report_data *d, json_t *list, size_t variable, size_t index, size_t rank)
{
    report_page *page = d->page;
    const results_view *view = page->view;
    const results_view_variable *of = view->variables[variable];
    const int axis = report_find_axis(view, variable, 0, index);
    ff_array y = report_load(page, (int)variable, index), x = report_load(page, axis, index),
             bar = report_load(page, report_find_bar(view, variable), index);
    const size_t count = report_array_size(&y);
    if (y.data && y.rank == 1 && count > 2 &&
        (axis < 0 || (x.data && report_array_size(&x) == count))) {
        size_t *kept = memory_alloc(count * sizeof *kept);
        const size_t used = choose_points(x.data, y.data, count, kept);
        page->thinned = page->thinned || used < count;
        json_t *made =
            json_pack("{s:o, s:i, s:o, s:o, s:o}", "of", results_json_text(of->name), "case",
                      (int)rank, "dim", results_json_text(of->dims[0]), "x",
                      report_pack(x.data, kept, used), "y", report_pack(y.data, kept, used));
        report_describe(d, variable, report_magnitude(&y));
        if (axis >= 0) {
            report_describe(d, (size_t)axis, report_magnitude(&x));
            json_object_set_new(made, "along", results_json_text(view->variables[axis]->name));
        }
        if (bar.data && report_array_size(&bar) == count)
            json_object_set_new(made, "bar", report_pack(bar.data, kept, used));
        add_ends(made, of, &y);
        json_array_append_new(list, made);
        free(kept);
    }
    report_release(page, &x);
    report_release(page, &y);
    report_release(page, &bar);
}

json_t *report_data_case(report_page *page, size_t index, const char *name)
{
    const report_marks marks = report_find_marks(page, index);
    json_t *points = json_array();
    for (size_t i = 0; i < REPORT_MARKS; i++)
        if (isfinite(marks.roll[i]))
            json_array_append_new(points, json_pack("[f, s]", marks.roll[i], report_mark_names[i]));
    return json_pack("{s:o, s:o}", "name", results_json_text(name), "marks", points);
}
