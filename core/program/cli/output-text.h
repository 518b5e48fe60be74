/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints an output of a run in words. */
#ifndef CLI_OUTPUT_TEXT_H
#define CLI_OUTPUT_TEXT_H

#include "../accuracy/accuracy.h"

typedef struct cli_output_text {
    char value[96];  /* the value or its range, with the measured error if there is one */
    char place[256]; /* the shape of a field, or where the extremes of a series lie, or "" */
} cli_output_text;

cli_output_text cli_output_text_of(const accuracy_record *errors, const ff_pipeline *pipeline,
                                   const ff_stage *stage, size_t output, bool briefly);

#endif
