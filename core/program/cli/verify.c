/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command verify, which answers in TAP for test runners, or in one JSON object. */
#include "command.h"

#include "../results/json.h"
#include "../verify/verify.h"

#include <stdlib.h>

typedef struct verdicts {
    json_t *tests;       /* NULL: TAP is printed */
    const char *operand; /* the plugin, to print how to repeat a test */
    const char *pipeline;
    size_t count, faulty;
} verdicts;

static const char *finding_name(verify_finding finding)
{
    static const char *const names[] = {[VERIFY_PASSED] = "passed",
                                        [VERIFY_FAILED] = "faulty",
                                        [VERIFY_SKIPPED] = "untried",
                                        [VERIFY_LISTED] = "listed"};
    return names[finding];
}

static void print_verdict(void *ctx, size_t number, const verify_result *result)
{
    verdicts *t = ctx;
    bool faulty = result->finding == VERIFY_FAILED;
    t->count = number;
    t->faulty += faulty;
    if (t->tests) {
        json_array_append_new(
            t->tests, json_pack("{s:s, s:s, s:s, s:o, s:f}", "test", result->test, "claim",
                                result->claim, "finding", finding_name(result->finding), "why",
                                results_json_text(result->why[0] ? result->why : NULL), "seconds",
                                result->seconds));
        return;
    }
    if (result->finding == VERIFY_LISTED) {
        printf("%-13s %s\n", result->test, result->claim);
        return;
    }
    printf("%sok %zu - %s: %s\n", faulty ? "not " : "", number, result->test, result->claim);
    if (result->why[0])
        printf("# %s: %s\n", finding_name(result->finding), result->why);
    if (faulty)
        printf("# again: flankfilm verify %s --only %s%s%s\n", t->operand, result->test,
               t->pipeline ? " --pipeline " : "", t->pipeline ? t->pipeline : "");
    fflush(stdout);
}

/* Returns the seconds that a test may take. */
static double time_limit(void)
{
    const char *text = getenv("FLANKFILM_VERIFY_LIMIT"), *end;
    double limit;
    return text && ff_number_parse(text, &limit, &end) && limit > 0 ? limit : 60;
}

int cli_verify_command(const cli_options *options)
{
    ff_report *report = ff_report_new();
    verdicts t = {.tests = options->json ? json_array() : NULL,
                  .operand = options->operand,
                  .pipeline = cli_option(options, "pipeline")};
    verify_request request = {.path = options->operand,
                              .pipeline = cli_option(options, "pipeline"),
                              .sets = options->sets,
                              .set_count = options->set_count,
                              .limit = time_limit(),
                              .only = cli_option(options, "only"),
                              .list = cli_option(options, "list") != NULL};
    int code;
    if (!verify_plugin(&request, print_verdict, &t, report)) {
        code = cli_refuse(report, options, "nothing was tested");
    } else {
        code = t.faulty ? FF_FAULT_PLUGIN : EXIT_SUCCESS;
        if (options->json) {
            json_t *answer = results_json_answer(t.faulty ? "error" : "ok", code, report);
            json_object_set(answer, "tests", t.tests);
            results_json_print(answer);
        } else if (!request.list) {
            printf("1..%zu\n", t.count);
        }
    }
    json_decref(t.tests);
    ff_report_free(report);
    return code;
}
