/* SPDX-License-Identifier: MIT */
/*
 * What an output needs: an extension of the host, for models that do not give an output without a
 * parameter or an input. The program then knows before anything runs: an output that somebody needs
 * is an error that names who; any other is left out, and what it feeds does without it. A program
 * without the extension is not told, so that evaluate refuses the output as well (FF_UNSUPPORTED).
 */
#ifndef FLANKFILM_NEEDS_H
#define FLANKFILM_NEEDS_H

#include <flankfilm/plugin.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FF_NEEDS_ID "flankfilm.needs/1"

/* What host->extension(ctx, FF_NEEDS_ID) gives. */
typedef struct ff_needs {
    size_t size;
    /* In ready. With these settings the outputs in the list "safety|own_safety" are not given
       without one of `items`, parameters, inputs or wires: "ehl.h_min|roughness". `text`: what is
       missing, "this output needs a film". */
    void (*tell)(void *ctx, const char *items, const char *outputs, const char *text);
} ff_needs;

/* A row of them; `holds` is a condition on the settings. */
typedef struct ff_need {
    int holds;
    const char *items, *outputs, *text;
} ff_need;

static inline void ff_tell_needs(const ff_host *host, const ff_need *rows, size_t count)
{
    const ff_needs *needs = (const ff_needs *)host->extension(host->ctx, FF_NEEDS_ID);
    for (size_t i = 0; needs && i < count; i++)
        if (rows[i].holds)
            needs->tell(host->ctx, rows[i].items, rows[i].outputs, rows[i].text);
}

#ifdef __cplusplus
}
#endif
#endif
