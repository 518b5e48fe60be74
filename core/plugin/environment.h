/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a plugin must leave as it was: floating-point arithmetic, the locale, the process. */
#ifndef FF_ENVIRONMENT_H
#define FF_ENVIRONMENT_H

#include <fenv.h>
#include <limits.h>
#include <signal.h>
#include <stdbool.h>
#include <sys/types.h>

typedef struct ff_arithmetic {
    int rounding, traps;
    bool flushes;  /* subnormal results become zero */
    bool ignores;  /* subnormal operands count as zero */
    bool extended; /* long double has its full precision */
} ff_arithmetic;

typedef struct ff_environment {
    fenv_t floating;
    ff_arithmetic arithmetic;
    char locale[256]; /* "" when it was longer */
} ff_environment;

void ff_environment_keep(ff_environment *environment);

/* Sets back what differs and says what it was: a clause that completes 'the plugin ...'; NULL when
   all is as it was. */
const char *ff_environment_restore(const ff_environment *environment);

/* What of the process a plugin must leave alone beside these; dearer to look at. */
typedef struct ff_surroundings {
    struct sigaction signals[32];
    char folder[PATH_MAX];
    mode_t mask;
} ff_surroundings;

void ff_surroundings_keep(ff_surroundings *around);
const char *ff_surroundings_changed(const ff_surroundings *was); /* such a clause, or NULL */

#endif
