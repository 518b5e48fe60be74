/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the answers and verdicts at the top of the page. */
#include <flankfilm/engine.h>

#include "page.h"

#include "../memory/memory.h"
#include "../results/json.h"
#include "../results/label.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LABEL = 60 }; /* length of an output's description in bytes, if it has several clauses */

/* Prints "roll angle 22.3 deg, single contact". */
static void print_place(report_page *page, FILE *out, int axis, double at)
{
    char text[REPORT_TEXT_SIZE], words[REPORT_TEXT_SIZE];
    const results_view_variable *along = page->view->variables[axis];
    report_quantity_text(along->output, along->unit, at, text);
    bool roll = !strcmp(along->output, "roll_angle");
    fprintf(out, "%s %s", roll ? "roll angle" : report_output_words(along, words), text);
    if (!roll)
        return;
    report_marks marks = report_find_marks(page, 0);
    if (at >= marks.roll[1] && at <= marks.roll[3])
        fputs(", single contact", out);
    else if (at < marks.roll[1])
        fputs(", double contact, approach", out);
    else if (at > marks.roll[3])
        fputs(", double contact, recess", out);
}

/* Prints a number, with " +- 0.4 nm" if its error was measured. */
static void print_number(report_page *page, FILE *out, size_t variable, double value, size_t at)
{
    const results_view_variable *of = page->view->variables[variable];
    char text[REPORT_TEXT_SIZE];
    report_quantity_text(of->output, of->unit, value, text);
    fputs(text, out);
    ff_array bar = report_load(page, report_find_bar(page->view, variable), 0);
    if (bar.data && at < report_array_size(&bar) && bar.data[at] > 0) {
        report_bar_text(of->unit, bar.data[at], text);
        fprintf(out, " \u00b1 %s", text);
    }
    report_release(page, &bar);
}

/* Prints a value, the values of both gears, or the range of a series, and then where its extremes
 * are. */
static void print_values(report_page *page, size_t variable, const ff_array *y, FILE *out,
                         FILE *where)
{
    const results_view_variable *of = page->view->variables[variable];
    int axis = of->rank == 1 ? report_find_axis(page->view, variable, 0, 0) : -1;
    ff_array x = report_load(page, axis, 0);
    size_t count = report_array_size(y);
    bool pair = count == 2 && axis < 0;
    const bool share = *of->whole && of->extremes[0] < count && of->extremes[1] < count;
    report_extremes at = report_find_extremes(y);
    if (pair || share) {
        at.least = pair ? 0 : of->extremes[0];
        at.greatest = pair ? 1 : of->extremes[1];
    }
    double least = y->data[at.least], greatest = y->data[at.greatest];
    bool varies = pair || greatest > least;
    fputs(of->flags & RESULTS_VIEW_AT_LEAST ? "\u2265 " : "", out);
    print_number(page, out, variable, least, at.least);
    if (varies) {
        fputs(pair ? ", " : " to ", out);
        print_number(page, out, variable, greatest, at.greatest);
    }
    if (x.data && report_array_size(&x) == count && !pair && varies) {
        fputs("least at ", where);
        print_place(page, where, axis, x.data[at.least]);
        fputs("; largest at ", where);
        print_place(page, where, axis, x.data[at.greatest]);
    }
    if (share) {
        char words[REPORT_TEXT_SIZE];
        fprintf(where, "; where %s is above 1 %% of its largest",
                report_plain_name(of->whole, words));
    }
    report_release(page, &x);
}

/* Returns the row of an output: description, name, values, and places; NULL if it has no values. */
static json_t *output_row(report_page *page, size_t variable)
{
    const results_view_variable *of = page->view->variables[variable];
    ff_array y = report_load(page, (int)variable, 0);
    json_t *row = NULL;
    if (y.data && report_array_size(&y) > 0) {
        char label[RESULTS_LABEL_SIZE], *values = NULL, *where = NULL;
        size_t length;
        FILE *out = memory_require(open_memstream(&values, &length)),
             *place = memory_require(open_memstream(&where, &length));
        results_label(of->doc, LABEL, label);
        print_values(page, variable, &y, out, place);
        fclose(out);
        fclose(place);
        row = json_pack("[o, o, o, o]", report_head(label), report_as("code", of->name),
                        report_cell("number", values), results_json_text(where));
        free(values);
        free(where);
    }
    report_release(page, &y);
    return row;
}

