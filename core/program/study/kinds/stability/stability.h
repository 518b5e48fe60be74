/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A map of where a pipeline can be trusted. Its cells are cases on a grid and, between neighbours
 * that are judged differently, cases that halve the distance. Each is judged by the quality lines
 * of its stages, and by a twin: a case with coarser numerical parameters and, if that case does not
 * confirm the answer, a case with finer parameters. */
#ifndef STUDY_STABILITY_H
#define STUDY_STABILITY_H

#include "../answer/kind.h"
#include "../answer/text.h"

/* An output, and the quality lines whose sum estimates its relative error. */
typedef struct study_claim {
    const char *output;
    const char **estimates;
    size_t estimate_count;
} study_claim;

/* A condition: "stage.line", which holds if that quality line warns, or "stage.output > 1", in SI.
 */
typedef struct study_condition {
    const char *name;
    char than; /* '<' or '>'; '\0' for a quality line */
    double value;
    const char **lines; /* for a physical condition: the lines that warn because of it */
    size_t line_count;
    const char *words; /* for a note: text after the value: "stable motions coexist" */
} study_condition;

/* The verdicts on a cell, from good to bad. */
enum study_class {
    STUDY_CONVERGED,
    STUDY_OUTSIDE,   /* solved well, but outside the range of a model */
    STUDY_PHYSICAL,  /* solved well, but the machine itself is unstable */
    STUDY_UNCHECKED, /* every twin failed, or the limits of the knobs allow none */
    STUDY_DEGRADED,  /* a quality line warns */
    STUDY_SILENT,    /* no line warns, but the last twin differs too much */
    STUDY_FAILED,
    STUDY_REFUSED, /* a model refuses the input */
    STUDY_CLASSES
};
extern const char *const study_class_names[STUDY_CLASSES];
extern const char *const study_class_texts[STUDY_CLASSES]; /* meaning of each class */
extern const char study_class_letters[STUDY_CLASSES + 1];
extern const char study_note_text[];

enum { STUDY_NOT_SUBMITTED = -1 };

typedef struct study_cell {
    const study_setting *settings; /* its assignments, one for each axis */
    double *at;                    /* the number on each axis that is a range, otherwise the index
                                    * of its point */
    size_t halved; /* axis along which it is halfway between two other cells; axis_count if it is on
                      the grid */
    int64_t number, twin; /* numbers of its case and of its last twin, or STUDY_NOT_SUBMITTED */
    bool confirmed;       /* the twin agrees, or the letter does not depend on one */
    bool finer;           /* the last twin is the finer one */
    bool bounded;         /* the limits of the knobs do not allow the last twin that was tried */
    enum study_class class;
    const char *line;    /* the line or output that decides the class; NULL if there is none */
    double value, limit; /* value and limit of that line or output */
    const char *why;     /* the reason in words, or NULL */
    /* the output with the largest ratio of difference to estimate; NULL if there is none */
    const char *output;
    double difference, estimate;
    double *noted;    /* value of each note that holds; NaN for the others */
    const char *note; /* all notes that hold, in words; NULL if there are none */
} study_cell;

/* A boundary between neighbours along an axis, after the halvings. */
typedef struct study_boundary {
    size_t axis, low, high; /* cells */
    /* grid position of the lower of its two first cells */
    size_t slice, column, row;
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

typedef struct study_map {
    study_context *context;
    const study_key_value *values; /* valid only while the keys are read */
    const study_definition *grid;
    size_t axis_count;
    size_t *halvings; /* number of points along each axis */
    bool *log;        /* whether its points are spaced logarithmically */
    study_claim *claims;
    size_t claim_count;
    const char **knobs; /* "stage.parameter" */
    double *factors;    /* factors for the finer twin; the coarser one divides by them */
    size_t knob_count;
    study_condition *physical; /* conditions for an unstable machine, as opposed to unstable
                                * numerics */
    size_t physical_count;
    study_condition *notes; /* conditions that are worth noting but do not change the class */
    size_t note_count;
    /* quality lines that state where a model applies, not how well it is solved */
    const char **range;
    size_t range_count;
    double tolerance; /* allowed relative difference of an output without an estimate */

    study_cell *cells; /* cells; first those of the grid, in the order of the cases */
    size_t count;
    study_boundary *boundaries;
    size_t boundary_count;
    size_t counts[STUDY_CLASSES]; /* number of grid cells in each class */
    size_t more[STUDY_CLASSES];   /* number of cells between grid cells in each class */
    size_t noted[2];              /* numbers of cells with a note: on the grid, and between */
} study_map;

/* stability-read.c: reads the keys and submits the cells of the grid. Returns NULL after an error.
 */
void *study_map_read(study_context *context, const study_key_value *values);

/* stability-judge.c: decides the class of a cell from its own result and the result of its twin,
 * which is NULL if there is none yet. */
void study_judge(const study_map *map, study_cell *cell, const study_outcome *answer,
                 const study_outcome *twin);
/* Returns the result of the case with that number; NULL for STUDY_NOT_SUBMITTED. */
const study_outcome *study_map_outcome(const study_map *map, int64_t number);

/* stability-grid.c: axis 0 is horizontal in a drawing and axis 1, if any, vertical. Each point of
 * the other axes has a drawing of its own, a slice. */
size_t study_map_slices(const study_map *map);
size_t study_map_cell(const study_map *map, size_t slice, size_t column, size_t row);
size_t study_map_columns(const study_map *map);
size_t study_map_rows(const study_map *map);
size_t study_map_stride(const study_map *map, size_t axis);
const char *study_map_value(const study_map *map, size_t axis, size_t point);

/* stability-result.c: writes the answer of the map. */
void study_map_reduce(void *study, study_answer *answer);
/* stability-print.c */
void study_map_print(const study_map *map);
/* Returns "1.77827941004 m/s" with four digits: "1.778 m/s". */
const char *study_map_short(const study_map *map, const char *text);

#endif
