/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Determines the result of a run from the rows on the disk. */
#include "run.h"

#include "../store/journal.h"

/* Counts the rows of the cases of this run that have a key. */
static void count_rows(const study_run *run, study_records *records, char (*keys)[STUDY_KEY_SIZE],
                       study_counters *found, size_t *answered)
{
    size_t length = study_chain_length(run->study);
    size_t end = run->end ? run->end : study_chains(run->study);
    for (size_t k = run->begin + run->shard - 1; k < end; k += run->shards)
        for (size_t i = 0; i < length; i++) {
            size_t index = study_chain_case(run->study, k, i);
            const char *key = keys[index];
            enum study_state state = *key ? study_records_state(records, key) : STUDY_UNKNOWN;
            *answered += *key != '\0';
            if (state == STUDY_UNKNOWN)
                continue;
            study_judgement judgement = study_records_judge(records, key);
            found->done++;
            found->failed += state == STUDY_NOT_OK && judgement.verdict != STUDY_CASE_REFUSED;
            study_tally_add(&found->tally, index + 1, key, &judgement);
            study_judgement_free(&judgement);
        }
}

/* If a case ran again and failed, the row of an earlier success is kept, if there is one. The
   failure is counted nevertheless. */
bool study_recount(const study_run *run, study_records *records, char (*keys)[STUDY_KEY_SIZE],
                   study_counters *counters, ff_report *report)
{
    study_counters found = {.total = 0};
    size_t answered = 0;
    count_rows(run, records, keys, &found, &answered);
    bool whole = found.done == answered, hides = whole && found.failed < counters->failed;
    counters->done = found.done;
    if (counters->before > found.done)
        counters->before = found.done;
    if (!hides) {
        study_tally_free(&counters->tally);
        counters->failed = found.failed;
        counters->tally = found.tally;
    } else {
        study_tally_free(&found.tally);
    }
    return whole || ff_report_errors(report) > 0 ||
           ff_error(report, FF_FAULT_RUN, FF_NOWHERE, "the same command runs them again",
                    "%zu of %zu finished cases are no longer on the disk in \"%s\"",
                    answered - found.done, answered, run->directory);
}
