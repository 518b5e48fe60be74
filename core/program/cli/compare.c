/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command compare: designs side by side. */
#include "../terminal/terminal.h"
#include "command.h"

#include "../memory/memory.h"
#include "../report/compare.h"
#include "../report/report.h"
#include "../results/json.h"
#include "../results/target.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* Splits "results/study:3" into the directory, which is to be freed, and the number of the case,
 * from 1; 0 if none is named. */
static char *split(const char *operand, size_t *number)
{
    const char *colon = strrchr(operand, ':');
    int64_t parsed = 0;
    char why[160];
    *number = 0;
    if (!colon || !isdigit((unsigned char)colon[1]) ||
        !ff_integer_parse(colon + 1, &parsed, why, sizeof why) || parsed < 1)
        return memory_print_text("%s", operand);
    *number = (size_t)parsed;
    return memory_print_text("%.*s", (int)(colon - operand), operand);
}

/* Opens the results that an operand names; its view is to be closed. False after an error. */
static bool open_design(const char *operand, report_design *design, ff_report *report)
{
    size_t number;
    char *directory = split(operand, &number);
    const results_view *view = results_view_open(directory, report);
    *design = (report_design){view, number ? number - 1 : 0, operand};
    const bool good = view && number <= view->case_count && (number > 0 || view->case_count == 1);
    if (view && !good)
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                 "%s: name one of its cases, %s:1 to %s:%zu", operand, directory, directory,
                 view->case_count);
    free(directory);
    return good;
}

static void print_line(void *ctx, int indent, const char *line)
{
    const cli_options *options = ctx;
    if (options->json)
        return;
    if (indent > 0)
        terminal_print_wrapped(line, 0, indent);
    else
        puts(line);
}

/* Writes the text to PATH with that ending. An existing file is replaced only if the program
 * wrote it. */
static bool write_file(const char *path, const char *ending, const char *begins, const char *text,
                       const report_template *with, ff_report *report)
{
    results_target target = {
        .path = memory_print_text("%s%s", path, ending), .begins = begins, .report = report};
    bool good = results_target_open(&target, false);
    if (good && with)
        report_write_figures(target.file.out, with, "Designs compared", text);
    else if (good)
        fputs(text, target.file.out);
    good = good && results_target_commit(&target);
    results_target_close(&target);
    return good;
}

/* Writes the page and the table. */
static bool write_files(const study_context *context, const cli_options *options, ff_report *report)
{
    const char *path = options->directory;
    report_template *with = report_template_open(cli_option(options, "template"), report);
    bool good = with;
    for (size_t i = 0; i < context->file_count && good; i++) {
        const study_result_file *file = &context->files[i];
        if (strstr(file->name, ".csv"))
            good = write_file(path, ".csv", "output of ", file->text, NULL, report);
        else if (strstr(file->name, ".figure.json"))
            good = write_file(path, ".html", REPORT_BEGINS, file->text, with, report);
    }
    report_template_close(with);
    return good;
}

static bool compare(const cli_options *options, const report_design *designs, size_t count,
                    ff_report *report)
{
    const study_run run = {.print_line = print_line, .ctx = (void *)options};
    study_context context = {.name = "compare", .report = report, .run = &run};
    study_answer answer = {.context = &context, .file = "compare"};
    bool good = report_compare(&answer, designs, count);
    study_answer_close(&answer);
    good = good && (!options->directory || write_files(&context, options, report));
    if (good && options->json) {
        json_t *told = results_json_answer("ok", EXIT_SUCCESS, report);
        json_object_update(told, context.facts);
        results_json_print(told);
    } else if (good && options->directory) {
        printf("as a page and a table: %s.html, %s.csv\n", options->directory, options->directory);
    }
    study_context_free(&context);
    return good;
}

int cli_compare(const cli_options *options)
{
    const size_t count = 2 + options->further.count;
    report_design *designs = memory_alloc(count * sizeof *designs);
    ff_report *report = ff_report_new();
    bool good = true;
    for (size_t i = 0; i < count && good; i++)
        good = open_design(i == 0   ? options->operand
                           : i == 1 ? options->second
                                    : options->further.words[i - 2],
                           &designs[i], report);
    good = good && compare(options, designs, count, report);
    const int code = good ? EXIT_SUCCESS : cli_refuse(report, options, "nothing was compared");
    for (size_t i = 0; i < count; i++)
        results_view_close(designs[i].view);
    free(designs);
    ff_report_free(report);
    return code;
}
