/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Guards around every call into a model, for a user who has reason to doubt one. */
#include "build.h"

#include "../plugin/kind.h"
#include "../value/zoned.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A law that a stage uses, watched. */
typedef struct watch {
    ff_kindred kind;
    const ff_stage *law;
    void *table;
    atomic_flag taken;
    atomic_bool told;
    char text[240];
    struct watch *next;
} watch;

struct ff_paranoia {
    ff_surroundings around;
    watch *watches;
    double **inputs; /* copies during evaluate */
};

void ff_paranoia_begin(ff_instance *instance)
{
    instance->paranoia = ff_alloc(sizeof *instance->paranoia);
}

void ff_paranoia_end(ff_instance *instance)
{
    struct ff_paranoia *paranoia = instance->paranoia;
    for (watch *next, *w = paranoia ? paranoia->watches : NULL; w; w = next) {
        next = w->next;
        ff_kind_close(&w->kind);
        free(w->table);
        free(w);
    }
    free(paranoia);
    instance->paranoia = NULL;
}

void ff_paranoia_enter(ff_instance *instance)
{
    if (instance->paranoia)
        ff_surroundings_keep(&instance->paranoia->around);
}

bool ff_paranoia_leave(const ff_stage *stage, const char *changed, const char *action,
                       ff_report *report)
{
    const struct ff_paranoia *paranoia = stage->instance->paranoia;
    char what[300];
    bool good = true;
    if (!paranoia)
        return true;
    for (watch *w = paranoia->watches; w; w = w->next)
        if (atomic_load(&w->told))
            good = ff_blame(w->law, report, w->text);
    changed = changed ? changed : ff_surroundings_changed(&paranoia->around);
    if (!changed)
        return good;
    snprintf(what, sizeof what, "%s during %s", changed, action);
    return ff_blame(stage, report, what);
}

/* From any thread; the first word stands. */
static void blame(void *ctx, const char *text)
{
    watch *w = ctx;
    if (atomic_flag_test_and_set(&w->taken))
        return;
    snprintf(w->text, sizeof w->text, "%s", text);
    atomic_store(&w->told, true);
}

const void *ff_paranoia_watch(ff_build *b, ff_stage *stage, const ff_stage *law,
                              const char *service, const void *table)
{
    char *kind = ff_copy_text(law->use, strcspn(law->use, "/"));
    watch *w = ff_alloc(sizeof *w);
    w->law = law;
    if (ff_kind_open(&w->kind, b->library, kind, b->report) && w->kind.asks->service &&
        !strcmp(w->kind.asks->service, service) && FF_HAS(w->kind.asks, watch) &&
        w->kind.asks->watch)
        w->table = w->kind.asks->watch(table, blame, w);
    w->next = stage->instance->paranoia->watches;
    stage->instance->paranoia->watches = w;
    free(kind);
    return w->table ? w->table : table;
}

/* The results between zones become plain ones. */
static void settle_results(ff_stage *stage)
{
    ff_instance *instance = stage->instance;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        ff_result *result = &stage->results[i];
        if (!result->data)
            continue;
        if (!ff_zoned_whole(result->data, result->count) && !instance->fault[0])
            snprintf(instance->fault, sizeof instance->fault,
                     "wrote outside the array of the output \"%s\", %zu numbers", result->row->name,
                     result->count);
        double *data = ff_alloc(result->count * sizeof *data);
        memcpy(data, result->data, result->count * sizeof *data);
        ff_zoned_free(result->data);
        result->data = data;
    }
}

static size_t count_of(const ff_array *in)
{
    size_t count = in->data ? 1 : 0;
    for (uint32_t i = 0; in->data && i < in->rank; i++)
        count *= in->shape[i];
    return count;
}

void ff_paranoia_before(ff_stage *stage, const ff_array *in)
{
    size_t inputs = stage->loaded->model->input_count;
    double **copies = ff_alloc((inputs + 1) * sizeof *copies);
    for (size_t i = 0; i < inputs; i++) {
        copies[i] = ff_alloc(count_of(&in[i]) * sizeof **copies);
        if (in[i].data)
            memcpy(copies[i], in[i].data, count_of(&in[i]) * sizeof **copies);
    }
    stage->instance->paranoia->inputs = copies;
}

void ff_paranoia_after(ff_stage *stage, const ff_array *in)
{
    ff_instance *instance = stage->instance;
    double **copies = instance->paranoia->inputs;
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        size_t size = count_of(&in[i]) * sizeof **copies;
        if (size && memcmp(copies[i], in[i].data, size) != 0 && !instance->fault[0])
            snprintf(instance->fault, sizeof instance->fault, "changed its input \"%s\"",
                     ff_model_input(stage->loaded->model, i)->name);
        free(copies[i]);
    }
    free(copies);
    settle_results(stage);
}
