/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One evaluation of a stage, and its arrays by name. */
#ifndef LOOK_H
#define LOOK_H

#include <flankfilm/conformance.h>

#include <stdbool.h>

typedef struct look {
    const ff_bench *bench;
    void *instance;
} look;

typedef struct series {
    const double *data; /* NULL: there is none */
    size_t count;
} series;

/* Opens an instance and evaluates the outputs named. False when there is nothing to look at, which
   has been said. */
bool look_open(look *l, const ff_bench *bench, const char *wanted);
void look_close(look *l);

series look_at(const look *l, const char *name);
double look_scalar(const look *l, const char *name); /* NaN: there is none */

bool look_offers(const ff_bench *bench, const char *output);
bool look_all(const look *l, const char *names); /* each is there */

/* |value - expected| <= tolerance * scale, or a fault that names what and where it is. NaN stands
   for what the model does not offer, which is no fault; that outputs are numbers is tested before.
 */
bool look_near(const look *l, const char *what, size_t at, double value, double expected,
               double scale, double tolerance);

void give_scalar(const ff_bench *bench, const char *input, double value);
void give_series(const ff_bench *bench, const char *input, size_t count, const double *data);

#endif
