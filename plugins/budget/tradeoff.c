/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The most accurate candidate of a measured trade-off that fits into a time. */
#include <flankfilm/author.h>
#include <flankfilm/budget.h>

#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

static double number_of(const json_t *map, const char *key)
{
    return json_number_value(json_object_get(map, key));
}

/* A directory's name may be no UTF-8, which JSON wants. */
static json_t *json_text(const char *text)
{
    json_t *string = json_string(text);
    return string ? string : json_string("?");
}

/* Trade-offs that were measured, each in another scene, of the same candidates. */
typedef struct scenes {
    const ff_budget_request *request;
    json_t **results; /* of each directory */
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
static const json_t *choose(const scenes *all, double *least)
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
        if (time <= all->request->seconds &&
            (error < known || (best && error <= known && time < time_of(all, best))))
            best = one;
    }
    return best;
}

/* The worst errors of all scenes, and those of each. */
static json_t *promise_of(const scenes *all, const json_t *candidate)
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
        json_array_append_new(list,
                              json_pack("{s:o, s:o}", "from",
                                        json_text(all->request->directories[i]), "errors", own));
    }
    return json_pack("{s:f, s:O, s:O, s:f, s:o, s:o}", "seconds", all->request->seconds,
                     "candidate", json_object_get(candidate, "label"), "assignments",
                     json_object_get(candidate, "assignments"), "expected_seconds",
                     time_of(all, candidate), "measured_errors", errors, "scenes", list);
}

static void tell(const json_t *promise, FILE *out)
{
    const json_t *list = json_object_get(promise, "scenes");
    json_t *error, *scene;
    const char *name;
    size_t i;
    bool several = json_array_size(list) > 1;
    fprintf(out, "budget of %.3g s: %s, expected to take %.3g s\n%s", number_of(promise, "seconds"),
            json_string_value(json_object_get(promise, "candidate")),
            number_of(promise, "expected_seconds"),
            several ? "worst error that was measured:" : "");
    json_object_foreach(json_object_get(several ? promise : NULL, "measured_errors"), name, error)
        fprintf(out, " %s %.3g %%", name, 100 * json_number_value(error));
    fputs(several ? "\n" : "", out);
    json_array_foreach(list, i, scene)
    {
        fprintf(out, "error as measured in %s:", json_string_value(json_object_get(scene, "from")));
        json_object_foreach(json_object_get(scene, "errors"), name, error)
            fprintf(out, " %s %.3g %%", name, 100 * json_number_value(error));
        fputc('\n', out);
    }
    fputs(several
              ? "this relies on these scenes: one that is like none of them may be worse\n\n"
              : "this relies on one scene alone: another one may be worse; measure more of them, "
                "and name\neach with --from\n\n",
          out);
}

static ff_status hand_over(const scenes *all, json_t *promise)
{
    const ff_budget_request *r = all->request;
    json_t *assignment;
    size_t i, length = 0;
    char *text = NULL, *json = json_dumps(promise, JSON_COMPACT | JSON_REAL_PRECISION(17));
    FILE *out = open_memstream(&text, &length);
    if (out) {
        tell(promise, out);
        fclose(out);
    }
    ff_status status = out && json ? FF_OK : FF_NOMEM;
    json_array_foreach(json_object_get(promise, "assignments"), i, assignment)
        r->assign(r->ctx, json_string_value(assignment));
    if (status == FF_OK) {
        r->say(r->ctx, text);
        r->promise(r->ctx, json);
    }
    free(text);
    free(json);
    return status;
}

FF_PRINTF(3, 4)
static ff_status refuse(const ff_budget_request *r, const char *hint, const char *format, ...)
{
    char text[600];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return r->refuse(r->ctx, hint, text);
}

static ff_status load_scenes(const scenes *all)
{
    const ff_budget_request *r = all->request;
    for (size_t i = 0; i < all->count; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/tradeoff.json", r->directories[i]);
        all->results[i] = json_load_file(path, 0, NULL);
        if (!json_is_array(json_object_get(all->results[i], "candidates")))
            return refuse(r,
                          "run a study with \"tradeoff\" first, and name its results with --from",
                          "%s holds no measured trade-off", r->directories[i]);
    }
    return FF_OK;
}

static ff_status answer(const scenes *all)
{
    const ff_budget_request *r = all->request;
    double least;
    ff_status status = load_scenes(all);
    const json_t *best = status == FF_OK ? choose(all, &least) : NULL;
    if (best) {
        json_t *promise = promise_of(all, best);
        status = hand_over(all, promise);
        json_decref(promise);
        return status;
    }
    if (status != FF_OK)
        return status;
    if (isfinite(least))
        return refuse(r, NULL,
                      "nothing fits into %.3g s: the quickest candidate of %s takes %.3g s",
                      r->seconds, r->directories[0], least);
    return refuse(r, "the studies must have the same candidates",
                  "no candidate of %s was measured in all scenes", r->directories[0]);
}

static ff_status choose_run(void *self, const ff_budget_request *request)
{
    scenes all = {.request = request,
                  .results = calloc(request->directory_count, sizeof *all.results),
                  .count = request->directory_count};
    (void)self;
    ff_status status = all.results ? answer(&all) : FF_NOMEM;
    for (size_t i = 0; all.results && i < all.count; i++)
        json_decref(all.results[i]);
    free(all.results);
    return status;
}

static ff_status create(const ff_host *host, void **self)
{
    (void)host;
    *self = NULL;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    static const ff_budget budget = {.size = sizeof budget, .choose = choose_run};
    (void)self, (void)output;
    return &budget;
}

static const ff_port outputs[] = {{.name = "budget",
                                   .unit = "",
                                   .doc = "finds what keeps to a time",
                                   .dims = "",
                                   .service = FF_BUDGET_ID}};

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 1,
    .id = "budget/tradeoff",
    .version = "1.0.0",
    .summary = "the most accurate candidate of a measured trade-off that fits into a time",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_NO_TABLE,
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(outputs),
    .create = create,
    .service = service,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
