/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * One ladder for the whole answer: in its first twin all settings of all stages are one level
 * coarser, in its second two; then, where no others are known, one after the other, each setting is
 * a level finer than in the second, which shows what comes of it. The twins of a setting are cheap,
 * since all else is coarse and what lies before its stage is known. Where a coarser twin fails, the
 * answer is coarse itself, and a finer one tells.
 */
#include "measure.h"

#include "axis.h"
#include "choice.h"
#include "compare.h"
#include "estimate.h"
#include "goals.h"
#include "settings.h"
#include "twin.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A measured error above this is doubtful where the file names no accuracy. */
static const double doubtful_above = 0.05;

/* An error at few points that is so many times that of the others is told. */
static const double much_larger = 2;

/* Parts below this share of an error are not worth a reader's time. */
static const double least_part = 0.01;

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
static const double least_error = 0.05;

/* What is at work while errors are measured. */
typedef struct measurement {
    accuracy_record *record;
    accuracy_scene scene;
    const ff_pipeline *answer;
    knob *knobs;
    size_t count;
    const accuracy_known *known;
    const accuracy_twin *half, *quarter, *twice; /* NULL: it cannot be had */
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
            count = accuracy_settings(stage, &m->record->arena, settings);
        for (size_t k = 0; k < count; k++)
            m->knobs[m->count++] = (knob){at, settings[k]};
    }
    m->refined = take(m, m->count, sizeof *m->refined);
}

static void note_failure(measurement *m, const char *why)
{
    if (!m->record->failure)
        m->record->failure = memory_arena_text(&m->record->arena, why, strlen(why));
}

/* How much coarser the settings of a twin are. */
typedef enum level { TWICE, HALF, QUARTER } level;

static const char *assignment_at(const accuracy_setting *setting, level at)
{
    const char *const sets[] = {setting->finer, setting->coarser[0], setting->coarser[1]};
    return sets[at];
}

/* Fills the assignments of a twin, and marks the stages that they change. False: the limits of a
   setting forbid one. */
static bool list_sets(measurement *m, level at, size_t finer, const char **sets, bool *changed)
{
    for (size_t i = 0; i < m->count; i++) {
        const knob *k = &m->knobs[i];
        sets[i] = assignment_at(&k->setting, i == finer ? HALF : at);
        changed[k->stage] |= finer == SIZE_MAX || i == finer;
        if (sets[i])
            continue;
        char *why = memory_print_text("%s.%s has no %s value within its limits",
                                      m->answer->stages[k->stage].name, k->setting.name,
                                      at == TWICE ? "finer" : "coarser");
        note_failure(m, why);
        free(why);
        return false;
    }
    return true;
}

/* Runs a twin whose settings are all at a level, but for one that is at the level of half;
   SIZE_MAX: none. */
static void run_twin(measurement *m, level at, size_t finer, accuracy_twin *twin)
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
static bool is_twin(const measurement *m, level at, const ff_pipeline *answer)
{
    bool same = answer->count == m->answer->count;
    for (size_t i = 0; same && i < answer->count; i++)
        same = answer->stages[i].loaded == m->answer->stages[i].loaded;
    for (size_t i = 0; same && i < m->count; i++) {
        const accuracy_setting *setting = &m->knobs[i].setting;
        const char *has = accuracy_setting_at(&answer->stages[m->knobs[i].stage], setting->param, 0,
                                              &m->record->arena),
                   *wanted = assignment_at(setting, at);
        same = has && wanted && !strcmp(has, wanted);
    }
    return same;
}

/* Finds a twin whose settings are all at a level, or runs it; NULL: it cannot be had. */
static const accuracy_twin *find_twin(measurement *m, level at)
{
    for (size_t i = 0; m->known && i < m->known->count; i++) {
        const accuracy_twin *run = m->known->runs[i];
        if (run->pipeline && is_twin(m, at, run->pipeline))
            return run->good ? run : NULL;
    }
    if (m->stopped)
        return NULL;
    accuracy_twin *own = m->record->own[at] = memory_alloc(sizeof *own);
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
                             .twice = numbers_of_twin(m, e, m->twice)};
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
    e->order = accuracy_estimate(&levels, e->bar, shares);
    for (size_t i = 0; i < levels.count; i++) /* fmax drops NaN */
        e->bar[i] = fmax(e->bar[i], least_error * e->goal * levels.scale[i]);
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

/* "h_min_space_error" is of the output with the longest name that the line begins with; of fields
   no error is measured. */
