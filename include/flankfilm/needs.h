/* SPDX-License-Identifier: MIT */
/*
 * Host extension "flankfilm.needs/1": outputs that a model cannot give without a certain parameter
 * or input. With it, the program detects missing values before the run. If such an output is
 * required, the program reports an error that names the user of the output. Otherwise it skips the
 * output, and the stages that use it run without it. Some hosts do not have this extension, so
 * evaluate must also refuse the output (FF_UNSUPPORTED).
 */
#ifndef FLANKFILM_NEEDS_H
#define FLANKFILM_NEEDS_H

#include <flankfilm/plugin.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FF_NEEDS_ID "flankfilm.needs/1"

/* The result of host->extension(ctx, FF_NEEDS_ID). */
typedef struct ff_needs {
    size_t size;
    /* Call it in ready. With these settings the model cannot give the outputs in the list
       "safety|own_safety" without one of `items`, which lists parameters, inputs or wires:
       "ehl.h_min|roughness". `text` says what is missing: "this output needs a film". */
    void (*tell)(void *ctx, const char *items, const char *outputs, const char *text);
} ff_needs;

/* The arguments of one call of `tell`; it is made if `holds`, a condition on the settings. */
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
