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
    fe_kindred kind;
    const fe_stage *law;
    void *table;
    atomic_flag taken;
    atomic_bool told;
    char text[240];
    struct watch *next;
} watch;

struct fe_paranoia {
    fe_surroundings around;
    watch *watches;
    double **inputs; /* copies during evaluate */
};

void fe_paranoia_begin(fe_instance *instance)
{
    instance->paranoia = fe_alloc(sizeof *instance->paranoia);
}

void fe_paranoia_end(fe_instance *instance)
{
    struct fe_paranoia *paranoia = instance->paranoia;
    for (watch *next, *w = paranoia ? paranoia->watches : NULL; w; w = next) {
        next = w->next;
        fe_kind_close(&w->kind);
        free(w->table);
        free(w);
    }
    free(paranoia);
    instance->paranoia = NULL;
}

void fe_paranoia_enter(fe_instance *instance)
{
    if (instance->paranoia)
        fe_surroundings_keep(&instance->paranoia->around);
}

bool fe_paranoia_leave(const fe_stage *stage, const char *changed, const char *action,
                       fe_report *report)
{
    const struct fe_paranoia *paranoia = stage->instance->paranoia;
    char what[300];
    bool good = true;
    if (!paranoia)
        return true;
    for (watch *w = paranoia->watches; w; w = w->next)
        if (atomic_load(&w->told))
            good = fe_blame(w->law, report, w->text);
    changed = changed ? changed : fe_surroundings_changed(&paranoia->around);
    if (!changed)
        return good;
    snprintf(what, sizeof what, "%s during %s", changed, action);
    return fe_blame(stage, report, what);
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

const void *fe_paranoia_watch(fe_build *b, fe_stage *stage, const fe_stage *law,
                              const char *service, const void *table)
{
    char *kind = fe_copy_text(law->use, strcspn(law->use, "/"));
    watch *w = fe_alloc(sizeof *w);
    w->law = law;
    if (fe_kind_open(&w->kind, b->library, kind, b->report) && w->kind.asks->service &&
        !strcmp(w->kind.asks->service, service) && FF_HAS(w->kind.asks, watch) &&
        w->kind.asks->watch)
        w->table = w->kind.asks->watch(table, blame, w);
    w->next = stage->instance->paranoia->watches;
    stage->instance->paranoia->watches = w;
    free(kind);
    return w->table ? w->table : table;
}

/* The results between zones become plain ones. */
static void settle_results(fe_stage *stage)
{
    fe_instance *instance = stage->instance;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        fe_result *result = &stage->results[i];
        if (!result->data)
            continue;
        if (!fe_zoned_whole(result->data, result->count) && !instance->fault[0])
            snprintf(instance->fault, sizeof instance->fault,
                     "wrote outside the array of the output \"%s\", %zu numbers", result->row->name,
                     result->count);
        double *data = fe_alloc(result->count * sizeof *data);
        memcpy(data, result->data, result->count * sizeof *data);
        fe_zoned_free(result->data);
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

void fe_paranoia_before(fe_stage *stage, const ff_array *in)
{
    size_t inputs = stage->loaded->model->input_count;
    double **copies = fe_alloc((inputs + 1) * sizeof *copies);
    for (size_t i = 0; i < inputs; i++) {
        copies[i] = fe_alloc(count_of(&in[i]) * sizeof **copies);
        if (in[i].data)
            memcpy(copies[i], in[i].data, count_of(&in[i]) * sizeof **copies);
    }
    stage->instance->paranoia->inputs = copies;
}

void fe_paranoia_after(fe_stage *stage, const ff_array *in)
{
    fe_instance *instance = stage->instance;
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
