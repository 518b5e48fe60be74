/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Builds the cases of a study one after another. */
#include "walk.h"

#include "chain.h"

#include "../store/hash.h"

#include <assert.h>
#include <string.h>

study_walk study_walk_begin(const study_run *run, study_records *records)
{
    return (study_walk){.run = run,
                        .records = records,
                        .chain = run->shard - 1,
                        .end = study_chains(run->study),
                        .step = run->shards,
                        .states = json_object(),
                        .kept.keys = true};
}

static void begin_chain(study_walk *walk, size_t chain)
{
    walk->chain = chain;
    walk->position = 0;
    walk->before[0] = '\0';
    if (json_object_size(walk->states) == 0)
        return;
    json_decref(walk->states);
    walk->states = json_object();
}

/* Makes the open case part of its chain. Its key then depends on all cases before it. */
static void enter_chain(study_walk *walk)
{
    study_case *c = &walk->c;
    if (!study_is_chained(walk->run->study))
        return;
    c->states = walk->states;
    char *states = json_dumps(c->states, JSON_COMPACT | JSON_SORT_KEYS);
    uint64_t from = study_hash_text(STUDY_HASH_START, states);
    free(states);
    snprintf(c->from, sizeof c->from, "%016llx", (unsigned long long)from);
    uint64_t key = study_hash_text(
        study_hash_text(study_hash_text(STUDY_HASH_START, "follow"), c->key), walk->before);
    snprintf(c->key, sizeof c->key, "%016llx", (unsigned long long)key);
}

static void open_case(study_walk *walk, study_kept *kept)
{
    const study_definition *study = walk->run->study;
    size_t index = study_chain_case(study, walk->chain, walk->position);
    study_case_open(&walk->c, walk->run, index, kept);
    enter_chain(walk);
    walk->open = true;
}

/* Leaves a case and passes its final states on. A failed case passes on the states from which it
   started. */
static void pass(study_walk *walk, const char *key, const json_t *record)
{
    json_t *states = json_object_get(record, "state");
    walk->position++;
    memcpy(walk->before, key, sizeof walk->before);
    if (!json_is_object(states))
        return;
    json_incref(states);
    json_decref(walk->states);
    walk->states = states;
}

void study_walk_leave(study_walk *walk, const json_t *record)
{
    assert(walk->open);
    pass(walk, walk->c.key, record);
    study_case_close(&walk->c);
    walk->open = false;
}

/* Leaves the open case, if there is one, and passes on its states from an earlier run. */
static void leave_known(study_walk *walk)
{
    if (!walk->open)
        return;
    json_t *record = walk->c.states ? study_records_get(walk->records, walk->c.key) : NULL;
    study_walk_leave(walk, record);
    json_decref(record);
}

study_case *study_walk_next(study_walk *walk)
{
    const study_definition *study = walk->run->study;
    size_t length = study_chain_length(study);
    leave_known(walk);
    for (;;) {
        if (walk->position == length)
            begin_chain(walk, walk->chain + walk->step);
        if (walk->chain >= walk->end)
            return NULL;
        size_t index = study_chain_case(study, walk->chain, walk->position);
        if (!walk->keys || !walk->keys[index][0])
            break;
        pass(walk, walk->keys[index], NULL);
    }
    open_case(walk, &walk->kept);
    return &walk->c;
}

void study_walk_to(study_walk *walk, size_t index)
{
    size_t position, chain = study_chain_locate(walk->run->study, index, &position);
    if (walk->chain != chain || walk->position > position)
        begin_chain(walk, chain);
    while (walk->position < position) {
        study_walk_next(walk);
        leave_known(walk);
    }
}

void study_walk_make(study_walk *walk)
{
    if (!walk->c.kept || !walk->kept.keys)
        return;
    study_case_close(&walk->c);
    open_case(walk, &walk->made);
}

void study_walk_end(study_walk *walk)
{
    leave_known(walk);
    json_decref(walk->states);
    study_kept_free(&walk->kept);
    study_kept_free(&walk->made);
}
