/* SPDX-License-Identifier: GPL-3.0-or-later */
/* run --budget: as a model says, from what was measured, that the file keeps to a time. */
#include "command.h"
#include "json.h"

#include "../../engine/pipeline/tool.h"
#include "../../engine/value/memory.h"

#include <flankfilm/budget.h>
#include <stdlib.h>
#include <string.h>

typedef struct answer {
    ff_budget_request request;
    const cli_options *options;
    fe_report *report;
    char **sets;
    size_t set_count;
    json_t *promise;
} answer;

static ff_status refuse(void *ctx, const char *hint, const char *text)
{
    fe_error(((answer *)ctx)->report, FE_EXIT_INPUT, FE_NOWHERE, hint, "%s", text);
    return FF_INVALID;
}

/* What was measured is no promise for a run in which --set changes it. */
static void check_sets(const answer *a, const char *assignment)
{
    for (size_t i = 0; i < a->options->set_count; i++) {
        const char *set = a->options->sets[i];
        size_t length = strcspn(set, "=");
        if (!strncmp(assignment, set, length) && strchr("=.", assignment[length]))
            fe_error(a->report, FE_EXIT_INPUT, FE_NOWHERE,
                     "leave it to the budget, or measure with it first",
                     "--set %.80s changes the candidate that --budget takes: %s", set, assignment);
    }
}

static void assign(void *ctx, const char *assignment)
{
    answer *a = ctx;
    check_sets(a, assignment);
    a->sets = fe_resize(a->sets, (a->set_count + 1) * sizeof *a->sets);
    a->sets[a->set_count++] = fe_copy_text(assignment, strlen(assignment));
}

static void say(void *ctx, const char *text)
{
    const answer *a = ctx;
    if (!a->options->json && fe_report_errors(a->report) == 0)
        fputs(text, stdout);
}

static void promise(void *ctx, const char *json)
{
    answer *a = ctx;
    json_decref(a->promise);
    a->promise = json_loads(json, 0, NULL);
}

static ff_status call_choose(const void *table, void *ctx)
{
    const ff_budget *budget = table;
    return budget->choose(budget->self, &((answer *)ctx)->request);
}

static bool choose(answer *a, const char *directory)
{
    const cli_options *options = a->options;
    const fe_tool_choice choice = {
        .option = "--budget", .interface = FF_BUDGET_ID, .name = CLI_BUDGET_MODEL};
    fe_library *library = fe_library_new(options->plugin_paths, options->plugin_path_count);
    fe_tool tool = {.table = NULL};
    fe_unit second;
    char why[200];
    a->request = (ff_budget_request){
        .size = sizeof a->request,
        .ctx = a,
        .directories = options->from_count ? options->froms : &directory,
        .directory_count = options->from_count ? options->from_count : 1,
        .refuse = refuse,
        .assign = assign,
        .say = say,
        .promise = promise,
    };
    fe_unit_parse("s", &second, why, sizeof why);
    bool good =
        (fe_quantity_parse(options->budget, &second, "s", &a->request.seconds, why, sizeof why) &&
         a->request.seconds > 0) ||
        fe_error(a->report, FE_EXIT_INPUT, FE_NOWHERE, NULL,
                 "--budget wants a time such as \"10 s\", not \"%.40s\"", options->budget);
    good = good && fe_tool_open(&tool, library, &choice, a->report) &&
           fe_tool_call(&tool, "choose", call_choose, a, a->report);
    fe_tool_close(&tool);
    fe_library_free(library);
    return good && fe_report_errors(a->report) == 0;
}

/* No study, what was chosen, and above it what the user sets. */
static int run(const answer *a, const char *directory)
{
    cli_options single = *a->options;
    char *beside = fe_print_text("%s-budget", directory);
    single.sets = fe_alloc((a->set_count + a->options->set_count + 1) * sizeof *single.sets);
    single.set_count = 0;
    single.sets[single.set_count++] = "study=";
    for (size_t i = 0; i < a->set_count; i++)
        single.sets[single.set_count++] = a->sets[i];
    for (size_t i = 0; i < a->options->set_count; i++)
        single.sets[single.set_count++] = a->options->sets[i];
    single.budget = NULL;
    single.promise = a->promise;
    if (!single.directory && !single.json)
        single.directory = beside;
    int code = cli_run(&single);
    free(single.sets);
    free(beside);
    return code;
}

int cli_run_budget(const cli_options *options)
{
    answer a = {.options = options, .report = fe_report_new()};
    char *directory = cli_default_directory(options->operand);
    int code = choose(&a, directory) ? run(&a, directory)
                                     : cli_refuse(a.report, options, "nothing was run");
    for (size_t i = 0; i < a.set_count; i++)
        free(a.sets[i]);
    free(a.sets);
    json_decref(a.promise);
    fe_report_free(a.report);
    free(directory);
    return code;
}
