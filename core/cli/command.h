/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands of the program, and what they share. */
#ifndef FF_COMMAND_H
#define FF_COMMAND_H

#include "../study/study.h"

#include <jansson.h>

typedef struct ff_command ff_command;

/* What stands on the command line behind the command. */
typedef struct ff_options {
    const ff_command *command; /* NULL: none was understood */
    const char *operand;       /* FILE or ID; NULL when absent */
    const char *second;        /* of a command that takes two operands */
    const char **sets;
    size_t set_count;
    const char **plugin_paths;
    size_t plugin_path_count;
    const char *directory; /* -o; NULL when absent */
    const char *pipeline;  /* --pipeline; NULL when absent */
    size_t jobs;           /* 0: not said */
    size_t shard, shards;  /* 0: not said */
    const char *budget;    /* --budget, a time; NULL when absent */
    const char **froms;    /* --from, results of a trade-off in several scenes */
    size_t from_count;
    const json_t *promise; /* what a budget has chosen, for the result; or NULL */
    bool rerun_failed, rerun_all, fail_fast, paranoid;
    const char *executor; /* --executor; NULL when absent */
    const char *to;       /* --to; NULL when absent */
    const char **withs;   /* --with: parameters of the model that one of these names */
    size_t with_count;
    const char **laws; /* --law */
    size_t law_count;
    const char **ats; /* --at */
    size_t at_count;
    size_t chunk, tasks; /* 0: not said */
    bool now;
    bool json, markdown;
    bool help;
} ff_options;

struct ff_command {
    const char *name;
    const char *operand; /* "FILE", or two of them; in brackets when it may be left out */
    const char *accepts; /* letters of the options that it takes, see options.c */
    const char *usage;   /* the options, to read */
    const char *summary; /* one line */
    const char *text;    /* what `help` says below the usage line */
    int (*run)(const ff_options *options);
};

/* Reads argv[1] and on; false after ff_wrong_usage. */
bool ff_options_parse(ff_options *options, int argc, char **argv);
void ff_options_free(ff_options *options);
void ff_options_describe(const ff_command *command);

/* Prints one sentence and the usage line. Returns false. */
bool ff_wrong_usage(const ff_options *options, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Each returns the exit code of the program. */
int ff_run(const ff_options *options);
int ff_plan_study(const ff_options *options);
int ff_submit(const ff_options *options);
int ff_check(const ff_options *options);
int ff_explain(const ff_options *options);
int ff_show(const ff_options *options);
int ff_cite(const ff_options *options);
int ff_models(const ff_options *options);
int ff_verify_command(const ff_options *options);
int ff_new(const ff_options *options);
int ff_export(const ff_options *options);
int ff_write_report(const ff_options *options);
int ff_schema(const ff_options *options);
int ff_fit_command(const ff_options *options);

/* A file that was read, with all that the commands need of it. */
typedef struct ff_session {
    ff_report *report;
    ff_tree *tree;
    ff_library *library;
    ff_pipeline *pipeline; /* may be NULL after errors; of a study: its first case */
    ff_study *study;       /* NULL: a single case */
} ff_session;

/* Loads the file, applies --set and builds the pipeline. False with errors in the report. */
bool ff_session_open(ff_session *session, const ff_options *options, bool everything);
/* Makes the choices of models, for which what feeds them runs; false when one could not be made. */
bool ff_choose_models(ff_session *session);
void ff_session_close(ff_session *session);

/* Where the results of a study are, freed by the caller. */
char *ff_study_directory(const ff_options *options);
/* What the cases of a study have saved by taking over results; nothing when there are none. */
void ff_print_savings(const ff_savings *savings);
json_t *ff_json_savings(const ff_savings *savings);

/* Runs the most accurate candidate of a trade-off that fits the budget. */
int ff_run_budget(const ff_options *options);

/* Runs the study of the session. */
int ff_run_study(ff_session *session, const ff_options *options);
/* The part that Slurm's array, and unless array_only its tasks, leave to this process. False with
   an error when that cannot be told. */
bool ff_shard_find(ff_campaign *campaign, bool array_only, ff_report *report);
/* What the study is, as one JSON object. */
void ff_study_json(const ff_session *session, const ff_options *options, const ff_study *study,
                   FILE *out);
/* results/<name of the file without its ending>, freed by the caller. */
char *ff_default_directory(const char *file);

/* Prints the errors, as JSON or with `ending` below them, and returns their exit code. */
int ff_refuse(const ff_report *report, const ff_options *options, const char *ending);

#endif
