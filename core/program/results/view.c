/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "view.h"
#include "npy.h"
#include "view-tables.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const json_t *entry_of(const results_reader *reader, size_t variable, size_t index)
{
    const ff_view *view = &reader->view;
    if (variable >= view->variable_count || index >= view->case_count)
        return NULL;
    return json_object_get(reader->per_case[index].outputs, view->variables[variable]->name);
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

/* Returns what is known of an array: where its numbers are. NULL after an error. */
static const json_t *array_of(results_reader *reader, size_t index, const char *variable)
{
    if (!reader->view.study)
        return json_object_get(reader->per_case[index].outputs, variable);
    if (reader->arrays_case != index) {
        char *name = memory_print_text("cases/%s/arrays.json", reader->per_case[index].key);
        json_decref(reader->arrays);
        reader->arrays = results_view_read_json(reader, name);
        reader->arrays_case = reader->arrays ? index : reader->view.case_count;
        if (!reader->arrays)
            ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE,
                     "flankfilm run with --rerun all writes it anew", "%s/%s cannot be read%s%s",
                     reader->path, name, errno ? ": " : "", errno ? strerror(errno) : "");
        free(name);
        if (!reader->arrays)
            return NULL;
    }
    return json_object_get(json_object_get(reader->arrays, "outputs"), variable);
}

typedef struct loaded {
    size_t shape[4];
    double data[];
} loaded;

static loaded *make_loaded(size_t count)
{
    loaded *made = memory_alloc(sizeof *made + count * sizeof made->data[0]);
    return made;
}

/* Reads a list of `count` numbers, with NaN for null. */
static loaded *read_list(const json_t *data, double count)
{
    if (!json_is_array(data) || (double)json_array_size(data) != count)
        return NULL;
    loaded *made = make_loaded((size_t)count);
    for (size_t i = 0; i < (size_t)count; i++) {
        const json_t *number = json_array_get(data, i);
        made->data[i] = json_is_number(number) ? json_number_value(number) : (double)NAN;
        if (!json_is_number(number) && !json_is_null(number)) {
            free(made);
            return NULL;
        }
    }
    return made;
}

/* Reads the file of an array, which stands beside the one that names it. */
static loaded *read_file(results_reader *reader, size_t index, const char *file,
                         const size_t shape[4], uint32_t rank)
{
    char why[RESULTS_NPY_WHY] = "that is not the name of a file beside it";
    const char *key = reader->per_case[index].key;
    char *name = reader->view.study ? memory_print_text("cases/%s/%s", key, file)
                                    : memory_print_text("%s", file);
    bool plain = *file && *file != '.' && !strchr(file, '/');
    int fd = plain ? results_npy_open(reader->directory, name, shape, rank, why) : -1;
    size_t count = 1; /* the file has as many numbers, so that they fit */
    for (uint32_t i = 0; i < rank; i++)
        count *= shape[i];
    loaded *made = fd >= 0 ? make_loaded(count) : NULL;
    if (made && !results_npy_read(fd, made->data, count)) {
        snprintf(why, sizeof why, "%s", strerror(errno));
        free(made);
        made = NULL;
    }
    if (!made)
        ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE, "run the case again",
                 "%s/%s cannot be read: %s", reader->path, name, why);
    free(name);
    return made;
}

/* Reads the numbers of an array; NULL after an error. */
static loaded *read_array(results_reader *reader, size_t index, const char *name,
                          const size_t shape[4], uint32_t rank)
{
    const json_t *entry = array_of(reader, index, name);
    const char *file = json_string_value(json_object_get(entry, "file"));
    double count = 1;
    for (uint32_t i = 0; i < rank; i++)
        count *= (double)shape[i];
    if (file)
        return read_file(reader, index, file, shape, rank);
    loaded *made = read_list(json_object_get(entry, "data"), count);
    if (!made && (entry || !reader->view.study || reader->arrays))
        ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                 "the numbers of %s in %s cannot be read", name, reader->path);
    return made;
}

static loaded *read_scalar(const json_t *entry)
{
    const json_t *value = json_object_get(entry, "value");
    loaded *made = make_loaded(1);
    made->data[0] = json_is_number(value) ? json_number_value(value) : (double)NAN;
    return made;
}

