/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the errors that models claim, and counts of their work, among results and lines of quality.
 */
#include "tradeoff.h"

#include <math.h>
#include <string.h>

/* Returns name k, with its stage, of what says the error of an output; NULL after the last. */
static const char *claim_at(const study_tradeoff *t, size_t output, size_t k)
{
    const char *path = t->context->outputs[output]->text;
    const char *const *named = t->claims[output];
    if (!named)
        return k == 0 ? study_context_format(t->context, "%s_error", path) : NULL;
    return named[k] ? study_context_format(t->context, "%.*s.%s", (int)strcspn(path, "."), path,
                                           named[k])
                    : NULL;
}

void study_tradeoff_extras(const study_tradeoff *t)
{
    study_context *context = t->context;
    size_t most = t->count_count;
    for (size_t i = 0; i < context->output_count; i++)
        for (size_t k = 0; claim_at(t, i, k); k++)
            most++;
    const char **extras = memory_arena_alloc(&t->context->arena, (most + 1) * sizeof *extras);
    for (size_t i = 0; i < context->output_count; i++)
        for (size_t k = 0; claim_at(t, i, k); k++)
            extras[context->extra_count++] = claim_at(t, i, k);
    for (size_t i = 0; i < t->count_count; i++)
        extras[context->extra_count++] = t->counts[i];
    context->extras = extras;
}

/* Returns NULL when the case does not have the result. */
static const study_output *find_extra(const study_tradeoff *t, const study_outcome *answer,
                                      const char *name)
{
    for (size_t i = 0; i < t->context->extra_count; i++)
        if (!strcmp(t->context->extras[i], name)) {
            const study_output *found = &answer->outputs[t->context->output_count + i];
            return found->values ? found : NULL;
        }
    return NULL;
}

/* Returns the largest value of an estimate, which has the unit of the result, over the scale of the
   result there. */
static double relative_claim(const study_output *claim, const study_output *result)
{
    double largest = 0, most = accuracy_largest_magnitude(result->values, result->count);
    if (claim->count != result->count || claim->rank != result->rank)
        return NAN;
    for (size_t i = 0; i < result->count; i++)
        largest = fmax(largest, fabs(claim->values[i]) /
                                    accuracy_error_scale(result->values[i], most, result->rank));
    return largest;
}

/* Whether a line such as "film.h_min_space_error" says the error of film.h_min, as a share of it.
 */
static bool is_claim(const char *line, const char *path)
{
    size_t length = strlen(line), stem = strlen(path);
    return length > stem + 6 && !strncmp(line, path, stem) && line[stem] == '_' &&
           !strcmp(line + length - 6, "_error");
}

double study_tradeoff_claim(const study_tradeoff *t, const study_outcome *answer, size_t output)
{
    const study_output *result = &answer->outputs[output];
    bool some = false, named = t->claims[output];
    double sum = 0;
    const char *name;
    for (size_t k = 0; result->values && (name = claim_at(t, output, k)); k++) {
        const study_output *claim = find_extra(t, answer, name);
        sum += claim ? relative_claim(claim, result) : 0;
        some = some || claim;
    }
    if (some && !named)
        return sum;
    for (size_t i = 0; i < answer->quality_count; i++) {
        const study_quality *line = &answer->quality[i];
        bool claims = !named && is_claim(line->name, t->context->outputs[output]->text);
        for (size_t k = 0; named && (name = claim_at(t, output, k)); k++)
            claims = claims || !strcmp(name, line->name);
        sum += claims ? line->value : 0;
        some = some || claims;
    }
    return some ? sum : (double)NAN;
}

double study_tradeoff_count(const study_tradeoff *t, const study_outcome *answer, size_t count)
{
    const study_output *result = find_extra(t, answer, t->counts[count]);
    double sum = 0;
    for (size_t i = 0; result && i < result->count; i++)
        sum += result->values[i];
    for (size_t i = 0; !result && i < answer->quality_count; i++)
        if (!strcmp(answer->quality[i].name, t->counts[count]))
            return answer->quality[i].value;
    return result ? sum : (double)NAN;
}
