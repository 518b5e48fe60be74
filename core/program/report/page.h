/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions shared by the files of core/program/report. */
#ifndef REPORT_PAGE_H
#define REPORT_PAGE_H

#include "../results/view.h"
#include "../study/kinds/answer/number.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

/* An output whose best value the user requested: -1 for the least, 1 for the largest. */
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
    bool thinned; /* some figure shows fewer points than the results have */
} report_page;

/* page.c: writes text with the special characters of HTML escaped. */
void report_put_text(FILE *out, const char *text);
/* Writes markup; each %s is replaced by an escaped text. */
void report_print(FILE *out, const char *html, ...);

/* table.c prints all tables of the page. It writes and frees {"class", "caption", "summary",
 * "folded", "head", "rows"}, of which only the rows are required. A row is a list of cells, or
 * {"class", "cells"}. A cell is a text, a number, or a list of parts such as {"as": "b", "of":
 * "least"}; or it is {"cell": one of these, "class", "head", "si": key for sorting, "unit", "span",
 * "title", "share": strength of its shading}. */
void report_put_table(FILE *out, json_t *table);
void report_put_part(FILE *out, json_t *part); /* writes and frees the content of a cell */
/* Returns a part in an element ("code"), in a badge ("badge good"), or as a link ("#quality"). */
json_t *report_as(const char *kind, const char *text);
json_t *report_badge(const char *verdict); /* a verdict in its colour; "" for none */
json_t *report_cell(const char *class, const char *text);
json_t *report_head(const char *text); /* the head of a row */
/* An SI value in a readable unit; empty for NaN. */
json_t *report_value(const char *name, const char *si_unit, double si);

/* units.c writes numbers in readable units. `name`, of an output or a parameter, distinguishes a
   temperature from a temperature rise. */
study_readable report_unit_for(const char *name, const char *si_unit, double magnitude);
double report_convert(const study_readable *unit, double si);
enum { REPORT_TEXT_SIZE = 200 };
void report_number_text(double value, char out[REPORT_TEXT_SIZE]);
/* Prints an SI value as "22.3 deg". */
void report_quantity_text(const char *name, const char *si_unit, double si,
                          char out[REPORT_TEXT_SIZE]);
/* Prints the error bar of an SI value with two digits. */
void report_bar_text(const char *si_unit, double bar, char out[REPORT_TEXT_SIZE]);
/* Returns the name of an output in a figure, from its doc: "minimum film thickness" for h_min. */
const char *report_output_words(const results_view_variable *of, char out[REPORT_TEXT_SIZE]);
/* Returns the name of a path, which has no doc: its last word. */
const char *report_plain_name(const char *path, char out[REPORT_TEXT_SIZE]);
/* Returns the value of an axis as the user wrote it, unless that is long. */
const char *report_axis_word(const results_view_axis *axis, size_t point,
                             char out[REPORT_TEXT_SIZE]);
/* Returns the value of an input as a number; of several values, such as the relief of two gears,
 * the first one. NaN if it is not a number. */
double report_axis_number(const results_view_axis *axis, size_t point);
/* Returns the unit in which the value is written; for plain numbers, the SI unit. */
const char *report_axis_unit(const results_view_axis *axis);
/* Writes the value of an axis. If several inputs are varied, numbers are preceded by their names;
 * words are not. */
const char *report_name_value(const results_view *view, const results_view_axis *axis,
                              const char *value, char out[REPORT_TEXT_SIZE]);
/* Writes a case by its varied values, "lower, 100 N m". */
void report_name_case(const results_view *view, size_t index, char out[REPORT_TEXT_SIZE]);
/* Writes a case by its values along some dimensions; `named`: numbers with their names. */
void report_name_point(const results_view *view, size_t index, const bool *dims, bool named,
                       char out[REPORT_TEXT_SIZE]);
/* Returns the case of combination k of some dimensions, at the first point of the others. */
size_t report_case_of(const results_view *view, const bool *dims, size_t k);
void report_label(const char *words, const study_readable *unit, char out[REPORT_TEXT_SIZE]);

/* find.c: these find parts of the results and return -1 if they are missing. */
int report_find_output(const results_view *view, size_t stage, const char *output);
/* Finds the series against which dimension `dim` of a variable is plotted in a case. */
int report_find_axis(const results_view *view, size_t variable, uint32_t dim, size_t index);
/* Finds the error bar of a variable. */
int report_find_bar(const results_view *view, size_t variable);
bool report_is_bar(const results_view_variable *variable);
/* Whether a requested output is plotted against this series. */
bool report_is_axis(const results_view *view, size_t series);
/* Loads a variable unless something has failed; data is NULL if there is none. */
ff_array report_load(report_page *page, int variable, size_t index);
void report_release(report_page *page, ff_array *array);
size_t report_array_size(const ff_array *array);
/* Finds the least and the greatest number of an array, and their indices; NaN if none is known. */
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

/* described.c writes and frees a JSON value as text that HTML cannot mistake for a tag: "<" occurs
 * only in strings and is escaped. */