static ff_status load(void *ctx, size_t variable, size_t index, ff_array *array)
{
    results_reader *reader = ctx;
    const json_t *entry = entry_of(reader, variable, index);
    size_t shape[4] = {0};
    int32_t rank = shape_of(reader, variable, index, shape);
    *array = (ff_array){.data = NULL};
    if (rank < 0)
        return FF_OK;
    const char *name = reader->view.variables[variable]->name;
    loaded *made =
        rank ? read_array(reader, index, name, shape, (uint32_t)rank) : read_scalar(entry);
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

/* Leaves out what cannot be read, is not text or is too long. */
static void read_drawing(results_reader *reader, const char *name)
{
    enum { MOST = 1 << 20 };
    int fd = openat(reader->directory, name, O_RDONLY | O_CLOEXEC);
    char *text = memory_alloc(MOST);
    ssize_t length = fd >= 0 ? read(fd, text, MOST) : -1;
    if (length > 0 && length < MOST && !memchr(text, 0, (size_t)length)) {
        ff_view_drawing *made = results_view_add_row(reader, &reader->drawings, sizeof *made);
        *made = (ff_view_drawing){
            .size = sizeof *made,
            .name = memory_arena_text(&reader->arena, name, strlen(name)),
            .svg = memory_arena_text(&reader->arena, text, (size_t)length),
        };
    }
    free(text);
    if (fd >= 0)
        close(fd);
}

static void read_drawings(results_reader *reader)
{
    struct dirent **entries = NULL;
    int count = scandir(reader->path, &entries, is_svg, alphasort);
    for (int i = 0; i < count; i++) {
        read_drawing(reader, entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
}

static void finish_view(results_reader *reader)
{
    ff_view *view = &reader->view;
    view->size = sizeof *view;
    view->ctx = reader;
    view->shape = shape_of;
    view->load = load;
    view->release = release;
    view->fact_count = reader->facts.count;
    view->facts = results_view_take_rows(reader, &reader->facts);
    view->citation_count = reader->citations.count;
    view->citations = results_view_take_rows(reader, &reader->citations);
    view->stage_count = reader->stages.count;
    view->stages = results_view_take_rows(reader, &reader->stages);
    view->axis_count = reader->axes.count;
    view->axes = results_view_take_rows(reader, &reader->axes);
    view->variable_count = reader->variables.count;
    view->variables = results_view_take_rows(reader, &reader->variables);
    view->case_count = reader->cases.count;
    view->cases = results_view_take_rows(reader, &reader->cases);
    view->drawing_count = reader->drawings.count;
    view->drawings = results_view_take_rows(reader, &reader->drawings);
    char *summary = study_tally_text(&reader->tally);
    view->summary = memory_arena_text(&reader->arena, summary, strlen(summary));
    free(summary);
    study_tally_free(&reader->tally);
    reader->arrays_case = view->case_count;
}

static bool read_directory(results_reader *reader)
{
    const char *path = reader->path;
    reader->directory = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (reader->directory < 0)
        return ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE,
                        "name the directory that a run has written", "\"%s\" cannot be opened: %s",
                        path, strerror(errno));
    if (faccessat(reader->directory, study_marker, F_OK, 0) == 0) {
        read_drawings(reader);
        return results_view_read_study(reader);
    }
    if (faccessat(reader->directory, "result.json", F_OK, 0) == 0)
        return results_view_read_run(reader);
    bool begun = faccessat(reader->directory, ".flankfilm", F_OK, 0) == 0;
    return ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE,
                    begun ? "run it again" : "name the directory that a run has written",
                    begun ? "the run that writes \"%s\" has not ended, or was broken off"
                          : "\"%s\" holds no results of flankfilm",
                    path);
}

const ff_view *results_view_open(const char *directory, ff_report *report)
{
    results_reader *reader = memory_alloc(sizeof *reader);
    reader->report = report;
    reader->path = directory;
    reader->directory = -1;
    reader->index = json_object();
    reader->view.title = "";
    bool good = read_directory(reader);
    finish_view(reader);
    if (good)
        return &reader->view;
    results_view_close(&reader->view);
    return NULL;
}

void results_view_close(const ff_view *view)
{
    if (!view)
        return;
    results_reader *reader = view->ctx;
    for (size_t i = 0; reader->per_case && i < view->case_count; i++)
        json_decref(reader->per_case[i].outputs);
    free(reader->per_case);
    json_decref(reader->arrays);
    json_decref(reader->index);
    if (reader->directory >= 0)
        close(reader->directory);
    memory_arena_free(&reader->arena);
    free(reader);
}
