/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Determines what a run would do, and how much earlier runs have saved. */
#include "run.h"

#include "../cases/chain.h"
#include "../cases/walk.h"
#include "../store/hash.h"
#include "../store/journal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A case of an earlier run, found by its assignments. */
typedef struct earlier_case {
    uint64_t set;  /* hash of the assignments */
    uint64_t rank; /* position of its record */
    char key[STUDY_KEY_SIZE];
} earlier_case;

/* Counts, case by case, what is already done. */
typedef struct survey {
    const study_run *run;
    study_plan *plan;
    study_records *records;
    earlier_case *earlier; /* sorted; made when the first case with a changed key is found */
    size_t earlier_count;
} survey;

static uint64_t hash_set(const json_t *set)
{
    char *text = json_dumps(set, JSON_COMPACT | JSON_SORT_KEYS);
    uint64_t hash = study_hash_text(STUDY_HASH_START, text);
    free(text);
    return hash;
}

static int by_set(const void *a, const void *b)
{
    const earlier_case *one = a, *other = b;
    if (one->set != other->set)
        return one->set < other->set ? -1 : 1;
    return one->rank < other->rank ? -1 : one->rank > other->rank;
}

static void index_earlier(survey *s)
{
    size_t at = 0;
    uint64_t rank;
    json_t *record;
    s->earlier = memory_alloc((study_records_count(s->records) + 1) * sizeof *s->earlier);
    while ((record = study_records_next(s->records, &at, &rank))) {
        earlier_case *made = &s->earlier[s->earlier_count++];
        *made = (earlier_case){.set = hash_set(json_object_get(record, "set")), .rank = rank};
        snprintf(made->key, sizeof made->key, "%s",
                 json_string_value(json_object_get(record, "key")));
        json_decref(record);
    }
    qsort(s->earlier, s->earlier_count, sizeof *s->earlier, by_set);
}

/* Returns the last record with the assignments of the case, to be released, or NULL if there is
   none. */
static json_t *find_earlier(survey *s, size_t index)
{
    json_t *set = study_case_set(s->run->study, index);
    uint64_t wanted = hash_set(set);
    size_t low = 0, high;
    json_decref(set);
    if (!s->earlier)
        index_earlier(s);
    high = s->earlier_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (s->earlier[middle].set <= wanted)
            low = middle + 1;
        else
            high = middle;
    }
    return low > 0 && s->earlier[low - 1].set == wanted
               ? study_records_get(s->records, s->earlier[low - 1].key)
               : NULL;
}

static void count_seconds(survey *s, const json_t *record)
{
    const json_t *seconds = json_object_get(record, "seconds");
    s->plan->spent += json_number_value(seconds);
    s->plan->timed += seconds != NULL;
}

/* Counts a case that was done with the same assignments but now has another key. For the first such
   case, prints what has changed. */
static void explain_change(survey *s, const study_case *c)
{
    json_t *record = find_earlier(s, c->index);
    count_seconds(s, record);
    if (record && s->plan->again++ == 0 && study_case_is_good(c)) {
        const char *input = json_string_value(json_object_get(record, "input"));
        FILE *out = fmemopen(s->plan->changed, sizeof s->plan->changed, "w");
        if (out) {
            study_setup_compare(
                c, s->run->study,
                json_object_get(study_records_described(s->records), input ? input : ""), out);
            fclose(out);
        }
        size_t length = strnlen(s->plan->changed, sizeof s->plan->changed - 1);
        while (length > 0 && s->plan->changed[length - 1] != '\n')
            length--; /* removes an incomplete last line */
        s->plan->changed[length] = '\0';
    }
    json_decref(record);
}

static void count_case(survey *s, study_walk *walk)
{
    /* largest number of records that are read to estimate the duration of a case */
    enum { TIMED = 10000 };
    study_plan *plan = s->plan;
    if (study_records_state(s->records, walk->c.key) == STUDY_UNKNOWN)
        study_walk_make(walk);
    const study_case *c = &walk->c;
    enum study_state state = study_records_state(s->records, c->key);
    plan->done += state == STUDY_OK;
    plan->failed += state == STUDY_NOT_OK;
    plan->left += !study_case_is_settled(c, s->records, s->run->rerun);
    if (state == STUDY_UNKNOWN)
        explain_change(s, c);
    if (s->run->keys)
        memcpy(s->run->keys[c->index], c->key, sizeof c->key);
    if (state == STUDY_UNKNOWN || plan->timed >= TIMED)
        return;
    json_t *record = study_records_get(s->records, c->key);
    count_seconds(s, record);
    json_decref(record);
}

void study_preview(const study_run *given, study_plan *plan)
{
    study_run own = *given;
    ff_run *base = study_case_base(own.engine, own.file);
    own.base = base;
    survey s = {.run = &own, .plan = plan, .records = study_records_open(own.directory, true)};
    study_walk walk = study_walk_begin(&own, s.records);
    walk.chain += own.begin;
    walk.end = own.end ? own.end : walk.end;
    size_t chains = walk.chain < walk.end ? (walk.end - walk.chain - 1) / own.shards + 1 : 0;
    if (study_records_count(s.records) == 0) /* all cases are left, so none must be built */
        plan->left += chains * study_chain_length(own.study);
    while (study_records_count(s.records) > 0 && study_walk_next(&walk))
        count_case(&s, &walk);
    if (plan->timed > 0)
        plan->seconds = plan->spent / (double)plan->timed * (double)plan->left /
                        fmax(1, fmin((double)own.jobs, (double)chains));
    study_walk_end(&walk);
    if (own.rows)
        *own.rows = s.records;
    else
        study_records_close(s.records);
    free(s.earlier);
    ff_run_close(base);
}

static void add_seconds(size_t *count, double *sum, const json_t *seconds)
{
    const char *stage;
    json_t *value;
    json_object_foreach((json_t *)(size_t)seconds, stage, value)
    {
        *count += 1;
        *sum += json_number_value(value);
    }
}

void study_savings_add(study_reuse_counts *savings, const json_t *record)
{
    add_seconds(&savings->computed, &savings->spent, json_object_get(record, "stages"));
    add_seconds(&savings->reused, &savings->saved, json_object_get(record, "reused"));
}

study_reuse_counts study_savings(const char *directory)
{
    study_reuse_counts savings = {0};
    size_t at = 0;
    json_t *record;
    study_records *records = study_records_open(directory, false);
    while ((record = study_records_next(records, &at, NULL))) {
        study_savings_add(&savings, record);
        json_decref(record);
    }
    study_records_close(records);
    return savings;
}
