/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A law that is tried with one set of parameters after the other. */
#ifndef FE_CANDIDATE_H
#define FE_CANDIDATE_H

#include "pipeline.h"

typedef struct fe_candidate fe_candidate;

/* NULL after an error: no such model, it offers no such service, it takes inputs. */
fe_candidate *fe_candidate_new(fe_library *library, const char *id, const char *interface,
                               fe_report *report);
void fe_candidate_free(fe_candidate *candidate);

const fe_loaded *fe_candidate_model(const fe_candidate *candidate);
/* Reads a parameter that is held from here on. False after an error. */
bool fe_candidate_hold(fe_candidate *candidate, size_t param, const fe_node *node,
                       fe_report *report);
double fe_candidate_held(const fe_candidate *candidate, size_t param); /* NaN: it is no number */

/* The service with these values, in SI; NaN: what it is held at, its preset, or none. Lives until
   the next call. NULL after an error. */
const void *fe_candidate_open(fe_candidate *candidate, const double *values, fe_report *report);
/* The reason that the law itself gave for refusing them; "" without. */
const char *fe_candidate_why(const fe_candidate *candidate);

#endif
