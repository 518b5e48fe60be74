/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judges whether the numbers of a cell can be trusted. */
#include "stability.h"

#include "../../../accuracy/compare.h"

#include <math.h>
#include <string.h>

const char *const study_class_names[STUDY_CLASSES] = {
    "converged", "outside", "physical", "unchecked", "degraded", "silent", "failed", "refused"};
const char *const study_class_texts[STUDY_CLASSES] = {
    "all quality lines are good, and a case with coarser or finer settings agrees, if there is one",
    "solved equally well, but outside the range of a model",
    "solved equally well, but the machine itself is unstable, so there is no unique answer",
    "no case with coarser or finer settings ran, so the answer is not confirmed",
    "a quality line warns",
    "no line warns, but a case with other settings differs by more than three error estimates",
    "no result, and the reason why",
    "the model does not accept this input"};
const char study_class_letters[STUDY_CLASSES + 1] = ".op?d!Fx";
const char study_note_text[] = "does not change the verdict";

/* A difference counts as too large beyond this multiple of its estimate. */
static const double most_times = 3;
/* A relative difference due to rounding, which the estimates do not cover. */
static const double rounding = 1e-9;

static bool output_of(const study_map *map, const study_outcome *answer, const char *name,
                      double *value)
{
    const study_context *context = map->context;
    for (size_t i = 0; i < context->output_count + context->extra_count; i++)
        if (answer->outputs[i].values &&
            !strcmp(i < context->output_count ? context->outputs[i]->text
                                              : context->extras[i - context->output_count],
                    name)) {
            *value = answer->outputs[i].values[0];
            return true;
        }
    return false;
}

/* Returns a number of a line; 0 if the line does not have it. */
static double number_or_zero(double number)
{
    return isnan(number) ? 0 : number;
}

static bool is_ok(const study_outcome *answer)
{
    return !strcmp(answer->status, "ok");
}

static bool is_among(const char *name, const char *const *names, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!strcmp(names[i], name))
            return true;
    return false;
}

/* Evaluates a condition; false if the condition is not met, or if the answer does not have its line
 * or output. */
static bool condition_holds(const study_map *s, const study_condition *c,
                            const study_outcome *answer, double *value)
{
    const study_quality *line = c->than ? NULL : study_line_of(answer, c->name);
    *value = line ? number_or_zero(line->value) : NAN;
    if (!c->than)
        return line && line->verdict != FF_GOOD;
    return output_of(s, answer, c->name, value) &&
           (c->than == '<' ? *value < c->value : *value > c->value);
}

/* True if the line warns because the machine is unstable. */
static bool is_physical(const char *name, const study_map *s, const study_outcome *answer)
{
    double value;
    for (size_t i = 0; i < s->physical_count; i++) {
        const study_condition *c = &s->physical[i];
        if ((!c->than && !strcmp(c->name, name)) ||
            (is_among(name, c->lines, c->line_count) && condition_holds(s, c, answer, &value)))
            return true;
    }
    return false;
}

static bool is_noted(const char *name, const study_map *s)
{
    for (size_t i = 0; i < s->note_count; i++)
        if (!s->notes[i].than && !strcmp(s->notes[i].name, name))
            return true;
    return false;
}

static void set_class(study_cell *cell, enum study_class class, const study_quality *line)
{
    cell->class = class;
    cell->line = line->name;
    cell->value = line->value;
    cell->limit = number_or_zero(line->limit);
    cell->why = *line->text ? line->text : NULL;
}

/* How far a line is beyond its limit, to compare lines with the same verdict. */
static double beyond_limit(const study_quality *line)
{
    double value = fabs(line->value), limit = fabs(line->limit);
    return value > 0 && limit > 0 ? fabs(log(value / limit)) : HUGE_VAL;
}

/* Judges a cell by its worst warning line, either only among the notes or only among the other
 * lines. Lines about the numerics take precedence. */
static void judge_lines(study_cell *cell, const study_map *s, const study_outcome *answer,
                        bool notes)
{
    const study_quality *worst = NULL;
    for (size_t i = 0; i < answer->quality_count; i++) {
        const study_quality *line = &answer->quality[i];
        if (line->verdict == FF_GOOD || is_noted(line->name, s) != notes)
            continue;
        enum study_class class = is_physical(line->name, s, answer)               ? STUDY_PHYSICAL
                                 : is_among(line->name, s->range, s->range_count) ? STUDY_OUTSIDE
                                                                                  : STUDY_DEGRADED;
        int before = worst ? worst->verdict : FF_GOOD;
        if (class < cell->class ||
            (class == cell->class &&
             (line->verdict < before ||
              (line->verdict == before && worst && !(beyond_limit(line) > beyond_limit(worst))))))
            continue;
        worst = line;
        set_class(cell, class, line);
    }
}

static void judge_conditions(study_cell *cell, const study_map *s, const study_outcome *answer)
{
    for (size_t i = 0; i < s->physical_count && cell->class < STUDY_PHYSICAL; i++) {
        const study_condition *c = &s->physical[i];
        double value;
        if (!c->than || !condition_holds(s, c, answer, &value))
            continue;
        cell->class = STUDY_PHYSICAL;
        cell->line = c->name;
        cell->value = value;
        cell->limit = c->value;
        cell->why = NULL;
    }
}

