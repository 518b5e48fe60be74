/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table that answers what an engineer asks first. */
#include <flankfilm/engine.h>

#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ANY: the highest of a series, where it is not 0 */
enum { LEAST, MOST, LARGEST, ANY, MEAN, RANGE, PLAIN, PERCENT };

static const struct row {
    const char *words, *output;
    int how;
} rows[] = {
    {"Least film thickness", "h_min", LEAST},
    {"Lowest film over roughness (lambda)", "lambda_ratio", LEAST},
    {"Highest pressure", "p_max", MOST},
    {"Highest Hertz pressure", "hertz_pressure", MOST},
    {"Largest friction coefficient", "friction_coefficient", LARGEST},
    {"Mean friction coefficient (magnitude)", "friction_coefficient", MEAN},
    {"Highest power loss", "power_loss", MOST},
    {"Mean power loss", "power_loss", MEAN},
    {"Mean power loss of the mesh", "power_loss_mean", PLAIN},
    {"Efficiency of the mesh", "efficiency", PERCENT},
    {"Highest flash temperature rise", "flash_temperature", MOST},
    {"Highest contact temperature", "contact_temperature", MOST},
    {"Largest share of the asperities in the load", "asperity_load_share", ANY},
    {"Largest share of the contact where asperities touch", "contact_ratio", ANY},
    {"Highest load per width", "load_per_width", MOST},
    {"Transmission error, rms of its alternating part", "dte_rms", PLAIN},
    {"Transmission error, peak to peak", "dte_peak_to_peak", PLAIN},
    {"Quasi-static transmission error, peak to peak", "loaded_transmission_error", RANGE},
    {"Time without contact", "contact_loss", PERCENT},
    {"Time in contact on the back flank", "back_contact", PERCENT},
    {"Largest dynamic over quasi-static tooth force", "dynamic_factor_tooth", PLAIN},
    {"Largest mesh force over the static one", "dynamic_factor_mesh", PLAIN},
    {"Roughness Rq of gear 1", "rq_1", PLAIN},
    {"Roughness Rq of gear 2", "rq_2", PLAIN},
    {"Contact ratio", "contact_ratio", PLAIN},
    {"Speed of gear 1", "speed", PLAIN},
    {"Mesh frequency", "mesh_frequency", PLAIN},
};

static size_t find_extreme(const ff_array *array, int how)
{
    size_t best = 0;
    for (size_t i = 1; i < report_array_size(array); i++) {
        double a = array->data[i], b = array->data[best];
        bool better = how == LEAST ? a < b : how == LARGEST ? fabs(a) > fabs(b) : a > b;
        best = better || (isfinite(a) && !isfinite(b)) ? i : best;
    }
    return best;
}

/* Returns the mean magnitude over x, by the trapezoidal rule, or over the points without x. */
static double mean_of(const ff_array *y, const ff_array *x)
{
    double sum = 0, length = 0;
    size_t count = report_array_size(y);
    for (size_t i = 1; i < count; i++) {
        double step = x->data ? x->data[i] - x->data[i - 1] : 1;
        sum += step * 0.5 * (fabs(y->data[i]) + fabs(y->data[i - 1]));
        length += step;
    }
    return length > 0 ? sum / length : fabs(y->data[0]);
}

static double range_of(const ff_array *array)
{
    return array->data[find_extreme(array, MOST)] - array->data[find_extreme(array, LEAST)];
}

/* Writes "roll angle 22.3 deg, single contact". */
static void write_place(report_page *page, int axis, double at)
{
    char text[REPORT_TEXT_SIZE], words[REPORT_TEXT_SIZE];
    if (axis < 0)
        return;
    const results_view_variable *along = page->view->variables[axis];
    report_quantity_text(along->unit, at, text);
    bool roll = !strcmp(along->output, "roll_angle");
    report_put_text(page->out, roll ? "roll angle" : report_output_words(along->output, words));
    report_print(page->out, " %s", text);
    if (!roll)
        return;
    report_marks marks = report_find_marks(page, 0);
    if (at >= marks.roll[1] && at <= marks.roll[3])
        fputs(", single contact", page->out);
    else if (at < marks.roll[1])
        fputs(", double contact, approach", page->out);
    else if (at > marks.roll[3])
        fputs(", double contact, recess", page->out);
}

