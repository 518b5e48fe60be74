/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run or a study has left in its directory, as writers see it. */
#include "results.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool results_refuse(const results_reader *results, const char *hint, const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    results->source->refuse(results->source->ctx, hint, text);
    return false;
}

const void *results_keep(results_reader *results, results_rows *rows)
{
    size_t size = rows->count * sizeof *rows->rows;
    void *kept = results_arena_alloc(&results->arena, size);
    if (size)
        memcpy(kept, rows->rows, size);
    free(rows->rows);
    *rows = (results_rows){.rows = NULL};
    return kept;
}

static const json_t *entry_of(const results_reader *results, size_t variable, size_t index)
{
    const ff_view *view = &results->view;
    if (variable >= view->variable_count || index >= view->case_count)
        return NULL;
    return json_object_get(results->own[index].outputs, view->variables[variable]->name);
}

static int32_t shape_of(void *ctx, size_t variable, size_t index, size_t shape[4])
{
    const json_t *entry = entry_of(ctx, variable, index),
                 *lengths = json_object_get(entry, "shape");
    size_t rank = json_array_size(lengths);
    for (size_t i = 0; i < rank && i < 4; i++)
        shape[i] = (size_t)json_integer_value(json_array_get(lengths, i));
    return !entry || rank > 4 ? -1 : (int32_t)rank;
}

/* The document with the arrays of a case; NULL with an error. */
static const results_document *arrays_of(results_reader *results, size_t index)
{
    if (!results->view.study)
        return &results->run;
    if (results->opened == index)
        return &results->of_case;
    char *name = results_print_text("cases/%s/arrays.json", results->own[index].key);
    results_document_close(&results->of_case);
    errno = 0;
    bool good = results_document_open(&results->of_case, results->directory, name);
    results->opened = good ? index : results->view.case_count;
    if (!good)
        results_refuse(results, "flankfilm run with --rerun all writes it anew",
                       "%s/%s cannot be read%s%s", results->path, name, errno ? ": " : "",
                       errno ? strerror(errno) : "");
    free(name);
    return good ? &results->of_case : NULL;
}

typedef struct loaded {
    size_t shape[4];
    double data[];
} loaded;

/* The numbers of an array, or NULL with an error. A list of so many takes at least as many bytes.
 */
static loaded *read_array(results_reader *results, size_t index, const char *name,
                          const json_t *entry, double count)
{
    const results_document *document = arrays_of(results, index);
    if (!document)
        return NULL;
    const json_t *outputs = json_object_get(document->root, "outputs");
    const json_t *data =
        json_object_get(results->view.study ? json_object_get(outputs, name) : entry, "data");
    bool fits = count <= (double)document->length;
    loaded *made = results_alloc(sizeof *made + (fits ? (size_t)count : 0) * sizeof made->data[0]);
    if (fits && results_document_numbers(document, data, (size_t)count, made->data))
        return made;
    results_refuse(results, NULL, "the numbers of %s in %s cannot be read", name, results->path);
    free(made);
    return NULL;
}

static loaded *read_scalar(const json_t *entry)
{
    const json_t *value = json_object_get(entry, "value");
    loaded *made = results_alloc(sizeof *made + sizeof made->data[0]);
    made->data[0] = json_is_number(value) ? json_number_value(value) : (double)NAN;
    return made;
}

static ff_status load(void *ctx, size_t variable, size_t index, ff_array *array)
{
    results_reader *results = ctx;
    const json_t *entry = entry_of(results, variable, index);
    size_t shape[4] = {0};
    int32_t rank = shape_of(results, variable, index, shape);
    double count = 1;
    *array = (ff_array){.data = NULL};
    if (rank < 0)
        return FF_OK;
    for (int32_t i = 0; i < rank; i++)
        count *= (double)shape[i];
    const char *name = results->view.variables[variable]->name;
    loaded *made = rank ? read_array(results, index, name, entry, count) : read_scalar(entry);
    if (!made)
        return FF_NOCONV;
    memcpy(made->shape, shape, sizeof shape);
    *array = (ff_array){.data = made->data, .shape = made->shape, .rank = (uint32_t)rank};
    return FF_OK;
}

static void release(void *ctx, ff_array *array)
{
    (void)ctx;
    if (array->data)
        free((char *)(size_t)array->data - offsetof(loaded, data));
    *array = (ff_array){.data = NULL};
}

