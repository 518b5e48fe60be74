/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands of the program, and what they share. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include "../study/study.h"

#include <jansson.h>

typedef struct cli_command cli_command;

/* What stands on the command line behind the command. */
typedef struct cli_options {
    const cli_command *command; /* NULL: none was understood */
    const char *operand;        /* FILE or ID; NULL when absent */
    const char *second;         /* of a command that takes two operands */
    const char **sets;
    size_t set_count;
    const char **plugin_paths;
    size_t plugin_path_count;
    const char *directory; /* -o; NULL when absent */
    const char *pipeline;  /* --pipeline; NULL when absent */
    size_t jobs;           /* 0: not said */
    size_t shard, shards;  /* 0: not said */
    bool rerun_failed, rerun_all, fail_fast;
    const char *executor; /* --executor; NULL when absent */
    const char *to;       /* --to; NULL when absent */
    const char **withs;   /* --with: parameters of the model that one of these names */
    size_t with_count;
    const char **laws; /* --law */
    size_t law_count;
    const char **ats; /* --at */
    size_t at_count;
    bool json, markdown;
    bool help;
} cli_options;

struct cli_command {
    const char *name;
    const char *operand; /* "FILE", or two of them; in brackets when it may be left out */
    const char *accepts; /* letters of the options that it takes, see options.c */
    const char *usage;   /* the options, to read */
    const char *summary; /* one line */
    const char *text;    /* what `help` says below the usage line */
    int (*run)(const cli_options *options);
};

/* Reads argv[1] and on; false after cli_wrong_usage. */
bool cli_options_parse(cli_options *options, int argc, char **argv);
void cli_options_free(cli_options *options);
void cli_options_describe(const cli_command *command);

/* Prints one sentence and the usage line. Returns false. */
bool cli_wrong_usage(const cli_options *options, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Each returns the exit code of the program. */
int cli_run(const cli_options *options);
int cli_plan_study(const cli_options *options);
int ff_check(const cli_options *options);
int cli_explain(const cli_options *options);
int cli_show(const cli_options *options);
int cli_cite(const cli_options *options);
int cli_models(const cli_options *options);
int cli_verify_command(const cli_options *options);
int cli_new(const cli_options *options);
int cli_export(const cli_options *options);
int cli_write_report(const cli_options *options);
int cli_schema(const cli_options *options);
int cli_fit_command(const cli_options *options);

/* A file that was read, with all that the commands need of it. */
typedef struct cli_session {
    fe_report *report;
    fe_tree *tree;
    fe_library *library;
    fe_pipeline *pipeline;   /* may be NULL after errors; of a study: its first case */
    study_definition *study; /* NULL: a single case */
} cli_session;

/* Loads the file, applies --set and builds the pipeline. False with errors in the report. */
bool cli_session_open(cli_session *session, const cli_options *options, bool everything);
/* Makes the choices of models, for which what feeds them runs; false when one could not be made. */
bool cli_choose_models(cli_session *session);
void cli_session_close(cli_session *session);

/* Where the results of a study are, freed by the caller. */
char *cli_study_directory(const cli_options *options);
/* What the cases of a study have saved by taking over results; nothing when there are none. */
void cli_print_savings(const study_reuse_counts *savings);
json_t *cli_json_savings(const study_reuse_counts *savings);

/* Runs the study of the session. */
int cli_run_study(cli_session *session, const cli_options *options);
/* The part that Slurm's array, and unless array_only its tasks, leave to this process. False with
   an error when that cannot be told. */
bool cli_shard_find(study_campaign *campaign, bool array_only, fe_report *report);
/* results/<name of the file without its ending>, freed by the caller. */
char *cli_default_directory(const char *file);

/* Prints the errors, as JSON or with `ending` below them, and returns their exit code. */
int cli_refuse(const fe_report *report, const cli_options *options, const char *ending);

#endif
