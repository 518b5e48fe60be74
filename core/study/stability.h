/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A map of where a pipeline can be trusted. Its cells are cases on a grid, and between neighbours
 * that are judged differently cases that halve the distance. Each is judged by the quality that its
 * stages report, and by a second case in which the knobs of the numerics are turned finer.
 */
#ifndef FF_STABILITY_H
#define FF_STABILITY_H

#include "study.h"

/* An output, and the lines of quality that say how far off it is, relative; their sum counts. */
typedef struct ff_claim {
    const char *output;
    const char **estimates;
    size_t estimate_count;
} ff_claim;

typedef struct ff_knob {
    const char *path; /* "stage.parameter" */
    double factor;    /* of a refined case */
} ff_knob;

/* "stage.line", which holds where the model warns; or "stage.output > 1", in SI. */
typedef struct ff_condition {
    const char *name;
    char than; /* '<', '>'; '\0': a line */
    double value;
} ff_condition;

typedef struct ff_stability {
    const char *request; /* "outputs=[...]" in place of the file's */
    ff_claim *claims;
    size_t claim_count;
    ff_knob *knobs;
    size_t knob_count;
    ff_condition *physical; /* what the machine does, not the numerics */
    size_t physical_count;
    const char **range; /* lines that say where a model applies, not how well it is solved */
    size_t range_count;
    double tolerance; /* for an output without an estimate */
    size_t *halvings; /* along each axis of the study */
    bool *log;        /* whether its points are spaced so */
} ff_stability;

/* From good to worse. */
enum ff_class {
    FF_CONVERGED,
    FF_OUTSIDE,   /* solved well, but outside the range of a model */
    FF_PHYSICAL,  /* solved well, and what is solved is unstable or otherwise remarkable */
    FF_UNCHECKED, /* the refined case failed */
    FF_DEGRADED,  /* a line of quality warns */
    FF_SILENT,    /* no line warns, but the refined case differs too much */
    FF_FAILED,
    FF_REFUSED, /* the input is outside what a model takes */
    FF_CLASSES
};
extern const char *const ff_class_names[FF_CLASSES];
extern const char *const ff_class_texts[FF_CLASSES]; /* what it means */
extern const char ff_class_letters[FF_CLASSES + 1];

typedef struct ff_cell {
    const char **assignments; /* one for each path that the study varies */
    const char **names;       /* their values */
    double *at;               /* their numbers along a range, else the point */
    size_t halved; /* axis on which it lies between two others; axis_count: on the grid */
    char key[20], refined[20]; /* "": not run */
    enum ff_class class;
    const char *line;    /* the line or output that decides; NULL: none */
    double value, limit; /* of it */
    const char *why;     /* in words, or NULL */
    const char *output;  /* with the largest difference, measured by its estimate; NULL: none */
    double difference, estimate;
} ff_cell;

/* Between neighbours along an axis, as near as the halvings got. */
typedef struct ff_boundary {
    size_t axis, low, high;    /* cells */
    size_t slice, column, row; /* of the grid, of the lower of the two cells that it began with */
} ff_boundary;

typedef struct ff_map {
    const ff_study *study;
    ff_cell *cells; /* those of the grid first, as the cases of the study */
    size_t count;
    ff_boundary *boundaries;
    size_t boundary_count;
    size_t counts[FF_CLASSES]; /* on the grid */
    size_t more[FF_CLASSES];   /* between */
    ff_arena arena;
} ff_map;

/* Fills in the axes and `stability` of the study. */
bool ff_stability_read(ff_study *study, const ff_node *node, ff_report *report);

/* Whether the pipeline, as its file stands, has what the map names. */
void ff_stability_check(const ff_stability *stability, const ff_pipeline *pipeline,
                        ff_report *report);

/* Runs what is not done yet. The campaign is that of the grid. The map is freed in either case. */
bool ff_stability_run(const ff_campaign *campaign, ff_map *map, ff_tally *tally, ff_report *report);
/* map.json, map.csv and map.svg in the directory. */
bool ff_map_write(const ff_map *map, const char *directory, ff_report *report);
void ff_map_free(ff_map *map);

/* What a map is drawn in: the points of the two axes across and up (0 and 1 where there are so
   many) make a slice for each point of the others. */
size_t ff_map_slices(const ff_study *study);
size_t ff_map_cell(const ff_study *study, size_t slice, size_t column, size_t row);
size_t ff_map_columns(const ff_study *study);
size_t ff_map_rows(const ff_study *study);
/* The path that varies along an axis. */
const ff_varied *ff_map_axis(const ff_study *study, size_t axis);

#endif
