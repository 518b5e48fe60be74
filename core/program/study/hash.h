/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What results depend on, as a number. */
#ifndef STUDY_HASH_H
#define STUDY_HASH_H

#include "study.h"

uint64_t study_hash(uint64_t hash, const void *data, size_t length);
uint64_t study_hash_text(uint64_t hash, const char *text); /* NULL differs from "" */
/* Model and parameters of a stage, and what is wanted of it. */
uint64_t study_hash_setup(const fe_stage *stage);
/* What the case depends on: models, parameters in SI, contents of files, what feeds what, and what
   is asked for. fingerprints: the same for each needed stage. */
uint64_t study_fingerprint(const fe_pipeline *pipeline, uint64_t *fingerprints);
/* What the results of a stage depend on that is about to be evaluated: as above, but the values
   that it is fed instead of where they come from. */
uint64_t study_hash_evaluation(const fe_pipeline *pipeline, const fe_stage *stage,
                               const uint64_t *fingerprints);

#endif
