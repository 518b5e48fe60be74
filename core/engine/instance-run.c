/* SPDX-License-Identifier: MIT */
/* Runs an instance, and returns its results and services. */
#include "instance.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Returns the row of the output; -1 after an error. */
static int find_output(ff_instance *i, const char *name)
{
    const ff_model *model = i->stage.loaded->model;
    const char **names = fe_alloc((model->output_count + 1) * sizeof *names);
    size_t count = 0;
    int found = -1;
    for (size_t k = 0; k < model->output_count && found < 0; k++) {
        const ff_port *row = ff_model_output(model, k);
        if (!row->service && !strcmp(row->name, name))
            found = (int)k;
        else if (!row->service)
            names[count++] = row->name;
    }
    if (found < 0)
        fe_refuse_name(i, "output", name, names, count);
    fe_free(names);
    return found;
}

/* Marks the outputs named in `words` as requested; NULL: all outputs. False for an unknown name. */
static bool request(ff_instance *i, const char *words)
{
    const ff_model *model = i->stage.loaded->model;
    char name[96];
    for (size_t k = 0; k < model->output_count; k++) {
        i->stage.results[k].wanted = !words && !i->stage.results[k].row->service;
        i->stage.results[k].refused = false;
        i->stage.results[k].required = false;
    }
    while (words && *(words += strspn(words, " "))) {
        size_t length = strcspn(words, " ");
        snprintf(name, sizeof name, "%.*s", (int)length, words);
        int output = find_output(i, name);
        if (output < 0)
            return false;
        i->stage.results[output].wanted = i->stage.results[output].required = true;
        words += length;
    }
    return true;
}

static bool is_up_to_date(const ff_instance *i)
{
    bool good = i->stage.ran && i->object.alive;
    for (size_t k = 0; k < i->stage.loaded->model->input_count && good; k++) {
        const fe_feed *feed = &i->feeds[k];
        bool serves = ff_model_input(i->stage.loaded->model, k)->service;
        if (feed->from)
            good = serves ? feed->from->object.alive && feed->version == feed->from->version
                          : is_up_to_date(feed->from) && feed->version == feed->from->runs;
    }
    return good;
}

static bool run_marked(fe_request *q);

/* Runs the instance `from` for the outputs that this instance takes from it, and for those
   requested of it before. */
static bool run_feeding(ff_instance *i, ff_instance *from)
{
    const ff_model *model = i->stage.loaded->model;
    for (size_t k = 0; k < from->stage.loaded->model->output_count; k++) {
        from->stage.results[k].wanted = from->stage.results[k].data;
        from->stage.results[k].refused = false;
        from->stage.results[k].required = false;
    }
    for (size_t k = 0; k < model->input_count; k++) {
        const ff_port *row = ff_model_input(model, k);
        if (i->feeds[k].from != from || row->service)
            continue;
        ff_result *taken = &from->stage.results[i->feeds[k].output];
        taken->wanted = true;
        taken->required = taken->required || !(row->flags & FF_OPTIONAL);
    }
    return fe_pass_on(i, from, fe_handle(&(fe_request){.instance = from, .work = run_marked}));
}

static bool run_what_feeds(ff_instance *i)
{
    for (size_t k = 0; k < i->stage.loaded->model->input_count; k++) {
        ff_instance *from = i->feeds[k].from;
        if (!from || ff_model_input(i->stage.loaded->model, k)->service)
            continue;
        bool there = from->stage.results[i->feeds[k].output].data ||
                     from->stage.results[i->feeds[k].output].refused;
        if (!(there && is_up_to_date(from)) && !run_feeding(i, from))
            return false;
    }
    return true;
}

/* Collects one array for each input row. Dimensions with the same name on the same wire must
 * have the same length. */
static bool gather(ff_instance *i, ff_array *in)
{
    const ff_loaded *loaded = i->stage.loaded;
    fe_lengths all = {.count = 0};
    bool good = true;
    char why[256];
    for (size_t k = 0; k < loaded->model->input_count && good; k++) {
        const ff_port *row = ff_model_input(loaded->model, k);
        fe_feed *feed = &i->feeds[k];
        const ff_dims *dims = &loaded->input_dims[k];
        in[k] = feed->array;
        if (feed->from && !row->service) {
            const ff_result *given = &feed->from->stage.results[feed->output];
            in[k] = (ff_array){.data = given->data, .shape = given->shape, .rank = given->rank};
            feed->version = feed->from->runs;
        }
        if (!in[k].data)
            in[k] = (ff_array){.data = NULL};
        else if (!fe_rank_fits(dims, in[k].rank))
            good = fe_refuse(i, row->name, "\"%s\" is given %u dimensions; it takes \"%s\"",
                             row->name, in[k].rank, row->dims);
        else if (!fe_enter_lengths(&all, loaded->model, row, dims, in[k].rank, in[k].shape, why,
                                   sizeof why))
            good = fe_refuse(i, row->name, "%s", why);
    }
    fe_free(all.seen);
    return good;
}

