/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A third party's plugin, ready to build: source, build file, pipeline and three commands. */
#include "command.h"
#include "json.h"

#include "../value/memory.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char *const stage_c[] = {
#include "stage.c.inc"
    NULL};
static const char *const stage_yaml[] = {
#include "stage.yaml.inc"
    NULL};
static const char *const meson_build[] = {
#include "meson.build.in.inc"
    NULL};
static const char *const readme[] = {
#include "README.md.in.inc"
    NULL};

/* What stands in place of "@name@". */
typedef struct word {
    const char *name, *text;
} word;

/* Writes what the mark stands for; `name` is what is between its "@". */
static void write_mark(FILE *stream, const char *name, size_t length, const word *words)
{
    for (; words->name; words++)
        if (strlen(words->name) == length && !memcmp(words->name, name, length))
            fputs(words->text, stream);
}

static void write_line(FILE *stream, const char *line, const word *words)
{
    for (const char *mark, *end; (mark = strchr(line, '@')) && (end = strchr(mark + 1, '@'));
         line = end + 1) {
        fwrite(line, 1, (size_t)(mark - line), stream);
        write_mark(stream, mark + 1, (size_t)(end - mark - 1), words);
    }
    fprintf(stream, "%s\n", line);
}

/* What becomes of a file: the template of that name, else these lines. */
typedef struct source {
    char *path; /* NULL: none */
    const char *const *lines;
} source;

static bool write_template(FILE *stream, const source *from, const word *words)
{
    FILE *file = from->path ? fopen(from->path, "r") : NULL;
    char *line = NULL;
    size_t size = 0;
    for (ssize_t length; file && (length = getline(&line, &size, file)) > 0;) {
        line[length - (line[length - 1] == '\n')] = '\0';
        write_line(stream, line, words);
    }
    bool good = !from->path || (file && !ferror(file));
    if (file)
        fclose(file);
    free(line);
    for (const char *const *at = from->lines; !from->path && *at; at++)
        write_line(stream, *at, words);
    return good;
}

/* Writes folder/name; never over a file that is there. */
static bool write_file(const char *folder, const char *name, source from, const word *words,
                       ff_report *report)
{
    char *path = ff_print_text("%s/%s", folder, name);
    FILE *stream = fopen(path, "wx");
    bool good = stream && write_template(stream, &from, words) && !ferror(stream);
    if (stream)
        good = fclose(stream) == 0 && good;
    if (!good)
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "%s cannot be written: %s", path,
                 strerror(errno));
    free(path);
    return good;
}

/* The template that stands beside the models of the kind: "<plugin dir>/<kind>.template.c". */
static source find_template(const ff_library *library, const char *kind, const char *ending,
                            const char *const *otherwise)
{
    char *name = ff_print_text("%s.template.%s", kind, ending);
    source found = {.path = ff_library_file(library, name), .lines = otherwise};
    free(name);
    return found;
}

/* Whether the first model of the kind is a law: random parameters serve to verify it, where a stage
   wants the inputs of a real run. */
static bool is_law(ff_library *library, const char *kind)
{
    size_t count = 0, length = strlen(kind);
    const char *const *ids = ff_library_ids(library, &count);
    ff_report *unheard = ff_report_new();
    const ff_loaded *loaded = NULL;
    for (size_t i = 0; i < count && !loaded; i++)
        if (!strncmp(ids[i], kind, length) && ids[i][length] == '/')
            loaded = ff_library_load(library, ids[i], FF_NOWHERE, unheard);
    ff_report_free(unheard);
    return loaded && loaded->model->output_count > 0 && ff_model_output(loaded->model, 0)->service;
}

static bool write_all(const ff_options *options, const char *folder, ff_report *report)
{
    const char *id = options->operand, *name = strchr(id, '/') + 1;
    char *kind = ff_copy_text(id, strcspn(id, "/"));
    ff_library *library = ff_library_new(options->plugin_paths, options->plugin_path_count);
    char *inputs = is_law(library, kind) ? ff_copy_text("", 0)
                                         : ff_print_text(", '--pipeline', files('%s.yaml')", name);
    const word words[] = {
        {"ID", id}, {"KIND", kind}, {"NAME", name}, {"INPUTS", inputs}, {NULL, NULL}};
    source model = find_template(library, kind, "c", stage_c);
    source pipeline = find_template(library, kind, "yaml", stage_yaml);
    char *c = ff_print_text("%s.c", name), *y = ff_print_text("%s.yaml", name);
    bool good = write_file(folder, c, model, words, report) &&
                write_file(folder, y, pipeline, words, report) &&
                write_file(folder, "meson.build", (source){.lines = meson_build}, words, report) &&
                write_file(folder, "README.md", (source){.lines = readme}, words, report);
    if (good)
        printf("%s is in %s; its README.md has the next three commands\n", id, folder);
    if (good && !model.path)
        printf("there is no template for the kind \"%s\": it is a stage without a place in a "
               "pipeline yet\n",
               kind);
    free(c);
    free(y);
    free(model.path);
    free(pipeline.path);
    free(kind);
    free(inputs);
    ff_library_free(library);
    return good;
}

static bool is_word(const char *text, size_t length)
{
    return length > 0 && length < 64 &&
           strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789-") >= length && text[0] != '-';
}

int ff_new(const ff_options *options)
{
    const char *id = options->operand, *slash = strchr(id, '/');
    ff_report *report = ff_report_new();
    int code = FF_EXIT_OK;
    if (!slash || !is_word(id, (size_t)(slash - id)) || !is_word(slash + 1, strlen(slash + 1))) {
        ff_error(
            report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
            "\"%.100s\" is no name for a model: write kind/name, in lower-case letters, digits "
            "and hyphens",
            id);
    } else {
        const char *folder = options->directory ? options->directory : slash + 1;
        if (mkdir(folder, 0777) != 0)
            ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "the folder %s cannot be made: %s",
                     folder, strerror(errno));
        else
            write_all(options, folder, report);
    }
    if (ff_report_errors(report))
        code = ff_refuse(report, options, "nothing was made");
    ff_report_free(report);
    return code;
}
