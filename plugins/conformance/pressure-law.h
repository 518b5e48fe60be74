/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What laws of pressure and temperature share. */
#ifndef PRESSURE_LAW_H
#define PRESSURE_LAW_H

#include "kernel.h"

static const double any_pressure[] = {-1e30, -1e10, -1e6, 0, 1e6, 1e9, 1e10, 1e12, 1e30};
static const double any_temperature[] = {-1e30, 0, 1, 300, 1000, 1e30};

/* The `eval` of a table: the number that self points at, whose derivatives are 0. */
ff_status pressure_law_plain(const void *self, size_t n, const double *p, const double *T,
                             double *value, double *by_p, double *by_T);

#endif