/* Writes " +- 0.4 nm" where the error of the number was measured. */
static void write_error(report_page *page, size_t variable, size_t at)
{
    const results_view_variable *of = page->view->variables[variable];
    char text[REPORT_TEXT_SIZE];
    ff_array bar = report_load(page, report_find_bar(page->view, variable), 0);
    if (bar.data && at < report_array_size(&bar) && bar.data[at] > 0) {
        double rounded = 0;
        snprintf(text, sizeof text, "%.2g", bar.data[at]);
        ff_number_parse(text, &rounded, &(const char *){NULL});
        report_quantity_text(of->unit, rounded, text);
        fputs(" &#177; ", page->out);
        report_put_text(page->out, text);
    }
    report_release(page, &bar);
}

static void write_row(report_page *page, const struct row *row, size_t variable)
{
    const results_view_variable *of = page->view->variables[variable];
    char text[REPORT_TEXT_SIZE];
    int axis = of->rank == 1 ? report_find_axis(page->view, variable, 0, 0) : -1;
    ff_array y = report_load(page, (int)variable, 0), x = report_load(page, axis, 0);
    size_t at = y.data && row->how < MEAN ? find_extreme(&y, row->how) : 0;
    if (y.data && report_array_size(&y) > 0 && (row->how != ANY || y.data[at] > 0)) {
        double value = row->how == MEAN      ? mean_of(&y, &x)
                       : row->how == RANGE   ? range_of(&y)
                       : row->how == LARGEST ? fabs(y.data[at])
                                             : y.data[at];
        if (row->how == PERCENT)
            snprintf(text, sizeof text, "%.4g %%", 100 * value);
        else
            report_quantity_text(report_si_unit(of->unit, of->output), value, text);
        report_print(page->out, "<tr><th scope=\"row\">%s</th><td>", row->words);
        report_put_text(page->out, page->view->stages[of->stage]->name);
        fputs("</td><td class=\"number\">", page->out);
        report_put_text(page->out, text);
        if (row->how < MEAN || row->how == PLAIN)
            write_error(page, variable, at);
        fputs("</td><td>", page->out);
        if (row->how < MEAN && x.data && at < report_array_size(&x))
            write_place(page, axis, x.data[at]);
        fputs("</td></tr>\n", page->out);
    }
    report_release(page, &x);
    report_release(page, &y);
}

static void count_verdicts(const results_view *view, size_t counts[3])
{
    for (size_t c = 0; c < view->case_count; c++)
        for (size_t i = 0; i < view->cases[c]->quality_count; i++) {
            int32_t verdict = view->cases[c]->quality[i]->verdict;
            counts[verdict < FF_GOOD || verdict > FF_BAD ? FF_BAD : verdict]++;
        }
}

static void write_checks(report_page *page)
{
    size_t counts[3] = {0};
    count_verdicts(page->view, counts);
    fprintf(page->out, "<a href=\"#quality\">%zu checks good, %zu doubtful, %zu bad</a>",
            counts[FF_GOOD], counts[FF_DOUBTFUL], counts[FF_BAD]);
}

enum { SHOWN = 6 }; /* of the reasons; the others are folded */

/* Begins an item of the list of so many reasons. */
static void begin_reason(report_page *page, size_t item, size_t count)
{
    if (item == 0)
        fputs("<ul>\n", page->out);
    if (item == SHOWN)
        fprintf(page->out, "</ul>\n<details><summary>%zu more reasons</summary>\n<ul>\n",
                count - SHOWN);
    fputs("<li>", page->out);
}

static void end_reasons(report_page *page, size_t count)
{
    fputs(count > 0 ? "</ul>\n" : "", page->out);
    fputs(count > SHOWN ? "</details>\n" : "", page->out);
}

/* Writes "film: the domain ends ... (starvation 0.0124, held to 0.01)". */
static void write_reason(report_page *page, const results_view_quality *line)
{
    char value[REPORT_TEXT_SIZE], limit[REPORT_TEXT_SIZE];
    char words[REPORT_TEXT_SIZE], name[REPORT_TEXT_SIZE];
    const size_t length = strlen(line->name), end = strlen("_error");
    report_put_text(page->out, page->view->stages[line->stage]->name);
    fputs(": ", page->out);
    if (!strncmp(line->text, "measured", 8) && length > end && length < sizeof name) {
        snprintf(name, sizeof name, "%.*s", (int)(length - end), line->name);
        fputs("error of the ", page->out);
        report_put_text(page->out, report_output_words(name, words));
        fputs(", ", page->out);
    }
    report_put_text(page->out, *line->text ? line->text : line->name);
    report_number_text(line->value, value);
    report_number_text(line->limit, limit);
    fputs(" <small>(", page->out);
    report_put_text(page->out, line->name);
    report_print(page->out, " = %s, held to %s)</small>", value, limit);
}

