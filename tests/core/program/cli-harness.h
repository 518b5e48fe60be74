/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Runs the real program in a scratch directory that holds the toy models and "pair.yaml":
 * wave -> sum, and an idle stage. Arguments of a test: the program, then the modules
 * cli-toy-<name>.so.
 */
#ifndef CLI_HARNESS_H
#define CLI_HARNESS_H

#include <check.h>
#include <jansson.h>
#include <stdbool.h>

typedef struct outcome {
    int code;     /* exit code; 128 + n after signal n */
    char *out;    /* what it wrote to stdout */
    char *err;    /* and to stderr */
    json_t *json; /* stdout, when it is exactly one JSON object and a newline; else NULL */
} outcome;

void cli_open(int argc, char **argv);
int cli_close(void); /* removes the directory; the exit code of the test */

/* Runs the shell line, in which $F is the program; valid until the next call. */
outcome cli(const char *line);

void cli_write(const char *name, const char *text);
const char *cli_read(const char *name); /* "" without such a file; until the next call */
bool cli_exists(const char *name);
bool cli_has(const char *text, const char *part);

/* Checks that also tell what the program said. */
void cli_expect(const char *what, const outcome *result, bool condition);
/* Walks "stages/0/model"; NULL when it is not there. */
json_t *cli_at(const json_t *json, const char *path);
const char *cli_text_at(const json_t *json, const char *path); /* "" when it is not there */

#endif
