/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the answers of a run: what the file asks for, and what needs attention. */
#include "summary.h"
#include "output-text.h"

#include "../terminal/terminal.h"

#include "../accuracy/axis.h"
#include "../accuracy/lines.h"
#include "../memory/memory.h"
#include "../results/label.h"
#include "../study/kinds/answer/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VALUE = 24, BAR = 12, MOST_NAME = 40, VERDICT = 65, ERROR = 9 }; /* columns */
/* Widths, in columns, of the longest name and value among the requested outputs. */
typedef struct print_widths {
    int name, value;
} print_widths;

typedef struct paper {
    const accuracy_record *errors;
    bool colour;
    const char *heading; /* the heading, printed when the first line below it is */
} paper;

/* Prints text in a colour or bold, if the terminal has colours. */
static void paint(const paper *page, const char *code, const char *text)
{
    if (page->colour)
        printf("\033[%sm%s\033[0m", code, text);
    else
        printf("%s", text);
}

static void paint_verdict(const paper *page, int verdict, const char *text)
{
    paint(page, verdict == FF_GOOD ? "32" : verdict == FF_DOUBTFUL ? "33" : "31", text);
}

static void start_line(paper *page)
{
    if (page->heading) {
        putchar('\n');
        paint(page, "1", page->heading);
        putchar('\n');
    }
    page->heading = NULL;
}

static int worst_verdict(const ff_stage *stage)
{
    int worst = -1;
    for (size_t i = 0; i < stage->quality_count; i++)
        if (stage->quality[i].verdict > worst)
            worst = stage->quality[i].verdict;
    return worst;
}

static void print_stage(paper *page, const ff_stage *stage)
{
    study_readable time = study_readable_unit("s", stage->seconds);
    int verdict = worst_verdict(stage);
    const char *word = verdict < 0 ? "" : ff_verdict_name(verdict);
    if (stage->status != FF_OK) {
        verdict = stage->status == FF_DOMAIN ? FF_DOUBTFUL : FF_BAD;
        word = results_status_name(stage);
    }
    start_line(page);
    int column = printf("  %-16s  ", stage->name);
    if (stage->seconds > 0)
        column += printf("%-32s  %6.3g %s", stage->use, stage->seconds * time.factor, time.unit);
    else /* a law by itself takes no time */
        column += printf("%s", stage->use);
    if (*word) {
        printf("%*s", VERDICT - column, "");
        paint_verdict(page, verdict, word);
    }
    putchar('\n');
}

static void print_result(const paper *page, const ff_pipeline *pipeline, const ff_stage *stage,
                         size_t output, int width)
{
    const ff_port *row = stage->results[output].row;
    cli_output_text text = cli_output_text_of(page->errors, pipeline, stage, output, false);
    int column = printf("  %-*s  %-*s  ", width, row->name,
                        VALUE + (page->errors->count > 0 ? BAR : 0), text.value);
    char *words = memory_print_text("%s%s%s", row->doc, *text.place ? "; " : "", text.place);
    terminal_print_wrapped(words, column, column);
    free(words);
}

/* Prints a requested output: its name and value, and the place of its extremes if the line has
 * room. */
static void print_requested(const paper *page, const ff_pipeline *pipeline,
                            const results_requested *output, print_widths widths)
{
    char label[RESULTS_LABEL_SIZE];
    cli_output_text text =
        cli_output_text_of(page->errors, pipeline, output->stage, output->output, true);
    int column = printf("  %-*s  %-*s  ", widths.name, output->name, widths.value, text.value);
    const int room = terminal_width() - column;
    const int left = room - (int)(*text.place ? strlen("; ") + strlen(text.place) : 0);
    const char *doc = results_called(output->stage->results[output->output].row);
    results_label(doc, left > 0 ? (size_t)left : 0, label);
    bool fits = *text.place && (int)strlen(label) <= left;
    if (!fits)
        results_label(doc, room > 0 ? (size_t)room : 0, label);
    char *words = memory_print_text("%s%s%s", label, fits ? "; " : "", fits ? text.place : "");
    terminal_print_cut(words, column);
    free(words);
}

