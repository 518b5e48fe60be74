/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Files of format 1, where the oil stood under each law, rewritten as format 2, where it is a stage
 * of its own. Comments within a stage that changes are lost; what cannot be rewritten stays as it
 * is, with a remark.
 */
#ifndef REWRITE_H
#define REWRITE_H

#include <flankfilm/engine.h>

#include <stdbool.h>

/* When the file, or one that it includes, is of format 1: reports one error, whose hint is these
   files rewritten, and how assignments of the command line are written now. False: it is not. */
bool rewrite_old_format(const char *path, const char *const *sets, size_t set_count,
                        ff_report *report);

#endif
