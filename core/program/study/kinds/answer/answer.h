/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The findings of a study: typed tables, sentences and drawings. A kind of study fills an answer.
 * Terminal, CSV, JSON and page each have one printer, for all kinds. */
#ifndef STUDY_ANSWER_H
#define STUDY_ANSWER_H

#include "../../run/context.h"

/* Where a table or a sentence is shown. */
enum { STUDY_IN_FILE = 1, STUDY_ON_TERMINAL = 2, STUDY_ON_PAGE = 4 };

/* A column shows one member of each row, which is a JSON object. Numbers are in SI. */
typedef struct study_column {
    const char *of[3];    /* path to the member through nested objects, ended by NULL */
    const char *name;     /* head of the column in CSV, "cost [s]"; NULL: not in CSV */
    const char *head;     /* head on terminal and page; NULL: on neither */
    const char *unit;     /* unit, below the head; NULL or "" for none */
    const char *before;   /* text before a cell that is not empty, on the terminal; NULL: a blank */
    const char *missing;  /* text for a missing number, on the terminal; NULL: nothing */
    const char *words[2]; /* words for false and true; NULL: 0 and 1 */
    double factor;        /* factor of numbers on terminal and page; 0 means 1 */
    int width;            /* least width on the terminal; negative: left-aligned and as wide as its
                           * texts */
    int digits;           /* digits of numbers on the terminal; 0 means 4 */
    bool fixed;           /* the digits count from the decimal point */
    bool quoted;          /* put CSV texts in quotes even if they contain no commas or quotes */
} study_column;

typedef struct study_table {
    const char *title;   /* line above the table, or NULL */
    const char *summary; /* replaces the title on the page, or NULL */
    const study_column *columns;
    size_t column_count;
    json_t *rows;   /* list of objects, owned by the answer */
    unsigned forms; /* flags of the places listed above */
    int digits;     /* digits of numbers in CSV; 0 means 6 */
    int indent;     /* indent of the rows on the terminal */
    bool whole;     /* rows too long for the terminal are not cut */
    bool folded;    /* folded on the page */
    json_t *figure; /* the drawing above it on the page; NULL: none */
} study_table;

typedef struct study_answer {
    study_context *context;
    const char *file;  /* "map" for map.csv, map.json and map.figure.json */
    json_t *value;     /* contents of the JSON file, owned; NULL: the rows of the tables */
    int digits;        /* digits of its numbers; 0 means 6 */
    json_t *facts;     /* members for `run --json`; NULL: `value` under the name of the kind */
    json_t *figures;   /* list of drawings */
    json_t *sentences; /* tables and sentences of the page */
    study_table **tables;
    size_t table_count;
} study_answer;

/* Adds a sentence. If it is for the terminal, it is printed at once; `indent` as in
 * study_context_print_line. */
void study_answer_say(study_answer *answer, unsigned forms, int indent, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* Adds a table. If it is for the terminal, it is printed at once. */
void study_answer_add(study_answer *answer, const study_table *table);
/* Adds a drawing in the form described in docs/architecture.md, and returns it. */
json_t *study_answer_draw(study_answer *answer, json_t *figure);
/* Writes the files of the answer, and frees it. */
void study_answer_close(study_answer *answer);

/* answer-print.c */
void study_table_print(const study_context *context, const study_table *table);
/* answer-file.c */
void study_table_csv(const study_table *table, FILE *out);
/* Returns the table in the form that the page's script reads. */
json_t *study_table_page(const study_table *table);
/* Returns the member of the row that a column shows; NULL if there is none. */
const json_t *study_column_of(const study_column *column, const json_t *row);

#endif
