/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws series along the path of contact and over the mesh cycle: stages that offer the same
   output, such as the quasi-static and the dynamic film, share a figure. */
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_OUTPUTS = 4, MOST_CASES = 4, MOST_OTHERS = 30 };

typedef struct group {
    const char *title;
    const char *outputs[MOST_OUTPUTS];
    bool alternating; /* drawn without its mean */
} group;

static const group path_groups[] = {
    {.title = "Film thickness", .outputs = {"h_min", "h_central"}},
    {.title = "Pressure", .outputs = {"p_max", "hertz_pressure"}},
    {.title = "Load per width", .outputs = {"load_per_width"}},
    {.title = "Tooth force", .outputs = {"tooth_force"}},
    {.title = "Load share", .outputs = {"load_share"}},
    {.title = "Surface speeds",
     .outputs = {"speed_1", "speed_2", "entrainment_speed", "sliding_speed"}},
    {.title = "Friction coefficient", .outputs = {"friction_coefficient"}},
    {.title = "Power loss", .outputs = {"power_loss"}},
    {.title = "Contact temperature", .outputs = {"contact_temperature"}},
    {.title = "Flash temperature", .outputs = {"flash_temperature"}},
    {.title = "Film over roughness", .outputs = {"lambda_ratio"}},
    {.title = "Asperities", .outputs = {"asperity_load_share"}},
    {.title = "Separation of the flanks", .outputs = {"gap"}},
};

static const group cycle_groups[] = {
    {.title = "Transmission error, alternating part",
     .outputs = {"dte", "loaded_transmission_error"},
     .alternating = true},
    {.title = "Mesh force", .outputs = {"mesh_force"}},
    {.title = "Sliding loss", .outputs = {"mesh_power_loss"}},
    {.title = "Mesh stiffness", .outputs = {"stiffness"}},
};

static const group surface_groups[] = {
    {.title = "Roughness of gear 1", .outputs = {"height_1"}},
    {.title = "Roughness of gear 2", .outputs = {"height_2"}},
};

/* What a figure is drawn from. */
typedef struct figure {
    report_page *page;
    report_plot plot;
    study_readable x_unit, y_unit;
    char x_si[40], y_si[40]; /* "" before the first curve */
    bool alternating;
    bool share;       /* some curve says little where its whole is next to nothing */
    double low, high; /* of all curves, without what says little */
    bool *drawn;      /* variables that have had their figure */
    size_t cases[MOST_CASES];
    size_t case_count, good; /* good: how many there are to choose from */
} figure;

static double magnitude(const ff_array *array)
{
    const report_extremes found = report_find_extremes(array);
    return fmax(0, fmax(fabs(found.low), fabs(found.high))); /* 0: nothing is known */
}

static void label_curve(const figure *d, report_curve *curve, size_t variable, size_t index,
                        bool several)
{
    const results_view *view = d->page->view;
    const results_view_variable *of = view->variables[variable];
    char words[REPORT_TEXT_SIZE], name[REPORT_TEXT_SIZE];
    const char *stage = view->stages[of->stage]->name;
    if (several)
        snprintf(curve->label, sizeof curve->label, "%.60s: %.120s", stage,
                 report_output_words(of, words));
    else
        snprintf(curve->label, sizeof curve->label, "%s", stage);
    if (view->study) {
        report_name_case(view, index, SIZE_MAX, -1, name);
        size_t length = strlen(curve->label);
        snprintf(curve->label + length, sizeof curve->label - length, *name ? " (%.100s)" : "%s",
                 name);
    }
}

