/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands export and report: results for other programs and for people. */
#include "beside.h"
#include "command.h"

#include "../report/report.h"
#include "../results/derived-files.h"
#include "../results/export-csv.h"
#include "../results/json.h"
#include "../results/target.h"
#include "../results/view.h"
#include "../study/kinds/kinds.h"
#include "../terminal/terminal.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct form {
    const char *name;
    const char *suffix; /* ending of the file, such as ".html"; "" if the export is a directory */
    const char *begins; /* the first bytes of a file that the program wrote */
    /* Writes the file from the view of the results; NULL: another program does, and reads the
     * directory itself. */
    bool (*write)(const results_view *view, const results_target *target,
                  const cli_options *options);
} form;

static bool write_csv(const results_view *view, const results_target *target,
                      const cli_options *options)
{
    return results_export_csv(view, options->operand, target->folder);
}

static bool write_page(const results_view *view, const results_target *target,
                       const cli_options *options)
{
    report_template *with = report_template_open(cli_option(options, "template"), target->report);
    const cli_words best = cli_option_words(options, "best");
    const bool good =
        with && report_write(view, with, best.words, best.count, target->file.part, target->report);
    report_template_close(with);
    return good;
}

static const form forms[] = {
    {"csv", "", "", write_csv},
    {"netcdf", ".nc", "\x89HDF\r\n\x1a\n", NULL},
    {"html", ".html", REPORT_BEGINS, write_page},
};
enum { FORMS = sizeof forms / sizeof *forms };

/* Returns the format with that name; NULL after an error. */
static const form *find_form(const char *name, ff_report *report)
{
    const char *names[FORMS];
    for (size_t i = 0; i < FORMS; i++) {
        names[i] = forms[i].name;
        if (!strcmp(names[i], name))
            return &forms[i];
    }
    const char *near = ff_nearest(name, names, FORMS);
    ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, "results can be written as csv or netcdf",
             "--to %.80s: unknown format%s%s%s", name, near ? "; did you mean \"" : "",
             near ? near : "", near ? "\"?" : "");
    return NULL;
}

/* Returns results.nc, or results-csv if the format is a directory. */
static char *default_path(const char *directory, const char *stem, const form *to)
{
    size_t length = strlen(directory);
    const char *slash = length && directory[length - 1] == '/' ? "" : "/";
    return memory_print_text("%s%s%s%s%s", directory, slash, stem, *to->suffix ? to->suffix : "-",
                             *to->suffix ? "" : to->name);
}

/* Refuses a directory of results as the target: a later run that replaces the results would delete
 * the export. */
static bool holds_no_run(const char *path, ff_report *report)
{
    const char *const names[] = {"result.json", study_description};
    bool free_of_them = true;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char *file = memory_print_text("%s/%s", path, names[i]);
        free_of_them = free_of_them && access(file, F_OK) != 0;
        free(file);
    }
    return free_of_them ||
           ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, "name another directory with -o",
                    "\"%s\" contains the results of a run or a study", path);
}

static bool write_to(const form *to, const results_view *view, const cli_options *options,
                     const char *stem, results_target *target)
{
    target->path = options->directory ? memory_print_text("%s", options->directory)
                                      : default_path(options->operand, stem, to);
    target->begins = to->begins;
    bool good = (*to->suffix || holds_no_run(target->path, target->report)) &&
                results_target_open(target, !*to->suffix) &&
                (to->write ? to->write(view, target, options)
                           : cli_beside("flankfilm-netcdf", options->operand, target->file.part,
                                        target->report));
    if (good)
        results_made_note(options->operand, target->path,
                          target->file.part ? target->file.part : target->path);
    return good && results_target_commit(target);
}

static bool run(const cli_options *options, const char *name, const char *stem,
                results_target *target)
{
    const form *to = find_form(name, target->report);
    const results_view *view =
        to && to->write ? results_view_open(options->operand, target->report) : NULL;
    bool good = to && (view || !to->write) && write_to(to, view, options, stem, target);
    results_view_close(view);
    return good;
}

/* Prints which file was written, or why none was. */
static int answer_target(const cli_options *options, results_target *target, bool good)
{
    int code = EXIT_SUCCESS;
    if (!good) {
        code = cli_refuse(target->report, options, "nothing was written");
    } else if (options->json) {
        json_t *answer = results_json_answer("ok", code, target->report);
        json_object_set_new(answer, "path", results_json_text(target->path));
        results_json_print(answer);
    } else {
        terminal_print_messages(target->report, stderr, false);
        printf("%s\n", target->path);
    }
    results_target_close(target);
    ff_report_free(target->report);
    return code;
}

static int write_with(const cli_options *options, const char *to, const char *stem)
{
    results_target target = {.report = ff_report_new()};
    bool good = run(options, to, stem, &target);
    return answer_target(options, &target, good);
}

/* Whether the operand is a description of figures, from which a page with nothing else is made:
 * `report map.figure.json`. */
static bool names_figures(const char *operand)
{
    size_t length = strlen(operand);
    return length > 5 && !strcmp(operand + length - 5, ".json");
}

static bool write_figures(const char *from, const cli_options *options, results_target *target)
{
    report_template *with = report_template_open(cli_option(options, "template"), target->report);
    json_error_t error;
    json_t *figures = study_read_json(AT_FDCWD, from, &error);
    bool good = json_is_array(figures) || ff_error(target->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                                                   "\"%s\" does not describe figures: %s", from,
                                                   figures ? "it is not a list" : error.text);
    good = good && with && results_target_open(target, false);
    if (good) {
        char *text = json_dumps(figures, JSON_COMPACT);
        report_write_figures(target->file.out, with, from, text);
        free(text);
    }
    json_decref(figures);
    report_template_close(with);
    return good && results_target_commit(target);
}

static int report_figures(const cli_options *options)
{
    const char *from = options->operand;
    results_target target = {.report = ff_report_new(), .begins = REPORT_BEGINS};
    target.path = options->directory
                      ? memory_print_text("%s", options->directory)
                      : memory_print_text("%.*s.html", (int)(strlen(from) - strlen(".json")), from);
    bool good = write_figures(from, options, &target);
    return answer_target(options, &target, good);
}

int cli_export(const cli_options *options)
{
    return write_with(options, cli_option(options, "to"), "results");
}

int cli_write_report(const cli_options *options)
{
    return names_figures(options->operand) ? report_figures(options)
                                           : write_with(options, "html", "report");
}