void report_put_json(FILE *out, json_t *value);
/* Writes a list of descriptions: figures with their sentences and tables. */
void report_put_figures(FILE *out, const char *json);

/* section-quality.c: the worst line of one name over all cases, the first case with it, the number
 * of cases with that verdict, and the number of cases with the line. */
typedef struct report_check {
    const results_view_quality *line;
    size_t index, count, total;
} report_check;
/* Returns "good", "doubtful", "bad", or "range" for a line about the range of a model. */
const char *report_verdict_word(const results_view_quality *line);
/* Returns the name of a line; if the line is not good, as a link to its meaning. */
json_t *report_line_name(const results_view_quality *line);
/* Returns each line once, in the order of the first cases that have them; to be freed. */
report_check *report_find_checks(const results_view *view, size_t *count);

/* find.c: a scalar over the cases, in SI, and its readable unit. */
typedef struct report_scalar {
    report_page *page;
    size_t variable, count;
    double *values;
    double low, high; /* range of the known values; low > high if none is known */
    study_readable unit;
    char title[REPORT_TEXT_SIZE], label[REPORT_TEXT_SIZE];
} report_scalar;
/* Loads the scalar; its values are to be freed. */
report_scalar report_load_scalar(report_page *page, size_t variable);

/* sample.c: whether the cases are a sample: not ordered along any input, and of equal weight. */
bool report_is_sample(const results_view *view);
/* Returns the finite values in order, to be freed; percent is 0 to 100, count above 0. */
double *report_sort(const double *values, size_t count, size_t *kept);
double report_percentile(const double *list, size_t count, double percent);

/* section-limits.c: the number in an output's limit, in SI; NaN if it has no limit. */
double report_limit_bound(const results_view *view, size_t variable);
/* The limit itself, "> 0.2 um"; NULL if there is none. */
const char *report_limit_asked(const results_view *view, size_t variable);
/* Returns the worst standing of a case among the limits. */
int32_t report_standing(const results_view *view, size_t index);

/* section-best.c: whether the cases are a sweep of several axes. */
bool report_is_sweep(const results_view *view);
/* Paths of the stage that a sweep names first are choices of the designer, such as a relief; all
   others are operating conditions, such as torques. Dimensions with more than one point are marked
   as one of these. */
typedef struct report_sides {
    bool *choice_dims, *condition_dims;
    size_t choices, conditions; /* numbers of combinations */
} report_sides;
report_sides report_sides_of(const results_view *view);
void report_sides_free(report_sides *sides);
/* Returns which value of an output is best: -1 the least, 1 the largest, 0 if unknown. The user's
 * --best takes precedence over a limit of the file. */
int report_sense_of(const report_page *page, size_t variable);
/* Finds the case with the least (-1) or largest (1) value among the combinations of some
 * dimensions, starting at the case `first`; SIZE_MAX if no value is known. If `met`, cases that
 * miss a limit do not count. `same` is the number of other cases with that value. */
size_t report_find_extreme(const report_scalar *scalar, const bool *dims, size_t count,
                           size_t first, int sense, bool met, size_t *same);
/* Reads "OUTPUT=least" and "OUTPUT=largest"; returns false with an error in the report. */
bool report_read_sought(const results_view *view, const char *const *best, size_t count,
                        report_sought *out, ff_report *report);
/* Writes which choices are best for each condition; returns false if there was nothing to write. */
bool report_write_best(report_page *page);

/* section-grids.c writes a scalar as small tables; returns false if they would be too large. */
bool report_write_grids(const report_scalar *scalar);

/* These functions write the sections of the page. */
/* Writes whether the answers meet the limits of the file; for a study, in how many cases. */
void report_write_limits(report_page *page);
/* Returns a coloured cell with the standing of a case. */
json_t *report_standing_cell(const results_view *view, size_t index);
void report_write_verdict(report_page *page);
void report_write_study(report_page *page);
void report_write_quality(report_page *page);
/* Writes the parameters given by the user, stage by stage. */
void report_write_inputs(report_page *page);
void report_write_origin(report_page *page);
/* data.c: writes the numbers for the template's figures. */
void report_write_data(report_page *page);

/* data-series.c: packs parts of them, in SI, as 32-bit floats in base64. */
typedef struct report_data {
    report_page *page;
    json_t *outputs; /* {name: its name in words, its units} for each packed output */
} report_data;
/* Packs the chosen numbers, or the first ones if `chosen` is NULL. If `values` is NULL, packs
 * indices. */
json_t *report_pack(const double *values, const size_t *chosen, size_t count);
json_t *report_describe_unit(const char *name, const char *si, double magnitude);
/* Adds an output's name in words and the unit for numbers of this size, unless already added;
 * returns it. */
json_t *report_describe(report_data *d, size_t variable, double magnitude);
double report_magnitude(const ff_array *array); /* number of kept points; 0: none */
/* Adds a series of a case to the list, if it has points; `rank` is the index of the case. */
void report_data_series(report_data *d, json_t *list, size_t variable, size_t index, size_t rank);
/* Returns {name, marks: [[roll angle, "SAP"], ...]} for a case. */
json_t *report_data_case(report_page *page, size_t index, const char *name);

#endif
