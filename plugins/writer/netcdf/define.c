/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "define.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Arrays of fewer numbers are not worth a compression. */
enum { SMALL = 1 << 13 };

static const char *last_word(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot ? dot + 1 : path;
}

/* The last word of the path where no other axis has the same, else the path. */
static const char *axis_name(const ff_view *view, size_t a)
{
    static const char *const taken[] = {"use",     "status", "seconds", "reason",
                                        "command", "point",  "verdict", "reasons"};
    const char *path = view->axes[a]->path, *word = last_word(path);
    bool clear = *word && !strchr("0123456789", *word);
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++)
        clear = clear && strcmp(word, taken[i]) != 0;
    for (size_t i = 0; i < view->axis_count; i++)
        clear = clear && (i == a || strcmp(word, last_word(view->axes[i]->path)) != 0);
    return clear ? word : path;
}

/* The only axis along a dimension of the study, or -1 where several share it. */
static int axis_along(const ff_view *view, size_t d)
{
    int found = -1;
    for (size_t a = 0; a < view->axis_count; a++)
        if (view->axes[a]->dimension == d) {
            if (found >= 0)
                return -1;
            found = (int)a;
        }
    return found;
}

void writer_nc_define_study(writer_nc_file *f)
{
    const ff_view *view = f->view;
    if (view->dimension_count + 5 > NC_MAX_VAR_DIMS && f->status == FF_OK)
        f->status = ff_failf(f->host, FF_UNSUPPORTED, NULL, "the study has too many dimensions");
    for (size_t d = 0; d < view->dimension_count && f->status == FF_OK; d++) {
        char name[40];
        int axis = axis_along(view, d);
        snprintf(name, sizeof name, d ? "point_%zu" : "point", d + 1);
        writer_nc_good(f, nc_def_dim(f->nc, axis < 0 ? name : axis_name(view, (size_t)axis),
                                     view->lengths[d], &f->study[d]));
    }
}

void writer_nc_define_axes(writer_nc_file *f)
{
    const ff_view *view = f->view;
    for (size_t a = 0; a < view->axis_count && f->status == FF_OK; a++) {
        const ff_view_axis *axis = view->axes[a];
        const char *name = axis_name(view, a);
        const int *dim = &f->study[axis->dimension];
        size_t longest = 0;
        for (size_t i = 0; i < view->lengths[axis->dimension]; i++) {
            size_t length = strlen(axis->words[i]);
            longest = length > longest ? length : longest;
        }
        f->axes[a] = axis->values ? writer_nc_define_numbers(f, name, NC_DOUBLE, dim, 1)
                                  : writer_nc_define_texts(f, name, dim, 1, longest);
        writer_nc_text(f, f->axes[a], "long_name", axis->path);
        writer_nc_text(f, f->axes[a], "units", axis->values ? axis->unit : "");
    }
}

writer_nc_dim *writer_nc_dimension(const writer_nc_file *f, const ff_view_variable *variable,
                                   uint32_t which)
{
    for (size_t i = 0; i < f->dimension_count; i++) {
        writer_nc_dim *d = &f->dimensions[i];
        if (d->variable->stage == variable->stage &&
            !strcmp(d->variable->dims[d->which], variable->dims[which]))
            return d;
    }
    return NULL;
}

/* The length of each dimension: the largest of all cases. */
void writer_nc_measure(writer_nc_file *f)
{
    const ff_view *view = f->view;
    for (size_t v = 0; v < view->variable_count; v++)
        for (size_t c = 0; c < view->case_count; c++) {
            size_t shape[4];
            if (!ff_view_full_shape(view, v, c, shape))
                continue;
            for (uint32_t i = 0; i < view->variables[v]->rank; i++) {
                writer_nc_dim *d = writer_nc_dimension(f, view->variables[v], i);
                if (!d) {
                    d = &f->dimensions[f->dimension_count++];
                    *d = (writer_nc_dim){.variable = view->variables[v],
                                         .which = i,
                                         .length = shape[i],
                                         .shortest = shape[i],
                                         .lengths = -1};
                }
                d->length = shape[i] > d->length ? shape[i] : d->length;
                d->shortest = shape[i] < d->shortest ? shape[i] : d->shortest;
            }
        }
}

/* A variable over the study must not have the name of its own dimension: readers would take it for
   the coordinate. */
static bool is_taken(const ff_view *view, const char *name)
{
    for (size_t v = 0; v < view->variable_count; v++)
        if (!strcmp(view->variables[v]->name, name) &&
            view->variables[v]->rank + view->dimension_count > 1)
            return true;
    return false;
}

/* Outputs that are plotted against a series of the stage that feeds them run along its dimension.
 */
void writer_nc_share_dimensions(writer_nc_file *f)
{
    const ff_view *view = f->view;
    for (size_t v = 0; v < view->variable_count; v++)
        for (uint32_t d = 0; d < view->variables[v]->rank; d++)
            for (size_t k = 0; k < view->variable_count; k++) {
                const ff_view_variable *series = view->variables[k];
                if (series->rank != 1 || strcmp(series->name, view->variables[v]->against[d]) != 0)
                    continue;
                writer_nc_dim *own = writer_nc_dimension(f, view->variables[v], d),
                              *other = writer_nc_dimension(f, series, 0);
                if (own && other && own != other && own->length == other->length &&
                    own->length == own->shortest && other->length == other->shortest)
                    own->same = other;
            }
}

