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
    const double *data; /* NULL: there is none */
    size_t count;
} conformance_array;

/* Opens an instance and evaluates the named outputs. False, after a report, if there is nothing
 * to check. */
bool conformance_evaluate(conformance_evaluation *e, const ff_fixture *fixture, const char *wanted);
void conformance_close(conformance_evaluation *e);

conformance_array conformance_array_of(const conformance_evaluation *e, const char *name);
double conformance_scalar_of(const conformance_evaluation *e,
                             const char *name); /* NaN: there is none */

bool conformance_offers(const ff_fixture *fixture, const char *output);
/* every one is there */
bool conformance_has_all(const conformance_evaluation *e, const char *names);

/* Checks |value - expected| <= tolerance * scale, and reports a fault that names what and where.
 * NaN stands for an output that the model does not offer, which is no fault; another test checks
 * that outputs are numbers. */
bool conformance_near(const conformance_evaluation *e, const char *what, size_t at, double value,
                      double expected, double scale, double tolerance);

/* Returns y at x, linear between the points of a rising series; 0 outside of it. */
double conformance_at(conformance_array x, conformance_array y, double at);

void conformance_give_scalar(const ff_fixture *fixture, const char *input, double value);
void conformance_give_series(const ff_fixture *fixture, const char *input, size_t count,
                             const double *data);

#endif
