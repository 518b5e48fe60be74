/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "file.h"

#include <stdlib.h>
#include <string.h>

bool writer_nc_good(writer_nc_file *f, int code)
{
    if (code != NC_NOERR && f->status == FF_OK)
        f->status = ff_failf(f->host, code == NC_ENOMEM ? FF_NOMEM : FF_NOCONV, NULL,
                             "the file could not be written: %s", nc_strerror(code));
    return f->status == FF_OK;
}

void writer_nc_text(writer_nc_file *f, int variable, const char *name, const char *text)
{
    if (f->status == FF_OK && *text)
        writer_nc_good(f, nc_put_att_text(f->nc, variable, name, strlen(text), text));
}

void writer_nc_format(writer_nc_file *f, int variable, const char *name, const char *format, ...)
{
    char text[1000];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    writer_nc_text(f, variable, name, text);
}

int writer_nc_define_texts(writer_nc_file *f, const char *name, const int *dims, int rank,
                           size_t longest)
{
    char length[40];
    int all[NC_MAX_VAR_DIMS], id = -1;
    longest = longest ? longest : 1;
    snprintf(length, sizeof length, "string%zu", longest);
    memcpy(all, dims, (size_t)rank * sizeof *dims);
    if (f->status == FF_OK && nc_inq_dimid(f->nc, length, &all[rank]) != NC_NOERR)
        writer_nc_good(f, nc_def_dim(f->nc, length, longest, &all[rank]));
    if (f->status == FF_OK)
        writer_nc_good(f, nc_def_var(f->nc, name, NC_CHAR, rank + 1, all, &id));
    writer_nc_text(f, id, "_Encoding", "utf-8");
    return id;
}

int writer_nc_define_numbers(writer_nc_file *f, const char *name, nc_type type, const int *dims,
                             int rank)
{
    int id = -1;
    if (f->status == FF_OK)
        writer_nc_good(f, nc_def_var(f->nc, name, type, rank, dims, &id));
    return id;
}

void writer_nc_place(const writer_nc_file *f, size_t index, size_t rank, const size_t *shape,
                     writer_nc_slab *s)
{
    size_t study = f->view->dimension_count;
    for (size_t d = 0; d < study; d++) {
        s->start[d] = ff_view_point(f->view, index, d);
        s->count[d] = 1;
    }
    for (size_t i = 0; i < rank; i++) {
        s->start[study + i] = 0;
        s->count[study + i] = shape[i];
    }
}
