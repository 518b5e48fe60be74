/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hashes of what results depend on. */
#ifndef STUDY_HASH_H
#define STUDY_HASH_H

#include <flankfilm/engine.h>

/* Start value of a 64-bit FNV-1a hash. */
#define STUDY_HASH_START UINT64_C(0xcbf29ce484222325)

uint64_t study_hash(uint64_t hash, const void *data, size_t length);
uint64_t study_hash_text(uint64_t hash, const char *text); /* NULL differs from "" */
/* Hashes what the case depends on: models, parameters in SI, contents of files, wires, and
 * requested outputs. Sets the same hash for each needed stage in `fingerprints`. */
uint64_t study_fingerprint(const ff_pipeline *pipeline, uint64_t *fingerprints);
/* Hashes what the results of a stage depend on, just before it is evaluated: as above, but with
 * the values that feed it in place of the stages that feed it. The hash of a stage in a loop
 * covers the whole loop. */
uint64_t study_hash_evaluation(const ff_pipeline *pipeline, const ff_stage *stage,
                               const uint64_t *fingerprints);

#endif
