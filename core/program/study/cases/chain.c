/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A chain consists of the cases that differ only along the followed axis. Each case starts from the
 * final states of its neighbour's stages, which are in the neighbour's record in the journal.
 */
#include "chain.h"

#include "../store/hash.h"
#include "../store/journal.h"

#include <stdlib.h>
#include <string.h>

bool study_is_chained(const study_definition *study)
{
    return study->followed < study->axis_count;
}

size_t study_chain_length(const study_definition *study)
{
    return study_is_chained(study) ? study->points[study->followed] : 1;
}

size_t study_chains(const study_definition *study)
{
    return study->count / study_chain_length(study);
}

static bool runs_backwards(const study_definition *study, size_t index)
{
    bool down =
        study->direction < study->axis_count && study_rank(study, study->direction, index) == 1;
    return down != study->backwards;
}

size_t study_chain_case(const study_definition *study, size_t chain, size_t position)
{
    if (!study_is_chained(study))
        return chain;
    size_t length = study_chain_length(study), stride = study_stride(study, study->followed);
    size_t first = chain / stride * stride * length + chain % stride;
    size_t point = runs_backwards(study, first) ? length - 1 - position : position;
    return first + point * stride;
}

size_t study_chain_locate(const study_definition *study, size_t index, size_t *position)
{
    *position = 0;
    if (!study_is_chained(study))
        return index;
    size_t length = study_chain_length(study), stride = study_stride(study, study->followed);
    size_t point = study_rank(study, study->followed, index);
    *position = runs_backwards(study, index) ? length - 1 - point : point;
    return index / (stride * length) * stride + index % stride;
}

bool study_case_is_settled(const study_case *c, study_records *records, enum study_rerun rerun)
{
    bool settled = study_state_is_settled(study_records_state(records, c->key), rerun);
    if (!settled || !c->states)
        return settled;
    json_t *record = study_records_get(records, c->key);
    const char *from = json_string_value(json_object_get(record, "from"));
    settled = !from || !strcmp(from, c->from);
    json_decref(record);
    return settled;
}

static int digit_of(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* Reads a state from two hexadecimal digits for each byte. Any other text gives an empty state;
   this program never writes one. */
static void read_state(ff_stage *stage, const char *text)
{
    size_t size = strlen(text) / 2;
    unsigned char *bytes = memory_alloc(size + 1);
    for (size_t i = 0; i < size; i++) {
        int high = digit_of(text[2 * i]), low = digit_of(text[2 * i + 1]);
        if (high < 0 || low < 0)
            size = 0;
        else
            bytes[i] = (unsigned char)(16 * high + low);
    }
    ff_stage_set_state(stage, bytes, size);
    free(bytes);
}

void study_chain_restore_states(const study_case *c)
{
    for (size_t i = 0; c->states && i < c->pipeline->count; i++) {
        ff_stage *stage = &c->pipeline->stages[i];
        const char *text = json_string_value(json_object_get(c->states, stage->name));
        c->pipeline->chained = true;
        if (text)
            read_state(stage, text);
    }
}

static json_t *write_state(const ff_stage *stage)
{
    const unsigned char *bytes = stage->state;
    char *text = memory_alloc(2 * stage->state_size + 1);
    for (size_t i = 0; i < stage->state_size; i++)
        snprintf(text + 2 * i, 3, "%02x", bytes[i]);
    json_t *state = json_string(text);
    free(text);
    return state;
}

void study_chain_record_states(const study_case *c, json_t *record)
{
    if (!c->states)
        return;
    json_t *states = json_copy((json_t *)(size_t)c->states);
    for (size_t i = 0; c->pipeline && i < c->pipeline->count; i++)
        if (c->pipeline->stages[i].state)
            json_object_set_new(states, c->pipeline->stages[i].name,
                                write_state(&c->pipeline->stages[i]));
    json_object_set_new(record, "from", json_string(c->from));
    json_object_set_new(record, "state", states);
}
