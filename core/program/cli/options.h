/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command line: commands as data, and the options of the one that was given. */
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

/* An absent option is NULL, 0 or false. cli_option finds those that have no member here. */
typedef struct cli_options {
    const cli_command *command; /* NULL: none was understood */
    const char *operand;        /* FILE or ID */
    const char *second;         /* the second operand */
    cli_words further;          /* those behind it, where the command takes more */
    const char **sets;
    size_t set_count;
    const char **plugin_paths;
    size_t plugin_path_count;
    const char *directory; /* -o */
    size_t jobs;
    size_t shard, shards;
    bool rerun_failed, rerun_all;
    bool json;
    cli_words *given; /* the arguments of each option, by row of the table */
} cli_options;

struct cli_command {
    const char *name;
    const char *operand; /* "FILE", or two of them; in brackets when it may be left out; more may
                            follow where it ends in "..." */
    const char *summary; /* one line */
    const char *text;    /* what `help` says below the usage line */
    int (*run)(const cli_options *options); /* returns the exit code of the program */
};

/* Reads argv[1] and on; false after cli_wrong_usage. */
bool cli_options_parse(cli_options *options, int argc, char **argv);
void cli_options_free(cli_options *options);

/* The argument of an option of the table: the last one when it was given several times, "" when it
   takes none, NULL when it was not given. */
const char *cli_option(const cli_options *options, const char *name);
/* All arguments that a repeatable option was given. */
cli_words cli_option_words(const cli_options *options, const char *name);

/* "usage: flankfilm", the command, its operands and its options; NULL: of the program. */
void cli_print_usage(const cli_command *command, FILE *out);
/* The options of the command, a line for each. */
void cli_print_options(const cli_command *command);

/* Prints one sentence and the usage line. Returns false. */
bool cli_wrong_usage(const cli_options *options, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