/* Whether an output is shown: it was requested, or is a scalar. */
static bool is_shown(const ff_stage *stage, size_t output)
{
    const ff_result *result = &stage->results[output];
    return result->data && (result->requested || result->rank == 0);
}

static void print_results(paper *page, const ff_pipeline *pipeline, const ff_stage *stage)
{
    int width = 0;
    page->heading = stage->name;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        int columns = (int)strlen(stage->results[i].row->name);
        if (is_shown(stage, i) && columns > width)
            width = columns < MOST_NAME ? columns : MOST_NAME;
    }
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        if (!is_shown(stage, i))
            continue;
        start_line(page);
        print_result(page, pipeline, stage, i, width);
    }
}

/* Whether the output is a field or an axis of others, which a line cannot show. */
static bool is_array_only(const ff_result *result, const ff_result *const *axes)
{
    while (*axes && *axes != result)
        axes++;
    return result->rank > 1 || *axes;
}

static int widest(int width, const char *text)
{
    const int own = (int)strlen(text);
    return own > width ? own : width;
}

/* Prints what the file requests, in its order: a line for each output except fields and axes. */
static void print_answer(paper *page, const ff_pipeline *pipeline)
{
    size_t count;
    results_requested *list = results_list_requested(pipeline, &count);
    const ff_result **axes = results_axes(pipeline);
    char *arrays = memory_print_text("%s", "");
    print_widths widths = {0, 0};
    for (size_t i = 0; i < count; i++) {
        if (is_array_only(&list[i].stage->results[list[i].output], axes)) {
            memory_add_text(&arrays, "%s%s", *arrays ? ", " : "", list[i].name);
            continue;
        }
        const cli_output_text text =
            cli_output_text_of(page->errors, pipeline, list[i].stage, list[i].output, true);
        widths.name = widest(widths.name, list[i].name);
        widths.value = widest(widths.value, text.value);
    }
    widths.name = widths.name < MOST_NAME ? widths.name : MOST_NAME;
    putchar('\n');
    for (size_t i = 0; i < count; i++) {
        if (!is_array_only(&list[i].stage->results[list[i].output], axes))
            print_requested(page, pipeline, &list[i], widths);
    }
    if (*arrays)
        terminal_print_cut(arrays, printf("  only in the results: "));
    free(arrays);
    free(axes);
    results_free_requested(list, count);
}

/* Prints a count of the limits that are met, and each limit that is not surely met. */
static void print_limits(const paper *page, const limits_verdict *limits)
{
    static const int colours[LIMITS_STANDINGS] = {FF_GOOD, FF_DOUBTFUL, FF_BAD};
    char *sentence = limits_sentence(limits);
    if (*sentence) {
        paint_verdict(page, colours[limits->worst], sentence);
        putchar('\n');
    }
    for (size_t i = 0; i < limits->count; i++) {
        const limits_row *row = &limits->rows[i];
        const ff_port *port = row->stage->results[row->output].row;
        study_readable unit = study_readable_output(port->name, port->unit, fabs(row->value));
        if (row->standing == LIMITS_MET)
            continue;
        printf("  %s: ", row->name);
        paint_verdict(page, colours[row->standing], limits_word(row->standing));
        printf(", required is %s, the answer is ", row->asked);
        if (isnan(row->value)) {
            puts("not known");
            continue;
        }
        char number[STUDY_NUMBER_SIZE];
        study_number_text(row->value * unit.factor + unit.offset, 5, " ", number);
        printf("%s%s", isinf(row->bar) ? ">= " : "", number);
        study_number_text(row->bar * unit.factor, 2, " ", number);
        if (row->bar > 0 && !isinf(row->bar))
            printf(" +- %s", number);
        printf("%s%s\n", *unit.unit ? " " : "", unit.unit);
    }
    free(sentence);
}

/* The quality lines of the stages are printed below three headings: doubts that the file accepts,
 * numbers in doubt, and models outside their range. */
typedef enum { ACCEPTED, OF_NUMBERS, OF_RANGE } lines;

