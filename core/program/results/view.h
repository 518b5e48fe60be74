/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a run or a study has left in its directory, for those who write it in another form: the CSV
 * export and the page. A run is one case without axes. Everything is read-only and lives until the
 * view is closed. All numbers are coherent SI, angles in rad; text is UTF-8 and never NULL, ""
 * where there is none.
 */
#ifndef RESULTS_VIEW_H
#define RESULTS_VIEW_H

#include "../limits/limits.h"

#include <stdbool.h>

/* Something about the results as a whole: "flankfilm" "0.1.0", "date" "2026-01-31T12:00:00Z". */
typedef struct results_view_fact {
    const char *name, *text;
} results_view_fact;

/* The literature of a model that was used. */
typedef struct results_view_citation {
    const char *model, *reference, *bibtex;
} results_view_citation;

/* A parameter as it was used: "250 N m", from "gear.yaml:4". */
typedef struct results_view_param {
    const char *name, *text, *origin;
} results_view_param;

/* A stage; of a study, as it is in the first case. */
typedef struct results_view_stage {
    const char *name, *model, *version;
    const char *build; /* hash of the plugin's file */
    const results_view_param *const *params;
    size_t param_count;
} results_view_stage;

/* What is varied: a path, and the value that it takes at each point of a dimension of the study.
   Paths that vary together share their dimension. */
typedef struct results_view_axis {
    const char *path;         /* "duty.mesh_frequency" */
    size_t dimension;         /* rank in view->lengths */
    const char *unit;         /* of values; "" for words */
    const double *values;     /* NULL: words */
    const char *const *words; /* each value as the user wrote it: "400 Hz", "upper" */
} results_view_axis;

enum {
    RESULTS_VIEW_ASKED = 1,   /* the file asked for it; others were computed on the way */
    RESULTS_VIEW_AT_LEAST = 2 /* its error is not known: it is known from below alone */
};

/* An output of a stage. A case may lack it, or its first dimension. */
typedef struct results_view_variable {
    const char *name;   /* "film.h_min" */
    const char *output; /* "h_min" */
    size_t stage;
    const char *unit, *doc;
    uint32_t rank;
    const char *const *dims; /* `rank` names; those of one stage that are equal have one length */
    const char *const *against; /* the series that each dimension is plotted against, of this stage
                                   or of one that feeds it: "gears.roll_angle"; "" where unknown */
    uint32_t flags;
    size_t extremes[2]; /* of a run, where a series is a share of another: ranks of the least and
                           the greatest number where that is not next to nothing */
    const char *whole;  /* that other: "contact.load_per_width"; "": all numbers count */
} results_view_variable;

typedef struct results_view_quality {
    size_t stage;
    const char *name, *text;
    double value, limit;  /* NaN: none */
    int32_t verdict;      /* FF_GOOD ... */
    const char *accepted; /* why the file accepts the doubt; "" where it does not */
    bool range;           /* of the range of a model, and not of the numbers */
} results_view_quality;

/* How a case stands to a limit of the file. */
typedef struct results_view_limit {
    const char *output, *asked; /* "scuffing.safety", "> 1.5" */
    const char *unit;           /* SI, of the numbers */
    double value, bar;          /* NaN: not known */
    bool at_least;              /* the value is known from below alone */
    int32_t standing;           /* limits_standing */
} results_view_limit;

/* A case. The last dimension of the study varies fastest. */
typedef struct results_view_case {
    const char *status;  /* "ok", "failed", "invalid", "crashed", ...; "not run" */
    const char *reason;  /* of a case that is not ok */
    const char *command; /* that runs it again, alone */
    double seconds;      /* NaN: unknown */
    const results_view_quality *const *quality;
    size_t quality_count;
    const results_view_limit *const *limits;
    size_t limit_count;
    const char *limits_text; /* "missed: scuffing.safety > 1.5"; "" without limits */
    const char *verdict; /* of the numbers: "good", "doubtful", "bad", "failed"; "" when it has not
                            run */
    const char *reasons; /* the lines that are not good, the worst first: "load balance, mass" */
    const char *range;   /* those of models that are used outside of their range: "lambda" */
} results_view_case;

/* Figures that a study has described of itself, as the report draws them. */
typedef struct results_view_figures {
    const char *name; /* of their file: "map.figure.json" */
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
    const size_t *lengths; /* of the study's dimensions */
    size_t dimension_count;
    const results_view_axis *const *axes;
    size_t axis_count;
    const results_view_variable *const *variables;
    size_t variable_count;
    const results_view_case *const *cases;
    size_t case_count; /* product of lengths */

    const char
        *summary; /* of the verdicts: "12 good, 104 doubtful (inlet heating 88, lambda 61)" */
    const results_view_figures *const *figures;
    size_t figures_count;
} results_view;

/* The point of the study's dimension at which a case stands. */
size_t results_view_point(const results_view *view, size_t index, size_t dimension);
/* Lengths of a variable in a case with all its dimensions: one that may be absent has length 1.
   False: the case lacks the variable. */
bool results_view_full_shape(const results_view *view, size_t variable, size_t index,
                             size_t shape[4]);
/* Reads the numbers of a variable in a case, to be released; data is NULL if the case lacks it.
   What is not finite is NaN. False after an error. */
bool results_view_load(const results_view *view, size_t variable, size_t index, ff_array *array);
void results_view_release(ff_array *array); /* data may be NULL */
/* Whether a series is what dimension `dim` of another variable is plotted against: `against` says
   so, or it runs along that dimension and is named like it, or is a time or an angle. */
bool results_view_is_coordinate(const results_view_variable *series,
                                const results_view_variable *other, uint32_t dim);

/* Returns NULL after an error in the report, which also takes the errors of the view's functions.
   Report and directory outlive the view. */
const results_view *results_view_open(const char *directory, ff_report *report);
void results_view_close(const results_view *view); /* NULL is allowed */

#endif
