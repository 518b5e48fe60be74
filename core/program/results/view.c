/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "view.h"
#include "view-tables.h"

#include "../memory/file.h"

#include <assert.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool results_view_is_coordinate(const results_view_variable *series,
                                const results_view_variable *other, uint32_t dim)
{
    if (series->rank != 1 || series == other)
        return false;
    if (!strcmp(series->name, other->against[dim]))
        return true;
    return series->stage == other->stage && !strcmp(series->dims[0], other->dims[dim]) &&
           (!strcmp(series->output, series->dims[0]) || !strcmp(series->unit, "s") ||
            !strcmp(series->unit, "rad"));
}

/* The view is the first member of its reader. */
static results_reader *reader_of(const results_view *view)
{
    return (results_reader *)(size_t)view;
}

static const results_output *output_of(const results_reader *reader, size_t variable, size_t index)
{
    if (index >= reader->view.case_count)
        return NULL;
    const results_case *of = &reader->per_case[index];
    for (size_t i = 0; i < of->output_count; i++)
        if (of->outputs[i].variable == variable)
            return &of->outputs[i];
    return NULL;
}

bool results_view_full_shape(const results_view *view, size_t variable, size_t index,
                             size_t shape[4])
{
    assert(variable < view->variable_count);
    const results_output *output = output_of(reader_of(view), variable, index);
    const uint32_t full = view->variables[variable]->rank;
    if (!output || output->rank > full)
        return false;
    const uint32_t absent = full - output->rank;
    for (uint32_t i = 0; i < full; i++)
        shape[i] = i < absent ? 1 : output->shape[i - absent];
    return true;
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

static size_t count_of(const results_output *output)
{
    size_t count = 1;
    for (uint32_t i = 0; i < output->rank; i++)
        count *= output->shape[i];
    return count;
}

/* Reads the file of an array, from the directory of the file that names it. */
static loaded *read_file(results_reader *reader, const results_output *output, const char *file)
{
    char why[ARRAYS_WHY] = "that is not the name of a file in its directory";
    bool plain = *file && *file != '.' && !strchr(file, '/');
    int fd =
        plain ? arrays_npy_open(reader->directory, file, output->shape, output->rank, why) : -1;
    size_t count = count_of(output); /* the file has this many numbers, so the size does not
                                      * overflow */
    loaded *made = fd >= 0 ? make_loaded(count) : NULL;
    if (made && !arrays_npy_read(fd, made->data, count)) {
        snprintf(why, sizeof why, "%s", strerror(errno));
        free(made);
        made = NULL;
    }
    if (!made)
        ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE, "run the case again",
                 "%s/%s cannot be read: %s", reader->path, file, why);
    return made;
}

/* Reads an array of a study from the log of its case. */
static loaded *read_record(results_reader *reader, size_t index, const results_output *output)
{
    char why[ARRAYS_WHY];
    const results_case *of = &reader->per_case[index];
    const char *name = reader->view.variables[output->variable]->name;
    arrays_label label = {.key = of->key, .output = name, .rank = output->rank};
    memcpy(label.shape, output->shape, output->rank * sizeof *output->shape);
    bool good = arrays_reader_has(&reader->logs, of->log, output->offset, &label, why);
    loaded *made = good ? make_loaded(count_of(output)) : NULL;
    good =
        good && arrays_reader_read(&reader->logs, of->log, output->offset, &label, made->data, why);
    if (good)
        return made;
    ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE,
             "\"flankfilm run --rerun all\" writes it again",
             "%s of case %zu, in %s/%s, cannot be "
             "read: %s",
             name, index + 1, reader->path, of->log, why);
    free(made);
    return NULL;
}

/* Reads the numbers of an array; NULL after an error. */
static loaded *read_array(results_reader *reader, size_t index, const results_output *output)
{
    const char *file = json_string_value(json_object_get(output->entry, "file"));
    double count = 1;
    for (uint32_t i = 0; i < output->rank; i++)
        count *= (double)output->shape[i];
    if (reader->view.study)
        return read_record(reader, index, output);
    if (file)
        return read_file(reader, output, file);
    loaded *made = read_list(json_object_get(output->entry, "data"), count);
    if (!made)
        ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                 "the numbers of %s in %s cannot be read",
                 reader->view.variables[output->variable]->name, reader->path);
    return made;
}

