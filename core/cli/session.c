/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "command.h"
#include "json.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool ff_session_open(ff_session *session, const ff_options *options, bool everything)
{
    *session = (ff_session){.report = ff_report_new()};
    session->tree = ff_tree_load(options->operand, session->report);
    if (!ff_tree_root(session->tree))
        return false;
    for (size_t i = 0; i < options->set_count; i++)
        ff_tree_set(session->tree, options->sets[i], "pipeline", ff_pipeline_top_keys,
                    session->report);
    session->library = ff_library_new(options->plugin_paths, options->plugin_path_count);
    session->pipeline =
        ff_pipeline_build(session->tree, session->library, everything, session->report);
    return session->pipeline && ff_report_errors(session->report) == 0;
}

void ff_session_close(ff_session *session)
{
    if (session->pipeline)
        ff_pipeline_free(session->pipeline);
    if (session->library)
        ff_library_free(session->library);
    ff_tree_free(session->tree);
    ff_report_free(session->report);
}

bool ff_colour(FILE *stream)
{
    const char *refusal = getenv("NO_COLOR");
    const char *terminal = getenv("TERM");
    return isatty(fileno(stream)) && !(refusal && *refusal) &&
           !(terminal && strcmp(terminal, "dumb") == 0);
}

int ff_refuse(const ff_report *report, const ff_options *options, const char *ending)
{
    if (options->json)
        return ff_json_refuse(report);
    ff_report_print(report, stderr, ff_colour(stderr));
    size_t errors = ff_report_errors(report);
    fprintf(stderr, "%zu error%s; %s\n", errors, errors == 1 ? "" : "s", ending);
    return ff_report_exit_code(report);
}
