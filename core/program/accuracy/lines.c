/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "lines.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A measured error above this is doubtful if the file states no goal. */
static const double doubtful_above = 0.05;

/* An error at few points is printed if it is this many times the typical one. */
static const double much_larger = 2;

/* Parts below this share of an error are not printed. */
static const double least_part = 0.01;

static const char ending[] = "_error";

static bool ends_in_error(const char *name)
{
    size_t length = strlen(name), tail = sizeof ending - 1;
    return length > tail && !strcmp(name + length - tail, ending);
}

/* Returns the measured output whose error the line of this name estimates; NULL if it is another
   kind of line. "h_min_space_error" concerns the output with the longest name with which the line
   begins. Fields have no measured error. */
static const ff_result *estimated(const ff_stage *stage, const char *line)
{
    size_t longest = 0;
    const ff_result *found = NULL;
    if (!ends_in_error(line))
        return NULL;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const char *name = stage->results[i].row->name;
        size_t own = strlen(name);
        if (own > longest && !strncmp(line, name, own) && line[own] == '_') {
            longest = own;
            found = &stage->results[i];
        }
    }
    return found && found->requested && found->rank > 1 ? NULL : found;
}

/* True if a line states the error of the result, or of an output such as "h_min" if the result is
 * "h_min_lowest". */
static bool is_of(const ff_stage *stage, const ff_quality *line, const ff_result *result)
{
    const char *name = result->row->name;
    const ff_result *of = ends_in_error(name) ? NULL : estimated(stage, line->name);
    size_t stem = of ? strlen(of->row->name) : 0;
    return of && !strncmp(name, of->row->name, stem) && (!name[stem] || name[stem] == '_') &&
           !strcmp(result->row->unit, of->row->unit);
}

double accuracy_estimated_share(const ff_stage *stage, const ff_result *result)
{
    double share = NAN;
    for (size_t i = 0; i < stage->quality_count; i++) {
        const ff_quality *line = &stage->quality[i];
        if (is_of(stage, line, result))
            share = fmax(share, isnan(line->value) ? (double)INFINITY : line->value);
    }
    return share;
}

bool accuracy_is_unknown(const ff_stage *stage, const ff_result *result)
{
    return isinf(accuracy_estimated_share(stage, result));
}

bool accuracy_is_least(const ff_stage *stage, const ff_result *result)
{
    bool least = false;
    for (size_t i = 0; i < stage->quality_count; i++)
        least =
            least || (isinf(stage->quality[i].value) && is_of(stage, &stage->quality[i], result));
    return least;
}

bool accuracy_may_estimate(const ff_port *row, const ff_port *of)
{
    size_t stem = strlen(of->name);
    return !row->service && !of->service && !strncmp(row->name, of->name, stem) &&
           !strcmp(row->name + stem, ending) && !strcmp(row->unit, of->unit) && row->dims &&
           !strcmp(row->dims, of->dims);
}

static bool has_line_of(const ff_stage *stage, const ff_result *result)
{
    for (size_t i = 0; i < stage->quality_count; i++)
        if (estimated(stage, stage->quality[i].name) == result)
            return true;
    return false;
}

const ff_result *accuracy_estimate_of(const ff_stage *stage, const ff_result *result)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_result *estimate = &stage->results[i];
        if (accuracy_may_estimate(estimate->row, result->row) && estimate->data &&
            estimate->count == result->count && has_line_of(stage, result))
            return estimate;
    }
    return NULL;
}

/* Sum of the lines of the output's own name: "h_min_space_error" is of "h_min", not of
   "h_min_lowest". NaN: there are none. */
static double own_share(const ff_stage *stage, const ff_result *result)
{
    double share = NAN;
    for (size_t i = 0; i < stage->quality_count; i++) {
        const ff_quality *line = &stage->quality[i];
        if (estimated(stage, line->name) == result)
            share =
                (isnan(share) ? 0 : share) + (isnan(line->value) ? (double)INFINITY : line->value);
    }
    return share;
}

bool accuracy_fill_estimates(const ff_stage *stage, const ff_result *result, double *errors)
{
    const ff_result *estimate = accuracy_estimate_of(stage, result);
    const bool least = accuracy_is_least(stage, result);
    const double share = result->rank == 0 ? own_share(stage, result) : (double)NAN;
    for (size_t i = 0; i < result->count; i++) {
        const double error = estimate ? estimate->data[i] : share * result->data[i];
        errors[i] = least || !isfinite(error) ? (double)INFINITY : fabs(error);
    }
    return estimate || isfinite(share);
}