static loaded *read_scalar(const results_output *output)
{
    const json_t *value = json_object_get(output->entry, "value");
    loaded *made = make_loaded(1);
    made->data[0] = !output->entry          ? output->value
                    : json_is_number(value) ? json_number_value(value)
                                            : (double)NAN;
    return made;
}

bool results_view_load(const results_view *view, size_t variable, size_t index, ff_array *array)
{
    results_reader *reader = reader_of(view);
    const results_output *output = output_of(reader, variable, index);
    *array = (ff_array){.data = NULL};
    if (!output)
        return true;
    loaded *made = output->rank ? read_array(reader, index, output) : read_scalar(output);
    if (!made)
        return false;
    if (output->rank)
        memcpy(made->shape, output->shape, output->rank * sizeof *output->shape);
    *array = (ff_array){.data = made->data, .shape = made->shape, .rank = output->rank};
    return true;
}

void results_view_release(ff_array *array)
{
    if (array->data)
        free((char *)(size_t)array->data - offsetof(loaded, data));
    *array = (ff_array){.data = NULL};
}

static int is_figures(const struct dirent *entry)
{
    static const char ending[] = ".figure.json";
    size_t length = strlen(entry->d_name);
    return length > sizeof ending && !strcmp(entry->d_name + length - (sizeof ending - 1), ending);
}

/* Leaves out figures that cannot be read, are not text or are too long. */
static void read_figure(results_reader *reader, const char *name)
{
    enum { MOST = 1 << 23 };
    int fd = file_open(reader->directory, name, NULL);
    char *text = memory_alloc(MOST);
    ssize_t length = fd >= 0 ? read(fd, text, MOST) : -1;
    if (length > 0 && length < MOST && !memchr(text, 0, (size_t)length)) {
        results_view_figures *made = results_view_add_row(reader, &reader->figures, sizeof *made);
        *made = (results_view_figures){
            .name = memory_arena_text(&reader->arena, name, strlen(name)),
            .json = memory_arena_text(&reader->arena, text, (size_t)length),
        };
    }
    free(text);
    if (fd >= 0)
        close(fd);
}

static void read_figures(results_reader *reader)
{
    struct dirent **entries = NULL;
    int count = scandir(reader->path, &entries, is_figures, alphasort);
    for (int i = 0; i < count; i++) {
        read_figure(reader, entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
}

static void finish_view(results_reader *reader)
{
    results_view *view = &reader->view;
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
    view->figures_count = reader->figures.count;
    view->figures = results_view_take_rows(reader, &reader->figures);
    char *summary = study_tally_text(&reader->tally);
    view->summary = memory_arena_text(&reader->arena, summary, strlen(summary));
    free(summary);
    study_tally_free(&reader->tally);
}

static bool read_directory(results_reader *reader)
{
    const char *path = reader->path;
    reader->directory = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (reader->directory < 0)
        return ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE,
                        "name a directory written by run", "\"%s\" cannot be opened: %s", path,
                        strerror(errno));
    arrays_reader_open(&reader->logs, reader->directory);
    if (faccessat(reader->directory, study_marker, F_OK, 0) == 0) {
        read_figures(reader);
        return results_view_read_study(reader);
    }
    if (faccessat(reader->directory, "result.json", F_OK, 0) == 0)
        return results_view_read_run(reader);
    bool begun = faccessat(reader->directory, ".flankfilm", F_OK, 0) == 0;
    return ff_error(reader->report, FF_FAULT_INPUT, FF_NOWHERE,
                    begun ? "run it again" : "name a directory written by run",
                    begun ? "the run that writes \"%s\" has not ended, or was interrupted"
                          : "\"%s\" contains no results of flankfilm",
                    path);
}

const results_view *results_view_open(const char *directory, ff_report *report)
{
    results_reader *reader = memory_alloc(sizeof *reader);
    reader->report = report;
    reader->path = directory;
    reader->directory = -1;
    reader->index = json_object();
    reader->texts = json_object();
    reader->view.title = "";
    bool good = read_directory(reader);
    finish_view(reader);
    if (good)
        return &reader->view;
    results_view_close(&reader->view);
    return NULL;
}

void results_view_close(const results_view *view)
{
    if (!view)
        return;
    results_reader *reader = reader_of(view);
    free(reader->per_case);
    free(reader->outputs);
    arrays_reader_close(&reader->logs);
    json_decref(reader->root);
    json_decref(reader->index);
    json_decref(reader->texts);
    if (reader->directory >= 0)
        close(reader->directory);
    memory_arena_free(&reader->arena);
    free(reader);
}