/* Counts the good, doubtful and bad lines and, under FF_RANGE, those about models outside their
 * range. */
static void count_verdicts(const results_view *view, size_t counts[FF_RANGE + 1])
{
    for (size_t c = 0; c < view->case_count; c++)
        for (size_t i = 0; i < view->cases[c]->quality_count; i++) {
            const results_view_quality *line = view->cases[c]->quality[i];
            counts[line->verdict == FF_GOOD                            ? FF_GOOD
                   : line->range                                       ? FF_RANGE
                   : line->verdict < FF_GOOD || line->verdict > FF_BAD ? FF_BAD
                                                                       : line->verdict]++;
        }
}

static void write_checks(report_page *page)
{
    size_t counts[FF_RANGE + 1] = {0};
    count_verdicts(page->view, counts);
    fprintf(
        page->out,
        "<a href=\"#quality\">%zu checks good, %zu doubtful, %zu bad, %zu outside the range of a "
        "model</a>",
        counts[FF_GOOD], counts[FF_DOUBTFUL], counts[FF_BAD], counts[FF_RANGE]);
}

enum { SHOWN = 6 }; /* reasons shown; the others are folded */

/* Begins item i of a list of `count` reasons. */
static void begin_reason(report_page *page, size_t item, size_t count)
{
    if (item == 0)
        fputs("<ul>\n", page->out);
    if (item == SHOWN)
        fprintf(page->out, "</ul>\n<details><summary>%zu more reason%s</summary>\n<ul>\n",
                count - SHOWN, count == SHOWN + 1 ? "" : "s");
    fputs("<li>", page->out);
}

static void end_reasons(report_page *page, size_t count)
{
    fputs(count > 0 ? "</ul>\n" : "", page->out);
    fputs(count > SHOWN ? "</details>\n" : "", page->out);
}

/* Writes "film: the domain ends ... (starvation 0.0124, limit 0.01)". */
static void write_reason(report_page *page, const results_view_quality *line)
{
    char value[REPORT_TEXT_SIZE], limit[REPORT_TEXT_SIZE];
    char words[REPORT_TEXT_SIZE], name[REPORT_TEXT_SIZE];
    const size_t length = strlen(line->name), end = strlen("_error");
    report_print(page->out, "%s: ", page->view->stages[line->stage]->name);
    if (!strncmp(line->text, "measured", 8) && length > end && length < sizeof name) {
        snprintf(name, sizeof name, "%.*s", (int)(length - end), line->name);
        const int of = report_find_output(page->view, line->stage, name);
        report_print(page->out, "error of the %s, ",
                     of < 0 ? report_plain_name(name, words)
                            : report_output_words(page->view->variables[of], words));
    }
    report_put_text(page->out, *line->text ? line->text : line->name);
    report_number_text(line->value, value);
    report_number_text(line->limit, limit);
    fputs(" <small>(", page->out);
    report_put_part(page->out, report_line_name(line));
    report_print(page->out, " = %s, limit %s)</small>", value, limit);
}

/* Writes the doubts of a run that the file accepts, and why. */
static void write_accepted(report_page *page)
{
    const results_view_case *c = page->view->cases[0];
    size_t listed = 0;
    for (size_t i = 0; i < c->quality_count; i++) {
        const results_view_quality *line = c->quality[i];
        if (!*line->accepted)
            continue;
        fputs(listed++ ? "; " : "<p class=\"note\">Doubts that the file accepts: ", page->out);
        report_print(page->out, "%s.%s (%s)", page->view->stages[line->stage]->name, line->name,
                     line->accepted);
    }
    fputs(listed ? "</p>\n" : "", page->out);
}

/* Writes the texts of the lines that are not good: those about the numbers, or those about the
 * ranges of models. */
static void write_doubts(report_page *page, size_t count, bool range)
{
    const results_view_case *c = page->view->cases[0];
    size_t listed = 0;
    for (size_t i = 0; i < c->quality_count; i++) {
        if (c->quality[i]->verdict == FF_GOOD || c->quality[i]->range != range)
            continue;
        begin_reason(page, listed++, count);
        write_reason(page, c->quality[i]);
        fputs("</li>\n", page->out);
    }
    end_reasons(page, listed);
}

