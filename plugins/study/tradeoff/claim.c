/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The errors that models claim, and counts of their work: results, or lines of quality. */
#include "tradeoff.h"

#include <math.h>

/* Name number k of what says the error of an output, with its stage; NULL behind the last. */
static const char *claim_at(const study_tradeoff *t, size_t output, size_t k)
{
    const char *path = t->plan->outputs[output]->text;
    const char *const *named = t->claims[output];
    if (!named)
        return k == 0 ? study_keep(t->desk, "%s_error", path) : NULL;
    return named[k] ? study_keep(t->desk, "%.*s.%s", (int)strcspn(path, "."), path, named[k])
                    : NULL;
}

void study_tradeoff_extras(const study_tradeoff *t, ff_study_plan *plan)
{
    size_t most = t->count_count;
    for (size_t i = 0; i < plan->output_count; i++)
        for (size_t k = 0; claim_at(t, i, k); k++)
            most++;
    const char **extras = t->desk->memory(t->desk->ctx, (most + 1) * sizeof *extras);
    for (size_t i = 0; i < plan->output_count; i++)
        for (size_t k = 0; claim_at(t, i, k); k++)
            extras[plan->extra_count++] = claim_at(t, i, k);
    for (size_t i = 0; i < t->count_count; i++)
        extras[plan->extra_count++] = t->counts[i];
    plan->extras = extras;
}

/* NULL: the case has no such result. */
static const ff_study_output *find_extra(const study_tradeoff *t, const ff_study_answer *answer,
                                         const char *name)
{
    for (size_t i = 0; i < t->plan->extra_count; i++)
        if (!strcmp(t->plan->extras[i], name)) {
            const ff_study_output *found = answer->outputs[t->plan->output_count + i];
            return found->values ? found : NULL;
        }
    return NULL;
}

/* The largest of an estimate in the unit of the result, over the scale of the result there. */
static double relative_claim(const ff_study_output *claim, const ff_study_output *result)
{
    double largest = 0, most = study_largest(result->values, result->count);
    if (claim->count != result->count || claim->rank != result->rank)
        return NAN;
    for (size_t i = 0; i < result->count; i++)
        largest = fmax(largest,
                       fabs(claim->values[i]) / study_scale(result->values[i], most, result->rank));
    return largest;
}

/* "film.h_min_space_error" of film.h_min: a share of the output. */
static bool is_claim(const char *line, const char *path)
{
    size_t length = strlen(line), stem = strlen(path);
    return length > stem + 6 && !strncmp(line, path, stem) && line[stem] == '_' &&
           !strcmp(line + length - 6, "_error");
}

double study_tradeoff_claim(const study_tradeoff *t, const ff_study_answer *answer, size_t output)
{
    const ff_study_output *result = answer->outputs[output];
    bool some = false, named = t->claims[output];
    double sum = 0;
    const char *name;
    for (size_t k = 0; result->values && (name = claim_at(t, output, k)); k++) {
        const ff_study_output *claim = find_extra(t, answer, name);
        sum += claim ? relative_claim(claim, result) : 0;
        some = some || claim;
    }
    if (some && !named)
        return sum;
    for (size_t i = 0; i < answer->line_count; i++) {
        const ff_study_line *line = answer->lines[i];
        bool claims = !named && is_claim(line->name, t->plan->outputs[output]->text);
        for (size_t k = 0; named && (name = claim_at(t, output, k)); k++)
            claims = claims || !strcmp(name, line->name);
        sum += claims ? line->value : 0;
        some = some || claims;
    }
    return some ? sum : (double)NAN;
}

double study_tradeoff_count(const study_tradeoff *t, const ff_study_answer *answer, size_t count)
{
    const ff_study_output *result = find_extra(t, answer, t->counts[count]);
    double sum = 0;
    for (size_t i = 0; result && i < result->count; i++)
        sum += result->values[i];
    for (size_t i = 0; !result && i < answer->line_count; i++)
        if (!strcmp(answer->lines[i]->name, t->counts[count]))
            return answer->lines[i]->value;
    return result ? sum : (double)NAN;
}