static bool evaluate(ff_instance *i, const ff_array *in)
{
    ff_stage *stage = &i->stage;
    i->runs++;
    stage->seconds = stage->work = 0;
    fe_folder_keep(&i->memory.folder);
    i->object.watch = &i->observer;
    i->pipeline.chained = stage->state != NULL;
    stage->ran = fe_evaluate(&i->pipeline, stage, in, i->report);
    i->pipeline.chained = false;
    i->object.watch = NULL;
    if (!stage->ran || fe_wants_any(stage))
        i->evaluated = stage->ran;
    ff_stage_set_state(stage, NULL, 0);
    if (stage->status != FF_OK)
        i->object.status = stage->status;
    return stage->ran;
}

/* Drops the results of the previous run. */
static void begin(ff_instance *i)
{
    i->failed = true;
    i->stage.ran = false;
}

/* Runs the instance for the outputs that are marked as wanted. */
static bool run_marked(fe_request *q)
{
    ff_instance *i = q->instance;
    begin(i);
    if (!run_what_feeds(i) || !fe_make_object(i)) {
        fe_forget_results(&i->stage);
        return false;
    }
    ff_array *in = fe_alloc((i->stage.loaded->model->input_count + 1) * sizeof *in);
    fe_forget_results(&i->stage);
    i->failed = !(gather(i, in) && evaluate(i, in));
    fe_free(in);
    return !i->failed;
}

static bool run(fe_request *q)
{
    begin(q->instance);
    return request(q->instance, q->text) && run_marked(q);
}

ff_status ff_instance_run(ff_instance *instance, const char *outputs)
{
    if (!instance)
        return FF_INVALID;
    return fe_handle(&(fe_request){.instance = instance, .work = run, .text = outputs});
}

/* Explains why there are no results. */
static const char *why_not(const ff_instance *i)
{
    if (i->failed)
        return "the last run failed";
    return i->runs ? "a parameter or an input has changed since the last run"
                   : "the instance has not run yet";
}

static bool refuse_result(fe_request *q)
{
    ff_instance *i = q->instance;
    int row = find_output(i, q->name);
    return row >= 0 &&
           fe_refuse(i, q->name, "the output \"%s\" is not available: %s", q->name,
                     !i->stage.ran                   ? why_not(i)
                     : i->stage.results[row].refused ? "the model refused it in the last run"
                                                     : "the last run did not request it");
}

/* Explains why a call gives no result, and changes only the messages of the instance. */
static ff_status refuse(const ff_instance *i, bool (*work)(fe_request *q), const char *name)
{
    return fe_handle(
        &(fe_request){.instance = (ff_instance *)(uintptr_t)i, .work = work, .name = name});
}

ff_status ff_instance_result(const ff_instance *i, const char *output, const ff_result **result)
{
    if (result)
        *result = NULL;
    if (!i || !output || !result)
        return fe_absent(i, output ? "result" : "output");
    int row = ff_model_find_output(i->stage.loaded->model, output);
    bool there = !i->broken && i->stage.ran && row >= 0 && i->stage.results[row].data;
    *result = there ? &i->stage.results[row] : NULL;
    return there ? FF_OK : refuse(i, refuse_result, output);
}

ff_status ff_instance_quality(const ff_instance *i, size_t index, const ff_quality **line)
{
    if (!i || !line)
        return fe_absent(i, "line");
    bool there = !i->broken && (i->stage.ran || i->failed) && index < i->stage.quality_count;
    *line = there ? &i->stage.quality[index] : NULL;
    return there ? FF_OK : FF_INVALID;
}

static bool refuse_verdict(fe_request *q)
{
    return fe_refuse(q->instance, "", "there is no verdict: %s", why_not(q->instance));
}

