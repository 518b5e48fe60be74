/* SPDX-License-Identifier: MIT */
/*
 * Host extension "flankfilm.estimates/1": whether anybody reads what a model estimates of its own
 * errors, in quality lines and in outputs named `X_error`. A run that only measures the error of
 * another run does not. A model whose estimates take time asks during evaluate and may leave them
 * out. All other numbers must be the same with and without them.
 */
#ifndef FLANKFILM_ESTIMATES_H
#define FLANKFILM_ESTIMATES_H

#include <flankfilm/plugin.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FF_ESTIMATES_ID "flankfilm.estimates/1"

/* The result of host->extension(ctx, FF_ESTIMATES_ID). */
typedef struct ff_estimates {
    size_t size;
    /* Non-zero if the estimates are read. For a wanted output `X_error`, `wanted` of the host holds
       as well. */
    int32_t (*read)(void *ctx);
} ff_estimates;

/* Non-zero also on a host without this extension. */
static inline int ff_estimates_are_read(const ff_host *host)
{
    const ff_estimates *estimates =
        (const ff_estimates *)host->extension(host->ctx, FF_ESTIMATES_ID);
    return !estimates || estimates->read(host->ctx);
}

#ifdef __cplusplus
}
#endif
#endif
