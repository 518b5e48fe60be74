/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "accuracy.h"

#include "axis.h"
#include "control.h"
#include "goals.h"
#include "lines.h"

#include "../run/run.h"

bool accuracy_run(accuracy_record *record, ff_run *run, ff_engine *engine, const ff_observer *watch,
                  ff_report *report)
{
    ff_pipeline *pipeline = record->answer = ff_run_pipeline(run);
    const accuracy_scene scene = {
        .runs = &record->runs, .file = run, .engine = engine, .start = pipeline, .watch = watch};
    bool good;
    if (!accuracy_has_outputs(pipeline))
        return run_start(run, watch);
    if (accuracy_has_goals(run)) {
        good = accuracy_control(record, &scene, report);
    } else {
        accuracy_want_beside(pipeline, true);
        good = run_start(run, watch) && accuracy_measure(record, &scene, NULL, ACCURACY_PARTS);
    }
    if (good && accuracy_has_check(run))
        good = accuracy_check_twin(record, &scene);
    if (good)
        accuracy_add_lines(record, record->answer);
    return good;
}
