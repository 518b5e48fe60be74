/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.comparison/1": what is said of laws that a fitter has fitted to data.
 *
 * A model of the kind "comparison" that offers it is no stage of a pipeline: `fit` uses
 * comparison/laws.
 */
#ifndef FLANKFILM_COMPARISON_H
#define FLANKFILM_COMPARISON_H

#include "fitter.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_COMPARISON_ID "flankfilm.comparison/1"

/* What was fitted; lives as long as the instance. */
typedef struct ff_comparison_request {
    size_t size;
    void *ctx; /* first argument of the functions below */
    const ff_fitter *fitter;
    const ff_fit *fit;
    const uint32_t *lines; /* of each row of the data in their file */
    int32_t named;         /* the user has named the laws: each of them must be fitted */

    /* A value, in SI, as a user would write it: "80 degC". */
    void (*quantity)(void *ctx, const ff_param *row, double si, char *out, size_t size);
    /* Sentences about laws that were not fitted; refuse returns FF_INVALID. */
    ff_status (*refuse)(void *ctx, const char *text);
    void (*warn)(void *ctx, const char *text);
    /* The members that the answer has as JSON. */
    void (*facts)(void *ctx, const char *json);
    /* One piece of text after another; or of a text that begins in a column and goes on in lines
       that are indented, each as wide as the terminal, and a line end. */
    void (*put)(void *ctx, const char *text);
    void (*wrap)(void *ctx, const char *text, int32_t column, int32_t indent);
} ff_comparison_request;

/* The functions are called in this order. */
typedef struct ff_comparison {
    size_t size;
    void *self;
    /* For what the fitter says of a law; it lives until the call is over. */
    void (*found)(void *self, const ff_comparison_request *request, const ff_fit_found *found);
    /* The facts, after all was said. FF_OK, or FF_INVALID after refuse. */
    ff_status (*judge)(void *self, const ff_comparison_request *request);
    /* For people. */
    ff_status (*print)(void *self, const ff_comparison_request *request);
} ff_comparison;

#ifdef __cplusplus
}
#endif
#endif
