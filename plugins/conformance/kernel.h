/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of a law as arrays in, arrays out, and the checks that any of them stands. Each
   plugin of a kind of law defines law_kernels and is linked with kernel-checks.c. */
#ifndef KERNEL_H
#define KERNEL_H

#include <flankfilm/conformance.h>

#include <stdbool.h>

enum { KERNEL_AXES = 3, KERNEL_RESULTS = 3, KERNEL_SPEEDS = 3 };

/* An argument. */
typedef struct axis_row {
    const char *name;
    double low, high; /* where a law is at home */
    bool logarithmic; /* also the scale of its differences */
    bool optional;    /* NULL is legal */
    const double *extremes;
    size_t extreme_count;
} axis_row;

typedef struct law_kernel {
    const char *service, *name;
    axis_row axes[KERNEL_AXES];
    size_t axis_count;
    const char *results[KERNEL_RESULTS]; /* the value, then its derivatives by axis `by` */
    size_t by[KERNEL_RESULTS];
    size_t result_count;
    double speeds[KERNEL_SPEEDS]; /* of the scalar argument */
    size_t speed_count;
    bool positive;      /* the value */
    bool rising;        /* the value, along axis 0 */
    bool follows_speed; /* the value has the sign of the scalar argument */
    ff_status (*call)(const void *table, size_t n, const double *const *in, double speed,
                      double *const *out);
} law_kernel;

extern const law_kernel law_kernels[];
extern const size_t law_kernel_count;

void law_empty(const ff_bench *bench);
void law_guards(const ff_bench *bench);
void law_batch(const ff_bench *bench);
void law_finite(const ff_bench *bench);
void law_derivatives(const ff_bench *bench);
void law_physics(const ff_bench *bench);
void law_purity(const ff_bench *bench);

/* Rows of a table of checks. */
#define LAW_CHECKS                                                                                 \
    {"empty", "a batch of no points is legal", law_empty},                                         \
        {"guards", "writes its results and nothing else", law_guards},                             \
        {"batch", "a batch gives what single calls give", law_batch},                              \
        {"finite", "is finite for extreme arguments", law_finite},                                 \
        {"derivatives", "derivatives agree with differences", law_derivatives},                    \
        {"physics", "has the sign and slope that physics asks for", law_physics},                  \
    {                                                                                              \
        "purity", "gives the same answers again, and in two threads", law_purity                   \
    }

/* Arguments that several laws have. */
#define EXTREMES(list) (list), sizeof(list) / sizeof *(list)
#define PRESSURE                                                                                   \
    {                                                                                              \
        "p", 1e5, 3e9, true, false, EXTREMES(any_pressure)                                         \
    }
#define TEMPERATURE                                                                                \
    {                                                                                              \
        "T", 280, 420, false, true, EXTREMES(any_temperature)                                      \
    }
#define LN_ETA                                                                                     \
    {                                                                                              \
        "ln_eta", -7, 20, false, false, EXTREMES(any_ln_eta)                                       \
    }
#define FILM                                                                                       \
    {                                                                                              \
        "h", 1e-8, 1e-4, true, false, EXTREMES(any_film)                                           \
    }

#endif
