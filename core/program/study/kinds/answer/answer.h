/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a study found: typed tables, sentences and drawings. A kind of study fills an answer; one
 * printer for each form, the terminal, CSV, JSON and the page, shows all of them.
 */
#ifndef STUDY_ANSWER_H
#define STUDY_ANSWER_H

#include "../../run/context.h"

/* Where a table or a sentence is shown. */
enum { STUDY_IN_FILE = 1, STUDY_ON_TERMINAL = 2, STUDY_ON_PAGE = 4 };

/* A column takes one member of each row, which is a JSON object. Numbers are in SI. */
typedef struct study_column {
    const char *of[3];    /* the member, and members of that; NULL ends them */
    const char *name;     /* head of the column in CSV, "cost [s]"; NULL: it is not there */
    const char *head;     /* on terminal and page; NULL: it is not there */
    const char *unit;     /* below the head; NULL or "" for none */
    const char *before;   /* on the terminal before a cell that is not empty; NULL: a blank */
    const char *missing;  /* on the terminal in place of a missing number; NULL: nothing */
    const char *words[2]; /* of false and true; NULL: 0 and 1 */
    double factor;        /* of numbers on terminal and page; 0 means 1 */
    int width;            /* least width on the terminal; negative: set to the left, and grows */
    int digits;           /* of numbers on the terminal; 0 means 4 */
    bool fixed;           /* they follow the point */
    bool quoted;          /* in CSV also where a text has neither commas nor quotes */
} study_column;

typedef struct study_table {
    const char *title;   /* a line above it, or NULL */
    const char *summary; /* on the page in place of the title, or NULL */
    const study_column *columns;
    size_t column_count;
    json_t *rows;   /* a list of objects, which the answer takes */
    unsigned forms; /* of those above */
    int digits;     /* of numbers in CSV; 0 means 6 */
    int indent;     /* of its rows on the terminal */
    bool whole;     /* rows that are too long for the terminal are not cut */
    bool folded;    /* on the page */
    json_t *figure; /* the drawing that it stands below on the page; NULL: it stands alone */
} study_table;

typedef struct study_answer {
    study_context *context;
    const char *file;  /* "map": of map.csv, map.json and map.figure.json */
    json_t *value;     /* what the JSON file holds; taken; NULL: the rows of the tables */
    int digits;        /* of its numbers; 0 means 6 */
    json_t *facts;     /* members for `run --json`; NULL: the value under the name of the kind */
    json_t *figures;   /* a list of drawings */
    json_t *sentences; /* those of the page */
    study_table **tables;
    size_t table_count;
} study_answer;

/* Adds a sentence, which is printed at once where the terminal has it; `indent` as in
   study_context_print_line. */
void study_answer_say(study_answer *answer, unsigned forms, int indent, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* Adds a table, which is printed at once where the terminal has it. */
void study_answer_add(study_answer *answer, const study_table *table);
/* Adds a drawing, as docs/guide describes them, and returns it. */
json_t *study_answer_draw(study_answer *answer, json_t *figure);
/* Writes the files of the answer, and frees it. */
void study_answer_close(study_answer *answer);

/* answer-print.c */
void study_table_print(const study_context *context, const study_table *table);
/* answer-file.c */
void study_table_csv(const study_table *table, FILE *out);
/* Returns the table as the page's script takes it. */
json_t *study_table_page(const study_table *table);
/* Returns the member of the row that a column takes; NULL without one. */
const json_t *study_column_of(const study_column *column, const json_t *row);

#endif
