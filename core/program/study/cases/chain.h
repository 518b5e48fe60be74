/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains of cases: each case starts from the final states of the previous one. */
#ifndef STUDY_CHAIN_H
#define STUDY_CHAIN_H

#include "case.h"

#include "../store/records.h"

/* Returns whether an axis is followed. If not, each case is a chain of its own. */
bool study_is_chained(const study_definition *study);
/* Returns the chain of a case, and sets its position in that chain. */
size_t study_chain_locate(const study_definition *study, size_t index, size_t *position);
/* Copies the states to the stages before a run, and to the record after it. */
void study_chain_restore_states(const study_case *c);
void study_chain_record_states(const study_case *c, json_t *record);
/* Returns true if the recorded case need not run again (study_state_is_settled) and started from
   the same states. */
bool study_case_is_settled(const study_case *c, study_records *records, enum study_rerun rerun);

#endif
