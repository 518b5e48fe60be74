/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * One ladder for the whole answer: in its first twin all settings of all stages are one level
 * coarser, in its second two; then, where no others are known, one after the other, each setting is
 * a level finer than in the second, which shows what comes of it. The twins of a setting are cheap,
 * since all else is coarse and what lies before its stage is known. Where attempts are made, the
 * levels are those of the counts, and other twins tell what the tolerances add. Where a coarser
 * twin fails, the answer is coarse itself, and a finer one tells.
 */
#include "measure.h"

#include "axis.h"
#include "choice.h"
#include "compare.h"
#include "estimate.h"
#include "goals.h"
#include "lines.h"
#include "settings.h"
#include "twin.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A time, an angle, or what its dimension is named after: series are compared along it. */
static bool is_axis(const ff_result *result)
{
    return result->rank == 1 &&
           (!strcmp(result->row->unit, "s") || !strcmp(result->row->unit, "rad") ||
            !strcmp(result->row->name, result->dims[0]));
}

/* A setting with the stage that it belongs to. */
typedef struct knob {
    size_t stage; /* in the pipeline */
    accuracy_setting setting;
} knob;

/* Twins may agree by chance: an error is told to this share of what the file asks for. */
static const double least_error = 0.1;

/* What is at work while errors are measured. */
typedef struct measurement {
    accuracy_record *record;
    accuracy_scene scene;
    const ff_pipeline *answer;
    knob *knobs;
    size_t count;
    const accuracy_known *known;
    const accuracy_twin *half, *quarter, *twice; /* NULL: it cannot be had */
    const accuracy_twin *middle, *tight, *loose; /* estimate.h; NULL: not told apart */
    bool is_finer;
    accuracy_twin *refined; /* one for each knob; not good: errors are not split by it */
    bool stopped;
} measurement;

static void *take(const measurement *m, size_t count, size_t size)
{
    return memory_arena_alloc(&m->record->arena, count * size + 1);
}

static bool is_headline(const ff_result *result)
{
    bool finite = result->data && result->requested && result->rank <= 1 && result->count > 0;
    for (size_t i = 0; finite && i < result->count; i++)
        finite = isfinite(result->data[i]);
    return finite && !is_axis(result);
}

/* Lists what is to be measured, and says it as the outputs of the twins. */
static void list_outputs(measurement *m)
{
    const ff_pipeline *answer = m->answer;
    accuracy_record *record = m->record;
    char *text = NULL;
    size_t length = 0, most = 0;
    for (size_t s = 0; s < answer->count; s++)
        most += answer->stages[s].ran ? answer->stages[s].loaded->model->output_count : 0;
    record->errors = take(m, most, sizeof *record->errors);
    FILE *out = memory_require(open_memstream(&text, &length));
    fputs("outputs=[", out);
    for (size_t s = 0; s < answer->count; s++) {
        const ff_stage *stage = &answer->stages[s];
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            if (!is_headline(&stage->results[i]))
                continue;
            accuracy_error *e = &record->errors[record->count++];
            *e = (accuracy_error){.stage = stage,
                                  .result = &stage->results[i],
                                  .goal = accuracy_goal(m->scene.tree, stage, &stage->results[i]),
                                  .relative = NAN,
                                  .largest = NAN,
                                  .order = NAN};
            fprintf(out, "%s%s.%s", record->count > 1 ? ", " : "", stage->name,
                    e->result->row->name);
        }
    }
    putc(']', out);
    fclose(out);
    m->scene.outputs = memory_arena_text(&record->arena, text, length);
    free(text);
}

/* The settings of all stages that something measured depends on. */
static void list_knobs(measurement *m)
{
    accuracy_setting settings[ACCURACY_MOST_SETTINGS];
    const ff_pipeline *answer = m->answer;
    m->knobs = take(m, answer->count * ACCURACY_MOST_SETTINGS, sizeof *m->knobs);
    for (size_t i = 0; i < answer->count; i++) {
        size_t at = answer->order[i];
        const ff_stage *stage = &answer->stages[at];
        size_t count = 0;
        if (stage->needed && stage->loaded)
            count = accuracy_settings(stage, settings);
        for (size_t k = 0; k < count; k++)
            if (!m->known ||
                !accuracy_is_idle(m->known->said, m->known->place, stage->name, settings[k].name))
                m->knobs[m->count++] = (knob){at, settings[k]};
    }
    m->refined = take(m, m->count, sizeof *m->refined);
}