static void judge_notes(study_cell *cell, const study_map *s, const study_outcome *answer)
{
    cell->noted = memory_arena_alloc(&s->context->arena, (s->note_count + 1) * sizeof *cell->noted);
    for (size_t i = 0; i < s->note_count; i++) {
        double value;
        bool there = condition_holds(s, &s->notes[i], answer, &value);
        cell->noted[i] = there ? value : NAN;
        if (there)
            cell->note =
                study_context_format(s->context, "%s%s%.3g %s", cell->note ? cell->note : "",
                                     cell->note ? "; " : "", value, s->notes[i].words);
    }
}

/* True if the cell is compared with its twin: also a degraded cell, for which the difference shows
 * how bad it is. If the model itself warns that there are several answers, the twin need not agree.
 */
static bool is_compared(const study_cell *cell, const study_map *s, const study_outcome *answer)
{
    return cell->class <= STUDY_DEGRADED &&
           !(cell->class == STUDY_PHYSICAL && is_physical(cell->line, s, answer));
}

static void judge_claim(study_cell *cell, const study_map *s, const study_claim *claim,
                        const study_outcome *answer, const study_outcome *twin)
{
    double value, other, estimate = 0;
    bool promised = false;
    accuracy_difference d;
    if (!output_of(s, answer, claim->output, &value) || !output_of(s, twin, claim->output, &other))
        return;
    for (size_t i = 0; i < claim->estimate_count; i++) {
        const study_quality *line = study_line_of(answer, claim->estimates[i]);
        promised = promised || line;
        estimate += !line ? 0 : isnan(line->value) ? (double)INFINITY : fabs(line->value);
    }
    estimate = promised ? estimate : s->tolerance / most_times;
    const accuracy_series one = {0, 1, NULL, &value, 0, false};
    const bool known = accuracy_compare(&one, &(accuracy_series){0, 1, NULL, &other, 0, false}, &d);
    /* a difference from 0 cannot be relative */
    double difference = known && (!d.absolute || value == other) ? d.typical : (double)INFINITY;
    if (cell->output &&
        difference / (estimate + rounding) <= cell->difference / (cell->estimate + rounding))
        return;
    cell->output = claim->output;
    cell->difference = difference;
    cell->estimate = estimate;
}

static const char *name_twin(const study_cell *cell)
{
    return cell->finer ? "with finer settings" : "with coarser settings";
}

static void judge_twin(study_cell *cell, const study_map *s, const study_outcome *answer,
                       const study_outcome *twin)
{
    bool warned = cell->class == STUDY_DEGRADED;
    if (!is_ok(twin)) {
        if (warned)
            return;
        cell->class = STUDY_UNCHECKED;
        cell->line = NULL;
        cell->why = study_context_format(s->context, "%s: %s", name_twin(cell),
                                         *twin->reason ? twin->reason : "not run");
        return;
    }
    for (size_t i = 0; i < s->claim_count; i++)
        judge_claim(cell, s, &s->claims[i], answer, twin);
    if (warned || !cell->output || cell->difference <= most_times * cell->estimate + rounding)
        return;
    cell->class = STUDY_SILENT;
    cell->line = cell->output;
    cell->value = cell->difference;
    cell->limit = most_times * cell->estimate;
    cell->why =
        isinf(cell->difference)
            ? study_context_format(s->context,
                                   "%s, it is 0 or not finite, so the twin cannot be compared",
                                   name_twin(cell))
            : study_context_format(s->context, "%s, it differs by %.2g %%; the estimate is %.2g %%",
                                   name_twin(cell), 100 * cell->difference, 100 * cell->estimate);
}

/* Judges a cell without a twin, since the limits of its parameters allow no other values. */
static void judge_bounded(study_cell *cell)
{
    if (cell->class == STUDY_DEGRADED)
        return;
    cell->class = STUDY_UNCHECKED;
    cell->line = NULL;
    cell->why = "the limits of its parameters allow no coarser and no finer settings";
}

/* If the twin disagrees or failed, a line that is only a note counts as a warning. */
static void judge_warned(study_cell *cell, const study_map *s, const study_outcome *answer)
{
    study_cell warned = *cell;
    warned.class = STUDY_CONVERGED;
    judge_lines(&warned, s, answer, true);
    if (warned.class != STUDY_CONVERGED)
        *cell = warned;
}

void study_judge(const study_map *s, study_cell *cell, const study_outcome *answer,
                 const study_outcome *twin)
{
    cell->class = STUDY_CONVERGED;
    cell->confirmed = true;
    cell->line = cell->why = cell->output = cell->note = NULL;
    if (!is_ok(answer)) {
        cell->class = !strcmp(answer->status, "invalid") ? STUDY_REFUSED : STUDY_FAILED;
        cell->why = *answer->reason ? answer->reason : "not run";
        return;
    }
    judge_notes(cell, s, answer);
    judge_lines(cell, s, answer, false);
    judge_conditions(cell, s, answer);
    if ((!twin && !cell->bounded) || !is_compared(cell, s, answer))
        return;
    if (twin)
        judge_twin(cell, s, answer, twin);
    else
        judge_bounded(cell);
    cell->confirmed = cell->class != STUDY_SILENT && cell->class != STUDY_UNCHECKED;
    if (!cell->confirmed)
        judge_warned(cell, s, answer);
}
