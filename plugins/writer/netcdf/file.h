/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of the writer netcdf. */
#ifndef FF_NETCDF_FILE_H
#define FF_NETCDF_FILE_H

#include "../pick.h"

#include <netcdf.h>

enum { FF_NC_LONGEST = NC_MAX_NAME, FF_NC_STATES = 16 };

/* A dimension of a stage's arrays. */
typedef struct ff_nc_dim {
    const ff_view_variable *variable; /* one that has it, and where */
    uint32_t which;
    size_t length, shortest;
    int id, lengths;              /* in the file; lengths: a variable, or -1 */
    const struct ff_nc_dim *same; /* of another stage, or NULL */
} ff_nc_dim;

typedef struct ff_nc_file {
    const ff_view *view;
    const ff_host *host;
    int nc;
    ff_status status;
    int study[NC_MAX_VAR_DIMS]; /* ids of the study's dimensions */
    int *axes;                  /* ids of the variables of the axes */
    ff_nc_dim *dimensions;
    size_t dimension_count;
    int *variables;
    int case_status, seconds, reason, command;
    const char *states[FF_NC_STATES];
    size_t state_count;
    int *quality, *verdicts; /* of each line of `lines` */
    const ff_view_quality **lines;
    size_t line_count;
} ff_nc_file;

/* True as long as all went well. */
bool ff_nc_good(ff_nc_file *f, int code);
void ff_nc_text(ff_nc_file *f, int variable, const char *name, const char *text);
void ff_nc_format(ff_nc_file *f, int variable, const char *name, const char *format, ...)
    FF_PRINTF(4, 5);

/* Where a case stands, followed by the whole of `shape`. */
typedef struct ff_nc_slab {
    size_t start[NC_MAX_VAR_DIMS], count[NC_MAX_VAR_DIMS];
} ff_nc_slab;

void ff_nc_place(const ff_nc_file *f, size_t index, size_t rank, const size_t *shape,
                 ff_nc_slab *s);

/* define.c: dimensions and variables. */
int ff_nc_define_texts(ff_nc_file *f, const char *name, const int *dims, int rank, size_t longest);
int ff_nc_define_numbers(ff_nc_file *f, const char *name, nc_type type, const int *dims, int rank);
ff_nc_dim *ff_nc_dimension(const ff_nc_file *f, const ff_view_variable *variable, uint32_t which);
void ff_nc_measure(ff_nc_file *f);
void ff_nc_share_dimensions(ff_nc_file *f);
void ff_nc_define_study(ff_nc_file *f);
void ff_nc_define_axes(ff_nc_file *f);
void ff_nc_define_dimensions(ff_nc_file *f);
void ff_nc_define_variable(ff_nc_file *f, size_t v);

/* status.c: how the cases ended, and how far their numbers can be trusted. */
void ff_nc_find_states(ff_nc_file *f);
bool ff_nc_find_lines(ff_nc_file *f);
void ff_nc_define_status(ff_nc_file *f);
void ff_nc_define_quality(ff_nc_file *f);
void ff_nc_write_status(ff_nc_file *f, size_t index, const ff_nc_slab *at);
void ff_nc_write_quality(ff_nc_file *f, size_t index, const ff_nc_slab *at);

/* origin.c: attributes of the whole file. */
void ff_nc_define_globals(ff_nc_file *f);

#endif
