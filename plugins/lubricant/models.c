/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists the oils of this shared object. */
#include <flankfilm/author.h>

extern const ff_model lubricant_grade, lubricant_measured;

FF_EXPORT_MODELS(&lubricant_grade, &lubricant_measured);