static void note_failure(measurement *m, const char *why)
{
    if (!m->record->failure)
        m->record->failure = memory_arena_text(&m->record->arena, why, strlen(why));
}

/* By how many levels the settings of a twin are coarser. */
typedef struct coarser {
    int counts, tolerances;
} coarser;

static const coarser half = {1, 1}, quarter = {2, 2}, twice = {-1, -1};

/* NULL: its limits forbid it. */
static const char *assignment_at(const measurement *m, const knob *k, coarser at)
{
    int levels = k->setting.tolerance ? at.tolerances : at.counts;
    return accuracy_setting_at(&m->answer->stages[k->stage], k->setting.param, levels,
                               &m->record->arena);
}

/* Fills the assignments of a twin, and marks the stages that they change. False: the limits of a
   setting forbid one. */
static bool list_sets(measurement *m, coarser at, size_t finer, const char **sets, bool *changed)
{
    for (size_t i = 0; i < m->count; i++) {
        const knob *k = &m->knobs[i];
        sets[i] = assignment_at(m, k, i == finer ? half : at);
        changed[k->stage] |= finer == SIZE_MAX || i == finer;
        if (sets[i])
            continue;
        char *why = memory_print_text("%s.%s has no %s value within its limits",
                                      m->answer->stages[k->stage].name, k->setting.name,
                                      at.counts < 0 ? "finer" : "coarser");
        note_failure(m, why);
        free(why);
        return false;
    }
    return true;
}

/* Runs a twin; one of its settings is at the level of half; SIZE_MAX: none. */
static void run_twin(measurement *m, coarser at, size_t finer, accuracy_twin *twin)
{
    const char **sets = memory_alloc((m->count + 1) * sizeof *sets);
    bool *changed = memory_alloc((m->answer->count + 1) * sizeof *changed);
    m->scene.donor = finer == SIZE_MAX ? m->answer : m->quarter->pipeline;
    if (list_sets(m, at, finer, sets, changed)) {
        accuracy_twin_run(twin, &m->scene, sets, m->count, NULL, changed);
        m->record->twins++;
        m->record->seconds += twin->work;
        m->stopped = twin->stopped;
        if (!twin->good)
            note_failure(m, accuracy_twin_reason(twin));
    }
    free(changed);
    free(sets);
}

/* Whether an answer has the settings of a twin. */
static bool is_twin(const measurement *m, coarser at, const ff_pipeline *answer)
{
    bool same = answer->count == m->answer->count;
    for (size_t i = 0; same && i < answer->count; i++)
        same = answer->stages[i].loaded == m->answer->stages[i].loaded;
    for (size_t i = 0; same && i < m->count; i++) {
        const knob *k = &m->knobs[i];
        const char *has = accuracy_setting_at(&answer->stages[k->stage], k->setting.param, 0,
                                              &m->record->arena),
                   *wanted = assignment_at(m, k, at);
        same = has && wanted && !strcmp(has, wanted);
    }
    return same;
}

/* A twin that was run before, good or not; NULL: none was. */
static const accuracy_twin *known_twin(const measurement *m, coarser at)
{
    for (size_t i = 0; i < m->record->own_count; i++)
        if (m->record->own[i]->pipeline && is_twin(m, at, m->record->own[i]->pipeline))
            return m->record->own[i];
    for (size_t i = 0; m->known && i < m->known->count; i++)
        if (m->known->runs[i]->pipeline && is_twin(m, at, m->known->runs[i]->pipeline))
            return m->known->runs[i];
    return NULL;
}

/* Finds a twin, or runs it; NULL: it cannot be had. */
static const accuracy_twin *find_twin(measurement *m, coarser at)
{
    const accuracy_twin *known = known_twin(m, at);
    if (known)
        return known->good ? known : NULL;
    if (m->stopped || m->record->own_count == ACCURACY_OWN)
        return NULL;
    accuracy_twin *own = m->record->own[m->record->own_count++] = memory_alloc(sizeof *own);
    run_twin(m, at, SIZE_MAX, own);
    return own->good ? own : NULL;
}

