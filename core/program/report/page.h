/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of core/program/report alone. */
#ifndef REPORT_PAGE_H
#define REPORT_PAGE_H

#include "../results/view.h"
#include "../study/kinds/answer/number.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

/* An output of which the reader asks the best: -1 the least, 1 the largest. */
typedef struct report_sought {
    size_t variable;
    int sense;
} report_sought;

typedef struct report_page {
    const results_view *view;
    const report_sought *goals;
    size_t goal_count;
    FILE *out;
    bool failed;  /* the results could not be read; the view has reported why */
    bool thinned; /* something is drawn with fewer points than it has */
} report_page;

/* page.c: writes text with the special characters of HTML escaped. */
void report_put_text(FILE *out, const char *text);
/* Writes markup of the page's own, with a text in the place of each %s, which is escaped. */
void report_print(FILE *out, const char *html, ...);

/*
 * table.c is the printer of all tables, of the page's sections and of studies alike. It writes, and
 * takes, {"class", "caption", "summary", "folded", "head", "rows"}, all but the rows optional. A
 * row is a list of cells, or {"class", "cells"}. A cell has a text, a number, or a list of parts,
 * such as {"as": "b", "of": "least"}; or it is {"cell": such a part, "class", "head", "si": by
 * which scripts sort, "unit", "span", "title", "share": of its shade}.
 */
void report_put_table(FILE *out, json_t *table);
void report_put_part(FILE *out, json_t *part); /* what stands in a cell, which it takes */
/* A part in an element, "code", in a badge, "badge good", or in a link, "#quality". */
json_t *report_as(const char *kind, const char *text);
json_t *report_badge(const char *verdict); /* a verdict in its colour; "" has none */
json_t *report_cell(const char *class, const char *text);
json_t *report_head(const char *text); /* the head of a row */
/* An SI value as engineers read it; NaN is empty. */
json_t *report_value(const char *name, const char *si_unit, double si);

/* units.c writes numbers as engineers read them. `name` is that of an output or a parameter: it
   tells a temperature from a rise of it. */
study_readable report_unit_for(const char *name, const char *si_unit, double magnitude);
double report_convert(const study_readable *unit, double si);
enum { REPORT_TEXT_SIZE = 200 };
void report_number_text(double value, char out[REPORT_TEXT_SIZE]);
/* Prints an SI value as "22.3 deg". */
void report_quantity_text(const char *name, const char *si_unit, double si,
                          char out[REPORT_TEXT_SIZE]);
/* Prints the error bar of an SI value with the two digits that are known of it. */
void report_bar_text(const char *si_unit, double bar, char out[REPORT_TEXT_SIZE]);
/* Returns what an output is called in a figure, by its doc: "least film thickness" for h_min. */
const char *report_output_words(const results_view_variable *of, char out[REPORT_TEXT_SIZE]);
/* The same of what has no doc: the last word of its path. */
const char *report_plain_name(const char *path, char out[REPORT_TEXT_SIZE]);
/* Returns the value of an axis as the user wrote it, unless that is long. */
const char *report_axis_word(const results_view_axis *axis, size_t point,
                             char out[REPORT_TEXT_SIZE]);
/* Returns the value of an input as a number: of one with several values, such as the relief of two
   gears, that which it was given in words; NaN when it has none. */
double report_axis_number(const results_view_axis *axis, size_t point);
/* Returns the unit in which it is written; of numbers, their SI unit. */
const char *report_axis_unit(const results_view_axis *axis);
/* Names a value of an axis: numbers need a name where several are varied, words speak for
   themselves. */
const char *report_name_value(const results_view *view, const results_view_axis *axis,
                              const char *value, char out[REPORT_TEXT_SIZE]);
/* Names a case by what varies, "lower, 100 N m". */
void report_name_case(const results_view *view, size_t index, char out[REPORT_TEXT_SIZE]);
/* Names a case by what varies along some dimensions alone; `named`: with the names of numbers. */
void report_name_point(const results_view *view, size_t index, const bool *dims, bool named,
                       char out[REPORT_TEXT_SIZE]);
/* Returns the case of combination k of some dimensions, at the first point of the others. */
size_t report_case_of(const results_view *view, const bool *dims, size_t k);
void report_label(const char *words, const study_readable *unit, char out[REPORT_TEXT_SIZE]);

/* find.c: finds parts of the results; -1 when they are missing. */
int report_find_output(const results_view *view, size_t stage, const char *output);
/* Finds the series that dimension dim of a variable is plotted against in a case. */
int report_find_axis(const results_view *view, size_t variable, uint32_t dim, size_t index);
/* Finds the error bar of a variable. */
int report_find_bar(const results_view *view, size_t variable);
bool report_is_bar(const results_view_variable *variable);
/* Whether a series is what another output that the file asks for is plotted against. */
bool report_is_axis(const results_view *view, size_t series);
/* Loads unless something has failed; data is NULL when there is nothing. */
ff_array report_load(report_page *page, int variable, size_t index);
void report_release(report_page *page, ff_array *array);
size_t report_array_size(const ff_array *array);
/* Finds the least and the greatest number of an array, and their ranks; NaN if none is known. */
typedef struct report_extremes {
    size_t least, greatest;
    double low, high;
} report_extremes;
report_extremes report_find_extremes(const ff_array *array);

