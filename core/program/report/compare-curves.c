/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Series of several designs in one drawing: along paths of contact of any length, which are scaled
   to their points SAP, LPSTC, pitch, HPSTC and tip. */
#include "compare.h"
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A series of a design. */
typedef struct series {
    ff_array x, y;
    report_marks marks;
} series;

/* The place of a roll angle on the scaled path, from 0 at SAP to 4 at the tip, between the points
   that all designs know; NaN beyond. */
static double scale(const report_marks *marks, const bool known[REPORT_MARKS], double roll)
{
    size_t before = REPORT_MARKS;
    for (size_t k = 0; k < REPORT_MARKS; k++) {
        if (!known[k])
            continue;
        const double to = marks->roll[k];
        const double from = before < REPORT_MARKS ? marks->roll[before] : to;
        const double slack = 1e-6 * fabs(to - from);
        if (roll >= from - slack && roll <= to + slack && to > from)
            return (double)before + (double)(k - before) * (roll - from) / (to - from);
        before = k;
    }
    return NAN;
}

/* The points that every design knows. */
static bool find_known(const report_design *designs, size_t count, bool known[REPORT_MARKS])
{
    bool good = true;
    for (size_t k = 0; k < REPORT_MARKS; k++)
        known[k] = true;
    for (size_t i = 0; i < count && good; i++) {
        report_page page = {.view = designs[i].view};
        const report_marks marks = report_find_marks(&page, designs[i].index);
        for (size_t k = 0; k < REPORT_MARKS; k++)
            known[k] = known[k] && isfinite(marks.roll[k]);
        good = !page.failed;
    }
    return good;
}

/* Reads the series of that name over the roll angle; x.data and y.data are NULL without one. */
static series read_series(report_page *page, size_t index, const char *name)
{
    const results_view *view = page->view;
    series s = {.x = {.data = NULL}};
    for (size_t v = 0; v < view->variable_count; v++) {
        const results_view_variable *of = view->variables[v];
        if (of->rank != 1 || strcmp(of->name, name) != 0)
            continue;
        const int axis = report_find_axis(view, v, 0, index);
        if (axis < 0 || strcmp(view->variables[axis]->unit, "rad") != 0)
            continue;
        s.x = report_load(page, axis, index);
        s.y = report_load(page, (int)v, index);
        s.marks = report_find_marks(page, index);
    }
    return s;
}

static json_t *curve_of(const report_design *design, const series *s,
                        const bool known[REPORT_MARKS], size_t rank, const study_readable *unit)
{
    json_t *x = json_array(), *y = json_array();
    const size_t count = report_array_size(&s->y), step = count / 800 + 1;
    for (size_t i = 0; i < count; i += step) {
        const double at = scale(&s->marks, known, s->x.data[i]),
                     value = report_convert(unit, s->y.data[i]);
        if (isnan(at) || !isfinite(value))
            continue;
        json_array_append_new(x, json_real(at));
        json_array_append_new(y, json_real(value));
    }
    return json_pack("{s:s, s:i, s:i, s:s, s:o, s:o}", "name", design->name, "colour", (int)rank,
                     "dash", (int)rank, "style", "line", "x", x, "y", y);
}

static json_t *marks_of(const bool known[REPORT_MARKS])
{
    json_t *list = json_array();
    for (size_t k = 0; k < REPORT_MARKS; k++)
        if (known[k])
            json_array_append_new(list, json_pack("[i, s]", (int)k, report_mark_names[k]));
    return list;
}

/* Draws a series that every design has. False after an error. */
static bool draw(study_answer *answer, const results_view_variable *of,
                 const report_design *designs, size_t count, const bool known[REPORT_MARKS])
{
    json_t *curves = json_array();
    study_readable unit = {1, 0, of->unit};
    bool good = true;
    for (size_t i = 0; i < count && good; i++) {
        report_page page = {.view = designs[i].view};
        series s = read_series(&page, designs[i].index, of->name);
        const size_t points = report_array_size(&s.y);
        if (points > 0 && points == report_array_size(&s.x)) {
            double most = 0;
            for (size_t k = 0; i == 0 && k < points; k++)
                most = fmax(most, fabs(s.y.data[k]));
            if (i == 0)
                unit = report_unit_for(of->output, of->unit, most);
            json_array_append_new(curves, curve_of(&designs[i], &s, known, i, &unit));
        }
        report_release(&page, &s.x);
        report_release(&page, &s.y);
        good = !page.failed;
    }
    if (good && json_array_size(curves) == count) {
        char title[REPORT_TEXT_SIZE], label[REPORT_TEXT_SIZE], words[REPORT_TEXT_SIZE];
        report_label(report_output_words(of, words), &unit, label);
        snprintf(title, sizeof title, "%.100s: %.90s", of->name, words);
        study_answer_draw(answer, json_pack("{s:s, s:s, s:{s:s, s:i}, s:{s:s, s:i}, s:o, s:O}",
                                            "sort", "curves", "title", title, "x", "label",
                                            "path of contact, each scaled to its points", "log", 0,
                                            "y", "label", label, "log", 0, "marks", marks_of(known),
                                            "curves", curves));
    }
    json_decref(curves);
    return good;
}

bool report_compare_curves(study_answer *answer, const report_design *designs, size_t count)
{
    const results_view *view = designs[0].view;
    bool known[REPORT_MARKS];
    bool good = find_known(designs, count, known);
    for (size_t v = 0; v < view->variable_count && good; v++) {
        const results_view_variable *of = view->variables[v];
        if (of->rank == 1 && of->flags & RESULTS_VIEW_ASKED && !report_is_axis(view, v))
            good = draw(answer, of, designs, count, known);
    }
    return good;
}