/* Writes the two verdicts of a run: on the numbers, and on the ranges of the models. */
static void write_judgement(report_page *page)
{
    size_t counts[FF_RANGE + 1] = {0};
    count_verdicts(page->view, counts);
    fputs("<p class=\"judgement\">", page->out);
    report_put_part(page->out, report_badge(page->view->cases[0]->verdict));
    if (counts[FF_DOUBTFUL] + counts[FF_BAD] == 0)
        fprintf(page->out,
                " No check casts doubt on these numbers: <a href=\"#quality\">all %zu are "
                "good</a>.</p>\n",
                counts[FF_GOOD]);
    else
        fprintf(page->out,
                " %s: <a href=\"#quality\">%zu checks are good</a>, %zu doubtful, "
                "%zu bad:</p>\n",
                counts[FF_BAD] ? "Some of these numbers are wrong"
                               : "Some of these numbers are in doubt",
                counts[FF_GOOD], counts[FF_DOUBTFUL], counts[FF_BAD]);
    write_doubts(page, counts[FF_DOUBTFUL] + counts[FF_BAD], false);
    if (counts[FF_RANGE] > 0)
        fprintf(page->out,
                "<p class=\"judgement\"><span class=\"badge range\">range</span> %s outside %s "
                "range; the numbers are not corrected for this:</p>\n",
                counts[FF_RANGE] == 1 ? "A model is used" : "Models are used",
                counts[FF_RANGE] == 1 ? "its" : "their");
    write_doubts(page, counts[FF_RANGE], true);
    write_accepted(page);
}

/* Whether the table has a row for an output: it was requested, or is another computed scalar.
 * Fields and axes are in the figures. */
static bool has_row(const results_view *view, size_t v, bool asked)
{
    const results_view_variable *of = view->variables[v];
    if (((of->flags & RESULTS_VIEW_ASKED) != 0) != asked || report_is_bar(of))
        return false;
    return of->rank == 0 || (of->rank == 1 && asked && !report_is_axis(view, v));
}

static size_t count_rows(const results_view *view, bool asked)
{
    size_t count = 0;
    for (size_t v = 0; v < view->variable_count; v++)
        count += has_row(view, v, asked) ? 1 : 0;
    return count;
}

static void write_table(report_page *page, bool asked, size_t count)
{
    json_t *rows = json_array();
    char *more = memory_print_text("%zu more computed value%s", count, count == 1 ? "" : "s");
    for (size_t v = 0; v < page->view->variable_count; v++)
        if (has_row(page->view, v, asked)) {
            json_t *row = output_row(page, v);
            if (row)
                json_array_append_new(rows, row);
        }
    json_t *table = json_pack("{s:s, s:[s, s, s, s], s:o, s:i, s:s}", "class", "verdict run",
                              "head", "quantity", "output", "value", "where", "rows", rows,
                              "folded", 1, "summary", asked ? "" : more);
    if (count > 0)
        report_put_table(page->out, table);
    else
        json_decref(table);
    free(more);
}

/* Writes the requested outputs, in the order of the file, and other computed scalars in a folded
 * table. */
static void write_run(report_page *page)
{
    write_judgement(page);
    write_table(page, true, count_rows(page->view, true));
    write_table(page, false, count_rows(page->view, false));
}

static json_t *value_cell(const report_scalar *f, double value)
{
    const results_view_variable *of = f->page->view->variables[f->variable];
    return report_value(of->output, of->unit, value);
}

/* Adds the least and the largest value of a scalar over the cases, and the first cases with them.
 */
static void add_span(const report_scalar *f, json_t *row)
{
    const double ends[] = {f->low, f->high};
    char words[REPORT_TEXT_SIZE];
    for (int side = 0; side < 2; side++) {
        size_t at = 0;
        while (!(f->values[at] == ends[side]))
            at++;
        report_name_case(f->page->view, at, words);
        json_array_append_new(row, value_cell(f, ends[side]));
        json_array_append_new(row, results_json_text(words));
    }
}

