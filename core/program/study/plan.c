/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds what a run would do, and what earlier runs have saved. */
#include "chain.h"
#include "journal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Counts case by case what is done. */
typedef struct survey {
    const study_run *run;
    study_plan *plan;
    json_t *records;
    json_t *by_set; /* {assignments of a case: its record}, to find a case whose key has changed */
    json_t *parameters; /* {hash: values} of all setups */
    double spent;
    size_t timed;
} survey;

static char *print_set(const json_t *set)
{
    return json_dumps(set, JSON_COMPACT | JSON_SORT_KEYS);
}

static void index_records(survey *s)
{
    const char *key;
    json_t *record;
    s->by_set = json_object();
    s->parameters = json_object();
    json_object_foreach(s->records, key, record)
    {
        char *set = print_set(json_object_get(record, "set"));
        if (set)
            json_object_set(s->by_set, set, record);
        json_object_update(s->parameters, json_object_get(record, "parameters"));
        free(set);
    }
}

/* Counts a case that was done with the same assignments but has another key now; for the first of
   them, prints what has changed. */
static void explain_change(survey *s, const study_case *c, size_t index)
{
    json_t *set = study_case_set(s->run->study, index);
    char *text = print_set(set);
    const json_t *record = text ? json_object_get(s->by_set, text) : NULL;
    s->spent += json_number_value(json_object_get(record, "seconds"));
    s->timed += json_object_get(record, "seconds") != NULL;
    if (record && s->plan->again++ == 0 && study_case_is_good(c)) {
        FILE *out = fmemopen(s->plan->changed, sizeof s->plan->changed, "w");
        if (out) {
            study_setup_compare(c, record, s->parameters, out);
            fclose(out);
        }
        size_t length = strnlen(s->plan->changed, sizeof s->plan->changed - 1);
        while (length > 0 && s->plan->changed[length - 1] != '\n')
            length--; /* drops an incomplete last line */
        s->plan->changed[length] = '\0';
    }
    free(text);
    json_decref(set);
}

static void count_case(survey *s, study_chain *chain, size_t index)
{
    study_plan *plan = s->plan;
    study_case c;
    study_case_open(&c, s->run, index);
    study_chain_enter(chain, s->run->study, &c);
    const json_t *record = json_object_get(s->records, c.key);
    plan->done += study_record_is_ok(record);
    plan->failed += record && !study_record_is_ok(record);
    if (!record)
        explain_change(s, &c, index);
    plan->left += !study_record_is_settled(record, s->run->rerun);
    s->spent += json_number_value(json_object_get(record, "seconds"));
    s->timed += json_object_get(record, "seconds") != NULL;
    study_chain_pass(chain, &c, record);
    study_case_close(&c);
}

void study_preview(const study_run *given, study_plan *plan)
{
    study_run own = *given;
    const study_run *run = &own;
    const study_definition *study = run->study;
    ff_tree *tree = study_case_tree(own.file);
    own.tree = tree;
    survey s = {.run = run, .plan = plan};
    size_t chains = 0;
    study_chain chain = {0};
    *plan = (study_plan){.seconds = -1};
    s.records = study_arrays_read_done(run->directory);
    index_records(&s);
    for (size_t k = run->shard - 1; k < study_chains(study); k += run->shards) {
        study_chain_begin(&chain, k);
        chains++;
        if (!json_object_size(
                s.records)) { /* without records all cases are left: none need be built */
            plan->left += study_chain_length(study);
            continue;
        }
        for (size_t i = 0; i < study_chain_length(study); i++)
            count_case(&s, &chain, study_chain_case(study, k, i));
    }
    if (s.timed > 0)
        plan->seconds = s.spent / (double)s.timed * (double)plan->left /
                        fmax(1, fmin((double)run->jobs, (double)chains));
    study_chain_free(&chain);
    json_decref(s.records);
    json_decref(s.by_set);
    json_decref(s.parameters);
    ff_tree_free(tree);
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
    const char *key;
    json_t *record;
    json_t *records = study_journal_read(directory);
    json_object_foreach(records, key, record) study_savings_add(&savings, record);
    json_decref(records);
    return savings;
}
