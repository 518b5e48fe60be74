/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "command.h"
#include "progress.h"
#include "result.h"

#include "../value/memory.h"

#include <stdlib.h>
#include <string.h>

/* results/<name of the file without its ending> */
static char *default_directory(const char *file)
{
    const char *slash = strrchr(file, '/');
    const char *name = slash ? slash + 1 : file;
    size_t length = strlen(name);
    if (length > 5 && strcmp(name + length - 5, ".yaml") == 0)
        length -= 5;
    else if (length > 4 && strcmp(name + length - 4, ".yml") == 0)
        length -= 4;
    return ff_print_text("results/%.*s", (int)length, name);
}

static const char *status_of(int exit_code)
{
    if (exit_code == FF_EXIT_OK)
        return "ok";
    if (exit_code != FF_EXIT_FAILED)
        return "error";
    return ff_interrupted() ? "stopped" : "failed";
}

static bool has_started(const ff_pipeline *pipeline)
{
    for (size_t i = 0; i < pipeline->count; i++)
        if (pipeline->stages[i].ran || pipeline->stages[i].status != FF_OK)
            return true;
    return false;
}

/* False when nothing was there to be written, or with an error. */
static bool write_folder(const ff_outcome *outcome, ff_folder *folder, ff_report *report)
{
    if (!folder || !has_started(outcome->pipeline))
        return false;
    ff_result_csv(outcome, folder);
    FILE *stream = ff_folder_begin(folder, "result", ".json");
    if (stream)
        ff_result_json(outcome, true, stream);
    ff_folder_end(folder);
    return ff_folder_commit(folder, report);
}

/* folder: where the results are, or NULL. */
static void tell(const ff_outcome *outcome, const char *folder, bool json)
{
    if (json) {
        ff_result_json(outcome, false, stdout);
        return;
    }
    if (has_started(outcome->pipeline))
        ff_result_summary(outcome, folder, stdout, ff_colour(stdout));
    fflush(stdout);
    if (ff_report_count(outcome->report)) {
        fputc('\n', stderr);
        ff_report_print(outcome->report, stderr, ff_colour(stderr));
    }
    if (outcome->exit_code != FF_EXIT_OK)
        fprintf(stderr, "the run %s\n",
                strcmp(outcome->status, "stopped") == 0 ? "was stopped" : "failed");
}

static int run_session(ff_session *session, const ff_options *options, ff_folder *folder)
{
    ff_progress progress;
    ff_progress_begin(&progress, session->report);
    bool ran = ff_pipeline_run(session->pipeline, &progress.watch, session->report);
    ff_progress_end(&progress);
    if (ff_interrupted() && !ran && ff_report_errors(session->report) == 0)
        ff_error(session->report, FF_EXIT_FAILED, FF_NOWHERE, NULL, "the run was stopped");

    ff_outcome outcome = {.pipeline = session->pipeline,
                          .report = session->report,
                          .file = options->operand,
                          .exit_code = ff_report_exit_code(session->report),
                          .log = progress.log};
    outcome.status = status_of(outcome.exit_code);
    bool written = write_folder(&outcome, folder, session->report);
    outcome.exit_code = ff_report_exit_code(session->report); /* writing may have failed */
    outcome.status = status_of(outcome.exit_code);
    tell(&outcome, written ? ff_folder_path(folder) : NULL, options->json);
    ff_progress_free(&progress);
    return outcome.exit_code;
}

int ff_run(const ff_options *options)
{
    ff_session session;
    ff_folder *folder = NULL;
    char *preset = NULL;
    int code;
    if (!ff_session_open(&session, options, false)) {
        code = ff_refuse(session.report, options, "nothing was run");
        goto out;
    }
    const char *directory = options->directory;
    if (!directory && !options->json)
        directory = preset = default_directory(options->operand);
    if (directory && !(folder = ff_folder_open(directory, session.report))) {
        code = ff_refuse(session.report, options, "nothing was run");
        goto out;
    }
    code = run_session(&session, options, folder);
out:
    ff_folder_free(folder);
    free(preset);
    ff_session_close(&session);
    return code;
}
