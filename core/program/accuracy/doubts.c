/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "doubts.h"

#include "lines.h"

#include <math.h>
#include <string.h>

/* A doubt whose value changes by less than this share in one refinement is not a discretisation
   error. */
static const double lasting = 0.1;

/* True if the coarser answer had the same doubt: refinement does not help. */
static bool is_lasting(const ff_stage *before, const ff_quality *line)
{
    for (size_t i = 0; i < before->quality_count; i++) {
        const ff_quality *was = &before->quality[i];
        if (!strcmp(was->name, line->name))
            return was->verdict != FF_GOOD &&
                   fabs(line->value - was->value) <= lasting * fabs(was->value);
    }
    return false;
}

bool accuracy_has_doubts(const ff_pipeline *answer, const ff_pipeline *before)
{
    for (size_t i = 0; i < answer->count; i++)
        for (size_t k = 0; k < answer->stages[i].quality_count; k++) {
            const ff_stage *stage = &answer->stages[i];
            const ff_quality *line = &stage->quality[k];
            if (line->verdict != FF_GOOD && !accuracy_estimated(stage, line->name) &&
                !(before && is_lasting(&before->stages[i], line)))
                return true;
        }
    return false;
}
