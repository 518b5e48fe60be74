/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "command.h"
#include "progress.h"
#include "result.h"
#include "text.h"

#include "../value/memory.h"

#include <stdlib.h>
#include <string.h>

char *ff_default_directory(const char *file)
{
    const char *slash = strrchr(file, '/');
    const char *name = slash ? slash + 1 : file;
    const char *dot = strrchr(name, '.');
    bool yaml = dot && dot > name && (!strcmp(dot, ".yaml") || !strcmp(dot, ".yml"));
    return ff_print_text("results/%.*s", (int)(yaml ? (size_t)(dot - name) : strlen(name)), name);
}

/* Takes the exit code and the status in words from the report. */
static void settle(ff_outcome *outcome)
{
    outcome->exit_code = ff_report_exit_code(outcome->report);
    outcome->status = outcome->exit_code == FF_EXIT_OK       ? "ok"
                      : outcome->exit_code != FF_EXIT_FAILED ? "error"
                      : ff_interrupted()                     ? "stopped"
                                                             : "failed";
}

static bool write_folder(const ff_outcome *outcome, ff_folder *folder)
{
    ff_result_csv(outcome->pipeline, folder);
    FILE *stream = ff_folder_begin(folder, "result", ".json");
    if (stream)
        ff_result_json(outcome, true, stream);
    return ff_folder_commit(folder);
}

/* directory: where the results are, or NULL. */
static void tell(const ff_outcome *outcome, const char *directory)
{
    ff_result_summary(outcome);
    fflush(stdout);
    if (ff_report_count(outcome->report)) {
        fputc('\n', stderr);
        ff_report_print(outcome->report, stderr, ff_colour(stderr));
    }
    if (directory)
        printf("\nresults in %s\n", directory);
    if (outcome->exit_code != FF_EXIT_OK)
        fprintf(stderr, "the run %s\n", ff_interrupted() ? "was stopped" : "failed");
}

static int run_session(ff_session *session, const ff_options *options, ff_folder *folder,
                       const char *directory)
{
    ff_progress progress;
    ff_progress_begin(&progress, session->report);
    bool ran = ff_pipeline_run(session->pipeline, &progress.watch, session->report);
    ff_progress_end(&progress);
    if (!ran && ff_report_errors(session->report) == 0)
        ff_error(session->report, FF_EXIT_FAILED, FF_NOWHERE, NULL, "the run was stopped");

    ff_outcome outcome = {.pipeline = session->pipeline,
                          .report = session->report,
                          .file = options->operand,
                          .promise = options->promise,
                          .log = progress.log};
    settle(&outcome);
    bool written = folder && write_folder(&outcome, folder);
    settle(&outcome); /* writing may have failed */
    if (options->json)
        ff_result_json(&outcome, false, stdout);
    else
        tell(&outcome, written ? directory : NULL);
    json_decref(progress.log);
    return outcome.exit_code;
}

int ff_run(const ff_options *options)
{
    ff_session session;
    ff_folder *folder = NULL;
    char *directory = NULL;
    int code;
    if (options->budget)
        return ff_run_budget(options);
    bool good = ff_session_open(&session, options, false);
    if (good && session.study) {
        code = ff_run_study(&session, options);
        ff_session_close(&session);
        return code;
    }
    if (good && options->executor)
        good = ff_error(session.report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                        "%s has no study: there is nothing to spread", options->operand);
    if (options->directory)
        directory = ff_print_text("%s", options->directory);
    else if (!options->json)
        directory = ff_default_directory(options->operand);
    if (good && (!directory || (folder = ff_folder_open(directory, session.report))))
        code = run_session(&session, options, folder, directory);
    else
        code = ff_refuse(session.report, options, "nothing was run");
    ff_folder_free(folder);
    free(directory);
    ff_session_close(&session);
    return code;
}
