/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "twin.h"

#include "axis.h"

#include "../run/run.h"

#include <stdlib.h>
#include <string.h>

/* Marks all stages downstream of the marked ones. */
static void spread(const ff_pipeline *pipeline, bool *marks)
{
    for (bool again = true; again;) { /* stages wired in a loop need several passes */
        again = false;
        for (size_t i = 0; i < pipeline->count; i++) {
            const ff_stage *stage = &pipeline->stages[i];
            for (size_t k = 0; k < stage->wire_count && !marks[i]; k++)
                if (stage->wires[k].stage >= 0 && marks[stage->wires[k].stage])
                    marks[i] = again = true;
        }
    }
}

typedef struct observation {
    const accuracy_scene *scene;
    accuracy_twin *twin;
    const bool *affected; /* stages that are computed anew */
} observation;

static void copy_results(const ff_stage *from, ff_stage *to)
{
    for (size_t i = 0; i < from->loaded->model->output_count; i++) {
        const ff_result *given = &from->results[i];
        if (given->data && to->results[i].wanted)
            memcpy(ff_result_fill(to, i, given->rank, given->shape), given->data,
                   given->count * sizeof *given->data);
    }
    for (size_t i = 0; i < from->quality_count; i++) {
        const ff_quality *line = &from->quality[i];
        ff_add_quality(to, line->name, line->value, line->limit, ff_quality_given(line),
                       line->text);
    }
    to->seconds = from->seconds;
}

/* True if the stage `from` has computed every output that the twin needs. The twin may have another
 * model that needs more outputs. */
static bool has_all(const ff_stage *from, const ff_stage *to)
{
    bool all = from->ran;
    for (size_t i = 0; all && i < to->loaded->model->output_count; i++)
        all = from->results[i].wanted || !to->results[i].wanted;
    return all;
}

static bool recall(void *ctx, const ff_pipeline *pipeline, ff_stage *stage)
{
    const observation *o = ctx;
    const ff_pipeline *from = o->scene->reuse_from;
    ff_stage *to;
    bool all = from && !o->affected[stage - pipeline->stages];
    for (size_t i = 0; all && (to = run_together(pipeline, stage, i)); i++)
        all = has_all(&from->stages[to - pipeline->stages], to);
    for (size_t i = 0; all && (to = run_together(pipeline, stage, i)); i++)
        copy_results(&from->stages[to - pipeline->stages], to);
    return all;
}

static int32_t progress(void *ctx, const ff_stage *stage, double fraction)
{
    const ff_observer *watch = ((const observation *)ctx)->scene->watch;
    return watch && watch->progress ? watch->progress(watch->ctx, stage, fraction) : 0;
}

static void take_note(void *ctx, const ff_stage *stage, int32_t level, const char *text)
{
    const observation *o = ctx;
    accuracy_twin *twin = o->twin;
    size_t count = twin->note_count + 1;
    twin->notes = memory_resize(twin->notes, count * sizeof *twin->notes);
    twin->notes[twin->note_count++] =
        (accuracy_note){.stage = (size_t)(stage - twin->pipeline->stages),
                        .level = level,
                        .text = memory_arena_text(&twin->arena, text, strlen(text))};
}

void accuracy_copy_states(const ff_pipeline *from, ff_pipeline *to)
{
    to->chained = from->chained;
    for (size_t i = 0; to->chained && i < to->count; i++)
        if (from->stages[i].state)
            ff_stage_set_state(&to->stages[i], from->stages[i].state, from->stages[i].state_size);
}

static void copy_wanted(const ff_pipeline *from, ff_pipeline *to)
{
    for (size_t i = 0; i < to->count; i++) {
        const ff_stage *stage = &from->stages[i], *other = &to->stages[i];
        for (size_t k = 0;
             stage->results && other->results && k < stage->loaded->model->output_count; k++) {
            int output = ff_model_find_output(other->loaded->model, stage->results[k].row->name);
            if (output >= 0)
                other->results[output].wanted |= stage->results[k].wanted;
        }
    }
}

static accuracy_twin *add_twin(accuracy_runs *runs)
{
    runs->list = memory_resize(runs->list, (runs->count + 1) * sizeof(accuracy_twin *));
    return runs->list[runs->count++] = memory_alloc(sizeof(accuracy_twin));
}

