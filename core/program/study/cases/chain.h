/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains of cases: each case starts from the states that the previous one left. */
#ifndef STUDY_CHAIN_H
#define STUDY_CHAIN_H

#include "case.h"

#include "../store/records.h"

/* Whether an axis is followed. If not, each case is a chain of its own. */
bool study_is_chained(const study_definition *study);
/* Returns the chain of a case, and sets its position in that chain. */
size_t study_chain_locate(const study_definition *study, size_t index, size_t *position);
/* Puts the states into the stages before a run, and into the record after it. */
void study_chain_restore_states(const study_case *c);
void study_chain_record_states(const study_case *c, json_t *record);
/* True if study_state_is_settled is true for the recorded case, and it started from the same
 * states. */
bool study_case_is_settled(const study_case *c, study_records *records, enum study_rerun rerun);

#endif