/* Fills the error of an output over its value: typical of a series, and the largest. */
static void find_relative(const double *at, accuracy_error *e)
{
    const accuracy_series answer = {e->result->rank, e->result->count, at, e->result->data};
    e->relative = accuracy_relative(e->bar, &answer, &e->largest);
}

static const double *numbers_of_twin(const measurement *m, const accuracy_error *e,
                                     const accuracy_twin *twin)
{
    return twin && twin->good ? accuracy_numbers_like(m->answer, e->stage, e->result,
                                                      twin->pipeline, &m->record->arena)
                              : NULL;
}

/* The largest part first. */
static int by_error(const void *a, const void *b)
{
    const accuracy_part *one = a, *other = b;
    return (one->error < other->error) - (one->error > other->error);
}

/* Splits the error by the settings. */
static void add_parts(const measurement *m, const double *shares, accuracy_error *e)
{
    size_t most = m->count + (m->record->choice ? m->record->choice->change_count : 0);
    e->parts = take(m, most, sizeof *e->parts);
    for (size_t i = 0; i < m->count; i++)
        if (shares[i] > 0)
            e->parts[e->part_count++] =
                (accuracy_part){.stage = &m->answer->stages[m->knobs[i].stage],
                                .setting = m->knobs[i].setting.name,
                                .error = e->relative * shares[i]};
    qsort(e->parts, e->part_count, sizeof *e->parts, by_error);
}

/* Adds what the models that were chosen move. */
static void add_changes(const measurement *m, accuracy_error *e)
{
    const accuracy_choice *choice = m->record->choice;
    const ff_result *result = e->result;
    double most = accuracy_largest_magnitude(result->data, result->count);
    for (size_t i = 0; choice && i < choice->change_count; i++) {
        const accuracy_change *c = &choice->changes[i];
        if (c->of != (size_t)(e->stage - m->answer->stages) ||
            strcmp(c->output, result->row->name) != 0)
            continue;
        for (size_t k = 0; k < result->count; k++) /* NaN: it could not be compared */
            e->bar[k] += c->error * accuracy_error_scale(result->data[k], most, result->rank);
        e->relative += c->error;
        e->largest += c->error;
        e->parts[e->part_count++] = (accuracy_part){
            .stage = &m->answer->stages[c->stage], .setting = "use", .error = c->error};
    }
    qsort(e->parts, e->part_count, sizeof *e->parts, by_error);
}

static accuracy_ladder ladder_of(const measurement *m, const accuracy_error *e)
{
    const ff_result *result = e->result, *along = accuracy_axis_of(m->answer, e->stage, result);
    double *scale = take(m, result->count, sizeof *scale);
    double most = accuracy_largest_magnitude(result->data, result->count);
    for (size_t i = 0; i < result->count; i++)
        scale[i] = accuracy_error_scale(result->data[i], most, result->rank);
    return (accuracy_ladder){.count = result->count,
                             .at = along ? along->data : NULL,
                             .scale = scale,
                             .answer = e->result->data,
                             .half = numbers_of_twin(m, e, m->half),
                             .quarter = numbers_of_twin(m, e, m->quarter),
                             .twice = numbers_of_twin(m, e, m->twice),
                             .middle = numbers_of_twin(m, e, m->middle),
                             .tight = numbers_of_twin(m, e, m->tight),
                             .loose = numbers_of_twin(m, e, m->loose),
                             .is_finer = m->is_finer};
}

/* Twins may see less of an error than the stage, which knows where it comes from: no number is
   better known than by what the stage estimates there. */
static void hold_to_estimate(accuracy_error *e)
{
    const ff_result *estimate = accuracy_estimate_of(e->stage, e->result);
    for (size_t i = 0; estimate && i < estimate->count; i++) /* fmax drops NaN */
        e->bar[i] = fmax(e->bar[i], fabs(estimate->data[i]));
}