void writer_nc_define_dimensions(writer_nc_file *f)
{
    const ff_view *view = f->view;
    for (size_t i = 0; i < f->dimension_count && f->status == FF_OK; i++) {
        writer_nc_dim *d = &f->dimensions[i];
        char name[WRITER_NC_LONGEST], lengths[WRITER_NC_LONGEST];
        if (d->same)
            continue;
        snprintf(name, sizeof name, "%s.%s", view->stages[d->variable->stage]->name,
                 d->variable->dims[d->which]);
        if (is_taken(view, name))
            strncat(name, ".index", sizeof name - strlen(name) - 1);
        writer_nc_good(f, nc_def_dim(f->nc, name, d->length ? d->length : 1, &d->id));
        if (d->shortest == d->length)
            continue;
        snprintf(lengths, sizeof lengths, "%.200s.length", name);
        d->lengths =
            writer_nc_define_numbers(f, lengths, NC_INT, f->study, (int)view->dimension_count);
        writer_nc_format(f, d->lengths, "long_name", "points along %s that a case has", name);
    }
    for (size_t i = 0; i < f->dimension_count; i++) {
        const writer_nc_dim *from = &f->dimensions[i];
        for (size_t steps = 0; from->same && steps < f->dimension_count; steps++)
            from = from->same;
        f->dimensions[i].id = from->id;
    }
}

/* Series k can be the coordinate of dimension d of variable v. */
static bool shares_dimension(const writer_nc_file *f, size_t k, size_t v, uint32_t d)
{
    const ff_view_variable *series = f->view->variables[k], *variable = f->view->variables[v];
    if (!ff_view_is_coordinate(series, variable, d))
        return false;
    const writer_nc_dim *own = writer_nc_dimension(f, variable, d),
                        *other = writer_nc_dimension(f, series, 0);
    return own && other && own->id == other->id;
}

/* Names what the variable can be plotted against, beside its own dimensions. */
static void define_coordinates(writer_nc_file *f, size_t v)
{
    const ff_view *view = f->view;
    char text[2000] = "";
    size_t length = 0;
    for (size_t a = 0; a < view->axis_count && length < sizeof text; a++)
        if (axis_along(view, view->axes[a]->dimension) < 0)
            length += (size_t)snprintf(text + length, sizeof text - length, "%s%s",
                                       length ? " " : "", axis_name(view, a));
    for (size_t k = 0; k < view->variable_count; k++)
        for (uint32_t d = 0; d < view->variables[v]->rank && length < sizeof text; d++)
            if (shares_dimension(f, k, v, d))
                length += (size_t)snprintf(text + length, sizeof text - length, "%s%s",
                                           length ? " " : "", view->variables[k]->name);
    if (length < sizeof text)
        writer_nc_text(f, f->variables[v], "coordinates", text);
}

/* One chunk for the array of each case: that is how they are written. */
static void compress(writer_nc_file *f, int id, size_t study, size_t rank, const size_t *lengths)
{
    size_t chunk[NC_MAX_VAR_DIMS], count = 1;
    for (size_t i = 0; i < study; i++)
        chunk[i] = 1;
    for (size_t i = 0; i < rank; i++) {
        chunk[study + i] = lengths[i] ? lengths[i] : 1;
        count *= chunk[study + i];
    }
    if (count < SMALL || count > (size_t)1 << 28)
        return;
    writer_nc_good(f, nc_def_var_chunking(f->nc, id, NC_CHUNKED, chunk));
    writer_nc_good(f, nc_def_var_deflate(f->nc, id, NC_SHUFFLE, 1, 1));
}

void writer_nc_define_variable(writer_nc_file *f, size_t v)
{
    const ff_view_variable *variable = f->view->variables[v];
    const double none = NAN;
    int dims[NC_MAX_VAR_DIMS], study = (int)f->view->dimension_count;
    size_t lengths[4] = {0};
    memcpy(dims, f->study, (size_t)study * sizeof *dims);
    for (uint32_t i = 0; i < variable->rank; i++) {
        const writer_nc_dim *d = writer_nc_dimension(f, variable, i);
        if (!d)
            return;
        dims[study + (int)i] = d->id;
        lengths[i] = d->length;
    }
    int id =
        writer_nc_define_numbers(f, variable->name, NC_DOUBLE, dims, study + (int)variable->rank);
    f->variables[v] = id;
    bool coordinate =
        study == 0 && variable->rank == 1 && !strcmp(variable->output, variable->dims[0]);
    if (f->status == FF_OK && !coordinate)
        writer_nc_good(f, nc_def_var_fill(f->nc, id, NC_FILL, &none));
    writer_nc_text(f, id, "units", variable->unit);
    writer_nc_text(f, id, "long_name", *variable->doc ? variable->doc : variable->name);
    define_coordinates(f, v);
    for (uint32_t i = 0; i < variable->rank; i++) {
        const writer_nc_dim *d = writer_nc_dimension(f, variable, i);
        char name[WRITER_NC_LONGEST + 1] = "";
        if (d->lengths >= 0 && nc_inq_varname(f->nc, d->lengths, name) == NC_NOERR)
            writer_nc_text(f, id, "ancillary_variables", name);
    }
    if (f->status == FF_OK && variable->rank > 0)
        compress(f, id, (size_t)study, variable->rank, lengths);
}
