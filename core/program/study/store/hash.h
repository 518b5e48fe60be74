/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hashes everything on which results depend. */
#ifndef STUDY_HASH_H
#define STUDY_HASH_H

#include <flankfilm/engine.h>

/* Start value of a 64-bit FNV-1a hash. */
#define STUDY_HASH_START UINT64_C(0xcbf29ce484222325)

uint64_t study_hash(uint64_t hash, const void *data, size_t length);
uint64_t study_hash_text(uint64_t hash, const char *text); /* NULL differs from "" */
/* Hashes everything on which the case depends: models, parameters in SI, contents of files, wires,
   and requested outputs. Sets the hash of each needed stage in `fingerprints`. */
uint64_t study_fingerprint(const ff_pipeline *pipeline, uint64_t *fingerprints);
/* Hashes everything on which the results of a stage depend, just before the stage is evaluated: as
   above, but with the values of its inputs in place of the stages that feed it. The hash of a stage
   in a loop covers the whole loop. */
uint64_t study_hash_evaluation(const ff_pipeline *pipeline, const ff_stage *stage,
                               const uint64_t *fingerprints);

#endif