/* The first curve decides the unit of the x axis; others must have the same. */
static bool choose_units(figure *d, size_t variable, int axis, const ff_array *x, const ff_array *y)
{
    const results_view_variable *of = d->page->view->variables[variable];
    const results_view_variable *along = axis < 0 ? NULL : d->page->view->variables[axis];
    const char *x_si = along ? along->unit : "index";
    char words[REPORT_TEXT_SIZE];
    if (d->plot.count > 0)
        return !strcmp(d->x_si, x_si) && !strcmp(d->y_si, of->unit);
    snprintf(d->x_si, sizeof d->x_si, "%s", x_si);
    snprintf(d->y_si, sizeof d->y_si, "%s", of->unit);
    d->x_unit = along ? report_unit_for(along->output, along->unit, magnitude(x))
                      : (study_readable){1, 0, ""};
    d->y_unit = report_unit_for(of->output, of->unit, magnitude(y));
    report_label(along ? report_output_words(along, words) : report_plain_name(of->dims[0], words),
                 &d->x_unit, d->plot.x_label);
    report_label(report_output_words(of, words), &d->y_unit, d->plot.y_label);
    return true;
}

/* Subtracts the mean over x, by the trapezoidal rule. */
static void remove_mean(report_curve *curve)
{
    double sum = 0, length = 0;
    for (size_t i = 1; i < curve->count; i++) {
        double step = curve->x[i] - curve->x[i - 1];
        sum += 0.5 * step * (curve->y[i] + curve->y[i - 1]);
        length += step;
    }
    for (size_t i = 0; i < curve->count && length > 0; i++)
        curve->y[i] -= sum / length;
}

/* Keeps what the y axis must show: of the friction coefficient not what it is without load. */
static void keep_range(figure *d, const results_view_variable *of, const report_curve *curve)
{
    const bool share =
        *of->whole && of->extremes[0] < curve->count && of->extremes[1] < curve->count;
    d->share = d->share || share;
    if (share) {
        d->low = fmin(d->low, curve->y[of->extremes[0]]);
        d->high = fmax(d->high, curve->y[of->extremes[1]]);
    }
    for (size_t i = 0; i < curve->count && !share; i++) {
        d->low = fmin(d->low, curve->y[i]);
        d->high = fmax(d->high, curve->y[i]);
    }
}

static void add_curve(figure *d, size_t variable, size_t index, bool several, size_t stage)
{
    report_page *page = d->page;
    int axis = report_find_axis(page->view, variable, 0, index);
    ff_array y = report_load(page, (int)variable, index), x = report_load(page, axis, index);
    if (y.data && y.rank == 1 && report_array_size(&y) > 2 && (axis < 0 || x.data) &&
        choose_units(d, variable, axis, &x, &y)) {
        report_curve *same = page->view->study ? NULL
                                               : report_plot_find(&d->plot, &d->y_unit, y.data,
                                                                  report_array_size(&y), 0),
                     *made = NULL;
        const char *name = page->view->stages[page->view->variables[variable]->stage]->name;
        if (same) {
            char rest[REPORT_TEXT_SIZE]; /* of "stage: output", or "" */
            size_t length = strcspn(same->label, ":");
            snprintf(rest, sizeof rest, "%s", same->label + length);
            snprintf(same->label + length, sizeof same->label - length, ", %.60s%.100s", name,
                     rest);
        } else {
            made = report_plot_add(&d->plot, &d->x_unit, x.data, &d->y_unit, y.data,
                                   report_array_size(&y));
        }
        if (made) {
            int bar = report_find_bar(page->view, variable);
            ff_array bars = report_load(page, bar, index);
            if (bars.data && report_array_size(&bars) == made->count)
                report_curve_bar(made, &d->y_unit, bars.data);
            report_release(page, &bars);
            made->colour = (int)stage;
            made->dash = (int)(d->plot.count - 1);
            if (d->alternating)
                remove_mean(made);
            label_curve(d, made, variable, index, several);
            keep_range(d, page->view->variables[variable], made);
        }
        d->drawn[variable] = true;
    }
    report_release(page, &x);
    report_release(page, &y);
}

