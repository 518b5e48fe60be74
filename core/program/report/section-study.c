/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sections of a study: each scalar over what is varied, the cases, and those that failed. */
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LINES = 8, MOST_MAPS = 6, MOST_ROWS = 400, MOST_FAILED = 100 };

/* Whether the values of an axis rise or fall: along others a line would run to and fro. */
static bool is_in_order(const results_view *view, const results_view_axis *axis)
{
    bool rises = true, falls = true;
    for (size_t i = 1; i < view->lengths[axis->dimension]; i++) {
        rises = rises && axis->values[i] >= axis->values[i - 1];
        falls = falls && axis->values[i] <= axis->values[i - 1];
    }
    return rises || falls;
}

/* Finds the numeric axis with the most points that is not of dimension `other`. */
static int main_axis(const results_view *view, int other)
{
    int best = -1;
    size_t points = 1;
    for (size_t a = 0; a < view->axis_count; a++) {
        const results_view_axis *axis = view->axes[a];
        if (axis->values && (int)axis->dimension != other &&
            view->lengths[axis->dimension] > points && is_in_order(view, axis)) {
            best = (int)a;
            points = view->lengths[axis->dimension];
        }
    }
    return best;
}

static size_t stride_of(const results_view *view, size_t dimension)
{
    size_t stride = 1;
    for (size_t d = dimension + 1; d < view->dimension_count; d++)
        stride *= view->lengths[d];
    return stride;
}

/* Writes the label of an axis and returns its unit. */
static study_readable show_axis(const results_view *view, const results_view_axis *axis,
                                char label[REPORT_TEXT_SIZE])
{
    double size = 0;
    char words[REPORT_TEXT_SIZE];
    for (size_t i = 0; i < view->lengths[axis->dimension]; i++)
        size = fmax(size, fabs(axis->values[i]));
    study_readable unit = report_unit_for(axis->path, axis->unit, size);
    report_label(report_plain_name(axis->path, words), &unit, label);
    return unit;
}

/* Says whether values are spaced as by `spacing: log`, over a factor of five at least. */
static bool is_geometric(const double *values, size_t count)
{
    bool good = count > 2 && values[0] > 0 && fabs(log(values[count - 1] / values[0])) > log(5);
    double ratio = good ? values[1] / values[0] : 0;
    for (size_t i = 2; i < count && good; i++)
        good = fabs(values[i] / values[i - 1] / ratio - 1) < 1e-6;
    return good;
}

static void draw_lines(const report_scalar *f, const results_view_axis *axis, size_t combinations)
{
    const results_view *view = f->page->view;
    size_t points = view->lengths[axis->dimension], stride = stride_of(view, axis->dimension);
    double *y = memory_alloc(points * sizeof *y);
    report_plot plot = {.count = 0};
    plot.decades = is_geometric(axis->values, points);
    study_readable unit = show_axis(view, axis, plot.x_label);
    snprintf(plot.title, sizeof plot.title, "%s", f->title);
    snprintf(plot.y_label, sizeof plot.y_label, "%s", f->label);
    plot.limit_name = report_limit_asked(view, f->variable);
    plot.limit = report_convert(&f->unit, report_limit_bound(view, f->variable));
    for (size_t k = 0; k < combinations && k < MOST_LINES; k++) {
        size_t first = report_first_case(view, k, axis->dimension, -1);
        bool any = false;
        for (size_t i = 0; i < points; i++) {
            y[i] = f->values[first + i * stride];
            any = any || isfinite(y[i]);
        }
        if (!any)
            continue;
        char name[REPORT_TEXT_SIZE];
        report_name_case(view, first, axis->dimension, -1, name);
        /* both chains of a sweep are one where there is one motion */
        report_curve *curve = report_plot_find(&plot, &f->unit, y, points, 1e-3);
        if (curve) {
            size_t length = strlen(curve->label);
            snprintf(curve->label + length, sizeof curve->label - length, " and %.80s", name);
            continue;
        }
        curve = report_plot_add(&plot, &unit, axis->values, &f->unit, y, points);
        if (curve) {
            curve->dash = (int)k;
            snprintf(curve->label, sizeof curve->label, "%s", name);
        }
    }
    report_plot_write(f->page, &plot);
    if (combinations > MOST_LINES)
        fprintf(f->page->out, "<p class=\"note\">The first %d of %zu combinations.</p>\n",
                MOST_LINES, combinations);
    report_plot_free(&plot);
    free(y);
}

