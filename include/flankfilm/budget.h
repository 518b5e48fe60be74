/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.budget/1": how a file is to be run so that it takes no more than a time, from
 * what was measured before.
 *
 * A model of the kind "budget" that offers it is no stage of a pipeline: `run --budget TIME` uses
 * budget/tradeoff.
 */
#ifndef FLANKFILM_BUDGET_H
#define FLANKFILM_BUDGET_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_BUDGET_ID "flankfilm.budget/1"

/* What is asked for; valid until `choose` returns. */
typedef struct ff_budget_request {
    size_t size;
    void *ctx;                      /* first argument of the functions below */
    double seconds;                 /* that the run may take */
    const char *const *directories; /* of what was measured, each in another scene */
    size_t directory_count;         /* at least 1 */

    /* Says why there is no answer, and what to do about it (or NULL); returns FF_INVALID. */
    ff_status (*refuse)(void *ctx, const char *hint, const char *text);
    /* What the run assigns: "film.cells=64". */
    void (*assign)(void *ctx, const char *assignment);
    /* What is to be expected of it: for people, lines and all; and as a JSON object, which becomes
       the member "budget" of the result. */
    void (*say)(void *ctx, const char *text);
    void (*promise)(void *ctx, const char *json);
} ff_budget_request;

typedef struct ff_budget {
    size_t size;
    void *self;
    /* FF_OK, or a status after refuse or host->fail. */
    ff_status (*choose)(void *self, const ff_budget_request *request);
} ff_budget;

#ifdef __cplusplus
}
#endif
#endif