/* The verdict of a run, with what the lines say that are not good. */
static void write_judgement(report_page *page)
{
    const results_view_case *c = page->view->cases[0];
    size_t listed = 0, counts[3] = {0};
    count_verdicts(page->view, counts);
    fputs("<p class=\"judgement\">", page->out);
    report_put_badge(page->out, c->verdict);
    if (counts[FF_DOUBTFUL] + counts[FF_BAD] == 0)
        fprintf(page->out,
                " Nothing speaks against these numbers: <a href=\"#quality\">all %zu "
                "checks are good</a>.</p>\n",
                counts[FF_GOOD]);
    else
        fprintf(page->out,
                " %s: <a href=\"#quality\">%zu checks are good</a>, %zu doubtful and %zu "
                "bad, namely</p>\n",
                counts[FF_BAD] ? "Some of these numbers are wrong"
                               : "Some of these numbers are in doubt",
                counts[FF_GOOD], counts[FF_DOUBTFUL], counts[FF_BAD]);
    for (size_t i = 0; i < c->quality_count; i++) {
        if (c->quality[i]->verdict == FF_GOOD)
            continue;
        begin_reason(page, listed++, counts[FF_DOUBTFUL] + counts[FF_BAD]);
        write_reason(page, c->quality[i]);
        fputs("</li>\n", page->out);
    }
    end_reasons(page, listed);
}

static void write_run(report_page *page)
{
    const results_view *view = page->view;
    write_judgement(page);
    fputs("<table class=\"verdict run\"><thead><tr><th>quantity</th><th>stage</th><th>value</th>"
          "<th>where</th></tr></thead><tbody>\n",
          page->out);
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        for (size_t v = 0; v < view->variable_count; v++)
            if (!strcmp(view->variables[v]->output, rows[r].output) &&
                view->variables[v]->rank == (rows[r].how < PLAIN))
                write_row(page, &rows[r], v);
    fputs("</tbody></table>\n", page->out);
}

/* Loads a scalar over the cases, in SI. */
static double *load_values(report_page *page, size_t variable)
{
    double *values = memory_alloc(page->view->case_count * sizeof *values);
    for (size_t c = 0; c < page->view->case_count; c++) {
        ff_array array = report_load(page, (int)variable, c);
        values[c] = array.data ? array.data[0] : (double)NAN;
        report_release(page, &array);
    }
    return values;
}

static void begin_span(report_page *page, const results_view_variable *of)
{
    char words[REPORT_TEXT_SIZE];
    fputs("<tr><th scope=\"row\">", page->out);
    report_put_text(page->out, report_output_words(of->output, words));
    fputs("</th>", page->out);
    report_put_cell(page->out, page->view->stages[of->stage]->name);
}

static void put_value(report_page *page, const results_view_variable *of, double value)
{
    char text[REPORT_TEXT_SIZE];
    report_quantity_text(report_si_unit(of->unit, of->output), value, text);
    fputs("<td class=\"number\">", page->out);
    report_put_text(page->out, text);
    fputs("</td>", page->out);
}

/* Writes the least and the largest value of a scalar over the cases, and where they are. */
static void write_span(report_page *page, const results_view_variable *of, const double *values)
{
    const results_view *view = page->view;
    size_t at[2] = {0};
    char words[REPORT_TEXT_SIZE];
    for (size_t c = 0; c < view->case_count; c++)
        for (int side = 0; side < 2; side++) {
            double best = values[at[side]];
            if (isfinite(values[c]) &&
                (!isfinite(best) || (side ? values[c] > best : values[c] < best)))
                at[side] = c;
        }
    if (!isfinite(values[at[0]]))
        return;
    begin_span(page, of);
    for (int side = 0; side < 2; side++) {
        put_value(page, of, values[at[side]]);
        report_name_case(view, at[side], SIZE_MAX, -1, words);
        report_put_cell(page->out, words);
    }
    fputs("</tr>\n", page->out);
}

/* Writes how a scalar is distributed over a sample; of the lambda ratio, how often it is below 1,
   where flanks touch. */
static void write_distribution(report_page *page, const results_view_variable *of,
                               const double *values)
{
    static const double percents[] = {0, 5, 50, 95, 100};
    size_t kept, below = 0;
    double *list = report_sort(values, page->view->case_count, &kept);
    if (kept > 0) {
        begin_span(page, of);
        for (size_t i = 0; i < sizeof percents / sizeof *percents; i++)
            put_value(page, of, report_percentile(list, kept, percents[i]));
        while (below < kept && list[below] < 1)
            below++;
        fputs("<td>", page->out);
        if (!strcmp(of->output, "lambda_ratio_lowest"))
            fprintf(page->out, "below 1 in %zu of %zu cases (%.3g %%)", below, kept,
                    100 * (double)below / (double)kept);
        fputs("</td></tr>\n", page->out);
    }
    free(list);
}

