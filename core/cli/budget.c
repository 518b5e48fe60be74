/* SPDX-License-Identifier: GPL-3.0-or-later */
/* run --budget: as a model says, from what was measured, that the file keeps to a time. */
#include "command.h"
#include "json.h"

#include "../pipeline/tool.h"
#include "../value/memory.h"

#include <flankfilm/budget.h>
#include <stdlib.h>
#include <string.h>

typedef struct answer {
    ff_budget_request request;
    const ff_options *options;
    ff_report *report;
    char **sets;
    size_t set_count;
    json_t *promise;
} answer;

static ff_status refuse(void *ctx, const char *hint, const char *text)
{
    ff_error(((answer *)ctx)->report, FF_EXIT_INPUT, FF_NOWHERE, hint, "%s", text);
    return FF_INVALID;
}

/* What was measured is no promise for a run in which --set changes it. */
static void check_sets(const answer *a, const char *assignment)
{
    for (size_t i = 0; i < a->options->set_count; i++) {
        const char *set = a->options->sets[i];
        size_t length = strcspn(set, "=");
        if (!strncmp(assignment, set, length) && strchr("=.", assignment[length]))
            ff_error(a->report, FF_EXIT_INPUT, FF_NOWHERE,
                     "leave it to the budget, or measure with it first",
                     "--set %.80s changes the candidate that --budget takes: %s", set, assignment);
    }
}

static void assign(void *ctx, const char *assignment)
{
    answer *a = ctx;
    check_sets(a, assignment);
    a->sets = ff_resize(a->sets, (a->set_count + 1) * sizeof *a->sets);
    a->sets[a->set_count++] = ff_copy_text(assignment, strlen(assignment));
}

static void say(void *ctx, const char *text)
{
    const answer *a = ctx;
    if (!a->options->json && ff_report_errors(a->report) == 0)
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
    const ff_options *options = a->options;
    const ff_tool_choice choice = {
        .option = "--budget", .interface = FF_BUDGET_ID, .name = FF_BUDGET_MODEL};
    ff_library *library = ff_library_new(options->plugin_paths, options->plugin_path_count);
    ff_tool tool = {.table = NULL};
    ff_unit second;
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
    ff_unit_parse("s", &second, why, sizeof why);
    bool good =
        (ff_quantity_parse(options->budget, &second, "s", &a->request.seconds, why, sizeof why) &&
         a->request.seconds > 0) ||
        ff_error(a->report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                 "--budget wants a time such as \"10 s\", not \"%.40s\"", options->budget);
    good = good && ff_tool_open(&tool, library, &choice, a->report) &&
           ff_tool_call(&tool, "choose", call_choose, a, a->report);
    ff_tool_close(&tool);
    ff_library_free(library);
    return good && ff_report_errors(a->report) == 0;
}

/* No study, what was chosen, and above it what the user sets. */
static int run(const answer *a, const char *directory)
{
    ff_options single = *a->options;
    char *beside = ff_print_text("%s-budget", directory);
    single.sets = ff_alloc((a->set_count + a->options->set_count + 1) * sizeof *single.sets);
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
    int code = ff_run(&single);
    free(single.sets);
    free(beside);
    return code;
}

int ff_run_budget(const ff_options *options)
{
    answer a = {.options = options, .report = ff_report_new()};
    char *directory = ff_default_directory(options->operand);
    int code = choose(&a, directory) ? run(&a, directory)
                                     : ff_refuse(a.report, options, "nothing was run");
    for (size_t i = 0; i < a.set_count; i++)
        free(a.sets[i]);
    free(a.sets);
    json_decref(a.promise);
    ff_report_free(a.report);
    free(directory);
    return code;
}
