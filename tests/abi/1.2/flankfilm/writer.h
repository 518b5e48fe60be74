/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.writer/1": makes files for people or other programs of what a run or a study
 * has left in its directory.
 *
 * A model of the kind "writer" that offers it is no stage of a pipeline: `flankfilm export DIR --to
 * NAME` uses it. It has one output row, the service, and no inputs. It sees the results as an
 * ff_view, which is the same for a run and for a study: a run is one case without axes. Everything
 * is read-only and lives until `write` returns. All numbers are coherent SI, angles in rad; text is
 * UTF-8 and never NULL, "" where there is none. Strings may hold anything that a user wrote: escape
 * them as your format asks.
 *
 *     for (size_t c = 0; c < view->case_count; c++)
 *         for (size_t v = 0; v < view->variable_count; v++) {
 *             ff_array array;
 *             ff_status status = view->load(view->ctx, v, c, &array);
 *             if (status != FF_OK)
 *                 return status;
 *             if (array.data)
 *                 ... array.rank, array.shape, view->variables[v]->unit ...
 *             view->release(view->ctx, &array);
 *         }
 */
#ifndef FLANKFILM_WRITER_H
#define FLANKFILM_WRITER_H

#include "author.h"

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FF_WRITER_ID "flankfilm.writer/1"

/* Something about the results as a whole: "flankfilm" "0.1.0", "date" "2026-01-31T12:00:00Z". */
typedef struct ff_view_fact {
    size_t size;
    const char *name, *text;
} ff_view_fact;

/* The literature of a model that was used. */
typedef struct ff_view_citation {
    size_t size;
    const char *model, *reference, *bibtex;
} ff_view_citation;

/* A parameter as it was used: "250 N m", from "gear.yaml:4". */
typedef struct ff_view_param {
    size_t size;
    const char *name, *text, *origin;
} ff_view_param;

/* A stage; of a study, as it is in the first case. */
typedef struct ff_view_stage {
    size_t size;
    const char *name, *model, *version;
    const char *build; /* hash of the plugin's file */
    const ff_view_param *const *params;
    size_t param_count;
    const size_t *feeders; /* the stages that it is wired to */
    size_t feeder_count;
} ff_view_stage;

/* What is varied: a path, and the value that it takes at each point of a dimension of the study.
   Paths that vary together share their dimension. */
typedef struct ff_view_axis {
    size_t size;
    const char *path;         /* "duty.mesh_frequency" */
    size_t dimension;         /* rank in view->lengths */
    const char *unit;         /* of values; "" for words */
    const double *values;     /* NULL: words */
    const char *const *words; /* each value as the user wrote it: "400 Hz", "upper" */
} ff_view_axis;

enum {
    FF_VIEW_ASKED = 1 /* the file asked for it; others were computed on the way */
};

/* An output of a stage. A case may lack it, or its first dimension. */
typedef struct ff_view_variable {
    size_t size;
    const char *name;   /* "film.h_min" */
    const char *output; /* "h_min" */
    size_t stage;
    const char *unit, *doc;
    uint32_t rank;
    const char *const *dims; /* `rank` names; those of one stage that are equal have one length */
    const char *const *against; /* the series that each dimension is plotted against, of this stage
                                   or of one that feeds it: "gears.roll_angle"; "" where unknown */
    uint32_t flags;
} ff_view_variable;

typedef struct ff_view_quality {
    size_t size;
    size_t stage;
    const char *name, *text;
    double value, limit; /* NaN: none */
    int32_t verdict;     /* FF_GOOD ... */
} ff_view_quality;

/* A case. The last dimension of the study varies fastest. */
typedef struct ff_view_case {
    size_t size;
    const char *status;  /* "ok", "failed", "invalid", "crashed", ...; "not run" */
    const char *reason;  /* of a case that is not ok */
    const char *command; /* that runs it again, alone */
    double seconds;      /* NaN: unknown */
    const ff_view_quality *const *quality;
    size_t quality_count;
    const char *verdict; /* "good", "doubtful", "bad", "failed"; "" when it has not run */
    const char *reasons; /* the lines that are not good, the worst first: "inlet heating, lambda" */
} ff_view_case;

