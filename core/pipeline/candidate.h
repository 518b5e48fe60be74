/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A law that is tried with one set of parameters after the other. */
#ifndef FF_CANDIDATE_H
#define FF_CANDIDATE_H

#include "pipeline.h"

typedef struct ff_candidate ff_candidate;

/* NULL after an error: no such model, it offers no such service, it takes inputs. */
ff_candidate *ff_candidate_new(ff_library *library, const char *id, const char *interface,
                               ff_report *report);
void ff_candidate_free(ff_candidate *candidate);

const ff_loaded *ff_candidate_model(const ff_candidate *candidate);
/* Reads a parameter that is held from here on. False after an error. */
bool ff_candidate_hold(ff_candidate *candidate, size_t param, const ff_node *node,
                       ff_report *report);
double ff_candidate_held(const ff_candidate *candidate, size_t param); /* NaN: it is no number */

/* The service with these values, in SI; NaN: what it is held at, its preset, or none. Lives until
   the next call. NULL after an error. */
const void *ff_candidate_open(ff_candidate *candidate, const double *values, ff_report *report);
/* The reason that the law itself gave for refusing them; "" without. */
const char *ff_candidate_why(const ff_candidate *candidate);

#endif
