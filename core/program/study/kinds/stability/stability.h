/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A map of where a pipeline can be trusted. Its cells are cases on a grid and, between neighbours
 * that are judged differently, cases that halve the distance. Each is judged by the quality that
 * its stages report, and by a twin: a case with coarser numerical parameters and, if that one does
 * not confirm the answer, a case with finer ones.
 */
#ifndef STUDY_STABILITY_H
#define STUDY_STABILITY_H

#include "../answer/kind.h"
#include "../answer/text.h"

/* An output, and the lines of quality whose sum estimates its relative error. */
typedef struct study_claim {
    const char *output;
    const char **estimates;
    size_t estimate_count;
} study_claim;

/* A condition "stage.line", which holds where that line of quality warns, or "stage.output > 1", in
   SI. */
typedef struct study_condition {
    const char *name;
    char than; /* '<' or '>'; '\0' for a line of quality */
    double value;
    const char **lines; /* of a physical condition: the lines that warn because of it */
    size_t line_count;
    const char *words; /* of a note, printed after the value: "stable motions coexist" */
} study_condition;

/* The verdicts on a cell, from good to bad. */
enum study_class {
    STUDY_CONVERGED,
    STUDY_OUTSIDE,   /* solved well, but outside the range of a model */
    STUDY_PHYSICAL,  /* solved well, but what is solved is unstable */
    STUDY_UNCHECKED, /* every twin failed, or the limits of the knobs allow none */
    STUDY_DEGRADED,  /* a line of quality warns */
    STUDY_SILENT,    /* no line warns, but the last twin differs too much */
    STUDY_FAILED,
    STUDY_REFUSED, /* the input is outside what a model takes */
    STUDY_CLASSES
};
extern const char *const study_class_names[STUDY_CLASSES];
extern const char *const study_class_texts[STUDY_CLASSES]; /* what each class means */
extern const char study_class_letters[STUDY_CLASSES + 1];
extern const char study_note_text[];

enum { STUDY_NOT_SUBMITTED = -1 };

typedef struct study_cell {
    const study_setting *settings; /* what it assigns, one for each axis */
    double *at;                    /* the number on each axis that is a range, else its point */
    size_t halved; /* axis on which it lies between two others; axis_count when it is on the grid */
    int64_t number, twin; /* numbers of its case and of its last twin, or STUDY_NOT_SUBMITTED */
    bool confirmed;       /* the twin agrees, or the letter does not depend on one */
    bool finer;           /* the last twin is the finer one */
    bool bounded;         /* the limits of the knobs do not allow the twin that was wanted last */
    enum study_class class;
    const char *line;    /* the line or output that decides the class; NULL for none */
    double value, limit; /* of that line or output */
    const char *why;     /* the reason in words, or NULL */
    /* the output with the largest difference over its estimate; NULL for none */
    const char *output;
    double difference, estimate;
    double *noted;    /* for each note its value where it holds, else NaN */
    const char *note; /* all notes that hold, in words; NULL for none */
} study_cell;

/* A boundary between neighbours along an axis, after the halvings. */
typedef struct study_boundary {
    size_t axis, low, high; /* cells */
    /* where the lower of the two cells that it began with is on the grid */
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
    const study_key_value *values; /* only while they are read */
    const study_definition *grid;
    size_t axis_count;
    size_t *halvings; /* along each axis */
    bool *log;        /* whether its points are spaced logarithmically */
    study_claim *claims;
    size_t claim_count;
    const char **knobs; /* "stage.parameter" */
    double *factors;    /* by which the finer twin scales them; the coarser one divides */
    size_t knob_count;
    study_condition *physical; /* what says that the machine is unstable, not the numerics */
    size_t physical_count;
    study_condition *notes; /* what is worth knowing of an answer and does not change its class */
    size_t note_count;
    /* lines of quality that say where a model applies, not how well it is solved */
    const char **range;
    size_t range_count;
    double tolerance; /* relative, for an output without an estimate */

    study_cell *cells; /* first those of the grid, in the order of the cases */
    size_t count;
    study_boundary *boundaries;
    size_t boundary_count;
    size_t counts[STUDY_CLASSES]; /* cells of the grid in each class */
    size_t more[STUDY_CLASSES];   /* cells between those in each class */
    size_t noted[2];              /* cells with a note on the grid, and between */
} study_map;

/* stability-read.c: reads the keys and submits the cells of the grid; NULL after an error. */
void *study_map_read(study_context *context, const study_key_value *values);

/* stability-judge.c: decides the class of a cell from what its case gave and its twin, which is
   NULL when there is none yet. */
void study_judge(const study_map *map, study_cell *cell, const study_outcome *answer,
                 const study_outcome *twin);
/* Returns what the case of that number gave; NULL for STUDY_NOT_SUBMITTED. */
const study_outcome *study_map_outcome(const study_map *map, int64_t number);

/* stability-grid.c: axis 0 runs across a drawing and axis 1, if any, up; they make a slice for each
   point of the other axes. */
size_t study_map_slices(const study_map *map);
size_t study_map_cell(const study_map *map, size_t slice, size_t column, size_t row);
size_t study_map_columns(const study_map *map);
size_t study_map_rows(const study_map *map);
size_t study_map_stride(const study_map *map, size_t axis);
const char *study_map_value(const study_map *map, size_t axis, size_t point);

/* stability-result.c: says what the map found. */
void study_map_reduce(void *study, study_answer *answer);
/* stability-print.c */
void study_map_print(const study_map *map);
/* Returns "1.77827941004 m/s" with four digits: "1.778 m/s". */
const char *study_map_short(const study_map *map, const char *text);

#endif
