/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results for people and other programs: what a reader finds in a directory, a writer makes files
   of. */
#include "command.h"

#include "../../engine/pipeline/tool.h"
#include "../results/folder.h"
#include "../results/json.h"

#include <flankfilm/reader.h>

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A file, or a directory of files, that appears when all is written. */
typedef struct destination {
    char *path;
    char *part;             /* of a file: its temporary name */
    results_folder *folder; /* of a directory */
    fe_report *report;
    ff_reader_source source;
    const ff_view *view; /* of the source, or NULL */
} destination;

/* results.nc, or results-csv for a writer of many files. */
static char *default_path(const cli_options *options, const ff_writer *writer, const char *stem,
                          const char *name)
{
    size_t length = strlen(options->operand);
    const char *slash = length && options->operand[length - 1] == '/' ? "" : "/";
    return *writer->suffix
               ? fe_print_text("%s%s%s%s", options->operand, slash, stem, writer->suffix)
               : fe_print_text("%s%s%s-%s", options->operand, slash, stem, name);
}

/* A file that stands beside its temporary name, which must be of the same file system. */
static bool open_file(destination *to)
{
    const char *slash = strrchr(to->path, '/');
    char *parent = slash ? fe_print_text("%.*s", (int)(slash - to->path + 1), to->path) : NULL;
    bool good = !parent || study_make_path(parent);
    free(parent);
    to->part = fe_print_text("%s.%ld.part", to->path, (long)getpid());
    int fd = good ? open(to->part, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666) : -1;
    if (fd >= 0)
        close(fd);
    return fd >= 0 || fe_error(to->report, FE_EXIT_INPUT, FE_NOWHERE, "name another file with -o",
                               "\"%s\" cannot be written: %s", to->path, strerror(errno));
}

static bool open_destination(destination *to, const ff_writer *writer)
{
    if (*writer->suffix)
        return open_file(to);
    to->folder = results_folder_open(to->path, to->report);
    if (to->folder)
        results_folder_sync(to->folder);
    return to->folder != NULL;
}

static bool finish(destination *to)
{
    if (to->folder)
        return results_folder_commit(to->folder);
    return (results_file_sync(to->part) && rename(to->part, to->path) == 0) ||
           fe_error(to->report, FE_EXIT_FAILED, FE_NOWHERE, NULL, "\"%s\" cannot be written: %s",
                    to->path, strerror(errno));
}

static void close_destination(destination *to)
{
    if (to->part)
        unlink(to->part);
    results_folder_discard(to->folder);
    free(to->part);
    free(to->path);
}

static const char *path_of(void *ctx, const char *name)
{
    destination *to = ctx;
    const char *path = to->folder ? name ? results_folder_path(to->folder, name) : NULL : to->part;
    if (!path)
        fe_error(to->report, FE_EXIT_PLUGIN, FE_NOWHERE, NULL,
                 "the writer asked for a file of the name \"%s\"", name ? name : "");
    return path;
}

static ff_status call_write(const void *table, void *ctx)
{
    const ff_writer *writer = table;
    destination *to = ctx;
    const ff_target target = {.size = sizeof target, .ctx = to, .path = path_of};
    return writer->write(writer->self, to->view, &target);
}

/* What the view reported comes before what the writer made of it. */
static bool write_all(destination *to, const fe_tool *tool)
{
    fe_report *said = fe_report_new();
    bool good = fe_tool_call(tool, "write", call_write, to, said);
    for (size_t i = 0; i < fe_report_count(said); i++) {
        const fe_message *message = fe_report_at(said, i);
        if (message->severity == FE_WARNING)
            fe_warn(to->report, FE_NOWHERE, "%s", message->text);
        else if (fe_report_errors(to->report) == 0)
            fe_error(to->report, message->exit_code, FE_NOWHERE, message->hint, "%s",
                     message->text);
    }
    fe_report_free(said);
    return good && fe_report_errors(to->report) == 0;
}

static ff_status refuse(void *ctx, const char *hint, const char *text)
{
    fe_error(ctx, FE_EXIT_INPUT, FE_NOWHERE, hint, "%s", text);
    return FF_INVALID;
}

static ff_status call_open(const void *table, void *ctx)
{
    const ff_reader *reader = table;
    destination *to = ctx;
    return reader->open(reader->self, &to->source, &to->view);
}

static bool open_view(destination *to, fe_tool *reader, fe_library *library)
{
    const fe_tool_choice choice = {
        .option = "export", .interface = FF_READER_ID, .name = CLI_RESULTS_READER};
    return fe_tool_open(reader, library, &choice, to->report) &&
           fe_tool_call(reader, "open", call_open, to, to->report);
}

static bool run(const cli_options *options, const char *name, const char *stem, destination *to,
                fe_library *library)
{
    const cli_words settings = cli_option_words(options, "with");
    const fe_tool_choice choice = {
        .option = "--to",
        .interface = FF_WRITER_ID,
        .name = name,
        .settings = settings.words,
        .setting_count = settings.count,
    };
    fe_tool tool = {.table = NULL}, reader = {.table = NULL};
    bool good =
        open_view(to, &reader, library) && fe_tool_open(&tool, library, &choice, to->report);
    if (good) {
        const ff_writer *writer = tool.table;
        const char *slash = strchr(name, '/');
        to->path = options->directory
                       ? fe_print_text("%s", options->directory)
                       : default_path(options, writer, stem, slash ? slash + 1 : name);
        good = open_destination(to, writer) && write_all(to, &tool) && finish(to);
    }
    fe_tool_close(&tool);
    const ff_reader *from = reader.table;
    if (to->view)
        from->close(from->self, to->view);
    fe_tool_close(&reader);
    return good;
}

static int write_with(const cli_options *options, const char *name, const char *stem)
{
    fe_library *library = fe_library_new(options->plugin_paths, options->plugin_path_count);
    fe_report *report = fe_report_new();
    destination to = {.report = report,
                      .source = {sizeof to.source, report, options->operand, refuse}};
    bool good = run(options, name, stem, &to, library);
    int code = FE_EXIT_OK;
    if (!good) {
        code = cli_refuse(to.report, options, "nothing was written");
    } else if (options->json) {
        json_t *answer = results_json_answer("ok", code, to.report);
        json_object_set_new(answer, "path", results_json_text(to.path));
        results_json_print(answer);
    } else {
        fe_report_print(to.report, stderr, false);
        printf("%s\n", to.path);
    }
    close_destination(&to);
    fe_report_free(to.report);
    fe_library_free(library);
    return code;
}

int cli_export(const cli_options *options)
{
    return write_with(options, cli_option(options, "to"), "results");
}

int cli_write_report(const cli_options *options)
{
    const char *writer = cli_option(options, "to");
    return write_with(options, writer ? writer : CLI_REPORT_WRITER, "report");
}
