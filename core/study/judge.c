/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far the numbers of a cell can be trusted. */
#include "private.h"
#include "stability.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const ff_class_names[FF_CLASSES] = {"converged", "outside", "physical", "unchecked",
                                                "degraded",  "silent",  "failed",   "refused"};
const char *const ff_class_texts[FF_CLASSES] = {
    "every line of quality holds, and so does the refined case",
    "solved as well, but outside the range of a model",
    "solved as well; the motion or film itself is unstable or worth a note",
    "the refined case failed, so nothing confirms it",
    "a line of quality warns",
    "no line warns, yet the refined case differs by more than three estimates",
    "no result, and the reason why",
    "the model does not take such input"};
const char ff_class_letters[FF_CLASSES + 1] = ".op?d!Fx";

/* A difference that its estimate may be short of. */
static const double most_times = 3;
/* Rounding, of which no estimate speaks. */
static const double rounding = 1e-9;

static const char *keep(ff_arena *arena, char *text)
{
    const char *kept = ff_arena_text(arena, text, strlen(text));
    free(text);
    return kept;
}

/* [value, limit, verdict, text] of "stage.line"; NULL: there is none. */
static const json_t *line_of(const json_t *record, const char *name)
{
    char stage[80];
    size_t length = strcspn(name, ".");
    if (length >= sizeof stage || !name[length])
        return NULL;
    snprintf(stage, sizeof stage, "%.*s", (int)length, name);
    return json_object_get(json_object_get(json_object_get(record, "quality"), stage),
                           name + length + 1);
}

static bool output_of(const json_t *record, const char *name, double *value)
{
    const json_t *pair = json_object_get(json_object_get(record, "outputs"), name);
    *value = json_number_value(json_array_get(pair, 1));
    return pair != NULL;
}

static double number_at(const json_t *line, size_t i)
{
    return json_number_value(json_array_get(line, i));
}

static int verdict_of(const json_t *line)
{
    return (int)json_integer_value(json_array_get(line, 2));
}

static bool is_listed(const char *name, const ff_stability *s, bool physical)
{
    for (size_t i = 0; physical && i < s->physical_count; i++)
        if (!s->physical[i].than && !strcmp(s->physical[i].name, name))
            return true;
    for (size_t i = 0; !physical && i < s->range_count; i++)
        if (!strcmp(s->range[i], name))
            return true;
    return false;
}

static void decide(ff_cell *cell, enum ff_class class, const char *name, const json_t *line,
                   ff_arena *arena)
{
    const char *text = json_string_value(json_array_get(line, 3));
    cell->class = class;
    cell->line = ff_arena_text(arena, name, strlen(name));
    cell->value = number_at(line, 0);
    cell->limit = number_at(line, 1);
    cell->why = text ? ff_arena_text(arena, text, strlen(text)) : NULL;
}

/* How far a line is beyond its limit, of two that warn alike. */
static double excess(const json_t *line)
{
    double value = fabs(number_at(line, 0)), limit = fabs(number_at(line, 1));
    return value > 0 && limit > 0 ? fabs(log(value / limit)) : HUGE_VAL;
}

/* The worst of the lines that warn; those of the numerics before others. */
static void judge_lines(ff_cell *cell, const ff_stability *s, const json_t *record, ff_arena *arena)
{
    const char *stage, *name;
    json_t *lines, *line;
    const json_t *worst = NULL;
    char path[200];
    json_object_foreach(json_object_get(record, "quality"), stage, lines)
        json_object_foreach(lines, name, line)
    {
        snprintf(path, sizeof path, "%.80s.%.80s", stage, name);
        if (verdict_of(line) == FF_GOOD)
            continue;
        enum ff_class class = is_listed(path, s, true)    ? FF_PHYSICAL
                              : is_listed(path, s, false) ? FF_OUTSIDE
                                                          : FF_DEGRADED;
        bool worse = class > cell->class ||
                     (class == cell->class &&
                      (verdict_of(line) > verdict_of(worst) ||
                       (verdict_of(line) == verdict_of(worst) && excess(line) > excess(worst))));
        if (!worse)
            continue;
        worst = line;
        decide(cell, class, path, line, arena);
    }
}

