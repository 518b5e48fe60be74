/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the variables for a figure among the results. */
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <string.h>

int report_find_output(const results_view *view, size_t stage, const char *output)
{
    for (size_t v = 0; v < view->variable_count; v++)
        if (view->variables[v]->stage == stage && !strcmp(view->variables[v]->output, output))
            return (int)v;
    return -1;
}

static const char bar_ending[] = "_error_bar"; /* as results/view-run.c names them */

int report_find_bar(const results_view *view, size_t variable)
{
    const results_view_variable *of = view->variables[variable];
    char name[REPORT_TEXT_SIZE];
    snprintf(name, sizeof name, "%.150s%s", of->output, bar_ending);
    return report_find_output(view, of->stage, name);
}

bool report_is_bar(const results_view_variable *variable)
{
    size_t length = strlen(variable->output), tail = sizeof bar_ending - 1;
    return length > tail && !strcmp(variable->output + length - tail, bar_ending);
}

bool report_is_axis(const results_view *view, size_t series)
{
    for (size_t v = 0; v < view->variable_count; v++)
        for (uint32_t k = 0; k < view->variables[v]->rank; k++)
            if (v != series && (view->variables[v]->flags & RESULTS_VIEW_ASKED) &&
                !strcmp(view->variables[v]->against[k], view->variables[series]->name))
                return true;
    return false;
}

/* Returns whether a variable is a series of `count` points. */
static bool is_series_of(const results_view *view, size_t series, size_t index, size_t count)
{
    size_t shape[4];
    return view->variables[series]->rank == 1 &&
           results_view_full_shape(view, series, index, shape) && shape[0] == count;
}

int report_find_axis(const results_view *view, size_t variable, uint32_t dim, size_t index)
{
    const results_view_variable *of = view->variables[variable];
    size_t shape[4];
    int found = -1;
    if (dim >= of->rank || !results_view_full_shape(view, variable, index, shape))
        return -1;
    for (size_t k = 0; k < view->variable_count; k++) {
        const results_view_variable *series = view->variables[k];
        if (!results_view_is_coordinate(series, of, dim) ||
            !is_series_of(view, k, index, shape[dim]))
            continue;
        if (!strcmp(series->name, of->against[dim]))
            return (int)k;
        if (found < 0 || !strcmp(series->unit, "rad"))
            found = (int)k;
    }
    return found;
}

ff_array report_load(report_page *page, int variable, size_t index)
{
    ff_array array = {.data = NULL};
    if (variable < 0 || page->failed)
        return array;
    page->failed = !results_view_load(page->view, (size_t)variable, index, &array);
    return array;
}

void report_release(report_page *page, ff_array *array)
{
    (void)page;
    results_view_release(array);
}

size_t report_array_size(const ff_array *array)
{
    size_t count = array->data ? 1 : 0;
    for (uint32_t i = 0; i < array->rank; i++)
        count *= array->shape[i];
    return count;
}

report_extremes report_find_extremes(const ff_array *array)
{
    const size_t count = report_array_size(array);
    report_extremes found = {0, 0, NAN, NAN};
    for (size_t i = 0; i < count; i++) {
        const double value = array->data[i];
        if (!isfinite(value))
            continue;
        if (!(value >= found.low)) {
            found.least = i;
            found.low = value;
        }
        if (!(value <= found.high)) {
            found.greatest = i;
            found.high = value;
        }
    }
    return found;
}

/* Returns the value, in SI, of the first scalar output with that name in any stage; NaN if there is
 * none. */
static double find_scalar(report_page *page, const char *output, size_t index)
{
    double value = NAN;
    for (size_t v = 0; v < page->view->variable_count && !isfinite(value); v++) {
        const results_view_variable *variable = page->view->variables[v];
        if (variable->rank != 0 || strcmp(variable->output, output) != 0)
            continue;
        ff_array array = report_load(page, (int)v, index);
        if (array.data)
            value = array.data[0];
        report_release(page, &array);
    }
    return value;
}

const char *const report_mark_names[REPORT_MARKS] = {"SAP", "LPSTC", "pitch", "HPSTC", "tip"};

/* Finds LPSTC and HPSTC, the only stations of a gear pair that occur twice. */
static void find_jumps(report_page *page, size_t index, report_marks *marks)
{
    double found[2] = {NAN, NAN};
    size_t count = 0;
    for (size_t v = 0; v < page->view->variable_count && count == 0; v++) {
        const results_view_variable *of = page->view->variables[v];
        if (of->rank != 1 || strcmp(of->output, "roll_angle") || strcmp(of->dims[0], "station"))
            continue;
        ff_array roll = report_load(page, (int)v, index);
        for (size_t i = 1; i < report_array_size(&roll); i++)
            if (roll.data[i] == roll.data[i - 1]) {
                if (count < 2)
                    found[count] = roll.data[i];
                count++;
            }
        report_release(page, &roll);
    }
    if (count == 2) {
        marks->roll[1] = found[0];
        marks->roll[3] = found[1];
    }
}

report_marks report_find_marks(report_page *page, size_t index)
{
    static const char *const outputs[REPORT_MARKS] = {"roll_sap", "roll_lpstc", "roll_pitch",
                                                      "roll_hpstc", "roll_tip"};
    report_marks marks;
    for (size_t i = 0; i < REPORT_MARKS; i++)
        marks.roll[i] = find_scalar(page, outputs[i], index);
    if (!isfinite(marks.roll[1]) && !isfinite(marks.roll[3]))
        find_jumps(page, index, &marks);
    return marks;
}

report_scalar report_load_scalar(report_page *page, size_t variable)
{
    const results_view *view = page->view;
    const results_view_variable *of = view->variables[variable];
    report_scalar s = {.page = page,
                       .variable = variable,
                       .count = view->case_count,
                       .values = memory_alloc(view->case_count * sizeof *s.values),
                       .low = INFINITY,
                       .high = -INFINITY};
    char words[REPORT_TEXT_SIZE];
    for (size_t c = 0; c < s.count; c++) {
        ff_array array = report_load(page, (int)variable, c);
        s.values[c] = array.data ? array.data[0] : (double)NAN;
        report_release(page, &array);
        s.low = fmin(s.low, s.values[c]); /* fmin and fmax drop NaN */
        s.high = fmax(s.high, s.values[c]);
    }
    s.unit =
        report_unit_for(of->output, of->unit, s.low > s.high ? 0 : fmax(fabs(s.low), fabs(s.high)));
    snprintf(s.title, sizeof s.title, "%.60s: %.120s", view->stages[of->stage]->name,
             report_output_words(of, words));
    report_label(report_output_words(of, words), &s.unit, s.label);
    return s;
}
