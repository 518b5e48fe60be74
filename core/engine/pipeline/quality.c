/* SPDX-License-Identifier: MIT */
/* Quality lines: those that models give, and whether the file accepts their doubts; results outside
   the natural bounds of their rows; and differences between stages that give the same quantity. */
#include "build.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Returns the file's reason for accepting the doubt with that name; NULL: the file does not accept
   it. */
static const char *reason_to_accept(const ff_stage *stage, const char *name)
{
    const size_t length = strlen(stage->name);
    for (size_t i = 0; stage->accept && i < stage->accept->count; i++) {
        const char *key = stage->accept->keys[i];
        if (!strncmp(key, stage->name, length) && key[length] == '.' &&
            !strcmp(key + length + 1, name))
            return stage->accept->items[i]->text;
    }
    return NULL;
}

void ff_add_quality(ff_stage *stage, const char *name, double value, double limit, int verdict,
                    const char *text)
{
    const bool doubt = verdict == FF_RANGE || verdict == FF_DOUBTFUL;
    const char *reason = doubt ? reason_to_accept(stage, name) : NULL;
    stage->quality = fe_resize(stage->quality, (stage->quality_count + 1) * sizeof *stage->quality);
    ff_quality line = {.stage = stage->name,
                       .name = fe_copy_clean(name),
                       .value = value,
                       .limit = limit,
                       .verdict = reason  ? FF_GOOD
                                  : doubt ? FF_DOUBTFUL
                                          : verdict,
                       .range = verdict == FF_RANGE,
                       .text = text && text[0] ? fe_copy_clean(text) : NULL,
                       .accepted = reason ? fe_copy_clean(reason) : NULL};
    stage->quality[stage->quality_count++] = line;
}

int ff_quality_given(const ff_quality *line)
{
    return line->range ? FF_RANGE : line->accepted ? FF_DOUBTFUL : line->verdict;
}

static void free_quality(const ff_quality *line)
{
    fe_free((void *)line->name);
    fe_free((void *)line->text);
    fe_free((void *)line->accepted);
}

void ff_drop_quality(ff_stage *stage, size_t line)
{
    free_quality(&stage->quality[line]);
    stage->quality_count--;
    for (size_t i = line; i < stage->quality_count; i++)
        stage->quality[i] = stage->quality[i + 1];
}

void fe_forget_quality(ff_stage *stage)
{
    while (stage->quality_count > 0)
        free_quality(&stage->quality[--stage->quality_count]);
    fe_free(stage->quality);
    stage->quality = NULL;
}

typedef struct bounds {
    double least, most;
} bounds;

/* Returns the bounds of a row. Before 1.3 a model could not mark a number in K as a temperature
   difference, so such a number has no lower bound. */
static bounds bounds_of(const ff_model *model, const ff_port *row)
{
    const bool point = !(row->flags & FF_DIFFERENCE) && !strcmp(row->unit, "K");
    bounds b = {-INFINITY, INFINITY};
    if (row->min < row->max)
        b = (bounds){row->min, row->max};
    if (point && model->abi_minor >= 3)
        b.least = fmax(b.least, 0);
    return b;
}

static double outside(const bounds *b, double value)
{
    return fmax(fmax(b->least - value, value - b->most), 0);
}

/* Returns the number that lies farthest outside the bounds; NULL: all are inside. An excess within
   rounding of the bounds or of the largest number does not count. */
static const double *find_worst(const bounds *b, const ff_result *result)
{
    const double rounding = 1e-12;
    double scale =
        fmax(isfinite(b->least) ? fabs(b->least) : 0, isfinite(b->most) ? fabs(b->most) : 0);
    const double *worst = result->data;
    for (size_t k = 0; k < result->count; k++) {
        scale = fmax(scale, fabs(result->data[k]));
        if (outside(b, result->data[k]) > outside(b, *worst))
            worst = &result->data[k];
    }
    return outside(b, *worst) > rounding * scale ? worst : NULL;
}

static void print_bounds(const bounds *b, char *text, size_t size)
{
    if (isinf(b->most))
        snprintf(text, size, "it cannot be below %g", b->least);
    else if (isinf(b->least))
        snprintf(text, size, "it cannot be above %g", b->most);
    else
        snprintf(text, size, "it must be between %g and %g", b->least, b->most);
}