static int is_svg(const struct dirent *entry)
{
    size_t length = strlen(entry->d_name);
    return length > 4 && !strcmp(entry->d_name + length - 4, ".svg");
}

/* What cannot be read, or is no text of a sensible length, is left out. */
static void read_drawing(results_reader *results, const char *name)
{
    enum { MOST = 1 << 20 };
    int fd = openat(results->directory, name, O_RDONLY | O_CLOEXEC);
    char *text = results_alloc(MOST);
    ssize_t length = fd >= 0 ? read(fd, text, MOST) : -1;
    if (length > 0 && length < MOST && !memchr(text, 0, (size_t)length)) {
        ff_view_drawing *made = results_add(results, &results->drawings, sizeof *made);
        *made = (ff_view_drawing){
            .size = sizeof *made,
            .name = results_arena_text(&results->arena, name, strlen(name)),
            .svg = results_arena_text(&results->arena, text, (size_t)length),
        };
    }
    free(text);
    if (fd >= 0)
        close(fd);
}

static void read_drawings(results_reader *results)
{
    struct dirent **entries = NULL;
    int count = scandir(results->path, &entries, is_svg, alphasort);
    for (int i = 0; i < count; i++) {
        read_drawing(results, entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
}

static void finish_view(results_reader *results)
{
    ff_view *view = &results->view;
    view->size = sizeof *view;
    view->ctx = results;
    view->shape = shape_of;
    view->load = load;
    view->release = release;
    view->fact_count = results->facts.count;
    view->facts = results_keep(results, &results->facts);
    view->citation_count = results->citations.count;
    view->citations = results_keep(results, &results->citations);
    view->stage_count = results->stages.count;
    view->stages = results_keep(results, &results->stages);
    view->axis_count = results->axes.count;
    view->axes = results_keep(results, &results->axes);
    view->variable_count = results->variables.count;
    view->variables = results_keep(results, &results->variables);
    view->case_count = results->cases.count;
    view->cases = results_keep(results, &results->cases);
    view->drawing_count = results->drawings.count;
    view->drawings = results_keep(results, &results->drawings);
    results->opened = view->case_count;
}

static bool read_directory(results_reader *results)
{
    const char *path = results->path;
    results->directory = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (results->directory < 0)
        return results_refuse(results, "name the directory that a run has written",
                              "\"%s\" cannot be opened: %s", path, strerror(errno));
    if (faccessat(results->directory, results_study_marker, F_OK, 0) == 0) {
        read_drawings(results);
        return results_read_study(results);
    }
    if (faccessat(results->directory, "result.json", F_OK, 0) == 0)
        return results_read_run(results);
    return results_refuse(results, "name the directory that a run has written",
                          "\"%s\" holds no results of flankfilm", path);
}

static void close_results(void *self, const ff_view *view)
{
    (void)self;
    results_reader *results = view->ctx;
    for (size_t i = 0; results->own && i < view->case_count; i++)
        json_decref(results->own[i].outputs);
    free(results->own);
    results_document_close(&results->run);
    results_document_close(&results->of_case);
    json_decref(results->index);
    if (results->directory >= 0)
        close(results->directory);
    results_arena_free(&results->arena);
    free(results);
}

static ff_status open_results(void *self, const ff_reader_source *source, const ff_view **view)
{
    results_reader *results = results_alloc(sizeof *results);
    results->source = source;
    results->path = source->directory;
    results->directory = -1;
    results->index = json_object();
    results->view.title = "";
    bool good = read_directory(results);
    finish_view(results);
    *view = good ? &results->view : NULL;
    if (!good)
        close_results(self, &results->view);
    return good ? FF_OK : FF_INVALID;
}

static ff_status create(const ff_host *host, void **self)
{
    (void)host;
    *self = NULL;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    static const ff_reader reader = {
        .size = sizeof reader, .open = open_results, .close = close_results};
    (void)self, (void)output;
    return &reader;
}

static const ff_port outputs[] = {{.name = "reader",
                                   .unit = "",
                                   .doc = "reads what a run or a study has left",
                                   .dims = "",
                                   .service = FF_READER_ID}};

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 1,
    .id = "reader/results",
    .version = "1.0.0",
    .summary = "reads the directory that a run or a study has written, for export and report",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_NO_TABLE,
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(outputs),
    .create = create,
    .service = service,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
