/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file on its way, and its attributes and variables. */
#ifndef WRITER_NETCDF_FILE_H
#define WRITER_NETCDF_FILE_H

#include <flankfilm/writer.h>
#include <netcdf.h>
#include <stdbool.h>

enum { WRITER_NC_LONGEST = NC_MAX_NAME, WRITER_NC_STATES = 16 };

/* A dimension of a stage's arrays. */
typedef struct writer_nc_dim {
    const ff_view_variable *variable; /* one that has it, and where */
    uint32_t which;
    size_t length, shortest;
    int id, lengths;                  /* in the file; lengths: a variable, or -1 */
    const struct writer_nc_dim *same; /* of another stage, or NULL */
} writer_nc_dim;

typedef struct writer_nc_file {
    const ff_view *view;
    const ff_host *host;
    int nc;
    ff_status status;
    int study[NC_MAX_VAR_DIMS]; /* ids of the study's dimensions */
    int *axes;                  /* ids of the variables of the axes */
    writer_nc_dim *dimensions;
    size_t dimension_count;
    int *variables;
    int case_status, case_verdict, seconds, reasons, reason, command;
    const char *states[WRITER_NC_STATES];
    size_t state_count;
    int *quality, *verdicts; /* of each line of `lines` */
    const ff_view_quality **lines;
    size_t line_count;
} writer_nc_file;

/* Records the first error of the library; true as long as all went well. */
bool writer_nc_good(writer_nc_file *f, int code);
/* An attribute of a variable or of the file; nothing for an empty text. */
void writer_nc_text(writer_nc_file *f, int variable, const char *name, const char *text);
void writer_nc_format(writer_nc_file *f, int variable, const char *name, const char *format, ...)
    FF_PRINTF(4, 5);

/* The part of a variable that belongs to a case: a point of the study, and the whole of `shape`. */
typedef struct writer_nc_slab {
    size_t start[NC_MAX_VAR_DIMS], count[NC_MAX_VAR_DIMS];
} writer_nc_slab;

void writer_nc_place(const writer_nc_file *f, size_t index, size_t rank, const size_t *shape,
                     writer_nc_slab *s);

/* Defines a variable that holds a text for each point of these dimensions. */
int writer_nc_define_texts(writer_nc_file *f, const char *name, const int *dims, int rank,
                           size_t longest);
int writer_nc_define_numbers(writer_nc_file *f, const char *name, nc_type type, const int *dims,
                             int rank);

#endif
