/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters in words. */
#ifndef FF_BOUND_H
#define FF_BOUND_H

#include "../pipeline/pipeline.h"

/* Where the value comes from: "pair.yaml:12", "--set", "preset". */
void ff_origin(const ff_bound *bound, char *out, size_t size);

/* The value as a user would write it: "[50, 50]", "3 mm", "auto"; false when there is none. */
bool ff_bound_print(const ff_stage *stage, size_t param, char *out, size_t size);

/* What may be written, "2 numbers in mm"; the limits, "above 0 to 10; calibrated from 1 to 5". */
void ff_param_type_print(const ff_param *row, char *out, size_t size);
void ff_param_limits_print(const ff_param *row, char *out, size_t size); /* "" without any */
const char *ff_param_type_name(const ff_param *row);

#endif
