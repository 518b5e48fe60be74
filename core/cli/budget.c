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

/* Trade-offs that were measured, each in another scene, of the same candidates. */
typedef struct scenes {
    const char **from; /* directories */
    json_t **results;
    size_t count;
} scenes;

/* The candidate of the first scene in another one; NULL: it was not measured there. */
static const json_t *same_in(const json_t *result, const json_t *candidate)
{
    const json_t *wanted = json_object_get(candidate, "assignments");
    json_t *one;
    size_t i;
    json_array_foreach(json_object_get(result, "candidates"), i,
                       one) if (json_equal(json_object_get(one, "assignments"), wanted)) return one;
    return NULL;
}

/* What a whole run of the candidate takes at most, with the stages that all share; INFINITY: it
   failed. */
static double time_in(const json_t *candidate)
{
    const json_t *seconds = json_object_get(candidate, "seconds");
    return json_is_object(seconds) && !json_object_get(candidate, "reason")
               ? number_of(candidate, "shared_seconds") + number_of(seconds, "max")
               : INFINITY;
}

/* Not below what the reference is known to; INFINITY: there is none. */
static double error_in(const json_t *result, const json_t *candidate, const char *output)
{
    const json_t *error = json_object_get(json_object_get(candidate, "errors"), output);
    const json_t *about = json_object_get(json_object_get(result, "outputs"), output);
    return json_is_object(error) && about
               ? fmax(number_of(error, json_object_get(error, "judged") ? "judged" : "largest"),
                      number_of(about, "reference_error"))
               : INFINITY;
}

/* Over all scenes. */
static double time_of(const scenes *all, const json_t *candidate)
{
    double worst = 0;
    for (size_t i = 0; i < all->count; i++)
        worst = fmax(worst, time_in(same_in(all->results[i], candidate)));
    return worst;
}

static double error_of(const scenes *all, const json_t *candidate, const char *output)
{
    double worst = 0;
    for (size_t i = 0; i < all->count; i++)
        worst = fmax(worst, error_in(all->results[i], same_in(all->results[i], candidate), output));
    return worst;
}

/* Of all outputs. */
static double worst_of(const scenes *all, const json_t *candidate)
{
    const char *name;
    json_t *output;
    double worst = 0;
    json_object_foreach(json_object_get(all->results[0], "outputs"), name, output) worst =
        fmax(worst, error_of(all, candidate, name));
    return worst;
}

/* NULL: none fits; then *least is the time of the quickest. */
static const json_t *choose(const scenes *all, double budget, double *least)
{
    const json_t *best = NULL;
    size_t i;
    json_t *one;
    *least = INFINITY;
    json_array_foreach(json_object_get(all->results[0], "candidates"), i, one)
    {
        double time = time_of(all, one), error = worst_of(all, one);
        *least = fmin(*least, time);
        double known = best ? worst_of(all, best) : INFINITY;
        if (time <= budget &&
            (error < known || (best && error <= known && time < time_of(all, best))))
            best = one;
    }
    return best;
}

/* The worst errors of all scenes, and those of each. */
static json_t *promise_of(const scenes *all, const json_t *candidate, double budget)
{
    json_t *errors = json_object(), *list = json_array(), *output;
    const char *name;
    json_object_foreach(json_object_get(all->results[0], "outputs"), name, output)
        json_object_set_new(errors, name, json_real(error_of(all, candidate, name)));
    for (size_t i = 0; i < all->count; i++) {
        json_t *own = json_object();
        json_object_foreach(errors, name, output) json_object_set_new(
            own, name,
            json_real(error_in(all->results[i], same_in(all->results[i], candidate), name)));
        json_array_append_new(
            list, json_pack("{s:o, s:o}", "from", ff_json_text(all->from[i]), "errors", own));
    }
    return json_pack("{s:f, s:O, s:O, s:f, s:o, s:o}", "seconds", budget, "candidate",
                     json_object_get(candidate, "label"), "assignments",
                     json_object_get(candidate, "assignments"), "expected_seconds",
                     time_of(all, candidate), "measured_errors", errors, "scenes", list);
}

static void tell(const json_t *promise)
{
    const json_t *list = json_object_get(promise, "scenes");
    json_t *error, *scene;
    const char *name;
    size_t i;
    bool several = json_array_size(list) > 1;
    printf("budget of %.3g s: %s, expected to take %.3g s\n%s", number_of(promise, "seconds"),
           json_string_value(json_object_get(promise, "candidate")),
           number_of(promise, "expected_seconds"), several ? "worst error that was measured:" : "");
    json_object_foreach(json_object_get(several ? promise : NULL, "measured_errors"), name, error)
        printf(" %s %.3g %%", name, 100 * json_number_value(error));
    printf(several ? "\n" : "");
    json_array_foreach(list, i, scene)
    {
        printf("error as measured in %s:", json_string_value(json_object_get(scene, "from")));
        json_object_foreach(json_object_get(scene, "errors"), name, error)
            printf(" %s %.3g %%", name, 100 * json_number_value(error));
        putchar('\n');
    }
    puts(several
             ? "this relies on these scenes: one that is like none of them may be worse\n"
             : "this relies on one scene alone: another one may be worse; measure more of them, "
               "and name\neach with --from\n");
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

static bool load_scenes(scenes *all, ff_report *report)
{
    for (size_t i = 0; i < all->count; i++) {
        char *path = ff_print_text("%s/tradeoff.json", all->from[i]);
        all->results[i] = json_load_file(path, 0, NULL);
        free(path);
        if (!json_is_array(json_object_get(all->results[i], "candidates")))
            return ff_error(report, FF_EXIT_INPUT, FF_NOWHERE,
                            "run a study with \"tradeoff\" first, and name its results with --from",
                            "%s holds no measured trade-off", all->from[i]);
    }
    return true;
}

/* NULL after an error. */
static json_t *find_promise(const scenes *all, const char *text, ff_report *report)
{
    const json_t *best;
    double budget = 0, least;
    char why[200];
    ff_unit second;
    ff_unit_parse("s", &second, why, sizeof why);
    if (!ff_quantity_parse(text, &second, "s", &budget, why, sizeof why) || !(budget > 0))
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                 "--budget wants a time such as \"10 s\", not \"%.40s\"", text);
    else if ((best = choose(all, budget, &least)))
        return promise_of(all, best, budget);
    else if (isfinite(least))
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                 "nothing fits into %.3g s: the quickest candidate of %s takes %.3g s", budget,
                 all->from[0], least);
    else
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, "the studies must have the same candidates",
                 "no candidate of %s was measured in all scenes", all->from[0]);
    return NULL;
}

int ff_run_budget(const ff_options *options)
{
    ff_report *report = ff_report_new();
    char *own = ff_default_directory(options->operand);
    const char *only[] = {own};
    scenes all = {.from = options->from_count ? options->froms : only,
                  .count = options->from_count ? options->from_count : 1};
    all.results = ff_alloc(all.count * sizeof *all.results);
    json_t *promise =
        load_scenes(&all, report) ? find_promise(&all, options->budget, report) : NULL;
    if (promise && !options->json)
        tell(promise);
    int code = promise ? run(options, promise) : ff_refuse(report, options, "nothing was run");
    for (size_t i = 0; i < all.count; i++)
        json_decref(all.results[i]);
    free(all.results);
    json_decref(promise);
    ff_report_free(report);
    free(own);
    return code;
}
