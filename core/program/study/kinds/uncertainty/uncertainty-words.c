/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of an output for each word of an input whose values are words, such as the branch of
 * coexisting motions. */
#include "uncertainty.h"

#include <math.h>
#include <string.h>

/* Least number of samples with a word that give a mean and its spread. If one level of the estimate
 * has fewer, only the first level is used. */
enum { LEAST = 3 };

size_t study_uncertainty_words(const variate *v, const char *words[UNCERTAINTY_MOST_WORDS])
{
    size_t count = 0;
    for (size_t i = 0; i < v->sample_count; i++) {
        size_t k = 0;
        while (k < count && strcmp(words[k], v->samples[i]) != 0)
            k++;
        if (k < count)
            continue;
        if (count == UNCERTAINTY_MOST_WORDS)
            return 0;
        words[count++] = v->samples[i];
    }
    return count;
}

/* Describes how an input follows from its standard normal number; a correlated input also depends
 * on the numbers of the others. */
static estimate_input shape_of(const study_uncertainty *u, size_t input)
{
    const variate *v = &u->inputs.all[input];
    const char *words[UNCERTAINTY_MOST_WORDS];
    estimate_input shape = {.group = v->group, .steps = v->sample_count};
    size_t members = 0, count = study_uncertainty_words(v, words);
    for (size_t k = 0; k < u->inputs.count; k++)
        members += u->inputs.all[k].group == v->group;
    if (members > 1 || (v->kind == VARIATE_SAMPLES && count == 0))
        return shape;
    shape.shape = v->kind == VARIATE_UNIFORM   ? ESTIMATE_EVEN
                  : v->kind == VARIATE_SAMPLES ? ESTIMATE_STEPS
                                               : ESTIMATE_NORMAL;
    size_t *step = memory_arena_alloc(&u->context->arena, (v->sample_count + 1) * sizeof *step);
    for (size_t i = 0; i < v->sample_count; i++)
        while (step[i] < count && strcmp(words[step[i]], v->samples[i]) != 0)
            step[i]++;
    shape.step = step;
    return shape;
}

void study_uncertainty_shapes(study_uncertainty *u)
{
    for (size_t k = 0; k < u->inputs.count; k++)
        u->shapes[k] = shape_of(u, k);
}

size_t study_uncertainty_of_word(const study_uncertainty *u, const estimate_samples *all,
                                 size_t input, const char *word, estimate_samples *own)
{
    estimate_samples s = *all;
    size_t good[ESTIMATE_MOST_LEVELS] = {0}, levels = s.levels;
    double *values[ESTIMATE_MOST_LEVELS];
    for (size_t k = 0; k < s.levels; k++) {
        values[k] = memory_arena_alloc(&u->context->arena, s.count[k] * sizeof *values[k]);
        memcpy(values[k], s.values[k], s.count[k] * sizeof *values[k]);
        s.values[k] = values[k];
    }
    for (size_t i = 0; i < s.count[s.levels - 1]; i++) {
        const double *numbers = u->numbers + i * u->inputs.count;
        bool same = !strcmp(variates_value(&u->inputs, u->context, input, numbers), word);
        size_t block = 0;
        while (i >= s.count[block])
            block++;
        for (size_t k = block; k < s.levels; k++) {
            values[k][i] = same ? values[k][i] : (double)NAN;
            same = same && isfinite(values[k][i]);
        }
        good[block] += same;
    }
    for (size_t block = 0; block < s.levels; block++)
        levels = good[block] < LEAST ? 1 : levels;
    s.levels = levels;
    s.inputs = 0;
    *own = s;
    return good[0] < LEAST ? 0 : good[0];
}
