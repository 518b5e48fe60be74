/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "accuracy.h"

#include "axis.h"
#include "control.h"
#include "goals.h"
#include "lines.h"

bool accuracy_run(accuracy_record *record, const ff_tree *tree, ff_engine *engine,
                  ff_pipeline *pipeline, const ff_observer *watch, ff_report *report)
{
    const bool asked = accuracy_is_asked(tree) && accuracy_has_outputs(pipeline);
    bool good;
    record->answer = pipeline;
    if (asked && accuracy_has_goals(tree)) {
        good = accuracy_control(record, tree, engine, pipeline, watch, report);
    } else {
        if (asked)
            accuracy_want_beside(pipeline);
        good = ff_pipeline_run(pipeline, watch, report) &&
               (!asked || accuracy_measure(record, tree, engine, pipeline, watch, NULL));
    }
    if (good && asked)
        accuracy_tell(record, record->answer);
    return good;
}
