/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run would do, and what earlier ones have saved. */
#include "private.h"

#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A look at what is done, case by case. */
typedef struct look {
    const study_campaign *campaign;
    study_plan *plan;
    json_t *records;
    json_t *by_set;     /* {what is varied: record}, of cases that a run would not leave alone */
    json_t *parameters; /* {hash: values} of all setups */
    double spent;
    size_t timed;
} look;

static char *text_of(const json_t *set)
{
    return json_dumps(set, JSON_COMPACT | JSON_SORT_KEYS);
}

static void index_records(look *l)
{
    const char *key;
    json_t *record;
    l->by_set = json_object();
    l->parameters = json_object();
    json_object_foreach(l->records, key, record)
    {
        char *set = text_of(json_object_get(record, "set"));
        if (set)
            json_object_set(l->by_set, set, record);
        json_object_update(l->parameters, json_object_get(record, "parameters"));
        free(set);
    }
}

/* The same values gave another key. */
static void compare(look *l, const study_case *c, size_t index)
{
    json_t *set = study_case_set(l->campaign->study, index);
    char *text = text_of(set);
    const json_t *record = text ? json_object_get(l->by_set, text) : NULL;
    l->spent += json_number_value(json_object_get(record, "seconds"));
    l->timed += json_object_get(record, "seconds") != NULL;
    if (record && l->plan->again++ == 0 && study_case_is_good(c)) {
        FILE *out = fmemopen(l->plan->changed, sizeof l->plan->changed, "w");
        if (out) {
            study_setup_compare(c, record, l->parameters, out);
            fclose(out);
        }
        size_t length = strnlen(l->plan->changed, sizeof l->plan->changed - 1);
        while (length > 0 && l->plan->changed[length - 1] != '\n')
            length--; /* a line that had no room */
        l->plan->changed[length] = '\0';
    }
    free(text);
    json_decref(set);
}

static void look_at(look *l, study_chain *chain, size_t index)
{
    study_plan *plan = l->plan;
    study_case c;
    study_case_open(&c, l->campaign, index);
    study_chain_enter(chain, l->campaign->study, &c);
    const json_t *record = json_object_get(l->records, c.key);
    plan->done += study_record_is_ok(record);
    plan->failed += record && !study_record_is_ok(record);
    if (!record)
        compare(l, &c, index);
    plan->left += !study_record_stands(record, l->campaign->rerun);
    l->spent += json_number_value(json_object_get(record, "seconds"));
    l->timed += json_object_get(record, "seconds") != NULL;
    study_chain_pass(chain, &c, record);
    study_case_close(&c);
}

void study_foresee(const study_campaign *campaign, study_plan *plan)
{
    const study_definition *study = campaign->study;
    look l = {.campaign = campaign, .plan = plan};
    size_t chains = 0;
    study_chain chain = {0};
    *plan = (study_plan){.seconds = -1};
    l.records = study_journal_read(campaign->directory);
    index_records(&l);
    for (size_t k = campaign->shard - 1; k < study_chains(study); k += campaign->shards) {
        study_chain_begin(&chain, k);
        chains++;
        if (!json_object_size(l.records)) { /* there is nothing to look for */
            plan->left += study_chain_length(study);
            continue;
        }
        for (size_t i = 0; i < study_chain_length(study); i++)
            look_at(&l, &chain, study_chained(study, k, i));
    }
    if (l.timed > 0)
        plan->seconds = l.spent / (double)l.timed * (double)plan->left /
                        fmax(1, fmin((double)campaign->jobs, (double)chains));
    study_chain_free(&chain);
    json_decref(l.records);
    json_decref(l.by_set);
    json_decref(l.parameters);
}

static void add(size_t *count, double *sum, const json_t *seconds)
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
    add(&savings->computed, &savings->spent, json_object_get(record, "stages"));
    add(&savings->reused, &savings->saved, json_object_get(record, "reused"));
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