static bool is_among(const ff_quality *line, lines which)
{
    return which == ACCEPTED ? line->accepted != NULL
                             : line->verdict != FF_GOOD && line->range == (which == OF_RANGE);
}

static void print_quality(paper *page, const ff_stage *stage, lines which)
{
    for (size_t i = 0; i < stage->quality_count; i++) {
        const ff_quality *line = &stage->quality[i];
        const char *verdict = ff_verdict_name(line->verdict);
        const char *text = which == ACCEPTED ? line->accepted : line->text;
        if (!is_among(line, which))
            continue;
        start_line(page);
        char value[STUDY_NUMBER_SIZE];
        study_number_short(line->value, value);
        int column =
            printf("  %s.%s = %s, limit %.3g: ", stage->name, line->name, value, line->limit);
        if (which == OF_NUMBERS) {
            column += (int)strlen(verdict);
            paint_verdict(page, line->verdict, verdict);
            column += text ? printf(", ") : 0;
        }
        terminal_print_wrapped(text ? text : "", column, 4);
    }
}

/* Prints remarks of the models; their warnings are in the report. */
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
        if (strcmp(level, "info") != 0)
            continue;
        start_line(page);
        terminal_print_wrapped(text, printf("  %s: ", stage), 4);
    }
}

static bool is_missed(const accuracy_error *e)
{
    return !isnan(e->goal) && !(e->reached <= e->goal);
}

/* Prints for one output the measured error, the goal of the file, and the sources of the error. */
static void print_error_row(const paper *page, const accuracy_error *e, int width)
{
    char *error = accuracy_print_reached(e), *rest = accuracy_describe(e);
    char *goal = accuracy_print_goal(e);
    char *name = memory_print_text("%s.%s", e->stage->name, e->result->row->name);
    int column = printf("  %-*s  %-*s ", width, name, ERROR - 1, error);
    if (page->errors->attempts > 0)
        column += printf("%-*s", ERROR, goal);
    int start = column;
    if (is_missed(e)) {
        paint_verdict(page, FF_DOUBTFUL, "not reached");
        column += (int)strlen("not reached") + printf("%s", *rest ? "; " : "");
    }
    terminal_print_wrapped(rest, column, start);
    if (page->errors->checked) {
        char *check = accuracy_print_check(page->errors, e);
        terminal_print_wrapped(check, printf("%*s", start, ""), start);
        free(check);
    }
    free(goal);
    free(name);
    free(rest);
    free(error);
}

/* Prints how the search for the accuracy ended. */
static void print_search(const accuracy_record *errors, size_t missed)
{
    if (missed > 0 && *errors->fixed)
        terminal_print_wrapped(errors->fixed, printf("  settings fixed by the file: "), 4);
    else if (missed > 0 && errors->attempts > 1)
        puts("  a repeat with the settings predicted from the observed order of convergence did "
             "not reach the other goals");
    else if (missed > 0)
        puts("  no finer settings that the search may try are expected to reach the other goals");
    char *text = memory_print_text(
        "%s", errors->chosen_count ? "" : "nothing: the file leaves no setting open");
    for (size_t i = 0; i < errors->chosen_count; i++)
        memory_add_text(&text, "%s%s", i ? ", " : "", errors->chosen[i]);
    terminal_print_wrapped(text, printf("  chosen: "), 4);
    free(text);
}

/* Counts the outputs with a goal, and those that miss it; returns the width of the longest name. */
static int survey_errors(const accuracy_record *errors, size_t *goals, size_t *missed)
{
    size_t width = strlen("output");
    for (size_t i = 0; i < errors->count; i++) {
        const accuracy_error *e = &errors->errors[i];
        size_t own = strlen(e->stage->name) + 1 + strlen(e->result->row->name);
        *goals += isnan(e->goal) ? 0 : 1;
        *missed += is_missed(e);
        if (e->relative != 0 && own > width)
            width = own;
    }
    return (int)width;
}

/* Prints which goals were reached, and the sources of error, the largest first. A twin is a second
 * run of the file with other settings. */