/* Points along the path of contact: SAP, LPSTC, pitch, HPSTC, tip. */
enum { REPORT_MARKS = 5 };
typedef struct report_marks {
    double roll[REPORT_MARKS]; /* rad; NaN: unknown */
} report_marks;
extern const char *const report_mark_names[REPORT_MARKS];
report_marks report_find_marks(report_page *page, size_t index);

/* described.c writes a value, which it takes, as text in which HTML finds no tag: < occurs within
   strings alone. */
void report_put_json(FILE *out, json_t *value);
/* Writes a list of descriptions: drawings with their sentences and tables. */
void report_put_figures(FILE *out, const char *json);

/* section-quality.c: the worst of the lines of one name over all cases, the first case that has it,
   how many cases have that verdict, and how many have the line. */
typedef struct report_check {
    const results_view_quality *line;
    size_t index, count, total;
} report_check;
/* Returns "good", "doubtful", "bad", or "range" of a line that says that a model is outside of it.
 */
const char *report_verdict_word(const results_view_quality *line);
/* The name of a line; of one that is not good, it leads to what that means. */
json_t *report_line_name(const results_view_quality *line);
/* Returns each line of any case once, in the order of the first case that has it; to be freed. */
report_check *report_find_checks(const results_view *view, size_t *count);

/* find.c: a scalar over the cases, in SI, and how it is shown. */
typedef struct report_scalar {
    report_page *page;
    size_t variable, count;
    double *values;
    double low, high; /* of those that are known; low > high: none is */
    study_readable unit;
    char title[REPORT_TEXT_SIZE], label[REPORT_TEXT_SIZE];
} report_scalar;
/* Loads it; values are to be freed. */
report_scalar report_load_scalar(report_page *page, size_t variable);

/* sample.c: whether the points stand in no order along any input, and each counts as much. */
bool report_is_sample(const results_view *view);
/* Returns the finite values in order, to be freed; percent is 0 to 100, count above 0. */
double *report_sort(const double *values, size_t count, size_t *kept);
double report_percentile(const double *list, size_t count, double percent);

/* section-limits.c: the number that a limit of an output names, in SI; NaN: none does. */
double report_limit_bound(const results_view *view, size_t variable);
/* The limit itself, "> 0.2 um"; NULL: there is none. */
const char *report_limit_asked(const results_view *view, size_t variable);
/* How a case stands to the limits, the worst of them. */
int32_t report_standing(const results_view *view, size_t index);

/* section-best.c: whether the cases are a sweep of several axes. */
bool report_is_sweep(const results_view *view);
/* Paths of the stage that a sweep names first are what is chosen, such as a relief; the others are
   the conditions that are met, such as torques. Marks the dimensions of either that have more than
   one point. */
typedef struct report_sides {
    bool *chosen, *met;
    size_t choices, conditions; /* numbers of their combinations */
} report_sides;
report_sides report_sides_of(const results_view *view);
void report_sides_free(report_sides *sides);
/* Which number of an output is best: -1 the least, 1 the largest, 0 where nothing says it. The
   reader's own choice goes before a limit of the file. */
int report_sense_of(const report_page *page, size_t variable);
/* Finds the case with the least (-1) or largest (1) value among the combinations of some
   dimensions, from the case `first`; SIZE_MAX: no value is known. With `met` cases that miss a
   limit do not count. `same` counts other cases with that value. */
size_t report_find_extreme(const report_scalar *scalar, const bool *dims, size_t count,
                           size_t first, int sense, bool met, size_t *same);
/* Reads "OUTPUT=least" and "OUTPUT=largest"; false with an error in the report. */
bool report_read_sought(const results_view *view, const char *const *best, size_t count,
                        report_sought *out, ff_report *report);
/* Writes which of the values that are chosen are best for each condition; false: it had nothing. */
bool report_write_best(report_page *page);

/* section-grids.c writes a scalar as small tables; false where they would be large. */
bool report_write_grids(const report_scalar *scalar);

/* These write the sections of the page. */
/* Writes how the answers stand to the limits of the file: of a study, in how many cases. */
void report_write_limits(report_page *page);
/* Returns a cell with how a case stands to them, in its colour. */
json_t *report_standing_cell(const results_view *view, size_t index);
void report_write_verdict(report_page *page);
void report_write_study(report_page *page);
void report_write_quality(report_page *page);
/* Writes what the user has given, stage by stage. */
void report_write_inputs(report_page *page);
void report_write_origin(report_page *page);
/* data.c: the numbers that the template draws. */
void report_write_data(report_page *page);

/* data-series.c: parts of them. They are in SI, as 32-bit floats in base64. */
typedef struct report_data {
    report_page *page;
    json_t *outputs; /* {name: what it is called, its units}, of each output that is packed */
} report_data;
/* Packs chosen numbers, or their ranks if `values` is NULL; the first ones if `chosen` is NULL. */
json_t *report_pack(const double *values, const size_t *chosen, size_t count);
json_t *report_describe_unit(const char *name, const char *si, double magnitude);
/* Says what an output is called and how its numbers of such a size are read, unless that is said;
   returns it. */
json_t *report_describe(report_data *d, size_t variable, double magnitude);
double report_magnitude(const ff_array *array); /* 0: nothing is known */
/* Adds a series of a case to the list, if it has points; `rank` is that of the case. */
void report_data_series(report_data *d, json_t *list, size_t variable, size_t index, size_t rank);
/* Returns {name, marks: [[roll angle, "SAP"], ...]} of a case. */
json_t *report_data_case(report_page *page, size_t index, const char *name);

#endif
