/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command fit: parameters of laws from measured data. */
#include "../fit/fit.h"
#include "../report/report.h"
#include "../results/folder.h"
#include "../results/json.h"
#include "../terminal/terminal.h"
#include "command.h"

#include <stdlib.h>
#include <string.h>

static bool work(fit *f, ff_engine *engine, const cli_options *options)
{
    if (strcmp(options->operand, "viscosity") != 0)
        return ff_error(f->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "fit finds parameters of viscosity laws, not of \"%s\"", options->operand);
    const cli_words laws = cli_option_words(options, "law"), ats = cli_option_words(options, "at");
    bool good = fit_read(f, options->second);
    good = fit_add_laws(f, engine, laws.words, laws.count) && good;
    good = fit_set(f, engine, options->sets, options->set_count) && good;
    return good && fit_set_conditions(f, ats.words, ats.count) && fit_run(f);
}

static json_t *answer_of(const fit *f)
{
    json_t *answer = results_json_answer("ok", EXIT_SUCCESS, f->report), *facts = fit_facts(f);
    json_object_update(answer, facts);
    json_decref(facts);
    return answer;
}

static void write_answer(const fit *f, FILE *out)
{
    json_t *answer = answer_of(f);
    json_dumpf(answer, out, JSON_INDENT(1) | JSON_REAL_PRECISION(RESULTS_JSON_DIGITS));
    json_decref(answer);
}

static void write_page(const fit *f, FILE *out)
{
    json_t *figure = fit_figure(f);
    char *text = json_dumps(figure, JSON_COMPACT | JSON_REAL_PRECISION(6));
    report_template *with = report_template_open(NULL, NULL);
    report_write_figures(out, with, "Viscosity laws against data", text);
    report_template_close(with);
    free(text);
    json_decref(figure);
}

static bool write_files(const fit *f, const char *directory)
{
    static const struct {
        const char *stem, *suffix;
        void (*write)(const fit *f, FILE *out);
    } files[] = {{"card", ".yaml", fit_write_card},
                 {"residuals", ".csv", fit_write_residuals},
                 {"residuals", ".html", write_page},
                 {"fit", ".json", write_answer}};
    results_folder *folder = results_folder_open(directory, "fit", f->report);
    if (!folder)
        return false;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        FILE *out = results_folder_begin(folder, files[i].stem, files[i].suffix);
        if (out)
            files[i].write(f, out);
    }
    bool good = results_folder_commit(folder);
    results_folder_free(folder);
    return good;
}

/* Returns the directory to write to, results/<name of the data without its ending>; NULL if nothing
 * is written. */
static char *directory_of(const cli_options *options)
{
    const char *slash = strrchr(options->second, '/');
    const char *name = slash ? slash + 1 : options->second, *dot = strrchr(name, '.');
    if (options->directory || options->json)
        return options->directory ? memory_print_text("%s", options->directory) : NULL;
    return memory_print_text("results/%.*s", (int)(dot ? (size_t)(dot - name) : strlen(name)),
                             name);
}

int cli_fit_command(const cli_options *options)
{
    fit f = {.report = ff_report_new()};
    ff_engine *engine = cli_engine_new(options);
    char *directory = directory_of(options);
    int code = EXIT_SUCCESS;
    if (!work(&f, engine, options) || (directory && !write_files(&f, directory))) {
        code = cli_refuse(f.report, options, "nothing was fitted");
    } else if (options->json) {
        results_json_print(answer_of(&f));
    } else {
        terminal_print_messages(f.report, stderr, false);
        fit_print(&f);
        if (directory)
            printf("\nresults in %s\n", directory);
    }
    free(directory);
    fit_free(&f);
    ff_report_free(f.report);
    ff_engine_close(engine);
    return code;
}
