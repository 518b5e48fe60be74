/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a plugin must leave as it was: floating-point arithmetic and the locale. */
#ifndef FE_ENVIRONMENT_H
#define FE_ENVIRONMENT_H

#include <fenv.h>
#include <stdbool.h>

typedef struct fe_arithmetic {
    int rounding, traps;
    bool flushes;  /* subnormal results become zero */
    bool ignores;  /* subnormal operands count as zero */
    bool extended; /* long double has its full precision */
} fe_arithmetic;

typedef struct fe_environment {
    fenv_t floating;
    fe_arithmetic arithmetic;
    char locale[256]; /* "" when it was longer */
} fe_environment;

void fe_environment_keep(fe_environment *environment);

/* Sets back what differs and says what it was: a clause that completes 'the plugin ...'; NULL when
   all is as it was. */
const char *fe_environment_restore(const fe_environment *environment);

#endif