ff_status ff_instance_verdict(const ff_instance *i, int32_t *verdict)
{
    const ff_quality *line;
    if (!i || !verdict)
        return fe_absent(i, "verdict");
    *verdict = i->stage.ran ? FF_GOOD : FF_BAD;
    if (i->broken || !(i->stage.ran || i->failed))
        return refuse(i, refuse_verdict, "");
    for (size_t k = 0; ff_instance_quality(i, k, &line) == FF_OK; k++)
        *verdict = line->verdict > *verdict ? line->verdict : *verdict;
    return FF_OK;
}

static bool fetch(fe_request *q)
{
    ff_instance *i = q->instance;
    int row = ff_model_find_service(i->stage.loaded->model, q->name);
    if (row < 0)
        return fe_refuse(i, q->name, "it does not offer the service %s", q->name);
    if (!fe_make_object(i))
        return false;
    *q->fetched = fe_fetch_service(&i->stage, (uint32_t)row, false, i->report);
    return *q->fetched;
}

ff_status ff_instance_service(ff_instance *instance, const char *interface, const void **table)
{
    if (!instance || !interface || !table)
        return fe_absent(instance, interface ? "table" : "interface");
    *table = NULL;
    return fe_handle(
        &(fe_request){.instance = instance, .work = fetch, .name = interface, .fetched = table});
}

static void do_call(void *of)
{
    fe_request *q = of;
    q->status = q->call(q->ctx);
}

/* Calls the model. If an allocation fails inside, the call is only abandoned after fe_call_end, so
   that the bracket around the model's code is closed. */
static bool call(fe_request *q)
{
    ff_instance *i = q->instance;
    fe_call bracket = fe_call_begin(&i->stage, q->name);
    i->object.watch = &i->observer;
    if (fe_protected(&i->heap, do_call, q) == FF_NOMEM)
        i->object.no_memory = true;
    i->object.watch = NULL;
    return fe_call_end(&bracket, q->status, i->report);
}

ff_status ff_instance_call(ff_instance *instance, const char *action, ff_status (*work)(void *ctx),
                           void *ctx)
{
    if (!instance || !action || !work)
        return fe_absent(instance, action ? "work" : "action");
    return fe_handle(&(fe_request){
        .instance = instance, .work = call, .name = action, .call = work, .ctx = ctx});
}

/* Returns a copy of the state that the stage left, in the heap in use. The state that the stage was
   given for its own next run is not changed. */
static bool take_state(ff_instance *from, void **state, size_t *size, ff_report *report)
{
    ff_stage *stage = &from->stage;
    void *given = stage->state;
    size_t given_size = stage->state_size;
    stage->state = NULL;
    stage->state_size = 0;
    from->pipeline.chained = true;
    bool good = fe_save_state(&from->pipeline, stage, report);
    from->pipeline.chained = false;
    *state = stage->state;
    *size = stage->state_size;
    stage->state = given;
    stage->state_size = given_size;
    return good;
}

static bool carry(fe_request *q)
{
    ff_instance *i = q->instance, *from = q->other;
    void *state = NULL;
    size_t size = 0;
    if (from->engine != i->engine)
        return fe_refuse(i, "", "%s belongs to another engine", from->stage.use);
    bool there =
        ff_stage_has_state(&i->stage) && from->evaluated && ff_stage_has_state(&from->stage);
    if (there && !take_state(from, &state, &size, i->report))
        return false;
    if (!state) {
        i->object.status = FF_UNSUPPORTED;
        return fe_refuse(i, "", "%s has no state to hand on", from->stage.use);
    }
    fe_free(i->stage.state);
    i->stage.state = state;
    i->stage.state_size = size;
    return true;
}

ff_status ff_instance_carry(ff_instance *to, ff_instance *from)
{
    if (!to || !from)
        return fe_absent(to, "from");
    return fe_handle(&(fe_request){.instance = to, .work = carry, .other = from});
}

ff_status ff_instance_observe(ff_instance *instance, const ff_observer *observer)
{
    if (!instance)
        return FF_INVALID;
    size_t known = sizeof instance->observer;
    memset(&instance->observer, 0, known);
    if (observer)
        memcpy(&instance->observer, observer, observer->size < known ? observer->size : known);
    return FF_OK;
}

const char *ff_instance_reason(const ff_instance *i)
{
    return i ? i->reason : "";
}

const char *ff_instance_item(const ff_instance *i)
{
    return i ? i->item : "";
}

const ff_report *ff_instance_report(const ff_instance *i)
{
    return i->report;
}

const ff_stage *ff_instance_stage(const ff_instance *i)
{
    return &i->stage;
}

void ff_instance_watch(ff_instance *i, const ff_hooks *hooks)
{
    i->object.hooks = hooks;
}
