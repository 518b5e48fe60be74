/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "accuracy.h"

#include "axis.h"
#include "control.h"
#include "goals.h"

bool accuracy_run(accuracy_record *record, const ff_tree *tree, ff_engine *engine,
                  ff_pipeline *pipeline, const ff_observer *watch, ff_report *report)
{
    const bool asked = accuracy_is_asked(tree) && accuracy_has_outputs(pipeline);
    record->answer = pipeline;
    if (asked && accuracy_has_goals(tree))
        return accuracy_control(record, tree, engine, pipeline, watch, report);
    if (asked)
        accuracy_want_beside(pipeline);
    return ff_pipeline_run(pipeline, watch, report) &&
           (!asked || accuracy_measure(record, tree, engine, pipeline, watch, NULL));
}