bool accuracy_is_estimate(const ff_stage *stage, const char *line)
{
    static const char ending[] = "_error";
    size_t length = strlen(line), tail = sizeof ending - 1, longest = 0;
    const ff_result *found = NULL;
    if (length <= tail || strcmp(line + length - tail, ending) != 0)
        return false;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const char *name = stage->results[i].row->name;
        size_t own = strlen(name);
        if (own > longest && !strncmp(line, name, own) && line[own] == '_') {
            longest = own;
            found = &stage->results[i];
        }
    }
    return found && !(found->requested && found->rank > 1);
}

/* Takes the estimates of the stages away that measured outputs come from: two numbers for one
   error would contradict each other, and what comes of an error on the way is measured. */
static void drop_estimates(const measurement *m)
{
    const ff_pipeline *answer = m->answer;
    bool *feeds = memory_alloc((answer->count + 1) * sizeof *feeds);
    for (size_t i = 0; i < m->record->count; i++)
        feeds[m->record->errors[i].stage - answer->stages] = true;
    for (size_t n = answer->count; n-- > 0;) {
        ff_stage *stage = &answer->stages[answer->order[n]];
        if (!feeds[answer->order[n]])
            continue;
        for (size_t k = 0; k < stage->wire_count; k++)
            if (stage->wires[k].stage >= 0)
                feeds[stage->wires[k].stage] = true;
        for (size_t k = stage->quality_count; k-- > 0;)
            if (accuracy_is_estimate(stage, stage->quality[k].name))
                ff_drop_quality(stage, k);
    }
    free(feeds);
}

char *accuracy_describe(const accuracy_error *e)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&text, &length));
    const char *between = "";
    if (e->bar && e->largest > much_larger * e->relative) {
        fprintf(out, "at few points up to %.2g %%", 100 * e->largest);
        between = "; ";
    }
    for (size_t i = 0; i < e->part_count; i++)
        if (i < 1 || e->parts[i].error > least_part * e->relative) {
            fprintf(out, "%s%s.%s %.2g %%", i ? ", " : between, e->parts[i].stage->name,
                    e->parts[i].setting, 100 * e->parts[i].error);
            between = "; ";
        }
    if (isfinite(e->order))
        fprintf(out, "%sorder %.2g", between, e->order);
    fclose(out);
    return text;
}

char *accuracy_print_relative(const accuracy_error *e)
{
    return e->bar ? memory_print_text("%.2g %%", 100 * e->relative)
                  : memory_print_text("not known");
}

/* How the text of its line begins. */
static const char measured[] = "measured: ";

bool accuracy_is_line(const ff_quality *line)
{
    return line->text && !strncmp(line->text, measured, sizeof measured - 1);
}

static void add_line(const accuracy_error *e, ff_stage *stage)
{
    double limit = isnan(e->goal) ? doubtful_above : e->goal;
    char *name = memory_print_text("%s_error", e->result->row->name);
    char *error = accuracy_print_relative(e), *rest = accuracy_describe(e);
    char *text = memory_print_text("%s%s%s%s", measured, error, *rest ? "; " : "", rest);
    ff_add_quality(stage, name, e->relative, limit, e->relative <= limit ? FF_GOOD : FF_DOUBTFUL,
                   text);
    free(text);
    free(rest);
    free(error);
    free(name);
}

/* The quality of the stages is the one bookkeeping. */
static void conclude(const measurement *m)
{
    accuracy_record *record = m->record;
    for (size_t i = 0; i < record->count; i++)
        measure_output(m, &record->errors[i]);
    for (size_t i = 0; i < record->count; i++)
        hold_to_series(m, &record->errors[i]);
    drop_estimates(m);
    for (size_t i = 0; i < record->count; i++)
        add_line(&record->errors[i],
                 &m->answer->stages[record->errors[i].stage - m->answer->stages]);
}

static void run_ladder(measurement *m, bool split)
{
    m->half = find_twin(m, HALF);
    m->quarter = m->half ? find_twin(m, QUARTER) : NULL;
    /* where attempts are made two levels do, since the next one is finer itself */
    m->twice = m->quarter || (m->half && m->known) ? NULL : find_twin(m, TWICE);
    m->record->two_levels = m->half && !m->quarter && !m->twice;
    for (size_t i = 0; split && m->count > 1 && m->quarter && i < m->count && !m->stopped; i++)
        run_twin(m, QUARTER, i, &m->refined[i]);
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
    if (record->count > 0)
        run_ladder(&m, !known);
    if (!m.stopped)
        conclude(&m);
    for (size_t i = 0; i < m.count; i++)
        accuracy_twin_free(&m.refined[i]);
    return !m.stopped;
}

void accuracy_free(accuracy_record *record)
{
    for (size_t i = 0; i < ACCURACY_OWN; i++) {
        if (record->own[i])
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
