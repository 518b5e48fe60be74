/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains of cases, along which each starts from the states that its neighbour left. */
#ifndef STUDY_CHAIN_H
#define STUDY_CHAIN_H

#include "case.h"

/* Starts as {0}. */
typedef struct study_chain {
    size_t number, position;  /* of the case that comes next */
    char key[STUDY_KEY_SIZE]; /* of the case before it; "": none */
    json_t *states;           /* {stage: bytes as text} that it starts from */
} study_chain;

void study_chain_begin(study_chain *chain, size_t number);
void study_chain_free(study_chain *chain);
/* False when no axis is followed: then each case is a chain of its own. */
bool study_is_chained(const study_definition *study);
/* The chain of a case, and its position in there. */
size_t study_chain_locate(const study_definition *study, size_t index, size_t *position);
/* Makes an opened case, the next one, part of the chain: its key depends on all before it. */
void study_chain_enter(const study_chain *chain, const study_definition *study, study_case *c);
/* The case is done; record may be NULL. */
void study_chain_pass(study_chain *chain, const study_case *c, const json_t *record);
/* States into the stages before a run, and into the record behind it. */
void study_chain_give(const study_case *c);
void study_chain_take(const study_case *c, json_t *record);
/* As study_record_is_settled, and the record started from the same states. */
bool study_case_is_settled(const study_case *c, const json_t *record, enum study_rerun rerun);

#endif
