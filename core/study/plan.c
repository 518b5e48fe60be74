/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run would do. */
#include "private.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_COMPARED = 20 }; /* each with all records */

/* The stages that differ from those of an earlier run of the same case; "" when there is none. */
static void compare(const ff_case *c, const ff_study *study, size_t index, const json_t *records,
                    char *why, size_t size)
{
    json_t *set = ff_case_set(study, index), *setups = ff_case_setups(c), *record, *setup;
    const char *key, *stage;
    size_t length = 0;
    json_object_foreach((json_t *)(size_t)records, key, record)
    {
        if (length > 0 || !json_equal(json_object_get(record, "set"), set))
            continue;
        json_object_foreach(
            setups, stage,
            setup) if (length < size &&
                       !json_equal(json_object_get(json_object_get(record, "setups"), stage),
                                   setup)) length +=
            (size_t)snprintf(why + length, size - length, "%s%s", length ? ", " : "", stage);
    }
    json_decref(set);
    json_decref(setups);
}

void ff_study_plan(const ff_campaign *campaign, ff_plan *plan)
{
    const ff_study *study = campaign->study;
    int directory = open(campaign->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    json_t *records = directory < 0 ? json_object() : ff_journal_read(directory);
    double spent = 0;
    size_t timed = 0;
    *plan = (ff_plan){.seconds = -1};
    for (size_t i = campaign->shard - 1; i < study->count; i += campaign->shards) {
        ff_case c;
        ff_case_open(&c, campaign, i);
        const json_t *record = json_object_get(records, c.key);
        const json_t *seconds = json_object_get(record, "seconds");
        plan->done += ff_record_is_ok(record);
        plan->failed += record && !ff_record_is_ok(record);
        if (!record && !plan->changed[0] && plan->left < MOST_COMPARED)
            compare(&c, study, i, records, plan->changed, sizeof plan->changed);
        plan->left += !ff_record_stands(record, campaign->rerun);
        spent += json_number_value(seconds);
        timed += seconds != NULL;
        ff_case_close(&c);
    }
    if (timed > 0)
        plan->seconds = spent / (double)timed * (double)plan->left / (double)campaign->jobs;
    json_decref(records);
    if (directory >= 0)
        close(directory);
}