static void print_errors(paper *page, const results_outcome *outcome)
{
    const accuracy_record *errors = outcome->errors;
    const bool asked = errors->attempts > 0;
    size_t goals = 0, missed = 0;
    const int width = survey_errors(errors, &goals, &missed);
    char heading[120] = "Errors, measured by twins";
    if (asked)
        snprintf(heading, sizeof heading, "Accuracy, measured by twins: %zu of %zu goals reached",
                 goals - missed, goals);
    page->heading = heading;
    if (errors->count > 0) {
        start_line(page);
        printf("  %-*s  %-*s%s\n", width, "output", asked ? ERROR : 0, "error",
               asked ? "goal" : "");
    } else if (asked) {
        start_line(page);
        puts("  no error is measured: no requested output is a scalar or a series of finite "
             "numbers");
    }
    for (size_t i = 0; i < errors->count; i++)
        if (errors->errors[i].relative != 0) /* errors of the others do not depend on settings */
            print_error_row(page, &errors->errors[i], width);
    if (errors->failure)
        terminal_print_wrapped(errors->failure, printf("  a twin failed: "), 4);
    if (asked)
        print_search(errors, missed);
    if (errors->count > 0) {
        const size_t twins = accuracy_twin_count(errors);
        printf("  %zu %s", twins, twins == 1 ? "twin" : "twins");
        if (asked)
            printf(" and %zu earlier %s", errors->attempts - 1,
                   errors->attempts == 2 ? "attempt" : "attempts");
        printf(": %.3g s of CPU time\n", accuracy_seconds(errors));
    }
    page->heading = NULL;
}

/* Prints each stage with its time, and everything that was computed. */
static void print_everything(paper *page, const ff_pipeline *pipeline)
{
    page->heading = "Stages";
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        if (stage->ran || stage->status != FF_OK)
            print_stage(page, stage);
    }
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[pipeline->order[i]].ran)
            print_results(page, pipeline, &pipeline->stages[pipeline->order[i]]);
}

/* Prints the stages that failed. */
static void print_failures(paper *page, const ff_pipeline *pipeline)
{
    page->heading = "Stages that failed";
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[pipeline->order[i]].status != FF_OK)
            print_stage(page, &pipeline->stages[pipeline->order[i]]);
}

/* Prints what ran, how many checks were good, and where to find more. */
static void print_tally(const ff_pipeline *pipeline)
{
    size_t ran = 0, checks = 0, good = 0;
    double seconds = 0;
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        ran += stage->ran ? 1 : 0;
        seconds += stage->ran ? stage->seconds : 0;
        for (size_t k = 0; stage->ran && k < stage->quality_count; k++) {
            checks++;
            good += stage->quality[k].verdict == FF_GOOD ? 1 : 0;
        }
    }
    if (ran > 0)
        printf("\n%zu %s in %.3g s, %zu of %zu checks good; --all prints everything that was "
               "computed\n",
               ran, ran == 1 ? "stage" : "stages", seconds, good, checks);
}

void cli_print_summary(const results_outcome *outcome, bool all)
{
    const ff_pipeline *pipeline = outcome->pipeline;
    paper page = {.errors = outcome->errors, .colour = terminal_colour(stdout)};
    char title[400];
    ff_clean_text(title, sizeof title, pipeline->title ? pipeline->title : outcome->input->file);
    paint(&page, "1", title);
    putchar('\n');
    print_limits(&page, outcome->limits);
    if (all)
        print_everything(&page, pipeline);
    else
        print_answer(&page, pipeline);
    if (!all)
        print_failures(&page, pipeline);
    print_log(&page, outcome->log);
    print_errors(&page, outcome);
    static const char *const headings[] = {
        [ACCEPTED] = "Doubts that the file accepts",
        [OF_NUMBERS] = "Numbers in doubt (the report page and the guide say what each means)",
        [OF_RANGE] = "Models outside their range"};
    for (int which = ACCEPTED; which <= OF_RANGE; which++) {
        page.heading = headings[which];
        for (size_t i = 0; i < pipeline->count; i++)
            print_quality(&page, &pipeline->stages[pipeline->order[i]], (lines)which);
    }
    if (!all)
        print_tally(pipeline);
}