static void draw_map(const report_scalar *f, const results_view_axis *x, const results_view_axis *y,
                     size_t first)
{
    const results_view *view = f->page->view;
    char rest[REPORT_TEXT_SIZE];
    report_map map = {.columns = view->lengths[x->dimension], .rows = view->lengths[y->dimension]};
    double *xs = memory_alloc(map.columns * sizeof *xs), *ys = memory_alloc(map.rows * sizeof *ys);
    double *values = memory_alloc(map.columns * map.rows * sizeof *values);
    int32_t *standing = memory_alloc(map.columns * map.rows * sizeof *standing);
    study_readable x_unit = show_axis(view, x, map.x_label),
                   y_unit = show_axis(view, y, map.y_label);
    report_name_case(view, first, x->dimension, (int)y->dimension, rest);
    snprintf(map.title, sizeof map.title, *rest ? "%.100s (%.90s)" : "%.100s%s", f->title, rest);
    snprintf(map.value_label, sizeof map.value_label, "%s", f->label);
    for (size_t i = 0; i < map.columns; i++)
        xs[i] = report_convert(&x_unit, x->values[i]);
    for (size_t k = 0; k < map.rows; k++) {
        ys[k] = report_convert(&y_unit, y->values[k]);
        for (size_t i = 0; i < map.columns; i++) {
            const size_t c =
                first + i * stride_of(view, x->dimension) + k * stride_of(view, y->dimension);
            values[k * map.columns + i] = report_convert(&f->unit, f->values[c]);
            standing[k * map.columns + i] = report_standing(view, c);
        }
    }
    map.x = xs;
    map.y = ys;
    map.values = values;
    map.low = report_convert(&f->unit, f->low);
    map.high = report_convert(&f->unit, f->high);
    map.mark = report_convert(&f->unit, report_limit_bound(view, f->variable));
    map.best = (int)report_best_of(f, first, x->dimension, y->dimension);
    map.standing = standing;
    report_map_write(f->page, &map);
    free(xs);
    free(ys);
    free(values);
    free(standing);
}

static void draw_maps(const report_scalar *f, const results_view_axis *x,
                      const results_view_axis *y)
{
    const results_view *view = f->page->view;
    size_t count = view->case_count / view->lengths[x->dimension] / view->lengths[y->dimension];
    for (size_t k = 0; k < count && k < MOST_MAPS; k++)
        draw_map(f, x, y, report_first_case(view, k, x->dimension, (int)y->dimension));
    if (count > MOST_MAPS)
        fprintf(f->page->out, "<p class=\"note\">The first %d of %zu combinations.</p>\n",
                MOST_MAPS, count);
}

/* Draws points that have no order: those of cases that differ in words. */
static void draw_dots(const report_scalar *f)
{
    const results_view *view = f->page->view;
    report_plot plot = {.count = 0};
    double *x = memory_alloc(view->case_count * sizeof *x);
    const study_readable unit = {1, 0, ""};
    snprintf(plot.x_label, sizeof plot.x_label, "case");
    for (size_t c = 0; c < view->case_count; c++)
        x[c] = (double)(c + 1);
    snprintf(plot.title, sizeof plot.title, "%s", f->title);
    snprintf(plot.y_label, sizeof plot.y_label, "%s", f->label);
    report_curve *curve = report_plot_add(&plot, &unit, x, &f->unit, f->values, view->case_count);
    if (curve)
        curve->dots = true;
    report_plot_write(f->page, &plot);
    report_plot_free(&plot);
    free(x);
}

static void draw_scalar(const report_scalar *f)
{
    const results_view *view = f->page->view;
    int x = main_axis(view, -1);
    if (report_is_sample(view)) {
        report_write_sample(f);
        return;
    }
    if (x < 0) {
        draw_dots(f);
        return;
    }
    const results_view_axis *axis = view->axes[x];
    size_t combinations = view->case_count / view->lengths[axis->dimension];
    int y = main_axis(view, (int)axis->dimension);
    bool map = y >= 0 && view->lengths[view->axes[y]->dimension] >= 4;
    map = map && (combinations > MOST_LINES || combinations == 1 ||
                  view->lengths[view->axes[y]->dimension] > MOST_LINES / 2);
    const bool fits = map ? view->case_count / view->lengths[axis->dimension] /
                                    view->lengths[view->axes[y]->dimension] <=
                                MOST_MAPS
                          : combinations <= MOST_LINES;
    if (!fits && report_is_sweep(view) && report_write_grids(f))
        return;
    if (map)
        draw_maps(f, axis, view->axes[y]);
    else
        draw_lines(f, axis, combinations);
}

/* Says whether the study has figures of its own and its cases are in no order, such as the rows of
   a load spectrum: the numbers of the cases would be a meaningless axis. */
static bool has_own_figures(const results_view *view)
{
    return view->figures_count > 0 && main_axis(view, -1) < 0 && !report_is_sample(view);
}

static bool over_speed(const results_view *view)
{
    int x = main_axis(view, -1);
    return x >= 0 && (!strcmp(view->axes[x]->unit, "Hz") || !strcmp(view->axes[x]->unit, "rad/s"));
}

/* Draws the transmission errors, or all other scalars. */
static void write_scalars(report_page *page, const char *title, bool errors)
{
    const results_view *view = page->view;
    report_part part;
    report_part_begin(page, &part);
    report_print(page->out, "<section><h2>%s</h2>\n<div class=\"figures\">\n", title);
    for (size_t v = 0; v < view->variable_count; v++) {
        if (view->variables[v]->rank != 0 ||
            (!strncmp(view->variables[v]->output, "dte_", 4) && over_speed(view)) != errors)
            continue;
        report_scalar f = report_load_scalar(page, v);
        if (f.high > f.low) /* the table of verdicts has the constants */
            draw_scalar(&f);
        free(f.values);
    }
    fputs("</div></section>\n", page->out);
    report_part_end(page, &part);
}