static void judge_conditions(ff_cell *cell, const ff_stability *s, const json_t *record)
{
    for (size_t i = 0; i < s->physical_count && cell->class < FF_PHYSICAL; i++) {
        const ff_condition *c = &s->physical[i];
        double value;
        if (!c->than || !output_of(record, c->name, &value) ||
            !(c->than == '<' ? value < c->value : value > c->value))
            continue;
        cell->class = FF_PHYSICAL;
        cell->line = c->name;
        cell->value = value;
        cell->limit = c->value;
        cell->why = NULL;
    }
}

/* Of a degraded cell the difference says how much so. Where the model itself warns that there is no
   one answer, none is expected of the refined case. */
static bool is_compared(const ff_cell *cell, const ff_stability *s)
{
    return cell->class <= FF_DEGRADED &&
           !(cell->class == FF_PHYSICAL && is_listed(cell->line, s, true));
}

static void judge_claim(ff_cell *cell, const ff_claim *claim, double tolerance,
                        const json_t *record, const json_t *refined)
{
    double value, finer, estimate = 0;
    bool promised = false;
    if (!output_of(record, claim->output, &value) || !output_of(refined, claim->output, &finer))
        return;
    for (size_t i = 0; i < claim->estimate_count; i++) {
        const json_t *line = line_of(record, claim->estimates[i]);
        promised = promised || line;
        estimate += line ? fabs(number_at(line, 0)) : 0;
    }
    estimate = promised ? estimate : tolerance / most_times;
    double difference = fabs(value - finer) / fmax(fabs(finer), 1e-300);
    if (cell->output &&
        difference / (estimate + rounding) <= cell->difference / (cell->estimate + rounding))
        return;
    cell->output = claim->output;
    cell->difference = difference;
    cell->estimate = estimate;
}

static void judge_refined(ff_cell *cell, const ff_stability *s, const json_t *record,
                          const json_t *refined, ff_arena *arena)
{
    const char *reason = json_string_value(json_object_get(refined, "reason"));
    bool warned = cell->class == FF_DEGRADED;
    if (!ff_record_is_ok(refined)) {
        if (warned)
            return;
        cell->class = FF_UNCHECKED;
        cell->line = NULL;
        cell->why = keep(arena, ff_print_text("refined: %s", reason ? reason : "not run"));
        return;
    }
    for (size_t i = 0; i < s->claim_count; i++)
        judge_claim(cell, &s->claims[i], s->tolerance, record, refined);
    if (warned || !cell->output || cell->difference <= most_times * cell->estimate + rounding)
        return;
    cell->class = FF_SILENT;
    cell->line = cell->output;
    cell->value = cell->difference;
    cell->limit = most_times * cell->estimate;
    cell->why = keep(arena, ff_print_text("refined, it differs by %.2g %%; the estimate is %.2g %%",
                                          100 * cell->difference, 100 * cell->estimate));
}

void ff_judge(ff_cell *cell, const ff_stability *s, const json_t *record, const json_t *refined,
              ff_arena *arena)
{
    const char *status = json_string_value(json_object_get(record, "status"));
    const char *reason = json_string_value(json_object_get(record, "reason"));
    cell->class = FF_CONVERGED;
    cell->line = cell->why = cell->output = NULL;
    if (!ff_record_is_ok(record)) {
        cell->class = status && !strcmp(status, "invalid") ? FF_REFUSED : FF_FAILED;
        reason = reason ? reason : "not run";
        cell->why = ff_arena_text(arena, reason, strlen(reason));
        return;
    }
    judge_lines(cell, s, record, arena);
    judge_conditions(cell, s, record);
    if (refined && is_compared(cell, s))
        judge_refined(cell, s, record, refined, arena);
}
