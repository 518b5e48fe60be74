/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages to the user: errors and warnings, each with the place it is about. */
#ifndef FF_REPORT_H
#define FF_REPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Exit codes of the program. */
enum ff_exit {
    FF_EXIT_OK = 0,
    FF_EXIT_FAILED = 1, /* the run failed numerically */
    FF_EXIT_INPUT = 2,  /* the input is wrong */
    FF_EXIT_PLUGIN = 3, /* a plugin is at fault */
    FF_EXIT_CASES = 4   /* a study finished with failed cases */
};

/* A text that values were read from: a file or a command-line assignment. */
typedef struct ff_source {
    char *name; /* as messages print it: "gear.yaml", "--set" */
    char *text; /* the whole text, NUL at its end */
    size_t length;
    char *directory; /* where relative files of this source are looked for */
    bool brief;      /* it may go before the reports that mention it: they keep a copy */
} ff_source;

/* A stretch of one line. line 0: the whole source; source NULL: no place at all. */
typedef struct ff_place {
    const ff_source *source;
    uint32_t line, column; /* from 1; column counts characters, not bytes */
    uint32_t width;        /* characters to underline; 0: only the caret */
} ff_place;

typedef enum ff_severity { FF_ERROR, FF_WARNING } ff_severity;

typedef struct ff_message {
    ff_severity severity;
    int exit_code; /* of an error: FF_EXIT_INPUT, ... */
    ff_place place;
    char *text; /* one sentence */
    char *hint; /* what to do about it, or NULL */
} ff_message;

/* A growing list of messages. Equal messages at the same place are kept once; beyond 1000, errors
   are counted but not kept. Sources outlive it, unless they are brief. One thread. */
typedef struct ff_report ff_report;

#define FF_NOWHERE ((ff_place){0})

ff_report *ff_report_new(void);
void ff_report_free(ff_report *report);

/* hint may be NULL. Always returns false, so that `return ff_error(...)` reads well. */
bool ff_error(ff_report *report, int exit_code, ff_place place, const char *hint,
              const char *format, ...) __attribute__((format(printf, 5, 6)));
void ff_warn(ff_report *report, ff_place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

size_t ff_report_count(const ff_report *report);
const ff_message *ff_report_at(const ff_report *report, size_t index);
const ff_message *ff_report_first(const ff_report *report); /* error; NULL without */
size_t ff_report_errors(const ff_report *report);

/* The exit code that the errors ask for (a plugin's fault before wrong input before a failed run);
   FF_EXIT_OK without errors. */
int ff_report_exit_code(const ff_report *report);

/* Prints each message as "file:line:column: error: text", the line, a caret and the hint, in the
   order of files and lines, at most 20 errors. Colour when `colour`. */
void ff_report_print(const ff_report *report, FILE *stream, bool colour);

/* "load.csv:3:7: the text", as much of it as there is. */
void ff_message_print(const ff_message *message, char *out, size_t size);

/* The candidate nearest to `word` by edit distance, or NULL when none is near. */
const char *ff_nearest(const char *word, const char *const *candidates, size_t count);

#endif