bool accuracy_is_estimate(const ff_stage *stage, const ff_result *result)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++)
        if (stage->results[i].requested &&
            accuracy_may_estimate(result->row, stage->results[i].row))
            return true;
    return false;
}

/* Removes the stages' own estimates for outputs with a measured error: two numbers for one error
   would contradict each other. The measured error includes the errors of the stages upstream. */
static void drop_estimates(const accuracy_record *record, const ff_pipeline *answer)
{
    bool *feeds = memory_alloc((answer->count + 1) * sizeof *feeds);
    for (size_t i = 0; i < record->count; i++)
        feeds[record->errors[i].stage - answer->stages] |= record->errors[i].bar != NULL;
    for (size_t n = answer->count; n-- > 0;) {
        ff_stage *stage = &answer->stages[answer->order[n]];
        if (!feeds[answer->order[n]])
            continue;
        for (size_t k = 0; k < stage->wire_count; k++)
            if (stage->wires[k].stage >= 0)
                feeds[stage->wires[k].stage] = true;
        for (size_t k = stage->quality_count; k-- > 0;)
            if (estimated(stage, stage->quality[k].name) &&
                !isinf(stage->quality[k].value)) /* an infinite estimate says that the value is a
                                                    lower bound, which no twin can show */
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
    if (e->by_stage) {
        fprintf(out, "%sas the stage estimates", between);
        between = "; ";
    }
    if (e->fixed_part > least_part * e->reached) {
        fprintf(out, "%s%.0f %% of it due to settings of the file", between,
                100 * e->fixed_part / e->reached);
        between = "; ";
    }
    if (isfinite(e->order))
        fprintf(out, "%sorder %.2g", between, e->order);
    fclose(out);
    return text;
}

/* Prints an error in the form of its goal, "0.54 %" or "0.31 K"; to be freed. */
static char *print_number(const accuracy_error *e, double error, int digits)
{
    return e->absolute ? memory_print_text("%.*g %s", digits, error, e->result->row->unit)
                       : memory_print_text("%.*g %%", digits, 100 * error);
}

static char *print_error(const accuracy_error *of, double error)
{
    return isnan(error) ? memory_print_text("not known") : print_number(of, error, 2);
}

char *accuracy_print_reached(const accuracy_error *e)
{
    return print_error(e, e->bar ? e->reached : (double)NAN);
}

char *accuracy_print_goal(const accuracy_error *e)
{
    return isnan(e->goal) ? memory_print_text("%s", "") : print_number(e, e->goal, 3);
}

char *accuracy_print_check(const accuracy_record *record, const accuracy_error *e)
{
    if (record->check_failure)
        return memory_print_text("the finer run failed: %s", record->check_failure);
    if (isnan(e->twin_difference))
        return memory_print_text("it cannot be compared with a finer run");
    char *difference = print_error(e, e->twin_difference);
    char *text =
        memory_print_text("%s from a twin a level finer%s%s", difference,
                          record->from_finer ? ", which also gave the error" : "",
                          isnan(e->reached)                  ? "; the error itself is not known"
                          : e->twin_difference <= e->reached ? ""
                                                             : ": more than the stated error");
    free(difference);
    return text;
}

static void add_line(const accuracy_record *record, const accuracy_error *e, ff_stage *stage)
{
    double limit = isnan(e->goal) ? doubtful_above : e->goal;
    const bool held = !record->checked || e->twin_difference <= e->reached; /* not if one is NaN */
    char *name = memory_print_text("%s_error", e->result->row->name);
    char *error = accuracy_print_reached(e), *rest = accuracy_describe(e);
    char *check = held ? memory_print_text("%s", "") : accuracy_print_check(record, e);
    char *text = memory_print_text("measured: %s%s%s%s%s", error, *rest ? "; " : "", rest,
                                   held ? "" : "; ", check);
    ff_add_quality(stage, name, e->reached, limit,
                   held && e->reached <= limit ? FF_GOOD : FF_DOUBTFUL, text);
    free(text);
    free(check);
    free(rest);
    free(error);
    free(name);
}

void accuracy_add_lines(const accuracy_record *record, const ff_pipeline *answer)
{
    drop_estimates(record, answer);
    for (size_t i = 0; i < record->count; i++)
        add_line(record, &record->errors[i],
                 &answer->stages[record->errors[i].stage - answer->stages]);
}
