/* SPDX-License-Identifier: GPL-3.0-or-later */
/* run --budget: the most accurate candidate of a measured trade-off that fits into a time. */
#include "command.h"
#include "json.h"
#include "text.h"

#include "../value/memory.h"
#include "../value/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double number_of(const json_t *map, const char *key)
{
    return json_number_value(json_object_get(map, key));
}

/* What a whole run of the candidate takes at most, with the stages that all share; INFINITY: it
   failed. */
static double time_of(const json_t *candidate)
{
    const json_t *seconds = json_object_get(candidate, "seconds");
    return json_is_object(seconds) && !json_object_get(candidate, "reason")
               ? number_of(candidate, "shared_seconds") + number_of(seconds, "max")
               : INFINITY;
}

/* The worst of its outputs, none below what the reference is known to; INFINITY: one is missing. */
static double error_of(const json_t *candidate, const json_t *outputs)
{
    const char *name;
    json_t *output;
    double worst = 0;
    json_object_foreach((json_t *)(size_t)outputs, name, output)
    {
        const json_t *error = json_object_get(json_object_get(candidate, "errors"), name);
        if (!json_is_object(error))
            return INFINITY;
        worst =
            fmax(worst, fmax(number_of(error, "largest"), number_of(output, "reference_error")));
    }
    return worst;
}

/* NULL: none fits; then *least is the time of the quickest. */
static const json_t *choose(const json_t *result, double budget, double *least)
{
    const json_t *outputs = json_object_get(result, "outputs"), *best = NULL;
    size_t i;
    json_t *one;
    *least = INFINITY;
    json_array_foreach(json_object_get(result, "candidates"), i, one)
    {
        double time = time_of(one), error = error_of(one, outputs);
        *least = fmin(*least, time);
        double known = best ? error_of(best, outputs) : INFINITY;
        if (time <= budget && (error < known || (best && error <= known && time < time_of(best))))
            best = one;
    }
    return best;
}

static json_t *promise_of(const json_t *candidate, double budget)
{
    json_t *errors = json_object(), *error;
    const char *name;
    json_object_foreach(json_object_get(candidate, "errors"), name, error)
        json_object_set(errors, name, json_object_get(error, "largest"));
    return json_pack("{s:f, s:O, s:O, s:f, s:o}", "seconds", budget, "candidate",
                     json_object_get(candidate, "label"), "assignments",
                     json_object_get(candidate, "assignments"), "expected_seconds",
                     time_of(candidate), "measured_errors", errors);
}

static void tell(const json_t *promise, const char *from)
{
    json_t *error;
    const char *name;
    printf("budget of %.3g s: %s, expected to take %.3g s\nerror as measured in %s:",
           number_of(promise, "seconds"), json_string_value(json_object_get(promise, "candidate")),
           number_of(promise, "expected_seconds"), from);
    json_object_foreach(json_object_get(promise, "measured_errors"), name, error)
        printf(" %s %.3g %%", name, 100 * json_number_value(error));
    puts("\n");
}

/* The candidate's assignments, no study, and above them what the user sets. */
static int run(const ff_options *options, const json_t *promise)
{
    ff_options single = *options;
    const json_t *list = json_object_get(promise, "assignments");
    char *directory = ff_default_directory(options->operand);
    char *beside = ff_print_text("%s-budget", directory);
    single.sets = ff_alloc((json_array_size(list) + options->set_count + 1) * sizeof *single.sets);
    single.set_count = 0;
    single.sets[single.set_count++] = "study=";
    for (size_t i = 0; i < json_array_size(list); i++)
        single.sets[single.set_count++] = json_string_value(json_array_get(list, i));
    for (size_t i = 0; i < options->set_count; i++)
        single.sets[single.set_count++] = options->sets[i];
    single.budget = NULL;
    single.promise = promise;
    if (!single.directory && !single.json)
        single.directory = beside;
    int code = ff_run(&single);
    free(single.sets);
    free(directory);
    free(beside);
    return code;
}

int ff_run_budget(const ff_options *options)
{
    ff_report *report = ff_report_new();
    char *from =
        options->from ? ff_print_text("%s", options->from) : ff_default_directory(options->operand);
    char *path = ff_print_text("%s/tradeoff.json", from), why[200];
    double budget = 0, least;
    ff_unit second;
    json_t *result = json_load_file(path, 0, NULL), *promise = NULL;
    const json_t *best;
    ff_unit_parse("s", &second, why, sizeof why);
    if (!ff_quantity_parse(options->budget, &second, "s", &budget, why, sizeof why) ||
        !(budget > 0))
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                 "--budget wants a time such as \"10 s\", not \"%.40s\"", options->budget);
    else if (!json_is_array(json_object_get(result, "candidates")))
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE,
                 "run a study with \"tradeoff\" first, and name its results with --from",
                 "%s holds no measured trade-off", from);
    else if (!(best = choose(result, budget, &least)))
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                 "nothing fits into %.3g s: the quickest candidate of %s takes %.3g s", budget,
                 from, least);
    else
        promise = promise_of(best, budget);
    if (promise && !options->json)
        tell(promise, from);
    int code = promise ? run(options, promise) : ff_refuse(report, options, "nothing was run");
    json_decref(promise);
    json_decref(result);
    ff_report_free(report);
    free(path);
    free(from);
    return code;
}