const accuracy_twin *accuracy_twin_run(const accuracy_scene *scene, const char *const *sets,
                                       size_t count, const ff_place *place, const bool *changed)
{
    accuracy_twin *twin = add_twin(scene->runs);
    const ff_pipeline *like = scene->start;
    bool *affected = memory_alloc((like->count + 1) * sizeof *affected);
    memcpy(affected, changed, like->count * sizeof *affected);
    spread(like, affected);
    observation o = {scene, twin, affected};
    ff_observer watch = {
        .size = sizeof watch, .ctx = &o, .progress = progress, .log = take_note, .recall = recall};
    *twin = (accuracy_twin){.run = run_copy(scene->file)};
    if (scene->outputs)
        run_set(twin->run, scene->outputs, NULL, NULL);
    for (size_t i = 0; i < count; i++)
        run_set(twin->run, sets[i], place, place);
    twin->pipeline = run_build(twin->run, false);
    twin->report = ff_run_report(twin->run);
    if (twin->pipeline && !run_has_errors(twin->run)) {
        spread(twin->pipeline, affected); /* the new model of a stage may have other wires */
        accuracy_want_beside(twin->pipeline, !scene->outputs);
        accuracy_copy_states(like, twin->pipeline);
        if (!scene->outputs)
            copy_wanted(like, twin->pipeline);
        for (size_t i = 0; scene->outputs && !scene->estimates && i < twin->pipeline->count; i++)
            twin->pipeline->stages[i].unread = true;
        twin->good = run_start(twin->run, &watch) && !run_has_errors(twin->run);
    }
    for (size_t i = 0; twin->pipeline && i < twin->pipeline->count; i++) {
        twin->stopped = twin->stopped || twin->pipeline->stages[i].status == FF_STOPPED;
        twin->work += twin->pipeline->stages[i].work;
    }
    free(affected);
    return twin;
}

const char *accuracy_twin_reason(const accuracy_twin *twin)
{
    const ff_message *first = ff_report_first(twin->report);
    return first ? first->text : "it could not be run";
}

static bool is_known(const ff_report *report, const char *text)
{
    for (size_t i = 0; i < ff_report_count(report); i++)
        if (!strcmp(ff_report_at(report, i)->text, text))
            return true;
    return false;
}

/* True if the message is a warning about an assignment of the program. All such assignments have
   the same place, since the file does not contain them. */
static bool is_about(const ff_message *m, ff_place place)
{
    return m->severity == FF_WARNING && m->place.source == place.source &&
           m->place.line == place.line && m->place.column == place.column;
}

bool accuracy_is_idle(const ff_report *report, ff_place place, const char *stage,
                      const char *setting)
{
    char *start = memory_print_text("%s.%s changes nothing", stage, setting);
    bool idle = false;
    for (size_t i = 0; i < ff_report_count(report) && !idle; i++)
        idle = is_about(ff_report_at(report, i), place) &&
               !strncmp(ff_report_at(report, i)->text, start, strlen(start));
    free(start);
    return idle;
}

void accuracy_twin_copy_messages(const accuracy_twin *run, ff_place chosen,
                                 const ff_observer *watch, ff_report *report)
{
    for (size_t i = 0; i < ff_report_count(run->report); i++) {
        const ff_message *m = ff_report_at(run->report, i);
        ff_source source = m->place.source ? *m->place.source : (ff_source){0};
        ff_place place = m->place;
        source.temporary = true; /* the report copies the source, which is freed with the run */
        place.source = place.source ? &source : NULL;
        if (is_known(report, m->text) || is_about(m, chosen))
            continue;
        if (m->severity == FF_ERROR)
            ff_error(report, m->fault, place, m->hint, "%s", m->text);
        else
            ff_warn(report, place, "%s", m->text);
    }
    for (size_t i = 0; watch && watch->log && i < run->note_count; i++)
        watch->log(watch->ctx, &run->pipeline->stages[run->notes[i].stage], run->notes[i].level,
                   run->notes[i].text);
}

void accuracy_runs_free(accuracy_runs *runs)
{
    for (size_t i = 0; i < runs->count; i++) {
        accuracy_twin *twin = runs->list[i];
        ff_run_close(twin->run);
        free(twin->notes);
        memory_arena_free(&twin->arena);
        free(twin);
    }
    free(runs->list);
    *runs = (accuracy_runs){.count = 0};
}