static void measure_output(const measurement *m, accuracy_error *e)
{
    const double **refined = take(m, m->count, sizeof *refined);
    double *shares = take(m, m->count, sizeof *shares);
    accuracy_ladder levels = ladder_of(m, e);
    for (size_t i = 0; i < m->count; i++)
        refined[i] = numbers_of_twin(m, e, &m->refined[i]);
    levels.refined = refined;
    levels.refined_count = m->count;
    if (!levels.half && !levels.twice)
        return;
    e->bar = take(m, levels.count, sizeof *e->bar);
    e->order = accuracy_estimate(&levels, e->bar, shares, &e->by_tolerances);
    for (size_t i = 0; i < levels.count; i++) /* fmax drops NaN */
        e->bar[i] = fmax(e->bar[i], least_error * e->goal * levels.scale[i]);
    hold_to_estimate(e);
    find_relative(levels.at, e);
    add_parts(m, shares, e);
    add_changes(m, e);
}

/* The parts keep their shares. */
static void widen(accuracy_error *number, double bar)
{
    if (!(bar > number->bar[0] && isfinite(bar)) || number->result->data[0] == 0)
        return;
    double factor = bar / number->bar[0];
    number->bar[0] = bar;
    find_relative(NULL, number);
    for (size_t i = 0; isfinite(factor) && i < number->part_count; i++)
        number->parts[i].error *= factor;
}

/* Where the answer has the number as the largest or the least one of the series; SIZE_MAX: nowhere.
 */
static size_t extreme_of(const ff_result *number, const ff_result *series)
{
    const double value = number->data[0];
    size_t at = SIZE_MAX, above = 0, below = 0;
    for (size_t i = 0; i < series->count; i++) {
        above += series->data[i] > value;
        below += series->data[i] < value;
        if (series->data[i] == value)
            at = i;
    }
    return (above > 0) != (below > 0) ? at : SIZE_MAX;
}

/* A single number may be the same on two levels by chance. One that is the extreme of a series is
   off by what that is off there, at least. */
static void hold_to_series(const measurement *m, accuracy_error *number)
{
    if (number->result->rank != 0 || !number->bar)
        return;
    for (size_t i = 0; i < m->record->count; i++) {
        const accuracy_error *e = &m->record->errors[i];
        if (e->stage != number->stage || e->result->rank != 1 || !e->bar ||
            strcmp(e->result->row->unit, number->result->row->unit) != 0)
            continue;
        size_t at = extreme_of(number->result, e->result);
        if (at != SIZE_MAX)
            widen(number, e->bar[at]);
    }
}

/* Whether a stage estimates more than twice an error that was measured: no number is to be off by
   more than two of its bars. Below a quarter of what is asked that does not matter. */
static bool is_contradicted(const accuracy_error *e)
{
    const double twice_as_large = 2, matters = 0.25;
    for (size_t k = 0; !isnan(e->goal) && k < e->stage->quality_count; k++) {
        const ff_quality *line = &e->stage->quality[k];
        if (accuracy_estimated(e->stage, line->name) == e->result &&
            line->value > fmax(twice_as_large * e->relative, matters * e->goal))
            return true;
    }
    return false;
}

static void conclude(const measurement *m)
{
    accuracy_record *record = m->record;
    for (size_t i = 0; i < record->count; i++)
        measure_output(m, &record->errors[i]);
    for (size_t i = 0; i < record->count; i++)
        hold_to_series(m, &record->errors[i]);
    for (size_t i = 0; i < record->count; i++)
        record->contradicted = record->contradicted || is_contradicted(&record->errors[i]);
    accuracy_tell(record, m->answer);
}

static void run_ladder(measurement *m)
{
    m->half = find_twin(m, half);
    m->quarter = m->half ? find_twin(m, quarter) : NULL;
    m->twice = m->quarter ? NULL : find_twin(m, twice);
    for (size_t i = 0; m->count > 1 && m->quarter && i < m->count && !m->stopped; i++)
        run_twin(m, quarter, i, &m->refined[i]);
}

static bool have_tolerances(const measurement *m)
{
    bool any = false;
    for (size_t i = 0; i < m->count; i++)
        any = any || m->knobs[i].setting.tolerance;
    return any;
}

/* Whether a series has fewer points in the loose twin than in the tight one, but hardly: between
   them an error of second order does not even double, and what the steps of both miss neither of
   them shows. As many points are no steps. */
