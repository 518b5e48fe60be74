/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages to the user: errors and warnings, each with the place it is about. */
#ifndef FE_REPORT_H
#define FE_REPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Exit codes of the program. */
enum fe_exit {
    FE_EXIT_OK = 0,
    FE_EXIT_FAILED = 1, /* the run failed numerically */
    FE_EXIT_INPUT = 2,  /* the input is wrong */
    FE_EXIT_PLUGIN = 3, /* a plugin is at fault */
    FE_EXIT_CASES = 4   /* a study finished with failed cases */
};

/* A text that values were read from: a file or a command-line assignment. */
typedef struct fe_source {
    char *name; /* as messages print it: "gear.yaml", "--set" */
    char *text; /* the whole text, NUL at its end */
    size_t length;
    char *directory; /* where relative files of this source are looked for */
    bool temporary;  /* reports that mention it keep a copy, since it may be freed before them */
} fe_source;

/* A stretch of one line. line 0: the whole source; source NULL: no place at all. */
typedef struct fe_place {
    const fe_source *source;
    uint32_t line, column; /* from 1; column counts characters, not bytes */
    uint32_t width;        /* characters to underline; 0: only the caret */
} fe_place;

typedef enum fe_severity { FE_ERROR, FE_WARNING } fe_severity;

typedef struct fe_message {
    fe_severity severity;
    int exit_code; /* of an error: FE_EXIT_INPUT, ... */
    fe_place place;
    char *text; /* one sentence */
    char *hint; /* what to do about it, or NULL */
} fe_message;

/* A growing list of messages. Equal messages at the same place are kept once; beyond 1000, errors
   are counted but not kept. Sources outlive it, unless they are temporary. One thread. */
typedef struct fe_report fe_report;

#define FE_NOWHERE ((fe_place){0})

fe_report *fe_report_new(void);
void fe_report_free(fe_report *report);

/* hint may be NULL. Always returns false, so that `return fe_error(...)` reads well. */
bool fe_error(fe_report *report, int exit_code, fe_place place, const char *hint,
              const char *format, ...) __attribute__((format(printf, 5, 6)));
void fe_warn(fe_report *report, fe_place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

size_t fe_report_count(const fe_report *report);
const fe_message *fe_report_at(const fe_report *report, size_t index);
const fe_message *fe_report_first(const fe_report *report); /* error; NULL without */
size_t fe_report_errors(const fe_report *report);

/* The exit code that the errors ask for (a plugin's fault before wrong input before a failed run);
   FE_EXIT_OK without errors. */
int fe_report_exit_code(const fe_report *report);

/* Prints each message as "file:line:column: error: text", the line, a caret and the hint, in the
   order of files and lines, at most 20 errors. Colour when `colour`. */
void fe_report_print(const fe_report *report, FILE *stream, bool colour);

/* Writes "load.csv:3:7: the text", with the parts of the place that are known. */
void fe_message_print(const fe_message *message, char *out, size_t size);

/* The candidate nearest to `word` by edit distance, or NULL when none is near. */
const char *fe_nearest(const char *word, const char *const *candidates, size_t count);

#endif