static void write_failed(report_page *page)
{
    const results_view *view = page->view;
    size_t failed = 0;
    for (size_t c = 0; c < view->case_count; c++) {
        const results_view_case *of = view->cases[c];
        if (!strcmp(of->status, "ok") || !strcmp(of->status, "not run"))
            continue;
        if (failed++ == 0)
            fputs("<section><h2>Failed cases</h2>\n<div class=\"wide\"><table><thead><tr><th>case"
                  "</th><th>status</th><th>reason</th><th>repeat it</th></tr></thead><tbody>\n",
                  page->out);
        if (failed > MOST_FAILED)
            continue;
        fprintf(page->out, "<tr><td>%zu</td><td>", c + 1);
        report_print(page->out, "%s</td><td>%s</td><td><code>%s</code></td></tr>\n", of->status,
                     of->reason, of->command);
    }
    if (failed > 0)
        fputs("</tbody></table></div>\n", page->out);
    if (failed > MOST_FAILED)
        fprintf(page->out, "<p class=\"note\">The first %d of %zu; table.csv has them all.</p>\n",
                MOST_FAILED, failed);
    if (failed > 0)
        fputs("</section>\n", page->out);
}

/* Columns of the table of cases that some case needs. */
typedef struct columns {
    bool limits, range;
} columns;

static void write_table_row(report_page *page, size_t index, const columns *has)
{
    const results_view *view = page->view;
    char text[REPORT_TEXT_SIZE];
    fprintf(page->out, "<tr><td>%zu</td>", index + 1);
    for (size_t a = 0; a < view->axis_count; a++) {
        report_print(page->out, "<td>%s</td>",
                     report_axis_word(view->axes[a],
                                      results_view_point(view, index, view->axes[a]->dimension),
                                      text));
    }
    report_print(page->out, "<td>%s</td><td>", view->cases[index]->status);
    report_put_badge(page->out, view->cases[index]->verdict);
    report_print(page->out, "</td><td>%s</td>", view->cases[index]->reasons);
    if (has->range)
        report_put_cell(page->out, view->cases[index]->range);
    if (has->limits)
        report_put_standing(page, index);
    for (size_t v = 0; v < view->variable_count; v++) {
        if (view->variables[v]->rank != 0)
            continue;
        ff_array array = report_load(page, (int)v, index);
        report_put_value(page->out, view->variables[v]->output, view->variables[v]->unit,
                         array.data ? array.data[0] : (double)NAN);
        report_release(page, &array);
    }
    fputs("</tr>\n", page->out);
}

static void write_table(report_page *page)
{
    const results_view *view = page->view;
    columns has = {false, false};
    for (size_t c = 0; c < view->case_count; c++) {
        has.limits = has.limits || view->cases[c]->limit_count > 0;
        has.range = has.range || *view->cases[c]->range;
    }
    fprintf(page->out, "<section><details><summary>All cases</summary>\n<div class=\"wide\"><table>"
                       "<thead><tr><th>case</th>");
    for (size_t a = 0; a < view->axis_count; a++) {
        report_print(page->out, "<th>%s</th>", view->axes[a]->path);
    }
    fprintf(page->out, "<th>status</th><th>verdict</th><th>because of</th>%s%s",
            has.range ? "<th>outside of its range</th>" : "", has.limits ? "<th>limits</th>" : "");
    for (size_t v = 0; v < view->variable_count; v++)
        if (view->variables[v]->rank == 0)
            report_print(page->out, "<th data-unit=\"%s\">%s</th>", view->variables[v]->unit,
                         view->variables[v]->name);
    fputs("</tr></thead><tbody>\n", page->out);
    for (size_t c = 0; c < view->case_count && c < MOST_ROWS; c++)
        write_table_row(page, c, &has);
    fputs("</tbody></table></div>\n", page->out);
    if (view->case_count > MOST_ROWS)
        fprintf(page->out, "<p class=\"note\">The first %d of %zu; table.csv has them all.</p>\n",
                MOST_ROWS, view->case_count);
    fputs("</details></section>\n", page->out);
}

/* Writes what a trade-off or a map of stability has described. */
static void write_figures(report_page *page)
{
    const results_view *view = page->view;
    size_t count = view->figures_count;
    if (count > 0)
        fputs("<section><h2>What the study shows</h2>\n", page->out);
    for (size_t i = 0; i < count; i++)
        report_put_figures(page->out, view->figures[i]->json);
    if (count > 0)
        fputs("</section>\n", page->out);
}

void report_write_study(report_page *page)
{
    if (!page->view->study)
        return;
    write_figures(page);
    if (!has_own_figures(page->view)) {
        write_scalars(page, "Transmission error against speed", true);
        write_scalars(page, "Over what is varied", false);
    }
    write_failed(page);
    write_table(page);
}