static void write_spans(report_page *page)
{
    const results_view *view = page->view;
    bool sample = report_is_sample(view);
    fprintf(page->out,
            "<div class=\"wide\"><table class=\"verdict span%s\"><thead><tr><th>quantity</th>"
            "<th>stage</th>",
            sample ? " sample" : "");
    fputs(sample ? "<th>least</th><th>5 %</th><th>median</th><th>95 %</th><th>largest</th><th></th>"
                 : "<th>least</th><th>where</th><th>largest</th><th>where</th>",
          page->out);
    fputs("</tr></thead><tbody>\n", page->out);
    for (size_t v = 0; v < view->variable_count; v++) {
        if (view->variables[v]->rank != 0)
            continue;
        double *values = load_values(page, v);
        (sample ? write_distribution : write_span)(page, view->variables[v], values);
        free(values);
    }
    fputs("</tbody></table></div>\n", page->out);
}

/* The worst first, and among those the most frequent. */
static int compare_checks(const void *a, const void *b)
{
    const report_check *x = a, *y = b;
    if (x->line->verdict != y->line->verdict)
        return x->line->verdict < y->line->verdict ? 1 : -1;
    return (x->count < y->count) - (x->count > y->count);
}

/* What the checks say that are not good in some case, in sentences. */
static void write_reasons(report_page *page)
{
    size_t count, doubts = 0;
    report_check *checks = report_find_checks(page->view, &count);
    if (count > 0)
        qsort(checks, count, sizeof *checks, compare_checks);
    while (doubts < count && checks[doubts].line->verdict != FF_GOOD)
        doubts++;
    for (size_t i = 0; i < doubts; i++) {
        begin_reason(page, i, doubts);
        fprintf(page->out, "<b>%zu of %zu cases</b> %s: ", checks[i].count, page->view->case_count,
                ff_verdict_name(checks[i].line->verdict));
        write_reason(page, checks[i].line);
        fputs("</li>\n", page->out);
    }
    end_reasons(page, doubts);
    free(checks);
}

/* Says how many cases can be trusted, before the reasons. Refused rows of a spectrum have not run.
 */
static void write_counts(report_page *page)
{
    const results_view *view = page->view;
    size_t good = 0, doubtful = 0, bad = 0, failed = 0, idle = 0;
    for (size_t c = 0; c < view->case_count; c++) {
        const char *verdict = view->cases[c]->verdict;
        good += !strcmp(verdict, "good");
        doubtful += !strcmp(verdict, "doubtful");
        bad += !strcmp(verdict, "bad");
        failed += !strcmp(verdict, "failed");
        idle += !*verdict || !strcmp(verdict, "refused");
    }
    fputs("<p class=\"judgement\">", page->out);
    report_put_badge(page->out, failed        ? "failed"
                                : bad         ? "bad"
                                : doubtful    ? "doubtful"
                                : idle < good ? "good"
                                              : "");
    fprintf(page->out, " Of %zu cases %zu are good, %zu doubtful, %zu bad and %zu failed",
            view->case_count, good, doubtful, bad, failed);
    if (idle > 0)
        fprintf(page->out, "; %zu not run", idle);
    fputs(": ", page->out);
    write_checks(page);
    fputs(".</p>\n<p class=\"note\">", page->out);
    report_put_text(page->out, view->summary); /* it also counts warnings, which are no checks */
    fputs("</p>\n", page->out);
}

static void write_study(report_page *page)
{
    bool scalars = false;
    for (size_t v = 0; v < page->view->variable_count; v++)
        scalars = scalars || page->view->variables[v]->rank == 0;
    write_counts(page);
    write_reasons(page);
    if (scalars)
        write_spans(page);
}

void report_write_verdict(report_page *page)
{
    const results_view *view = page->view;
    fputs("<section><h2>Verdict</h2>\n", page->out);
    if (!view->study && strcmp(view->cases[0]->status, "ok") != 0) {
        fputs("<p class=\"alarm\">The run ended as <b>", page->out);
        report_put_text(page->out, view->cases[0]->status);
        fputs("</b>: ", page->out);
        report_put_text(page->out, view->cases[0]->reason);
        fputs("</p>\n", page->out);
    }
    (view->study ? write_study : write_run)(page);
    fputs("</section>\n", page->out);
}
