/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command run for one case: runs the pipeline, and writes and prints its results. */
#include "../terminal/answer.h"
#include "../terminal/terminal.h"
#include "command.h"
#include "progress.h"
#include "summary.h"
#include "swap-report.h"

#include "../accuracy/accuracy.h"
#include "../accuracy/axis.h"
#include "../accuracy/goals.h"
#include "../accuracy/models.h"
#include "../limits/accept.h"
#include "../limits/limits.h"
#include "../memory/memory.h"
#include "../results/previous-results.h"
#include "../results/write.h"
#include "../run/run.h"

#include <stdlib.h>

/* Sets the exit code and the status in words from the report. */
static void set_status(results_outcome *outcome)
{
    outcome->exit_code = ff_report_fault(outcome->report);
    outcome->status = outcome->exit_code == EXIT_SUCCESS   ? "ok"
                      : outcome->exit_code != FF_FAULT_RUN ? "error"
                      : cli_interrupted()                  ? "stopped"
                                                           : "failed";
}

/* The directory of the results, and what it contained before. */
typedef struct place {
    char *directory;        /* NULL: nothing is written */
    results_folder *folder; /* NULL if nothing is written */
    char *replaced;         /* how the inputs of the replaced results differ, or NULL */
    char *removed;          /* files derived from the replaced results that are gone, or NULL */
    bool written;
} place;

static void print_place(const place *to)
{
    if (to->written && to->replaced && *to->replaced)
        printf("earlier results in this directory are replaced (%s)\n", to->replaced);
    if (to->removed && *to->removed)
        printf("removed there, since it was made from them: %s\n", to->removed);
    if (to->written)
        printf("results in %s\nas a page with figures: flankfilm report %s\n", to->directory,
               to->directory);
    else if (to->replaced)
        printf("the earlier results in %s are kept\n", to->directory);
}

/* Adds the messages of print_place to the JSON answer, as warnings. */
static void warn_of_replaced(const place *to, ff_report *report)
{
    if (to->written && to->replaced && *to->replaced)
        ff_warn(report, FF_NOWHERE, "earlier results of \"%s\" are replaced (%s)", to->directory,
                to->replaced);
    if (to->removed && *to->removed)
        ff_warn(report, FF_NOWHERE,
                "removed from \"%s\", since it was made from earlier results: %s", to->directory,
                to->removed);
}

/* Whether --strict makes the outcome a failure. */
static bool is_strict_about(const results_outcome *outcome, const cli_options *options, bool print)
{
    study_judgement judgement = study_judge_pipeline(outcome->pipeline, false);
    const bool doubtful = judgement.verdict != FF_GOOD;
    study_judgement_free(&judgement);
    return cli_is_strict_about(options, doubtful, outcome->limits->worst != LIMITS_MET,
                               outcome->report, print);
}

static void print_outcome(const results_outcome *outcome, const place *to,
                          const cli_options *options)
{
    cli_print_summary(outcome, cli_option(options, "all") != NULL);
    fflush(stdout);
    if (ff_report_count(outcome->report)) {
        fputc('\n', stderr);
        terminal_print_messages(outcome->report, stderr, terminal_colour(stderr));
    }
    if (to->written || to->replaced)
        print_place(to);
    if (ff_report_errors(outcome->report) > 0)
        fprintf(stderr, "the run %s\n", cli_interrupted() ? "was stopped" : "failed");
    else if (outcome->exit_code != EXIT_SUCCESS)
        is_strict_about(outcome, options, true);
}

static void count_doubts(results_outcome *outcome, const cli_options *options)
{
    if (outcome->exit_code == EXIT_SUCCESS && is_strict_about(outcome, options, false))
        outcome->exit_code = FF_FAULT_RUN;
}

static int run_session(cli_session *session, const cli_options *options, const results_input *input,
                       place *to)
{
    cli_progress progress;
    cli_progress_begin(&progress, session->report);
    accuracy_record errors = {.answer = session->pipeline, .progress = progress.text};
    accuracy_want_points(session->pipeline);
    bool good =
        accuracy_is_requested(session->run)
            ? accuracy_run(&errors, session->run, session->engine, &progress.watch, session->report)
            : run_start(session->run, &progress.watch);
    ff_report_append(session->report, ff_run_report(session->run));
    if (!good && ff_report_errors(session->report) == 0)
        ff_error(session->report, FF_FAULT_RUN, FF_NOWHERE, NULL, "the run was stopped");
    cli_progress_end(&progress);
    ff_engine_warn_displaced(session->engine, session->report); /* messages of models that were
                                                                 * tried */

    limits_verdict limits = limits_judge(session->run, errors.answer, &errors);
    accept_check_pipeline(errors.answer, session->report);
    results_outcome outcome = {.pipeline = errors.answer,
                               .report = session->report,
                               .input = input,
                               .errors = &errors,
                               .limits = &limits,
                               .log = progress.log};
    set_status(&outcome);
    count_doubts(&outcome, options);
    /* an interrupted run does not replace complete results */
    bool kept = to->replaced && cli_interrupted();
    to->written =
        to->folder && !kept && results_write_run(&outcome, to->directory, to->folder, &to->removed);
    set_status(&outcome); /* writing the results may have failed */
    count_doubts(&outcome, options);
    if (options->json) {
        warn_of_replaced(to, session->report);
        results_write_answer(&outcome, to->written ? to->directory : NULL,
                             cli_option(options, "arrays") != NULL, terminal_answer());
    } else {
        print_outcome(&outcome, to, options);
    }
    json_decref(progress.log);
    limits_free(&limits);
    accuracy_free(&errors);
    return outcome.exit_code;
}

/* Opens the directory of the results; false after an error. */
static bool open_place(place *to, const results_input *input, ff_report *report)
{
    if (!to->directory)
        return true;
    to->folder = results_folder_open(to->directory, "result", report);
    return to->folder && results_earlier_check(to->directory, input, &to->replaced, report);
}

int cli_run(const cli_options *options)
{
    cli_session session;
    place to = {.directory = NULL};
    results_input input = {.file = options->operand,
                           .sets = options->sets,
                           .set_count = options->set_count,
                           .replace = cli_option(options, "replace") != NULL};
    int code;
    bool good = cli_session_open(&session, options, false);
    if (good && session.study && cli_option(options, "all"))
        good = ff_error(session.report, FF_FAULT_INPUT, FF_NOWHERE,
                        "table.csv has all outputs of its cases, and the page shows them",
                        "%s has a study; --all is for single cases", options->operand);
    if (session.study) {
        code = good ? cli_run_study(&session, options)
                    : cli_refuse(session.report, options, "nothing was run");
        cli_session_close(&session);
        return code;
    }
    if (good && cli_option(options, "executor"))
        good = ff_error(session.report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "%s has no study: there are no cases to distribute", options->operand);
    if (options->directory || !options->json)
        to.directory = cli_run_directory(options);
    input.pipeline = session.pipeline;
    char *accuracy = accuracy_print_goals(session.run);
    input.accuracy = accuracy;
    char *key = good ? accuracy_print_key(session.run, session.engine) : NULL;
    input.key = good ? results_input_key(session.pipeline, key) : 0;
    if (good && !options->json)
        cli_print_swaps(&session, options);
    if (good && open_place(&to, &input, session.report))
        code = run_session(&session, options, &input, &to);
    else
        code = cli_refuse(session.report, options, "nothing was run");
    results_folder_free(to.folder);
    free(accuracy);
    free(key);
    free(to.replaced);
    free(to.removed);
    free(to.directory);
    cli_session_close(&session);
    return code;
}
