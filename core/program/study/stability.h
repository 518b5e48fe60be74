/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A map of where a pipeline can be trusted. Its cells are cases on a grid, and between neighbours
 * that are judged differently cases that halve the distance. Each is judged by the quality that its
 * stages report, and by a second case in which the knobs of the numerics are turned finer.
 */
#ifndef STUDY_STABILITY_H
#define STUDY_STABILITY_H

#include "text.h"

/* An output, and the lines of quality that say how far off it is, relative; their sum counts. */
typedef struct study_claim {
    const char *output;
    const char **estimates;
    size_t estimate_count;
} study_claim;

/* "stage.line", which holds where the model warns; or "stage.output > 1", in SI. */
typedef struct study_condition {
    const char *name;
    char than; /* '<', '>'; '\0': a line */
    double value;
    const char **lines; /* physical: that warn because of it */
    size_t line_count;
    const char *words; /* of a note, behind the value: "stable motions coexist" */
} study_condition;

/* From good to worse. */
enum study_class {
    STUDY_CONVERGED,
    STUDY_OUTSIDE,   /* solved well, but outside the range of a model */
    STUDY_PHYSICAL,  /* solved well, and what is solved is unstable */
    STUDY_UNCHECKED, /* the refined case failed */
    STUDY_DEGRADED,  /* a line of quality warns */
    STUDY_SILENT,    /* no line warns, but the refined case differs too much */
    STUDY_FAILED,
    STUDY_REFUSED, /* the input is outside what a model takes */
    STUDY_CLASSES
};
extern const char *const study_class_names[STUDY_CLASSES];
extern const char *const study_class_texts[STUDY_CLASSES]; /* what it means */
extern const char study_class_letters[STUDY_CLASSES + 1];
extern const char study_note_text[];

enum { STUDY_NOT_SUBMITTED = -1 };

typedef struct study_cell {
    const study_setting *settings; /* one for each axis */
    double *at;                    /* their numbers along a range, else the point */
    size_t halved;         /* axis on which it lies between two others; their number: on the grid */
    int64_t number, finer; /* of its case and of the refined one, or STUDY_NOT_SUBMITTED */
    enum study_class class;
    const char *line;    /* the line or output that decides; NULL: none */
    double value, limit; /* of it */
    const char *why;     /* in words, or NULL */
    const char *output;  /* with the largest difference, measured by its estimate; NULL: none */
    double difference, estimate;
    double *noted;    /* value of each note that holds, else NaN */
    const char *note; /* all of them in words; NULL: none */
} study_cell;

/* Between neighbours along an axis, as near as the halvings got. */
typedef struct study_boundary {
    size_t axis, low, high;    /* cells */
    size_t slice, column, row; /* of the grid, of the lower of the two cells that it began with */
} study_boundary;

enum {
    MAP_AXES,
    MAP_OUTPUTS,
    MAP_ESTIMATES,
    MAP_REFINE,
    MAP_BISECT,
    MAP_PHYSICAL,
    MAP_NOTES,
    MAP_RANGE,
    MAP_TOLERANCE,
    STUDY_MAP_KEYS
};
extern const ff_param study_map_keys[STUDY_MAP_KEYS];

typedef struct study_map {
    study_context *context;
    const study_key_value *values; /* while they are read */
    const fe_node *outputs;
    const study_definition *grid;
    size_t axis_count;
    size_t *halvings; /* along each axis */
    bool *log;        /* whether its points are spaced so */
    study_claim *claims;
    size_t claim_count;
    const char **knobs; /* "stage.parameter" */
    double *factors;    /* of a refined case */
    size_t knob_count;
    study_condition *physical; /* what the machine does, not the numerics */
    size_t physical_count;
    study_condition *notes; /* what is good to know of an answer, however good it is */
    size_t note_count;
    const char **range; /* lines that say where a model applies, not how well it is solved */
    size_t range_count;
    double tolerance; /* for an output without an estimate */

    study_cell *cells; /* those of the grid first, as the cases of the study */
    size_t count;
    study_boundary *boundaries;
    size_t boundary_count;
    size_t counts[STUDY_CLASSES]; /* on the grid */
    size_t more[STUDY_CLASSES];   /* between */
    size_t noted[2];              /* on the grid, and between */
} study_map;

/* stability-read.c: reads the keys and submits the cells of the grid; NULL after an error. */
study_map *study_map_read(study_context *context, const study_key_value *values);
/* stability.c: runs them and what follows. False: the study cannot go on. */
bool study_map_run(study_map *map);

/* stability-judge.c: the class of a cell, by what its case gave and the refined one (NULL: there is
   none yet). */
void study_judge(const study_map *map, study_cell *cell, const study_outcome *answer,
                 const study_outcome *refined);
const study_outcome *study_map_outcome(const study_map *map,
                                       int64_t number); /* NULL: there is none */

/* What a map is drawn in: the points of the two axes across and up (0 and 1 where there are so
   many) make a slice for each point of the others. */
size_t study_map_slices(const study_map *map);
size_t study_map_cell(const study_map *map, size_t slice, size_t column, size_t row);
size_t study_map_columns(const study_map *map);
size_t study_map_rows(const study_map *map);
size_t study_map_stride(const study_map *map, size_t axis);
const char *study_map_value(const study_map *map, size_t axis, size_t point);

/* stability-result.c, stability-figure.c, stability-print.c */
json_t *study_map_facts(const study_map *map);
void study_map_json(const study_map *map, FILE *out);
void study_map_csv(const study_map *map, FILE *out);
void study_map_svg(const study_map *map, FILE *out);
void study_map_print(const study_map *map);

#endif
