/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records the work of the stages in which measured cases differ, and stores the series over which
   requested series are plotted. */
#include "case.h"

#include "../../accuracy/axis.h"
#include "../../run/run.h"
#include "../store/hash.h"
#include "../store/journal.h"

#include <sched.h>
#include <stdlib.h>
#include <string.h>

uint64_t study_measure_fingerprint(uint64_t fingerprint, size_t repeat)
{
    fingerprint = study_hash_text(fingerprint, "measured");
    return study_hash(fingerprint, &repeat, sizeof repeat);
}

void study_measure_pin(void)
{
    cpu_set_t set;
    int core = sched_getcpu();
    CPU_ZERO(&set);
    if (core < 0)
        return;
    CPU_SET((size_t)core, &set);
    sched_setaffinity(0, sizeof set, &set); /* if it fails, the measured costs only scatter more */
}

/* Returns the result "stage.name" if the stage runs, or NULL if there is none or it is a
   service. */
static ff_result *find_result(const ff_pipeline *pipeline, const char *path, const ff_stage **stage)
{
    ff_result *result = run_output(pipeline, path, stage);
    return result && (*stage)->needed && !result->row->service ? result : NULL;
}

/* Returns whether the output `of` may be plotted over the row: over the series that the file names,
   if it names one. */
static bool may_be_axis(const study_measure *m, const ff_port *row, const ff_port *of)
{
    bool along = row != of && of->dims && !strpbrk(of->dims, " ");
    return along &&
           (m->along ? row->dims && !strcmp(row->dims, of->dims) && !strcmp(row->name, m->along)
                     : accuracy_may_be_axis(row, of));
}

/* Marks the stages whose settings the case has as a twin: what they estimate is not read. Returns
   false if there are none. */
static bool mark_twin(const study_definition *study, size_t index, const ff_pipeline *pipeline)
{
    bool twin = false;
    const char *setting;
    for (size_t i = 0; i < pipeline->count; i++)
        pipeline->stages[i].unread = false;
    for (size_t k = study->varied_count - study->refined_count; k < study->varied_count; k++) {
        ff_stage *stage = ff_stage_of(pipeline, study->varied[k].path, &setting);
        if (!stage || !*study_assignment(study, k, index))
            continue;
        stage->unread = true;
        twin = true;
    }
    return twin;
}

void study_measure_want(const study_definition *study, size_t index, const ff_pipeline *pipeline)
{
    const size_t extra_count = mark_twin(study, index, pipeline) ? 0 : study->extra_count;
    const study_measure *m = study->measure;
    const ff_stage *stage;
    for (size_t i = 0; m && i < m->request->count; i++) {
        const ff_result *self = find_result(pipeline, m->request->items[i]->text, &stage);
        for (size_t k = 0; self && k < stage->loaded->model->output_count; k++)
            if (may_be_axis(m, stage->results[k].row, self->row))
                stage->results[k].wanted = true;
    }
    for (size_t i = 0; i < extra_count; i++) {
        ff_result *result = find_result(pipeline, study->extras[i], &stage);
        if (result) {
            result->wanted = true;
            result->requested = 1;
        }
    }
}

bool *study_measure_fresh(const study_measure *m, const ff_pipeline *pipeline)
{
    bool *fresh = memory_alloc((pipeline->count + 1) * sizeof *fresh);
    for (size_t i = 0; i < pipeline->count; i++) {
        size_t at = pipeline->order[i];
        const ff_stage *stage = &pipeline->stages[at];
        fresh[at] = m->all;
        for (size_t k = 0; k < m->knob_count; k++)
            fresh[at] = fresh[at] || !strcmp(m->knobs[k], stage->name);
        for (size_t k = 0; k < stage->wire_count; k++)
            fresh[at] = fresh[at] || (stage->wires[k].stage >= 0 && fresh[stage->wires[k].stage]);
    }
    return fresh;
}

static ff_result *find_axis(const study_measure *m, const ff_stage *stage, const ff_result *self)
{
    const ff_result *axis = accuracy_axis(NULL, stage, self->dims[0], self->count, self, m->along);
    return axis && may_be_axis(m, axis->row, self->row) ? (ff_result *)(size_t)axis : NULL;
}

/* Adds {output: name of the series of its stage over which it is plotted}, and stores that
   series. */
static void add_axis(const study_measure *m, const ff_pipeline *pipeline, const char *path,
                     json_t *all)
{
    const ff_stage *stage;
    const ff_result *result = find_result(pipeline, path, &stage);
    ff_result *axis =
        result && result->data && result->rank == 1 ? find_axis(m, stage, result) : NULL;
    if (!axis)
        return;
    axis->requested = true;
    json_object_set_new(all, path, json_string(axis->row->name));
}

void study_measure_record(const study_case *c, const study_definition *study, json_t *record)
{
    const study_measure *m = study->measure;
    const ff_pipeline *pipeline = c->pipeline;
    bool *fresh = study_measure_fresh(m, pipeline);
    json_t *along = json_object(), *work = json_object();
    for (size_t i = 0; i < m->request->count; i++)
        add_axis(m, pipeline, m->request->items[i]->text, along);
    for (size_t i = 0; i < study->extra_count; i++)
        add_axis(m, pipeline, study->extras[i], along);
    for (size_t i = 0; i < pipeline->count; i++)
        if (fresh[i] && pipeline->stages[i].ran)
            json_object_set_new(work, pipeline->stages[i].name,
                                json_real(pipeline->stages[i].work));
    json_object_set_new(record, "measured", json_pack("{s:o, s:o}", "work", work, "along", along));
    free(fresh);
}
