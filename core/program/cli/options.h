/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command line: the commands as data, and the options that were given. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct cli_command cli_command;

typedef struct cli_words {
    const char **words;
    size_t count;
} cli_words;

/* An option that is absent is NULL, 0 or false. cli_option finds options that have no member
 * here. */
typedef struct cli_options {
    const cli_command *command; /* NULL: the command is not known */
    const char *operand;        /* FILE or ID */
    const char *second;         /* the second operand */
    cli_words further;          /* operands after the second one, if the command takes more */
    const char **sets;
    size_t set_count;
    const char **plugin_paths;
    size_t plugin_path_count;
    const char *directory; /* -o */
    size_t jobs;
    size_t shard, shards;
    bool rerun_failed, rerun_all;
    bool json;
    cli_words *given; /* by row of the table: the arguments of each option */
} cli_options;

struct cli_command {
    const char *name;
    const char *operand; /* "FILE", or two of them; in brackets if it may be left out; "..." at the
                            end: more may follow */
    const char *summary; /* one line */
    const char *text;    /* printed by `help` below the usage line */
    int (*run)(const cli_options *options); /* returns the exit code of the program */
};

/* Reads the arguments from argv[1] on. False if they are wrong, after cli_wrong_usage. */
bool cli_options_parse(cli_options *options, int argc, char **argv);
void cli_options_free(cli_options *options);

/* Returns the argument of an option of the table: the last one if it was given several times, ""
 * if it takes none, NULL if it was not given. */
const char *cli_option(const cli_options *options, const char *name);
/* Returns all arguments of an option that may be repeated. */
cli_words cli_option_words(const cli_options *options, const char *name);

/* Prints "usage: flankfilm", the command, its operands and its options; NULL: the usage of the
 * program. */
void cli_print_usage(const cli_command *command, FILE *out);
/* Prints a line for each option of the command. */
void cli_print_options(const cli_command *command);

/* Prints one sentence and the usage line. Returns false. */
bool cli_wrong_usage(const cli_options *options, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
