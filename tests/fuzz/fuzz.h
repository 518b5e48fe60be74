/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the fuzz targets share. Each is a program of libFuzzer (fuzz.sh), or reads the inputs it is
   given one by one (replay.c). */
#ifndef FUZZ_H
#define FUZZ_H

#include <flankfilm/engine.h>

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void must(int holds)
{
    if (!holds)
        abort();
}

/* The bytes with a NUL behind them, to be freed. */
static inline char *fuzz_text(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    must(text != NULL);
    if (size)
        memcpy(text, data, size);
    text[size] = 0;
    return text;
}

/* Printing walks the places of all messages. */
static inline void fuzz_print(const ff_report *report)
{
    ff_free(ff_report_text(report, false));
}

#endif
