/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the writers: parts of a view. */
#ifndef WRITER_PICK_H
#define WRITER_PICK_H

#include <flankfilm/author.h>
#include <flankfilm/writer.h>

#include <stdbool.h>

/* The point of the study's dimension at which a case stands. */
size_t writer_point_of(const ff_view *view, size_t index, size_t dimension);

/* The two run along the same dimensions of one stage. */
bool writer_same_dims(const ff_view_variable *a, const ff_view_variable *b);
/* Variable `series` is what dimension `dim` of the other is plotted against: as the core says, or a
   series along it that is named like it, or is a time or an angle. */
bool writer_is_coordinate(const ff_view_variable *series, const ff_view_variable *other,
                          uint32_t dim);

/* Lengths of a variable in a case with all its dimensions: one that may be absent has length 1.
   False when the case lacks the variable. */
bool writer_full_shape(const ff_view *view, size_t variable, size_t index, size_t shape[4]);

/* The shortest decimal number that reads back as the same value; "nan" for what is none. */
enum { WRITER_EXACT_SIZE = 32 };
void writer_print_exact(double value, char out[WRITER_EXACT_SIZE]);

const char *writer_verdict_word(int32_t verdict);

/* A writer's object and the parts of a model that writers share. */
typedef struct writer_self {
    const ff_host *host;
    ff_writer table;
} writer_self;

extern const ff_port writer_outputs[1];
ff_status writer_create(const ff_host *host, const ff_writer *table, void **self);
const void *writer_service(void *self, uint32_t output);
void writer_destroy(void *self);

#endif
