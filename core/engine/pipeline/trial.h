/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A law that is tried with one set of parameters after the other. */
#ifndef FE_TRIAL_H
#define FE_TRIAL_H

#include "pipeline.h"

typedef struct fe_trial fe_trial;

/* NULL after an error: no such model, it offers no such service, it takes inputs. */
fe_trial *fe_trial_new(fe_library *library, const char *id, const char *interface,
                       fe_report *report);
void fe_trial_free(fe_trial *trial);

const fe_loaded *fe_trial_model(const fe_trial *trial);
/* Reads a parameter that is held from here on. False after an error. */
bool fe_trial_hold(fe_trial *trial, size_t param, const fe_node *node, fe_report *report);
double fe_trial_held(const fe_trial *trial, size_t param); /* NaN: it is no number */

/* The service with these values, in SI; NaN: what it is held at, its preset, or none. Lives until
   the next call. NULL after an error. */
const void *fe_trial_open(fe_trial *trial, const double *values, fe_report *report);
/* The reason that the law itself gave for refusing them; "" without. */
const char *fe_trial_why(const fe_trial *trial);

#endif
