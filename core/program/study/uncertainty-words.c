/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an output is for each word of an input of words: of each branch, where motions coexist. */
#include "uncertainty.h"

#include <math.h>
#include <string.h>

enum {
    MOST_WORDS = 8,
    LEAST = 3 /* samples that each count of levels needs for a mean with its spread */
};

/* Lists the words of an input; returns 0 where there are more than MOST_WORDS. */
static size_t list_words(const variate *v, const char *words[MOST_WORDS])
{
    size_t count = 0;
    for (size_t i = 0; i < v->sample_count; i++) {
        size_t k = 0;
        while (k < count && strcmp(words[k], v->samples[i]) != 0)
            k++;
        if (k < count)
            continue;
        if (count == MOST_WORDS)
            return 0;
        words[count++] = v->samples[i];
    }
    return count;
}

/* Leaves out all samples in which the input is another word; *left: how many of the file's model
   stay. Where the counts of levels leave too few, level 0 stands alone. */
static estimate_samples only_word(const study_uncertainty *u, estimate_samples s, size_t input,
                                  const char *word, size_t *left)
{
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
    *left = good[0];
    s.levels = levels;
    s.inputs = 0;
    return s;
}

json_t *study_uncertainty_words(const study_uncertainty *u, const estimate_samples *s)
{
    json_t *all = json_array();
    for (size_t k = 0; k < u->inputs.count; k++) {
        const char *words[MOST_WORDS];
        size_t count = u->inputs.all[k].words ? list_words(&u->inputs.all[k], words) : 0;
        for (size_t i = 0; count > 1 && i < count; i++) {
            size_t left;
            estimate_samples own = only_word(u, *s, k, words[i], &left);
            if (left < LEAST)
                continue;
            json_array_append_new(
                all, json_pack("{s:s, s:s, s:I, s:o, s:o}", "input", u->inputs.all[k].name, "word",
                               words[i], "samples", (json_int_t)left, "mean",
                               study_uncertainty_estimate(estimate_mean(&own)), "deviation",
                               study_uncertainty_estimate(estimate_deviation(&own))));
        }
    }
    return all;
}
