/* SPDX-License-Identifier: MIT */
/* The floating-point modes and the locale, which a plugin must not change. */
#ifndef FE_ENVIRONMENT_H
#define FE_ENVIRONMENT_H

#include <flankfilm/engine.h>

#include <fenv.h>

typedef struct fe_arithmetic {
    int rounding, traps;
    bool flushes;  /* subnormal results become zero */
    bool ignores;  /* subnormal operands are treated as zero */
    bool extended; /* long double has its full precision */
} fe_arithmetic;

struct ff_environment {
    fenv_t floating;
    fe_arithmetic arithmetic;
    char locale[256]; /* "" if it was too long */
};

void fe_environment_keep(ff_environment *environment);

#endif