static void add_contact_marks(figure *d)
{
    if (strcmp(d->x_si, "rad") != 0)
        return;
    report_marks marks = report_find_marks(d->page, d->cases[0]);
    for (size_t i = 0; i < REPORT_MARKS; i++)
        if (isfinite(marks.roll[i])) {
            d->plot.mark_names[d->plot.mark_count] = report_mark_names[i];
            d->plot.marks[d->plot.mark_count++] = report_convert(&d->x_unit, marks.roll[i]);
        }
}

static bool is_flat(const report_plot *plot)
{
    for (size_t k = 0; k < plot->count; k++)
        for (size_t i = 0; i < plot->curves[k].count; i++)
            if (plot->curves[k].y[i] != 0)
                return false;
    return true;
}

/* Each stage has a colour; where there is only one stage, each curve has one. */
static void spread_colours(report_plot *plot)
{
    for (size_t k = 1; k < plot->count; k++)
        if (plot->curves[k].colour != plot->curves[0].colour)
            return;
    for (size_t k = 0; k < plot->count; k++)
        plot->curves[k].colour = (int)k;
}

/* Says whether a variable is the gap of a contact, which is 0 as soon as damping loads the flanks
   again, beside that of a motion. */
static bool is_other_gap(const results_view *view, size_t variable)
{
    const results_view_variable *of = view->variables[variable];
    if (strcmp(of->output, "gap") != 0 || of->rank != 1 || strcmp(of->dims[0], "t") != 0)
        return false;
    for (size_t v = 0; v < view->variable_count; v++)
        if (!strcmp(view->variables[v]->output, "gap") && view->variables[v]->rank == 1 &&
            strcmp(view->variables[v]->dims[0], "t") != 0)
            return true;
    return false;
}

/* Draws the figure and begins the next one. */
static void finish_figure(figure *d)
{
    const double margin = 0.1 * (d->high - d->low);
    spread_colours(&d->plot);
    add_contact_marks(d);
    if (d->share) {
        d->plot.y0 = d->low - margin;
        d->plot.y1 = d->high + margin;
    }
    if (d->plot.count > 0 && !is_flat(&d->plot))
        report_plot_write(d->page, &d->plot);
    report_plot_free(&d->plot);
    d->plot = (report_plot){.count = 0};
    d->alternating = d->share = false;
    d->low = d->high = 0;
}

static void draw_group(figure *d, const group *g)
{
    const results_view *view = d->page->view;
    size_t used = 0, several = 0;
    char words[REPORT_TEXT_SIZE];
    d->alternating = g->alternating;
    for (size_t o = 0; o < MOST_OUTPUTS && g->outputs[o]; o++)
        for (size_t v = 0; v < view->variable_count; v++)
            if (view->variables[v]->rank >= 1 &&
                !strcmp(view->variables[v]->output, g->outputs[o])) {
                several++;
                break;
            }
    snprintf(d->plot.title, sizeof d->plot.title, "%s", g->title);
    for (size_t s = 0; s < view->stage_count; s++) {
        bool any = false;
        for (size_t o = 0; o < MOST_OUTPUTS && g->outputs[o]; o++) {
            int v = report_find_output(view, s, g->outputs[o]);
            if (v >= 0 && is_other_gap(view, (size_t)v))
                d->drawn[v] = true;
            if (v < 0 || d->drawn[v] || view->variables[v]->rank == 0 ||
                view->variables[v]->rank > 1)
                continue;
            for (size_t c = 0; c < d->case_count; c++)
                add_curve(d, (size_t)v, d->cases[c], several > 1, view->study ? c : used);
            any = true;
        }
        used += any;
    }
    if (several > 1 && d->plot.count > 0) { /* the legend names the outputs */
        snprintf(words, sizeof words, "%c%s", g->title[0] | ' ',
                 g->title + 1); /* in small letters */
        report_label(words, &d->y_unit, d->plot.y_label);
    }
    finish_figure(d);
}

