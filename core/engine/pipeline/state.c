/* SPDX-License-Identifier: MIT */
/* The chain state: a stage hands it to the next case of a chain, which starts from it. */
#include "build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BYTES = 1 << 20 };

bool ff_stage_has_state(const ff_stage *stage)
{
    return stage->needed && FF_HAS(stage->loaded->model, carry) && stage->loaded->model->carry;
}

void ff_stage_set_state(ff_stage *stage, const void *bytes, size_t size)
{
    void *copy = size ? fe_alloc(size) : NULL;
    if (size)
        memcpy(copy, bytes, size);
    fe_free(stage->state);
    stage->state = copy;
    stage->state_size = size;
}

static bool call(const ff_stage *stage, const ff_state_bytes *from, ff_state_bytes *to,
                 ff_report *report)
{
    fe_call call = fe_call_begin(stage, "carry");
    ff_status status = stage->loaded->model->carry(stage->instance->self, from, to);
    return fe_call_end(&call, status, report);
}

bool fe_restore_state(const ff_pipeline *pipeline, ff_stage *stage, ff_report *report)
{
    const ff_state_bytes from = {sizeof from, stage->state, stage->state_size};
    return !pipeline->chained || !ff_stage_has_state(stage) || !stage->state ||
           call(stage, &from, NULL, report);
}

bool fe_save_state(const ff_pipeline *pipeline, ff_stage *stage, ff_report *report)
{
    ff_state_bytes to = {.size = sizeof to};
    char what[96];
    if (!pipeline->chained || !ff_stage_has_state(stage))
        return true;
    if (!call(stage, NULL, &to, report))
        return false;
    if (to.count > MOST_BYTES || (to.count && !to.bytes)) {
        snprintf(what, sizeof what, "gave a state of %zu bytes%s; at most %d are possible",
                 to.count, to.bytes ? "" : " without their address", MOST_BYTES);
        return fe_plugin_fault(stage, report, what);
    }
    if (to.count) /* if evaluate left no state, the state before it is handed on */
        ff_stage_set_state(stage, to.bytes, to.count);
    return true;
}
