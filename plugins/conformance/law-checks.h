/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks that apply to the functions of any law, which take and return arrays. Each conformance
   plugin of a law kind defines conformance_functions and is linked with law-checks.c. */
#ifndef LAW_CHECKS_H
#define LAW_CHECKS_H

#include <flankfilm/conformance.h>

#include <stdbool.h>

enum { CONFORMANCE_AXES = 4, CONFORMANCE_RESULTS = 4, CONFORMANCE_SPEEDS = 3 };

/* An argument. */
typedef struct conformance_axis {
    const char *name;
    double low, high; /* range in which a law is meant to be used */
    bool logarithmic; /* logarithmic axis; also affects the steps of differences */
    double scale;     /* step of differences on a linear axis; 0: 10 of its unit */
    bool optional;    /* may be NULL */
    const double *extremes;
    size_t extreme_count;
} conformance_axis;

typedef struct conformance_function {
    const char *service, *name;
    size_t size; /* size of the service's table, bytes */
    const conformance_axis *axes[CONFORMANCE_AXES];
    size_t axis_count;
    const char *results[CONFORMANCE_RESULTS]; /* the value, then its derivatives along the axes
                                                 `by` */
    size_t by[CONFORMANCE_RESULTS];
    size_t result_count;
    double speeds[CONFORMANCE_SPEEDS]; /* values of the scalar argument */
    size_t speed_count;
    bool positive;      /* the value must be positive */
    bool rising;        /* the value must not decrease along axis 0 */
    bool follows_speed; /* the value must have the sign of the scalar argument */
    ff_status (*call)(const void *table, size_t n, const double *const *in, double speed,
                      double *const *out);
} conformance_function;

extern const conformance_function conformance_functions[];
extern const size_t conformance_function_count;

void conformance_check_empty(const ff_fixture *fixture);
void conformance_check_guards(const ff_fixture *fixture);
void conformance_check_batch(const ff_fixture *fixture);
void conformance_check_finite(const ff_fixture *fixture);
void conformance_check_derivatives(const ff_fixture *fixture);
void conformance_check_continuity(const ff_fixture *fixture);
void conformance_check_physics(const ff_fixture *fixture);
void conformance_check_purity(const ff_fixture *fixture);

/* The rows of these checks in a conformance table. */
#define CONFORMANCE_LAW_CHECKS                                                                     \
    {"empty", "a batch of no points is legal", conformance_check_empty},                           \
        {"guards", "writes its results and nothing else", conformance_check_guards},               \
        {"batch", "a batch gives the same as single calls", conformance_check_batch},              \
        {"finite", "is finite for extreme arguments", conformance_check_finite},                   \
        {"derivatives", "derivatives agree with finite differences",                               \
         conformance_check_derivatives},                                                           \
        {"continuity", "has no jumps", conformance_check_continuity},                              \
        {"physics", "has the sign and slope required by physics", conformance_check_physics},      \
    {                                                                                              \
        "purity", "gives the same results again, and in two threads", conformance_check_purity     \
    }

/* law-common.c defines the arguments that several laws share, and an `eval` whose value is the
   constant to which `self` points. */
extern const conformance_axis conformance_pressure, conformance_temperature, conformance_ln_eta,
    conformance_film, conformance_stress;

ff_status conformance_constant_law(const void *self, size_t n, const double *p, const double *T,
                                   double *value, double *by_p, double *by_T);

#endif