static void write_section(figure *d, const char *title, const group *groups, size_t count)
{
    report_page *page = d->page;
    report_part part;
    report_part_begin(page, &part);
    report_print(page->out, "<section><h2>%s</h2>\n<div class=\"figures\">\n", title);
    if (page->view->study)
        fprintf(page->out,
                "<p class=\"note\">Up to %zu of %zu cases that went well and have series.</p>\n",
                d->case_count, d->good);
    for (size_t i = 0; i < count; i++)
        draw_group(d, &groups[i]);
    fputs("</div></section>\n", page->out);
    report_part_end(page, &part);
}

/* Draws the series that no section above has drawn. */
static void write_others(figure *d)
{
    const results_view *view = d->page->view;
    report_page *page = d->page;
    const size_t before = page->figures;
    report_part part;
    report_part_begin(page, &part);
    fputs("<section><details><summary>Other series</summary>\n<div class=\"figures\">\n",
          page->out);
    for (size_t v = 0; v < view->variable_count && page->figures < before + MOST_OTHERS; v++) {
        const results_view_variable *of = view->variables[v];
        char words[REPORT_TEXT_SIZE];
        size_t used = 0;
        bool axis = !strcmp(of->unit, "rad") || !strcmp(of->unit, "s") ||
                    (of->rank == 1 && !strcmp(of->output, of->dims[0]));
        if (d->drawn[v] || of->rank != 1 || axis || report_is_bar(of) ||
            !strncmp(of->output, "atlas_", 6))
            continue;
        snprintf(d->plot.title, sizeof d->plot.title, "%s", report_output_words(of, words));
        for (size_t k = v; k < view->variable_count; k++)
            if (view->variables[k]->rank == 1 && !strcmp(view->variables[k]->output, of->output)) {
                for (size_t c = 0; c < d->case_count; c++)
                    add_curve(d, k, d->cases[c], false, view->study ? c : used);
                used++;
            }
        finish_figure(d);
    }
    fputs("</div></details></section>\n", page->out);
    report_part_end(page, &part);
}

/* Says whether a case has kept a series; a repeat in a trade-off has none. */
static bool has_series(const results_view *view, size_t index)
{
    size_t shape[4];
    for (size_t v = 0; v < view->variable_count; v++)
        if (view->variables[v]->rank == 1 && results_view_full_shape(view, v, index, shape))
            return true;
    return false;
}

/* Says whether a case went well, has series, and differs from the first one along the longest
   dimension alone, or along any when `all`. */
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

/* Chooses the case of a run; of a study, a few that are spread over those that went well, one chain
   of it if that has enough. */
static void choose_cases(figure *d)
{
    const results_view *view = d->page->view;
    size_t good = 0, seen = 0, line = 0;
    for (size_t c = 0; c < view->case_count; c++) {
        good += is_choice(view, c, true);
        line += is_choice(view, c, false);
    }
    d->good = good;
    bool all = line < MOST_CASES;
    good = all ? good : line;
    size_t wanted = good < MOST_CASES ? good : MOST_CASES;
    for (size_t c = 0; c < view->case_count && d->case_count < wanted; c++) {
        if (!is_choice(view, c, all))
            continue;
        if (wanted == 1 || seen * (wanted - 1) >= d->case_count * (good - 1))
            d->cases[d->case_count++] = c;
        seen++;
    }
    if (!view->study && d->case_count == 0) /* a run that failed has kept what it has */
        d->cases[d->case_count++] = 0;
}

void report_write_series(report_page *page)
{
    figure d = {.page = page, .drawn = memory_alloc(page->view->variable_count * sizeof *d.drawn)};
    choose_cases(&d);
    if (d.case_count > 0) {
        write_section(&d, "Along the path of contact", path_groups,
                      sizeof path_groups / sizeof *path_groups);
        write_section(&d, "Over the mesh cycle", cycle_groups,
                      sizeof cycle_groups / sizeof *cycle_groups);
        write_section(&d, "Surfaces", surface_groups,
                      sizeof surface_groups / sizeof *surface_groups);
        write_others(&d);
    }
    free(d.drawn);
}
