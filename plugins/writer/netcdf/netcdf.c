/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * One NetCDF-4 file of the classic data model, by the CF conventions 1.10: the dimensions of a
 * study come first, each named by what is varied along it; a stage's own dimensions are called
 * <stage>.<dimension>. A number that a case does not have is _FillValue. Where the length of a
 * dimension differs between cases, arrays are padded with _FillValue, and
 * <stage>.<dimension>.length has the lengths.
 */
#include "define.h"
#include "file.h"
#include "origin.h"
#include "references.h"
#include "status.h"

#include <H5public.h>
#include <stdlib.h>
#include <string.h>

static void define(writer_nc_file *f)
{
    writer_nc_define_study(f);
    writer_nc_define_axes(f);
    writer_nc_define_dimensions(f);
    writer_nc_define_status(f);
    for (size_t v = 0; v < f->view->variable_count && f->status == FF_OK; v++)
        writer_nc_define_variable(f, v);
    writer_nc_define_quality(f);
    writer_nc_define_globals(f);
    if (f->status == FF_OK)
        writer_nc_good(f, nc_enddef(f->nc));
}

static void write_axes(writer_nc_file *f)
{
    const ff_view *view = f->view;
    for (size_t a = 0; a < view->axis_count && f->status == FF_OK; a++) {
        const ff_view_axis *axis = view->axes[a];
        if (axis->values)
            writer_nc_good(f, nc_put_var_double(f->nc, f->axes[a], axis->values));
        for (size_t i = 0; !axis->values && i < view->lengths[axis->dimension]; i++) {
            size_t start[2] = {i, 0}, count[2] = {1, strlen(axis->words[i])};
            if (count[1])
                writer_nc_good(f,
                               nc_put_vara_text(f->nc, f->axes[a], start, count, axis->words[i]));
        }
    }
}

static void write_lengths(writer_nc_file *f, size_t v, const size_t *shape,
                          const writer_nc_slab *at)
{
    for (uint32_t i = 0; i < f->view->variables[v]->rank; i++) {
        const writer_nc_dim *d = writer_nc_dimension(f, f->view->variables[v], i);
        const int length = (int)shape[i];
        if (d->lengths >= 0)
            writer_nc_good(f, nc_put_vara_int(f->nc, d->lengths, at->start, at->count, &length));
    }
}

static void write_case(writer_nc_file *f, size_t index)
{
    const ff_view *view = f->view;
    writer_nc_slab at, s;
    writer_nc_place(f, index, 0, NULL, &at);
    writer_nc_write_status(f, index, &at);
    writer_nc_write_quality(f, index, &at);
    for (size_t v = 0; v < view->variable_count && f->status == FF_OK; v++) {
        size_t shape[4];
        ff_array array;
        if (!ff_view_full_shape(view, v, index, shape))
            continue;
        f->status = view->load(view->ctx, v, index, &array);
        if (f->status != FF_OK)
            return;
        writer_nc_place(f, index, view->variables[v]->rank, shape, &s);
        writer_nc_good(f, nc_put_vara_double(f->nc, f->variables[v], s.start, s.count, array.data));
        write_lengths(f, v, shape, &at);
        view->release(view->ctx, &array);
    }
}

static bool prepare(writer_nc_file *f)
{
    const ff_view *view = f->view;
    f->axes = calloc(view->axis_count + 1, sizeof *f->axes);
    f->variables = calloc(view->variable_count + 1, sizeof *f->variables);
    f->dimensions = calloc(4 * view->variable_count + 1, sizeof *f->dimensions);
    if (!f->axes || !f->variables || !f->dimensions || !writer_nc_find_lines(f))
        return false;
    writer_nc_find_states(f);
    writer_nc_measure(f);
    writer_nc_share_dimensions(f);
    return true;
}

typedef struct writer {
    const ff_host *host;
    ff_writer table;
} writer;

static ff_status write_file(void *self, const ff_view *view, const ff_target *target)
{
    const ff_host *host = ((const writer *)self)->host;
    writer_nc_file f = {.view = view, .host = host, .nc = -1};
    const char *path = target->path(target->ctx, NULL);
    if (!path || !prepare(&f))
        f.status = path ? FF_NOMEM : FF_NOCONV;
    else if (writer_nc_good(&f, nc_create(path, NC_NETCDF4 | NC_CLASSIC_MODEL | NC_CLOBBER, &f.nc)))
        define(&f);
    if (f.status == FF_OK)
        write_axes(&f);
    for (size_t c = 0; c < view->case_count && f.status == FF_OK; c++) {
        write_case(&f, c);
        if (f.status == FF_OK &&
            host->progress(host->ctx, (double)(c + 1) / (double)view->case_count))
            f.status = FF_STOPPED;
    }
    if (f.nc >= 0)
        writer_nc_good(&f, nc_close(f.nc));
    free(f.axes);
    free(f.variables);
    free(f.dimensions);
    free(f.lines);
    free(f.quality);
    free(f.verdicts);
    return f.status;
}

/* At the end of the program HDF5 would try again to write what a full disk refused, and crash. */
static ff_status create(const ff_host *host, void **self)
{
    writer *made = calloc(1, sizeof *made);
    *self = made;
    if (!made)
        return FF_NOMEM;
    H5dont_atexit();
    made->host = host;
    made->table =
        (ff_writer){.size = sizeof made->table, .self = made, .suffix = ".nc", .write = write_file};
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    (void)output;
    return &((const writer *)self)->table;
}

static const ff_port outputs[] = {{.name = "writer",
                                   .unit = "",
                                   .doc = "makes files of the results of a run or a study",
                                   .dims = "",
                                   .service = FF_WRITER_ID}};

const ff_model writer_netcdf = {
    FF_HEAD(writer, create),
    .id = "writer/netcdf",
    .version = "1.0.0",
    .summary = "results as one NetCDF-4 file with the attributes of the CF conventions",
    .reference = "Rew, Davis 1990, IEEE Comput. Graph. Appl. 10, 76-82",
    .bibtex = BIB_RewDavis1990,
    .licence = "GPL-3.0-or-later",
    .flags = FF_SERIAL, /* the library keeps its open files in global tables */
    .outputs = FF_TABLE(outputs),
    .service = service,
    .destroy = free,
};
FF_EXPORT_MODELS(&writer_netcdf);
