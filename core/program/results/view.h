/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The results of a run or a study, read from its directory for the CSV export and the page. A run
 * is one case without axes. Everything is read-only and lives until the view is closed. Numbers are
 * in coherent SI units, angles in rad. Texts are UTF-8 and never NULL; a missing text is "". */
#ifndef RESULTS_VIEW_H
#define RESULTS_VIEW_H

#include "../limits/limits.h"

#include <stdbool.h>

/* A fact about the results, such as "flankfilm" "0.1.0" or "date" "2026-01-31T12:00:00Z". */
typedef struct results_view_fact {
    const char *name, *text;
} results_view_fact;

/* The literature of a model that was used. */
typedef struct results_view_citation {
    const char *model, *reference, *bibtex;
} results_view_citation;

/* A parameter in use: "250 N m", from "gear.yaml:4". */
typedef struct results_view_param {
    const char *name, *text, *origin;
} results_view_param;

/* A stage; in a study, the stage of the first case. */
typedef struct results_view_stage {
    const char *name, *model, *version;
    const char *build; /* hash of the plugin's file */
    const results_view_param *const *params;
    size_t param_count;
} results_view_stage;

/* A varied path, and its value at each point of a dimension of the study. Paths that vary together
 * share a dimension. */
typedef struct results_view_axis {
    const char *path;         /* "duty.mesh_frequency" */
    size_t dimension;         /* index in view->lengths */
    const char *unit;         /* unit of the values; "" for words */
    const double *values;     /* in SI; NULL for words */
    const char *const *words; /* each value as the user wrote it: "400 Hz", "upper" */
} results_view_axis;

enum {
    RESULTS_VIEW_ASKED = 1,   /* the file requests it; others were computed in addition */
    RESULTS_VIEW_AT_LEAST = 2 /* only a lower bound is known, so it has no error */
};

/* An output of a stage. In a case the output may be missing, or its first dimension may be absent.
 */
typedef struct results_view_variable {
    const char *name;   /* "film.h_min" */
    const char *output; /* "h_min" */
    size_t stage;
    const char *unit, *doc;
    uint32_t rank;
    const char *const *dims;    /* `rank` names; within a stage, equal names have equal lengths */
    const char *const *against; /* for each dimension, the series against which it is plotted, from
                                 * this stage or one that feeds it: "gears.roll_angle"; "" if
                                 * unknown */
    uint32_t flags;
    size_t extremes[2]; /* in a run, for a series that is a share of another: indices of its least
                         * and greatest number among the points where the other series is not almost
                         * 0 */
    const char *whole;  /* the other series: "contact.load_per_width"; "" if all numbers count */
} results_view_variable;

typedef struct results_view_quality {
    size_t stage;
    const char *name, *text;
    double value, limit;  /* NaN: none */
    int32_t verdict;      /* FF_GOOD ... */
    const char *accepted; /* why the file accepts the doubt; "" where it does not */
    bool range;           /* the line concerns the range of a model, not the numbers */
} results_view_quality;

/* The standing of a case with respect to a limit of the file. */
typedef struct results_view_limit {
    const char *output, *asked; /* "scuffing.safety", "> 1.5" */
    const char *unit;           /* number and limit, in SI */
    double value, bar;          /* NaN: not known */
    bool at_least;              /* only a lower bound of the value is known */
    int32_t standing;           /* limits_standing */
} results_view_limit;

/* A case. The last dimension of the study varies fastest. */
typedef struct results_view_case {
    const char *status;  /* "ok", "failed", "invalid", "crashed", ...; "not run" */
    const char *reason;  /* reason, if the case is not ok */
    const char *command; /* command that runs only this case again */
    double seconds;      /* NaN: unknown */
    const results_view_quality *const *quality;
    size_t quality_count;
    const results_view_limit *const *limits;
    size_t limit_count;
    const char *limits_text; /* "missed: scuffing.safety > 1.5"; "" without limits */
    const char *verdict; /* verdict on the numbers: "good", "doubtful", "bad", "failed"; "" if it
                          * has not run */
    const char *reasons; /* lines that are not good, worst first: "load balance, mass" */
    const char *range;   /* lines of models that are used outside their range: "lambda" */
} results_view_case;

/* Figures that a study described for the report. */
typedef struct results_view_figures {
    const char *name; /* name of their file: "map.figure.json" */
    const char *json; /* a list of figures */
} results_view_figures;

typedef struct results_view {
    const char *title;
    bool study; /* false: a single run */

    const results_view_fact *const *facts;
    size_t fact_count;
    const results_view_citation *const *citations;
    size_t citation_count;
    const results_view_stage *const *stages;
    size_t stage_count;
    const size_t *lengths; /* lengths of the study's dimensions */
    size_t dimension_count;
    const results_view_axis *const *axes;
    size_t axis_count;
    const results_view_variable *const *variables;
    size_t variable_count;
    const results_view_case *const *cases;
    size_t case_count; /* product of lengths */

    /* count of the verdicts: "12 good, 104 doubtful (inlet heating 88, lambda 61)" */
    const char *summary;
    const results_view_figures *const *figures;
    size_t figures_count;
} results_view;

/* Returns the index of a case along a dimension of the study. */
size_t results_view_point(const results_view *view, size_t index, size_t dimension);
/* Writes the lengths of a variable's dimensions in a case; an absent optional dimension has length
 * 1. Returns false if the case does not have the variable. */
bool results_view_full_shape(const results_view *view, size_t variable, size_t index,
                             size_t shape[4]);
/* Reads the numbers of a variable in a case, to be released; data is NULL if the case does not have
 * it. Numbers that are not finite become NaN. Returns false after an error. */
bool results_view_load(const results_view *view, size_t variable, size_t index, ff_array *array);
void results_view_release(ff_array *array); /* data may be NULL */
/* Returns whether dimension `dim` of another variable is plotted against this series: if `against`
 * of the other variable names the series, or if the series belongs to the same stage, runs along
 * this dimension, and either has the name of the dimension or is a time or an angle. */
bool results_view_is_coordinate(const results_view_variable *series,
                                const results_view_variable *other, uint32_t dim);

/* Returns NULL after an error. The report also receives later errors of the view's functions.
 * Report and directory must outlive the view. */
const results_view *results_view_open(const char *directory, ff_report *report);
void results_view_close(const results_view *view); /* NULL is allowed */

#endif
