/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One instance of the model under test and the host that it sees; what is said of it. */
#include "subject.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double verify_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void verify_doing(verify_subject *subject, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(subject->doing, sizeof subject->doing, format, args);
    va_end(args);
    subject->exam->doing(subject->exam->ctx, subject->doing);
}

static void say(const verify_subject *subject, void (*word)(void *ctx, const char *text),
                const char *format, va_list args)
{
    char text[512];
    vsnprintf(text, sizeof text, format, args);
    word(subject->exam->ctx, text);
}

bool verify_faulty(verify_subject *subject, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    say(subject, subject->exam->fault, format, args);
    va_end(args);
    return false;
}

bool verify_untried(verify_subject *subject, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    say(subject, subject->exam->untried, format, args);
    va_end(args);
    return false;
}

double verify_uniform(verify_random *random)
{
    uint64_t z = random->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

size_t verify_below(verify_random *random, size_t count)
{
    return (size_t)(verify_uniform(random) * (double)count);
}

__attribute__((format(printf, 2, 3))) static void breach(verify_trial *trial, const char *format,
                                                         ...)
{
    va_list args;
    va_start(args, format);
    if (!trial->breach[0])
        vsnprintf(trial->breach, sizeof trial->breach, format, args);
    va_end(args);
}

static ff_status host_fail(void *ctx, ff_status status, const char *item, const char *text)
{
    verify_trial *trial = ctx;
    snprintf(trial->item, sizeof trial->item, "%s", item ? item : "");
    snprintf(trial->text, sizeof trial->text, "%s", text ? text : "");
    return status;
}

static void host_log(void *ctx, int32_t level, const char *text)
{
    (void)level;
    if (!text)
        breach(ctx, "logged no text");
}

/* Lengths that the rows of the stage share are the business of the caller. */
static double *host_output(void *ctx, uint32_t index, uint32_t rank, const size_t *shape)
{
    verify_trial *trial = ctx;
    const ff_model *model = trial->subject->model;
    size_t count = 1;
    if (!trial->evaluating || index >= model->output_count) {
        breach(trial, "asked for memory of output row %u %s", index,
               trial->evaluating ? "which it does not have" : "outside of evaluate");
        return NULL;
    }
    const verify_dims *dims = &trial->subject->output_dims[index];
    const char *name = ff_model_output(model, index)->name;
    if (trial->outputs[index].data)
        breach(trial, "gave the output \"%s\" twice", name);
    else if (rank > dims->rank || rank + dims->first_optional < dims->rank)
        breach(trial, "gave the output \"%s\" with %u dimensions", name, rank);
    for (uint32_t i = 0; i < rank && !trial->breach[0]; i++)
        count *= trial->shapes[index][i] = shape[i];
    if (trial->breach[0] || count > (size_t)1 << 27)
        return NULL;
    trial->ranks[index] = rank;
    trial->outputs[index] = verify_guarded_new(count);
    memset(trial->outputs[index].data, 0, count * sizeof(double));
    return trial->outputs[index].data;
}

static void host_quality(void *ctx, const char *name, double value, double limit, int32_t verdict,
                         const char *text)
{
    (void)value, (void)limit, (void)text;
    if (!name || !name[0] || verdict < FF_GOOD || verdict > FF_BAD)
        breach(ctx, "gave a quality line without a name or with an unknown verdict");
}

static int32_t host_progress(void *ctx, double fraction)
{
    verify_trial *trial = ctx;
    (void)fraction;
    if (trial->stop_at > 0 && verify_now() > trial->stop_at)
        trial->asked_to_stop = true;
    return trial->asked_to_stop;
}

static ff_status tell_table(verify_trial *trial, ff_status status)
{
    const char *item, *why = trial->subject->exam->tables->why(trial->tables, &item);
    if (status == FF_BUG)
        breach(trial, "asked for a table that cannot be, or spoke of one that it has not read");
    return why ? host_fail(trial, status, item, why) : status;
}

static ff_status table_read(void *ctx, const char *item, const char *path, const ff_param *rows,
                            size_t count, size_t stride, const ff_table **table)
{
    verify_trial *trial = ctx;
    const ff_table_keeper *keeper = trial->subject->exam->tables;
    return tell_table(trial, keeper->read(trial->tables, item, path, rows, count, stride, table));
}

static ff_status table_fail(void *ctx, const ff_table *table, size_t row, size_t column,
                            const char *text)
{
    verify_trial *trial = ctx;
    const ff_table_keeper *keeper = trial->subject->exam->tables;
    return tell_table(trial, keeper->fail(trial->tables, table, row, column, text ? text : ""));
}

static const void *host_extension(void *ctx, const char *id)
{
    static const ff_table_reader tables = {sizeof tables, table_read, table_fail};
    (void)ctx;
    return id && !strcmp(id, FF_TABLE_ID) ? &tables : NULL;
}

static ff_status wire(verify_trial *trial, const verify_feed *feed)
{
    const ff_model *model = trial->subject->model;
    ff_status status = FF_OK;
    for (size_t i = 0; i < model->input_count && model->wire && status == FF_OK; i++) {
        const char *service = ff_model_input(model, i)->service;
        const void *table = service ? feed->services[i] : NULL;
        if (table || (!service && feed->inputs[i].data))
            status = model->wire(trial->self, (uint32_t)i, table);
    }
    return status;
}

ff_status verify_trial_open(verify_trial *trial, const verify_feed *feed)
{
    const ff_model *model = feed->subject->model;
    *trial =
        (verify_trial){.subject = feed->subject, .tables = feed->subject->exam->tables->open()};
    trial->host = (ff_host){.size = sizeof trial->host,
                            .abi_minor = FF_ABI_MINOR,
                            .ctx = trial,
                            .fail = host_fail,
                            .log = host_log,
                            .output = host_output,
                            .quality = host_quality,
                            .progress = host_progress,
                            .extension = host_extension};
    ff_status status = model->create(&trial->host, &trial->self);
    trial->created = status == FF_OK;
    for (size_t i = 0; i < model->param_count && status == FF_OK; i++)
        if (feed->values[i].size)
            status = model->set(trial->self, (uint32_t)i, &feed->values[i]);
    if (status == FF_OK)
        status = wire(trial, feed);
    return status == FF_OK && model->ready ? model->ready(trial->self) : status;
}

static void forget(verify_trial *trial)
{
    for (size_t i = 0; i < VERIFY_MOST_OUTPUTS; i++)
        verify_guarded_free(&trial->outputs[i]);
}

ff_status verify_trial_evaluate(verify_trial *trial, uint64_t wanted, const verify_feed *feed)
{
    forget(trial);
    trial->text[0] = trial->item[0] = 0;
    trial->evaluating = true;
    ff_status status = trial->subject->model->evaluate(trial->self, wanted, feed->inputs);
    trial->evaluating = false;
    return status;
}

void verify_trial_close(verify_trial *trial)
{
    if (trial->created && trial->subject->model->destroy)
        trial->subject->model->destroy(trial->self);
    trial->created = false;
    if (trial->tables)
        trial->subject->exam->tables->close(trial->tables);
    trial->tables = NULL;
    forget(trial);
}

uint64_t verify_all_outputs(const ff_model *model)
{
    uint64_t all = 0;
    for (size_t i = 0; i < model->output_count; i++)
        if (!ff_model_output(model, i)->service)
            all |= UINT64_C(1) << i;
    return all;
}

verify_feed *verify_find_feed(verify_subject *subject, verify_trial *trial, bool quietly)
{
    enum { TRIES = 400 };
    verify_feed *feed = subject->given;
    for (int i = 0; i < TRIES; i++) {
        if (!subject->given)
            feed = verify_feed_new(subject);
        if (!subject->given)
            verify_feed_draw_values(feed, &subject->random, VERIFY_INSIDE);
        verify_doing(subject, "create, set and ready");
        if (verify_trial_open(trial, feed) == FF_OK)
            return feed;
        verify_trial_close(trial);
        if (subject->given)
            break;
    }
    if (!quietly)
        verify_untried(subject,
                       "no parameters were found that it takes%s%s; --pipeline FILE gives some",
                       trial->text[0] ? ": " : "", trial->text);
    return NULL;
}
