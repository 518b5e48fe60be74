/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One evaluation of a stage, and its arrays by name. */
#ifndef EVALUATION_H
#define EVALUATION_H

#include <flankfilm/conformance.h>

#include <stdbool.h>

typedef struct conformance_evaluation {
    const ff_fixture *fixture;
    void *instance;
} conformance_evaluation;

typedef struct conformance_array {
    const double *data; /* NULL: not available */
    size_t count;
} conformance_array;

/* Opens an instance and evaluates the named outputs. If there is nothing to check, reports why and
   returns false. */
bool conformance_evaluate(conformance_evaluation *e, const ff_fixture *fixture, const char *wanted);
void conformance_close(conformance_evaluation *e);

conformance_array conformance_array_of(const conformance_evaluation *e, const char *name);
double conformance_scalar_of(const conformance_evaluation *e,
                             const char *name); /* NaN: not available */

bool conformance_offers(const ff_fixture *fixture, const char *output);
/* Returns whether all named outputs are available. */
bool conformance_has_all(const conformance_evaluation *e, const char *names);

/* Checks |value - expected| <= tolerance * scale, and reports a fault with the name `what` and the
   place `at`. NaN means an output that the model does not offer, which is no fault; another check
   covers non-finite outputs. */
bool conformance_near(const conformance_evaluation *e, const char *what, size_t at, double value,
                      double expected, double scale, double tolerance);

/* Returns y at x by linear interpolation in a rising series; 0 outside its range. */
double conformance_at(conformance_array x, conformance_array y, double at);

void conformance_give_scalar(const ff_fixture *fixture, const char *input, double value);
void conformance_give_series(const ff_fixture *fixture, const char *input, size_t count,
                             const double *data);

#endif