static bool hardly_differ(const measurement *m)
{
    const double hardly = sqrt(1 / 2.0);
    for (size_t i = 0; i < m->record->count; i++) {
        const accuracy_error *e = &m->record->errors[i];
        const size_t stage = (size_t)(e->stage - m->answer->stages),
                     output = (size_t)(e->result - e->stage->results);
        double tight = (double)m->tight->pipeline->stages[stage].results[output].count,
               loose = (double)m->loose->pipeline->stages[stage].results[output].count;
        if (loose < tight && loose > hardly * tight)
            return true;
    }
    return false;
}

/* Two twins that were run before, as coarse in the counts; false: there are none, and `tight` and
   `loose` are to be set. */
static bool know_tolerances(measurement *m, int counts)
{
    m->tight = known_twin(m, (coarser){counts, 0});
    m->loose = known_twin(m, (coarser){counts, 1});
    return m->tight && m->tight->good && m->loose && m->loose->good;
}

/* Finds two twins of one level of the counts whose tolerances differ: those that were run before,
   or the cheapest; a finer one where the coarser cannot be had, or hardly differs. */
static void find_loose(measurement *m)
{
    int counts = know_tolerances(m, 1) ? 1 : 2;
    if (counts == 2 && !know_tolerances(m, 2)) {
        m->tight = m->quarter ? find_twin(m, (coarser){2, 0}) : NULL;
        counts = m->tight ? 2 : 1;
        m->tight = m->tight ? m->tight : m->half;
        m->loose = find_twin(m, (coarser){counts, 1});
    }
    if (m->loose && !hardly_differ(m))
        return;
    const accuracy_twin *finer = find_twin(m, (coarser){counts, -1});
    m->is_finer = finer != NULL;
    m->loose = finer ? finer : m->loose;
}

/* Where attempts are made: counts and tolerances become finer apart. Two levels do where the
   coarser twin fails, since the next attempt is finer itself. */
static void run_attempt_ladder(measurement *m)
{
    m->half = find_twin(m, (coarser){1, 0});
    for (int k = 0; m->half && k <= 2 && !(m->middle && m->quarter); k++) {
        m->middle = known_twin(m, (coarser){1, k});
        m->quarter = known_twin(m, (coarser){2, k});
    }
    if (m->half && !(m->middle && m->quarter)) {
        m->middle = m->half;
        m->quarter = find_twin(m, (coarser){2, 0});
    }
    if (m->quarter && !(m->quarter->good && m->middle->good))
        m->quarter = NULL;
    if (m->half && have_tolerances(m))
        find_loose(m);
    m->twice = m->half ? NULL : find_twin(m, twice);
    m->record->two_levels = m->half && !m->quarter;
}

bool accuracy_measure(accuracy_record *record, const ff_tree *tree, ff_engine *engine,
                      const ff_pipeline *pipeline, const ff_observer *watch,
                      const accuracy_known *known)
{
    measurement m = {.record = record,
                     .answer = pipeline,
                     .known = known,
                     .scene = {.tree = tree, .engine = engine, .start = pipeline, .watch = watch}};
    list_outputs(&m);
    list_knobs(&m);
    if (record->count > 0 && known)
        run_attempt_ladder(&m);
    else if (record->count > 0)
        run_ladder(&m);
    if (!m.stopped)
        conclude(&m);
    for (size_t i = 0; i < m.count; i++)
        accuracy_twin_free(&m.refined[i]);
    return !m.stopped;
}

void accuracy_free(accuracy_record *record)
{
    for (size_t i = 0; i < record->own_count; i++) {
        accuracy_twin_free(record->own[i]);
        free(record->own[i]);
    }
    if (record->twin)
        accuracy_twin_free(record->twin);
    if (record->choice)
        accuracy_choice_free(record->choice);
    free(record->choice);
    free(record->twin);
    memory_arena_free(&record->arena);
    *record = (accuracy_record){.count = 0};
}

const accuracy_error *accuracy_find(const accuracy_record *record, const ff_result *result)
{
    for (size_t i = 0; record && i < record->count; i++)
        if (record->errors[i].result == result)
            return &record->errors[i];
    return NULL;
}
