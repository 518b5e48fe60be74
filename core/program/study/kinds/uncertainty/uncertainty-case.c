/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Submits the cases of an uncertainty study, and finds them again. */
#include "uncertainty.h"

#include "../../../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

size_t study_uncertainty_submit(const study_uncertainty *u, const char *label,
                                const double *numbers, const uncertainty_patch *patch,
                                bool measured)
{
    study_context *context = u->context;
    study_setting *settings = memory_alloc(context->path_count * sizeof *settings);
    size_t k = 0;
    settings[k++] = (study_setting){"", label};
    for (size_t i = 0; i < u->inputs.count; i++) {
        const variate *one = &u->inputs.all[i];
        const char *value = variates_value(&u->inputs, context, i, numbers);
        for (size_t p = 0; p < one->path_count; p++, k++)
            settings[k] = (study_setting){
                study_context_format(context, "%s=%s", one->paths[p], value), value};
    }
    for (; k < context->path_count; k++) {
        const char *text = patch && patch->assignments ? patch->assignments[k] : NULL;
        bool accuracy = measured && !strcmp(context->paths[k], "accuracy");
        text = accuracy ? "accuracy=measured" : text ? text : "";
        settings[k] = (study_setting){text, *text ? strchr(text, '=') + 1 : ""};
    }
    size_t number =
        study_submit(context, settings, 0, label, patch ? patch->place : u->inputs.place);
    free(settings);
    return number;
}

size_t study_uncertainty_pilot_case(const study_uncertainty *u, size_t level, size_t sample)
{
    return u->first_pilot + level * u->pilot + sample;
}

size_t study_uncertainty_sample_case(const study_uncertainty *u, size_t slot, size_t sample)
{
    if (sample < u->pilot)
        return study_uncertainty_pilot_case(u, u->plan.level[slot], sample);
    size_t number = u->first_main + sample - u->pilot;
    for (size_t k = 0; k < slot; k++)
        number += u->plan.count[k] - u->pilot;
    return number;
}

double study_uncertainty_value(const study_uncertainty *u, size_t number, size_t output)
{
    const study_outcome *outcome = study_outcome_of(u->context, number);
    const study_output *one = &outcome->outputs[output];
    return *outcome->reason || !one->values || one->rank ? (double)NAN : one->values[0];
}
