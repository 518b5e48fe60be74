/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A third party's plugin, ready to build: source, build file, pipeline and three commands. */
#include "command.h"
#include "json.h"

#include "../value/memory.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <flankfilm/density.h>
#include <flankfilm/rheology.h>
#include <flankfilm/viscosity.h>

static const char *const viscosity_c[] = {
#include "viscosity.c.inc"
    NULL};
static const char *const density_c[] = {
#include "density.c.inc"
    NULL};
static const char *const rheology_c[] = {
#include "rheology.c.inc"
    NULL};
static const char *const stage_c[] = {
#include "stage.c.inc"
    NULL};
static const char *const film_yaml[] = {
#include "film.yaml.inc"
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

/* What stands in place of "@name@" or "@name|what to write without one@". */
typedef struct word {
    const char *name, *text;
} word;

/* Writes what the mark stands for; `text` is what is between its "@". */
static void write_mark(FILE *stream, const char *text, size_t length, const word *words,
                       size_t count)
{
    const char *bar = memchr(text, '|', length);
    size_t name = bar ? (size_t)(bar - text) : length;
    for (size_t i = 0; i < count; i++)
        if (words[i].name && strlen(words[i].name) == name && !memcmp(words[i].name, text, name)) {
            fputs(words[i].text, stream);
            return;
        }
    if (bar)
        fwrite(bar + 1, 1, length - name - 1, stream);
}

static void write_line(FILE *stream, const char *line, const word *words, size_t count)
{
    for (const char *mark, *end; (mark = strchr(line, '@')) && (end = strchr(mark + 1, '@'));
         line = end + 1) {
        fwrite(line, 1, (size_t)(mark - line), stream);
        write_mark(stream, mark + 1, (size_t)(end - mark - 1), words, count);
    }
    fprintf(stream, "%s\n", line);
}

/* Writes folder/name; never over a file that is there. */
static bool write_file(const char *folder, const char *name, const char *const *lines,
                       const word *words, size_t count, ff_report *report)
{
    char *path = ff_print_text("%s/%s", folder, name);
    FILE *stream = fopen(path, "wx");
    for (; stream && *lines; lines++)
        write_line(stream, *lines, words, count);
    bool good = stream && !ferror(stream);
    if (stream)
        good = fclose(stream) == 0 && good;
    if (!good)
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "%s cannot be written: %s", path,
                 strerror(errno));
    free(path);
    return good;
}

/* What a new model of a service looks like; all others are stages. `word` stands for it in
   film.yaml. */
static const struct law {
    const char *service, *word;
    const char *const *source;
} laws[] = {
    {FF_VISCOSITY_ID, "VISCOSITY", viscosity_c},
    {FF_DENSITY_ID, "DENSITY", density_c},
    {FF_RHEOLOGY_ID, "RHEOLOGY", rheology_c},
};
enum { LAWS = sizeof laws / sizeof laws[0] };

static const struct law *find_law(const ff_model *model)
{
    for (size_t i = 0; i < model->output_count; i++)
        for (size_t k = 0; k < LAWS && ff_model_output(model, i)->service; k++)
            if (!strcmp(ff_model_output(model, i)->service, laws[k].service))
                return &laws[k];
    return NULL;
}

/* What the models of that kind that are there offer; NULL: no law, or no such kind. */
static const struct law *law_of_kind(const ff_options *options, const char *kind)
{
    const struct law *law = NULL;
    ff_report *report = ff_report_new();
    ff_library *library = ff_library_new(options->plugin_paths, options->plugin_path_count);
    size_t count = 0, length = strlen(kind);
    const char *const *ids = ff_library_ids(library, &count);
    for (size_t i = 0; i < count && !law; i++) {
        const ff_loaded *loaded = NULL;
        if (!strncmp(ids[i], kind, length) && ids[i][length] == '/')
            loaded = ff_library_load(library, ids[i], FF_NOWHERE, report);
        law = loaded ? find_law(loaded->model) : NULL;
    }
    ff_library_free(library);
    ff_report_free(report);
    return law;
}

static bool write_all(const ff_options *options, const char *folder, ff_report *report)
{
    const char *id = options->operand;
    char *kind = ff_copy_text(id, strcspn(id, "/"));
    const char *name = id + strlen(kind) + 1;
    const struct law *law = law_of_kind(options, kind);
    const word words[] = {
        {"ID", id},
        {"KIND", kind},
        {"NAME", name},
        {law ? law->word : NULL, id},
    };
    const size_t count = sizeof words / sizeof words[0];
    char *c = ff_print_text("%s.c", name), *y = ff_print_text("%s.yaml", name);
    bool good = write_file(folder, c, law ? law->source : stage_c, words, count, report) &&
                write_file(folder, y, law ? film_yaml : stage_yaml, words, count, report) &&
                write_file(folder, "meson.build", meson_build, words, count, report) &&
                write_file(folder, "README.md", readme, words, count, report);
    free(c);
    free(y);
    free(kind);
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
        else if (write_all(options, folder, report))
            printf("%s is in %s; its README.md has the next three commands\n", id, folder);
    }
    if (ff_report_errors(report))
        code = ff_refuse(report, options, "nothing was made");
    ff_report_free(report);
    return code;
}