/* Adds how a scalar is distributed over a sample. */
static void add_distribution(const report_scalar *f, json_t *row)
{
    static const double percents[] = {0, 5, 50, 95, 100};
    size_t kept;
    double *list = report_sort(f->values, f->count, &kept);
    for (size_t i = 0; i < sizeof percents / sizeof *percents; i++)
        json_array_append_new(row, value_cell(f, report_percentile(list, kept, percents[i])));
    free(list);
}

static void write_spans(report_page *page)
{
    const results_view *view = page->view;
    const bool sample = report_is_sample(view);
    json_t *rows = json_array();
    json_t *head = sample ? json_pack("[s, s, s, s, s, s, s]", "quantity", "stage", "least", "5 %",
                                      "median", "95 %", "largest")
                          : json_pack("[s, s, s, s, s, s]", "quantity", "stage", "least", "where",
                                      "largest", "where");
    for (size_t v = 0; v < view->variable_count; v++) {
        const results_view_variable *of = view->variables[v];
        char words[REPORT_TEXT_SIZE];
        if (of->rank != 0 || report_is_bar(of))
            continue;
        report_scalar f = report_load_scalar(page, v);
        if (f.low <= f.high) {
            json_t *row = json_pack("[o, o]", report_head(report_output_words(of, words)),
                                    results_json_text(view->stages[of->stage]->name));
            (sample ? add_distribution : add_span)(&f, row);
            json_array_append_new(rows, row);
        }
        free(f.values);
    }
    report_put_table(page->out, json_pack("{s:s+, s:o, s:o}", "class", "verdict span",
                                          sample ? " sample" : "", "head", head, "rows", rows));
}

/* Sorts the worst lines first, and equally bad lines by frequency. */
static int compare_checks(const void *a, const void *b)
{
    const report_check *x = a, *y = b;
    if (x->line->verdict != y->line->verdict)
        return x->line->verdict < y->line->verdict ? 1 : -1;
    return (x->count < y->count) - (x->count > y->count);
}

/* Writes sentences on the checks that are not good in some case. */
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
                report_verdict_word(checks[i].line));
        write_reason(page, checks[i].line);
        fputs("</li>\n", page->out);
    }
    end_reasons(page, doubts);
    free(checks);
}

/* Writes how many cases can be trusted, and then the reasons. Refused rows of a spectrum have not
 * run. */
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
    report_put_part(page->out, report_badge(failed        ? "failed"
                                            : bad         ? "bad"
                                            : doubtful    ? "doubtful"
                                            : idle < good ? "good"
                                                          : ""));
    fprintf(page->out, " Of %zu cases, %zu are good, %zu doubtful, %zu bad and %zu failed",
            view->case_count, good, doubtful, bad, failed);
    if (idle > 0)
        fprintf(page->out, "; %zu not run", idle);
    fputs(": ", page->out);
    write_checks(page);
    fputs(".</p>\n", page->out);
}

static void write_study(report_page *page)
{
    bool scalars = false;
    for (size_t v = 0; v < page->view->variable_count; v++)
        scalars = scalars || page->view->variables[v]->rank == 0;
    write_counts(page);
    const bool best = report_write_best(page);
    /* it also counts warnings, which are not checks */
    report_print(page->out, "<p class=\"note\">%s</p>\n", page->view->summary);
    write_reasons(page);
    fputs(best ? "<details><summary>Least and largest of all cases</summary>\n" : "", page->out);
    if (scalars)
        write_spans(page);
    fputs(best ? "</details>\n" : "", page->out);
}

void report_write_verdict(report_page *page)
{
    const results_view *view = page->view;
    report_print(page->out, "<section class=\"%s\"><div><h2>Verdict</h2>\n",
                 view->study ? "study" : "answer");
    if (!view->study && strcmp(view->cases[0]->status, "ok") != 0) {
        report_print(page->out, "<p class=\"alarm\">The run did not succeed (<b>%s</b>): %s</p>\n",
                     view->cases[0]->status, view->cases[0]->reason);
    }
    report_write_limits(page);
    (view->study ? write_study : write_run)(page);
    fputs("</div><div><h2>Inputs</h2>\n", page->out);
    report_write_inputs(page);
    fputs("</div></section>\n", page->out);
}
