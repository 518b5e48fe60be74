/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "../terminal/answer.h"
#include "../terminal/terminal.h"
#include "command.h"
#include "progress.h"
#include "summary.h"

#include "../memory/memory.h"
#include "../results/write.h"

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

/* `directory` is where the results are, or NULL. */
static void print_outcome(const results_outcome *outcome, const char *directory)
{
    cli_print_summary(outcome);
    fflush(stdout);
    if (ff_report_count(outcome->report)) {
        fputc('\n', stderr);
        terminal_print_messages(outcome->report, stderr, terminal_colour(stderr));
    }
    if (directory)
        printf("\nresults in %s\n", directory);
    if (outcome->exit_code != EXIT_SUCCESS)
        fprintf(stderr, "the run %s\n", cli_interrupted() ? "was stopped" : "failed");
}

static int run_session(cli_session *session, const cli_options *options, results_folder *folder,
                       const char *directory)
{
    cli_progress progress;
    cli_progress_begin(&progress, session->report);
    bool ran = ff_pipeline_run(session->pipeline, &progress.watch, session->report);
    cli_progress_end(&progress);
    if (!ran && ff_report_errors(session->report) == 0)
        ff_error(session->report, FF_FAULT_RUN, FF_NOWHERE, NULL, "the run was stopped");

    results_outcome outcome = {.pipeline = session->pipeline,
                               .report = session->report,
                               .file = options->operand,
                               .log = progress.log};
    set_status(&outcome);
    bool written = folder && results_write_run(&outcome, folder);
    set_status(&outcome); /* writing may have failed */
    if (options->json)
        results_write_answer(&outcome, written ? directory : NULL,
                             cli_option(options, "arrays") != NULL, terminal_answer());
    else
        print_outcome(&outcome, written ? directory : NULL);
    json_decref(progress.log);
    return outcome.exit_code;
}

int cli_run(const cli_options *options)
{
    cli_session session;
    results_folder *folder = NULL;
    char *directory = NULL;
    int code;
    bool good = cli_session_open(&session, options, false);
    if (good && session.study) {
        code = cli_run_study(&session, options);
        cli_session_close(&session);
        return code;
    }
    if (good && cli_option(options, "executor"))
        good = ff_error(session.report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "%s has no study: there is nothing to spread", options->operand);
    if (options->directory)
        directory = memory_print_text("%s", options->directory);
    else if (!options->json)
        directory = cli_default_directory(options->operand);
    if (good && (!directory || (folder = results_folder_open(directory, session.report))))
        code = run_session(&session, options, folder, directory);
    else
        code = cli_refuse(session.report, options, "nothing was run");
    results_folder_free(folder);
    free(directory);
    cli_session_close(&session);
    return code;
}
