/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws the atlas of a stage: every periodic motion that it found, over the mesh frequency. */
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_PERIODS = 6 };

typedef struct atlas {
    ff_array frequency, rms, stable, branch;
    size_t count;
} atlas;

static ff_array load_output(report_page *page, size_t stage, const char *output)
{
    return report_load(page, report_find_output(page->view, stage, output), 0);
}

static double branch_of(const atlas *a, size_t i)
{
    return a->branch.data ? a->branch.data[i] : 0;
}

/* Returns the period in mesh cycles: the number of a branch is 1000 times that plus its rank. */
static int period_of(const atlas *a, size_t i)
{
    double branch = branch_of(a, i);
    return branch >= 1000 && branch < 1e6 ? (int)(branch / 1000) : 1;
}

static bool is_stable(const atlas *a, size_t i)
{
    return !a->stable.data || a->stable.data[i] > 0;
}

/* Adds the stable or the unstable motions of a period, branch by branch. Parts of a branch meet in
   the point where stability changes. */
static void add_part(report_plot *plot, const atlas *a, int period, bool stable)
{
    double *x = memory_alloc(2 * a->count * sizeof *x), *y = memory_alloc(2 * a->count * sizeof *y);
    const study_readable hertz = {1, 0, "Hz"}, size = report_unit_for("", "m", 1e-6);
    size_t count = 0;
    bool any = false;
    for (size_t i = 0; i < a->count; i++) {
        bool same = i > 0 && branch_of(a, i - 1) == branch_of(a, i);
        bool here = is_stable(a, i) == stable, before = same && is_stable(a, i - 1) == stable;
        bool kept = period_of(a, i) == period && (here || before);
        if (!same || !kept) {
            x[count] = NAN;
            y[count++] = NAN;
        }
        if (kept) {
            x[count] = a->frequency.data[i];
            y[count++] = a->rms.data[i];
            any = true;
        }
    }
    report_curve *curve = any ? report_plot_add(plot, &hertz, x, &size, y, count) : NULL;
    if (curve) {
        curve->colour = period - 1;
        curve->dash = stable ? 0 : 2;
        snprintf(curve->label, sizeof curve->label, "period of %d mesh cycle%s, %s", period,
                 period > 1 ? "s" : "", stable ? "stable" : "unstable");
    }
    free(x);
    free(y);
}

static void write_atlas(report_page *page, const atlas *a, const char *stage)
{
    report_plot plot = {.from_zero = true, .class = "broad"};
    const study_readable size = report_unit_for("", "m", 1e-6);
    double highest = 0, backlash = report_find_scalar(page, "backlash", 0);
    for (int period = 1; period <= MOST_PERIODS; period++) {
        add_part(&plot, a, period, true);
        add_part(&plot, a, period, false);
    }
    for (size_t i = 0; i < a->count; i++)
        highest = fmax(highest, a->rms.data[i]);
    if (highest > backlash && backlash > 0) /* contact loss with impacts on both flanks */
        plot.y1 = report_convert(&size, backlash);
    double here = report_find_scalar(page, "mesh_frequency", 0);
    if (isfinite(here)) {
        plot.mark_names[0] = "this run";
        plot.marks[plot.mark_count++] = here;
    }
    snprintf(plot.title, sizeof plot.title, "%s: all periodic motions", stage);
    snprintf(plot.x_label, sizeof plot.x_label, "mesh frequency (Hz)");
    snprintf(plot.y_label, sizeof plot.y_label, "transmission error, rms (µm)");
    report_plot_write(page, &plot);
    if (plot.y1 > 0)
        fputs("<p class=\"note\">Motions larger than the backlash are cut off.</p>\n", page->out);
    report_plot_free(&plot);
}

void report_write_speed(report_page *page)
{
    const results_view *view = page->view;
    bool open = false;
    for (size_t s = 0; s < view->stage_count && !view->study; s++) {
        atlas a = {load_output(page, s, "atlas_frequency"), load_output(page, s, "atlas_rms"),
                   load_output(page, s, "atlas_stable"), load_output(page, s, "atlas_branch"), 0};
        a.count = report_array_size(&a.frequency);
        if (a.count > 1 && report_array_size(&a.rms) == a.count) {
            if (!open)
                fputs("<section><h2>Transmission error against speed</h2>\n"
                      "<div class=\"figures\">\n",
                      page->out);
            open = true;
            write_atlas(page, &a, view->stages[s]->name);
        }
        report_release(page, &a.frequency);
        report_release(page, &a.rms);
        report_release(page, &a.stable);
        report_release(page, &a.branch);
    }
    if (open)
        fputs("</div></section>\n", page->out);
}
