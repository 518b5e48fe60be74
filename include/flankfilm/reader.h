/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.reader/1": what a run or a study has left in its directory, as writers see it.
 *
 * A model of the kind "reader" that offers it is no stage of a pipeline: `export` and `report` use
 * reader/results.
 */
#ifndef FLANKFILM_READER_H
#define FLANKFILM_READER_H

#include "writer.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_READER_ID "flankfilm.reader/1"

/* What is to be read; lives until the view is closed. */
typedef struct ff_reader_source {
    size_t size;
    void *ctx;
    const char *directory;
    /* Says why it cannot be read, and what to do about it (or NULL); returns FF_INVALID. */
    ff_status (*refuse)(void *ctx, const char *hint, const char *text);
} ff_reader_source;

typedef struct ff_reader {
    size_t size;
    void *self;
    /* FF_OK, or FF_INVALID after refuse. The functions of the view refuse, too. */
    ff_status (*open)(void *self, const ff_reader_source *source, const ff_view **view);
    void (*close)(void *self, const ff_view *view);
} ff_reader;

#ifdef __cplusplus
}
#endif
#endif
