/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Programs in the same folder as flankfilm. */
#ifndef CLI_BESIDE_H
#define CLI_BESIDE_H

#include <flankfilm/engine.h>

#include <stdbool.h>

/* Runs the program of that name with two arguments and waits for its end. False if it is not
 * there or failed; its stderr is then the error. */
bool cli_beside(const char *name, const char *first, const char *second, ff_report *report);

#endif