/* A drawing of a study; there are none any more, see ff_view_figures. */
typedef struct ff_view_drawing {
    size_t size;
    const char *name; /* of its file: "map.svg" */
    const char *svg;
} ff_view_drawing;

/* Figures that a study has described of itself, as the report draws them. */
typedef struct ff_view_figures {
    size_t size;
    const char *name; /* of their file: "map.figure.json" */
    const char *json; /* a list of figures */
} ff_view_figures;

typedef struct ff_view {
    size_t size;
    void *ctx; /* first argument of the functions below */
    const char *title;
    int32_t study; /* 0: a single run */

    const ff_view_fact *const *facts;
    size_t fact_count;
    const ff_view_citation *const *citations;
    size_t citation_count;
    const ff_view_stage *const *stages;
    size_t stage_count;
    const size_t *lengths; /* of the study's dimensions */
    size_t dimension_count;
    const ff_view_axis *const *axes;
    size_t axis_count;
    const ff_view_variable *const *variables;
    size_t variable_count;
    const ff_view_case *const *cases;
    size_t case_count; /* product of lengths */

    /* Rank and lengths of a variable in a case, without reading it; -1: the case lacks it. */
    int32_t (*shape)(void *ctx, size_t variable, size_t index, size_t shape[4]);
    /* Its numbers, until release; data is NULL when the case lacks it. What is not finite is NaN.
       A failure has been reported: return its status. */
    ff_status (*load)(void *ctx, size_t variable, size_t index, ff_array *array);
    void (*release)(void *ctx, ff_array *array); /* data may be NULL */

    const ff_view_drawing *const *drawings;
    size_t drawing_count;
    const char
        *summary; /* of the verdicts: "12 good, 104 doubtful (inlet heating 88, lambda 61)" */
    const ff_view_figures *const *figures;
    size_t figures_count;
} ff_view;

/* Where the files go. They appear under their names when `write` has returned FF_OK, all together;
   otherwise what was there before stays. */
typedef struct ff_target {
    size_t size;
    void *ctx;
    /* The path to write a file to; close it before `write` returns. name: its place in the
       directory that the user asked for; NULL for a writer of one file. NULL: it cannot be made,
       which has been reported; return FF_NOCONV. */
    const char *(*path)(void *ctx, const char *name);
} ff_target;

typedef struct ff_writer {
    size_t size;
    void *self;
    const char *suffix; /* of a writer of one file: ".nc"; "": it fills a directory */
    /* FF_OK, or a status after host->fail; a file that cannot be written is FF_NOCONV. */
    ff_status (*write)(void *self, const ff_view *view, const ff_target *target);
} ff_writer;

/* The point of the study's dimension at which a case stands. */
FF_UNUSED static size_t ff_view_point(const ff_view *view, size_t index, size_t dimension)
{
    size_t d;
    for (d = view->dimension_count; d-- > dimension + 1;)
        index /= view->lengths[d];
    return index % view->lengths[dimension];
}

/* Lengths of a variable in a case with all its dimensions: one that may be absent has length 1.
   0 when the case lacks the variable. */
FF_UNUSED static int ff_view_full_shape(const ff_view *view, size_t variable, size_t index,
                                        size_t shape[4])
{
    size_t found[4] = {0};
    int32_t rank = view->shape(view->ctx, variable, index, found);
    uint32_t i, absent, full = view->variables[variable]->rank;
    if (rank < 0 || (uint32_t)rank > full)
        return 0;
    absent = full - (uint32_t)rank;
    for (i = 0; i < full; i++)
        shape[i] = i < absent ? 1 : found[i - absent];
    return 1;
}

/* Whether a series is what dimension `dim` of another variable is plotted against: `against` says
   so, or it runs along that dimension and is named like it, or is a time or an angle. */
FF_UNUSED static int ff_view_is_coordinate(const ff_view_variable *series,
                                           const ff_view_variable *other, uint32_t dim)
{
    if (series->rank != 1 || series == other)
        return 0;
    if (!strcmp(series->name, other->against[dim]))
        return 1;
    return series->stage == other->stage && !strcmp(series->dims[0], other->dims[dim]) &&
           (!strcmp(series->output, series->dims[0]) || !strcmp(series->unit, "s") ||
            !strcmp(series->unit, "rad"));
}

#ifdef __cplusplus
}
#endif
#endif
