/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command new: writes a plugin that is ready to build, with a build file and a pipeline. */
#include "command.h"

#include "../memory/memory.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A mark such as "@name@", and the text that replaces it. */
typedef struct word {
    const char *name, *text;
} word;

/* Writes the text for a mark; `name` is the word between its two "@". */
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

static bool fill_in(FILE *stream, const char *template, const word *words)
{
    FILE *file = fopen(template, "r");
    char *line = NULL;
    size_t size = 0;
    for (ssize_t length; file && (length = getline(&line, &size, file)) > 0;) {
        line[length - (line[length - 1] == '\n')] = '\0';
        write_line(stream, line, words);
    }
    bool good = file && !ferror(file);
    if (file)
        fclose(file);
    free(line);
    return good;
}

/* Writes folder/name, but never replaces a file. */
static bool write_file(const char *folder, const char *name, const char *template,
                       const word *words, ff_report *report)
{
    char *path = memory_print_text("%s/%s", folder, name);
    FILE *stream = fopen(path, "wx");
    bool good = stream && fill_in(stream, template, words) && !ferror(stream);
    if (stream)
        good = fclose(stream) == 0 && good;
    if (!good)
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "%s cannot be written: %s", path,
                 strerror(errno));
    free(path);
    return good;
}

/* Finds the template of the kind, "<kind>.template.c", or the general one, "template.c", in the
 * directories of plugins. Sets *own if the kind has its own template. NULL after an error. */
static char *find_template(const ff_engine *engine, const char *kind, const char *ending, bool *own,
                           ff_report *report)
{
    char *name = memory_print_text("%s.template.%s", kind, ending);
    char *path = ff_engine_file(engine, name), *general = strstr(name, ".template.") + 1;
    *own = path != NULL;
    if (!path)
        path = ff_engine_file(engine, general);
    if (!path)
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE,
                 "--plugin-path and FLANKFILM_PLUGIN_PATH add directories",
                 "no directory of plugins contains %s", general);
    free(name);
    return path;
}

/* Whether the first model of the kind is a law. `verify` tests a law with random parameters; a
 * stage needs the inputs of a real run. */
static bool is_law(ff_engine *engine, const char *kind)
{
    size_t count = 0, length = strlen(kind);
    const char *const *ids = ff_engine_ids(engine, &count);
    ff_report *captured = ff_report_new();
    const ff_loaded *loaded = NULL;
    for (size_t i = 0; i < count && !loaded; i++)
        if (!strncmp(ids[i], kind, length) && ids[i][length] == '/')
            loaded = ff_engine_model(engine, ids[i], FF_NOWHERE, captured);
    ff_report_free(captured);
    return loaded && loaded->model->output_count > 0 && ff_model_output(loaded->model, 0)->service;
}

static bool write_all(const cli_options *options, const char *folder, ff_report *report)
{
    const char *id = options->operand, *name = strchr(id, '/') + 1;
    char *kind = memory_copy_text(id, strcspn(id, "/"));
    ff_engine *engine = cli_engine_new(options);
    char *inputs = is_law(engine, kind)
                       ? memory_copy_text("", 0)
                       : memory_print_text(", '--pipeline', files('%s.yaml')", name);
    const word words[] = {
        {"ID", id}, {"KIND", kind}, {"NAME", name}, {"INPUTS", inputs}, {NULL, NULL}};
    char *c = memory_print_text("%s.c", name), *yaml = memory_print_text("%s.yaml", name);
    const char *files[][2] = {
        {c, "c"}, {yaml, "yaml"}, {"meson.build", "meson.build"}, {"README.md", "md"}};
    bool good = true, own[4];
    for (size_t i = 0; i < 4 && good; i++) {
        char *template = find_template(engine, kind, files[i][1], &own[i], report);
        good = template && write_file(folder, files[i][0], template, words, report);
        ff_free(template);
    }
    if (good)
        printf("%s was written to %s; its README.md lists the next three commands\n", id, folder);
    if (good && !own[0])
        printf("no template exists for the kind \"%s\": %s.yaml contains only the new stage\n",
               kind, name);
    free(c);
    free(yaml);
    free(kind);
    free(inputs);
    ff_engine_close(engine);
    return good;
}

static bool is_word(const char *text, size_t length)
{
    return length > 0 && length < 64 &&
           strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789-") >= length && text[0] != '-';
}

int cli_new(const cli_options *options)
{
    const char *id = options->operand, *slash = strchr(id, '/');
    ff_report *report = ff_report_new();
    int code = EXIT_SUCCESS;
    if (!slash || !is_word(id, (size_t)(slash - id)) || !is_word(slash + 1, strlen(slash + 1)) ||
        !strcmp(slash + 1, "auto")) {
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                 "\"%.100s\" is not a valid name of a model: write kind/name, with lower-case "
                 "letters, digits and hyphens, but not \"auto\", which has a meaning of its own",
                 id);
    } else {
        const char *folder = options->directory ? options->directory : slash + 1;
        if (mkdir(folder, 0777) != 0)
            ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "the folder %s cannot be made: %s",
                     folder, strerror(errno));
        else
            write_all(options, folder, report);
    }
    if (ff_report_errors(report))
        code = cli_refuse(report, options, "nothing was made");
    ff_report_free(report);
    return code;
}
