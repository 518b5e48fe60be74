/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "command.h"
#include "json.h"

static void tell(const ff_session *session, const ff_options *options)
{
    size_t stages = session->pipeline->count;
    if (options->json) {
        json_t *answer = ff_json_answer("ok", FF_EXIT_OK);
        ff_json_add_messages(answer, session->report);
        json_object_set_new(answer, "stages", json_integer((json_int_t)stages));
        ff_json_print(answer, stdout);
        return;
    }
    ff_report_print(session->report, stderr, ff_colour(stderr)); /* warnings */
    printf("%s: ok (%zu stage%s)\n", options->operand, stages, stages == 1 ? "" : "s");
}

int ff_check(const ff_options *options)
{
    ff_session session;
    int code = FF_EXIT_OK;
    if (ff_session_open(&session, options, true))
        tell(&session, options);
    else
        code = ff_refuse(session.report, options, "nothing was run");
    ff_session_close(&session);
    return code;
}
