/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers between guard zones, which tell of a write outside. */
#ifndef FE_ZONED_H
#define FE_ZONED_H

#include <stdbool.h>
#include <stddef.h>

double *fe_zoned_new(size_t count, double fill); /* NULL: no memory */
bool fe_zoned_whole(const double *data, size_t count);
void fe_zoned_free(double *data); /* accepts NULL */

#endif