void fe_judge_bounds(ff_stage *stage)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        const bounds b = bounds_of(stage->loaded->model, result->row);
        const double *worst = result->data && result->count ? find_worst(&b, result) : NULL;
        if (!worst)
            continue;
        char allowed[80], text[160];
        print_bounds(&b, allowed, sizeof allowed);
        snprintf(text, sizeof text, result->rank ? "%s, at index %zu" : "%s", allowed,
                 (size_t)(worst - result->data));
        ff_add_quality(stage, result->row->name, *worst, *worst < b.least ? b.least : b.most,
                       FF_BAD, text);
    }
}

/* Returns the scalar output by which the stage gives the same quantity; NULL: none. */
static ff_result *find_quantity(const ff_stage *stage, const ff_port *as)
{
    for (size_t i = 0; stage->needed && stage->loaded && i < stage->loaded->model->output_count;
         i++) {
        ff_result *result = &stage->results[i];
        if (result->row->quantity && !result->row->service && !*result->row->dims &&
            !strcmp(result->row->quantity, as->quantity) && !strcmp(result->row->unit, as->unit))
            return result;
    }
    return NULL;
}

void fe_want_quantities(ff_pipeline *pipeline)
{
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        for (size_t k = 0; stage->loaded && k < stage->loaded->model->output_count; k++) {
            const ff_port *row = stage->results[k].row;
            ff_result *own = row->quantity ? find_quantity(stage, row) : NULL;
            for (size_t j = 0; own && j < pipeline->count; j++)
                if (j != i && find_quantity(&pipeline->stages[j], row))
                    own->wanted = true;
        }
    }
}

/* Two stages that give the same quantity. */
typedef struct pair {
    const ff_stage *stage;
    const ff_result *result;
    double apart, allowed;
} pair;

static void print_number(const ff_result *result, char *text, size_t size)
{
    const char *shown = result->row->shown ? result->row->shown : result->row->unit;
    char why[120];
    ff_unit unit;
    if (ff_unit_parse(shown, &unit, why, sizeof why))
        ff_quantity_print(*result->data, &unit, shown, text, size);
}

static void add_agreement(ff_stage *stage, const ff_result *own, const pair *other)
{
    char name[120], here[80] = "", there[80] = "", text[400];
    snprintf(name, sizeof name, "%.80s_agreement", own->row->name);
    print_number(own, here, sizeof here);
    print_number(other->result, there, sizeof there);
    snprintf(text, sizeof text, "%.100s: %s here, %s by %.80s.%.80s; their difference, in %s",
             own->row->quantity, here, there, other->stage->name, other->result->row->name,
             own->row->unit);
    for (size_t i = stage->quality_count; i-- > 0;)
        if (!strcmp(stage->quality[i].name, name)) /* reused from an earlier run */
            ff_drop_quality(stage, i);
    ff_add_quality(stage, name, other->apart, other->allowed,
                   other->apart > other->allowed ? FF_RANGE : FF_GOOD, text);
}

/* Compares an output with those of the earlier stages that give the same quantity. */
static void compare(const ff_pipeline *pipeline, size_t place, const ff_result *own)
{
    const double rounding = 1e-9;
    ff_stage *stage = &pipeline->stages[pipeline->order[place]];
    pair worst = {.stage = NULL};
    for (size_t j = 0; j < place; j++) {
        const ff_stage *other = &pipeline->stages[pipeline->order[j]];
        const ff_result *its = find_quantity(other, own->row);
        if (!its || !its->data || its->count != 1)
            continue;
        const double apart = fabs(*own->data - *its->data);
        const double allowed = fmax(fmax(own->row->apart, its->row->apart),
                                    rounding * fmax(fabs(*own->data), fabs(*its->data)));
        if (!worst.stage || apart - allowed > worst.apart - worst.allowed)
            worst = (pair){other, its, apart, allowed};
    }
    if (worst.stage)
        add_agreement(stage, own, &worst);
}

void fe_compare_quantities(ff_pipeline *pipeline)
{
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        for (size_t k = 0; stage->needed && k < stage->loaded->model->output_count; k++) {
            const ff_result *own = &stage->results[k];
            if (own->row->quantity && own->data && own->count == 1 &&
                find_quantity(stage, own->row) == own)
                compare(pipeline, i, own);
        }
    }
}
