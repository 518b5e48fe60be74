/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters of laws from measured data, found by a fitter. */
#include "command.h"
#include "text.h"

#include "../../engine/pipeline/candidate.h"
#include "../../engine/pipeline/tool.h"
#include "../../engine/plugin/guard.h"
#include "../../engine/plugin/param.h"
#include "../../engine/value/columns.h"
#include "../results/folder.h"
#include "../results/json.h"

#include <flankfilm/comparison.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct fit_law {
    fe_candidate *candidate;
    char *id;
    ff_fit_law view;
    ff_fit_param *params;
    const ff_fit_param **param_rows;
} fit_law;

typedef struct text_file {
    char *name, *text;
} text_file;

typedef struct fitting {
    const cli_options *options;
    fe_report *report;
    fe_library *library;
    fe_tool tool, comparer;
    const ff_fitter *fitter;
    const ff_comparison *comparison; /* what is said of the laws */
    fe_columns columns;
    double *at; /* of each column; NaN: not asked */
    fe_tree *settings;
    fit_law *laws;
    size_t law_count;
    const ff_fit_law **views;
    ff_fit fit;
    ff_comparison_request request;
    text_file *files;
    size_t file_count;
    char *why; /* of the last refusal of a law */
    json_t *facts;
} fitting;

/* What a fitter may call. */

static const void *open_law(void *ctx, size_t index, const double *values)
{
    fitting *f = ctx;
    if (index >= f->law_count)
        return NULL;
    const fe_candidate *candidate = f->laws[index].candidate;
    fe_report *said = fe_report_new();
    const void *table = fe_candidate_open(f->laws[index].candidate, values, said);
    if (!table) {
        const char *why = fe_candidate_why(candidate);
        const char *text = fe_report_count(said) ? fe_report_at(said, 0)->text : "";
        free(f->why);
        f->why = fe_print_text("%s", *why ? why : text);
        if (fe_report_exit_code(said) == FE_EXIT_PLUGIN)
            fe_error(f->report, FE_EXIT_PLUGIN, FE_NOWHERE, NULL, "%s", text);
    }
    fe_report_free(said);
    /* a crash up to the next call from the fitter is taken for the law's; `call` sets this back */
    if (table)
        fe_guard_enter(fe_candidate_model(candidate)->path, f->laws[index].id, "its fit");
    return table;
}

static const char *tell_why(void *ctx)
{
    const fitting *f = ctx;
    return f->why ? f->why : "";
}

static ff_status refuse(void *ctx, size_t row, size_t column, const char *text)
{
    fitting *f = ctx;
    fe_error(f->report, FE_EXIT_INPUT, fe_columns_place(&f->columns, row, column), NULL, "%s",
             text);
    return FF_INVALID;
}

static void take_found(void *ctx, const ff_fit_found *found)
{
    fitting *f = ctx;
    f->comparison->found(f->comparison->self, &f->request, found);
}

static void take_file(void *ctx, const char *name, const char *text)
{
    fitting *f = ctx;
    f->files = fe_resize(f->files, (f->file_count + 1) * sizeof *f->files);
    f->files[f->file_count++] =
        (text_file){fe_copy_text(name, strlen(name)), fe_copy_text(text, strlen(text))};
}

/* What a comparison may call. */

static void print_quantity(void *ctx, const ff_param *row, double si, char *out, size_t size)
{
    fe_unit unit = {.factor = 1};
    char why[200];
    (void)ctx;
    fe_unit_parse(row->unit, &unit, why, sizeof why);
    fe_quantity_print(si, &unit, row->unit, out, size);
}

static ff_status refuse_law(void *ctx, const char *text)
{
    fe_error(((fitting *)ctx)->report, FE_EXIT_INPUT, FE_NOWHERE, NULL, "%s", text);
    return FF_INVALID;
}

static void warn(void *ctx, const char *text)
{
    fe_warn(((fitting *)ctx)->report, FE_NOWHERE, "%s", text);
}

static void take_facts(void *ctx, const char *json)
{
    fitting *f = ctx;
    json_decref(f->facts);
    f->facts = json_loads(json, 0, NULL);
}

static void put(void *ctx, const char *text)
{
    (void)ctx;
    fputs(text, stdout);
}

static void wrap(void *ctx, const char *text, int32_t column, int32_t indent)
{
    (void)ctx;
    cli_print_wrapped(text, column, indent);
}

/* The laws, and what the user says of their parameters. */

static bool add_law(fitting *f, const char *id)
{
    fe_candidate *candidate = fe_candidate_new(f->library, id, f->fitter->service, f->report);
    if (!candidate)
        return false;
    const fe_loaded *loaded = fe_candidate_model(candidate);
    size_t count = loaded->model->param_count;
    f->laws = fe_resize(f->laws, (f->law_count + 1) * sizeof *f->laws);
    fit_law *law = &f->laws[f->law_count++];
    *law = (fit_law){
        .candidate = candidate,
        .id = fe_copy_text(id, strlen(id)),
        .params = fe_alloc((count + 1) * sizeof *law->params),
        .param_rows = fe_alloc((count + 1) * sizeof *law->param_rows),
    };
    for (size_t i = 0; i < count; i++) {
        law->params[i] = (ff_fit_param){.size = sizeof *law->params,
                                        .row = ff_model_param(loaded->model, i),
                                        .factor = loaded->param_units[i].factor,
                                        .offset = loaded->param_units[i].offset,
                                        .said = FF_FIT_UNSAID,
                                        .value = NAN};
        law->param_rows[i] = &law->params[i];
    }
    law->view = (ff_fit_law){
        .size = sizeof law->view, .id = law->id, .params = law->param_rows, .param_count = count};
    return true;
}

static bool add_laws(fitting *f)
{
    char id[100];
    bool good = true;
    const cli_words named = cli_option_words(f->options, "law");
    for (size_t i = 0; i < named.count; i++) {
        const char *name = named.words[i];
        char *full = strchr(name, '/') ? fe_print_text("%s", name)
                                       : fe_print_text("%s/%s", f->options->operand, name);
        for (size_t k = 0; k < f->law_count; k++)
            if (!strcmp(f->laws[k].id, full))
                good = fe_error(f->report, FE_EXIT_INPUT, FE_NOWHERE, NULL, "--law names %s twice",
                                full);
        good = good && add_law(f, full);
        free(full);
    }
    for (size_t i = 0; !named.count && ff_word_at(f->fitter->laws, i, id, sizeof id); i++)
        good = add_law(f, id) && good;
    return good;
}

/* "name" of all laws, or "name" in the map of the law's id. */
static bool take_setting(fitting *f, const char *key, const fe_node *node, fit_law *only)
{
    bool used = false, good = true;
    for (size_t i = 0; i < f->law_count; i++) {
        fit_law *law = &f->laws[i];
        int param = ff_model_find_param(fe_candidate_model(law->candidate)->model, key);
        if (param < 0 || (only && law != only))
            continue;
        used = true;
        if (node->kind == FE_SCALAR && !strcmp(node->text, "free")) {
            law->params[param].said = FF_FIT_FREE;
        } else {
            law->params[param].said = FF_FIT_HELD;
            good = fe_candidate_hold(law->candidate, (size_t)param, node, f->report) && good;
            law->params[param].value = fe_candidate_held(law->candidate, (size_t)param);
        }
    }
    return used ? good
                : fe_error(f->report, FE_EXIT_INPUT, node->place, NULL,
                           "no law that is fitted has a parameter \"%s\"", key);
}

static bool take_settings(fitting *f)
{
    bool good = true;
    f->settings = fe_tree_parse("--set", ".", "{}", f->report);
    for (size_t i = 0; i < f->options->set_count && good; i++)
        good = fe_tree_set(f->settings, f->options->sets[i], NULL, fe_pipeline_top_keys, f->report);
    const fe_node *root = fe_tree_root(f->settings);
    for (size_t i = 0; root && i < root->count && good; i++) {
        const fe_node *node = root->items[i];
        fit_law *only = NULL;
        for (size_t k = 0; k < f->law_count; k++)
            if (!strcmp(f->laws[k].id, root->keys[i]))
                only = &f->laws[k];
        for (size_t k = 0; only && node->kind == FE_MAP && k < node->count; k++)
            good = take_setting(f, node->keys[k], node->items[k], only) && good;
        if (!only)
            good = take_setting(f, root->keys[i], node, NULL);
    }
    return good;
}

static void find_range(const fe_columns *c, size_t column, double *low, double *high)
{
    *low = *high = c->values[column][0];
    for (size_t i = 1; i < c->rows; i++) {
        *low = fmin(*low, c->values[column][i]);
        *high = fmax(*high, c->values[column][i]);
    }
}

/* --at: a value of the column that has its dimension, inside the data. */
static bool take_at(fitting *f, const char *text)
{
    const fe_columns *c = &f->columns;
    char why[300] = "";
    for (size_t k = 0; k < c->count; k++) {
        double low, high, si;
        const ff_param *row = c->asked[k];
        if (k == f->fitter->quantity || fe_unit_is_dimensionless(&c->units[k]) ||
            !fe_quantity_parse(text, &c->units[k], row->unit, &si, why, sizeof why))
            continue;
        if (!c->values[k])
            return fe_error(f->report, FE_EXIT_INPUT, FE_NOWHERE, NULL,
                            "--at \"%s\" asks for a %s, but the data have no such column", text,
                            row->name);
        find_range(c, k, &low, &high);
        double slack = 1e-9 * fmax(fabs(low), fabs(high));
        f->at[k] = si;
        if (si >= low - slack && si <= high + slack)
            return true;
        char first[64], last[64];
        fe_quantity_print(low, &c->units[k], row->unit, first, sizeof first);
        fe_quantity_print(high, &c->units[k], row->unit, last, sizeof last);
        return fe_error(f->report, FE_EXIT_INPUT, FE_NOWHERE, NULL,
                        "--at \"%s\" lies outside the data, whose %s goes from %s to %s: a fit "
                        "says nothing beyond",
                        text, row->name, first, last);
    }
    return fe_error(f->report, FE_EXIT_INPUT, FE_NOWHERE, NULL,
                    "--at \"%s\" is no quantity of the data: %s", text, why);
}

static bool take_ats(fitting *f)
{
    bool good = true;
    const cli_words ats = cli_option_words(f->options, "at");
    f->at = fe_alloc((f->columns.count + 1) * sizeof *f->at);
    for (size_t k = 0; k < f->columns.count; k++)
        f->at[k] = NAN;
    for (size_t i = 0; i < ats.count; i++)
        good = take_at(f, ats.words[i]) && good;
    return good;
}

static ff_status call_fit(const void *table, void *ctx)
{
    const ff_fitter *fitter = table;
    fitting *f = ctx;
    f->views = fe_alloc((f->law_count + 1) * sizeof *f->views);
    for (size_t i = 0; i < f->law_count; i++)
        f->views[i] = &f->laws[i].view;
    f->fit = (ff_fit){
        .size = sizeof f->fit,
        .ctx = f,
        .source = f->columns.source.name,
        .row_count = f->columns.rows,
        .columns = (const double *const *)f->columns.values,
        .at = f->at,
        .laws = f->views,
        .law_count = f->law_count,
        .open = open_law,
        .why = tell_why,
        .refuse = refuse,
        .found = take_found,
        .file = take_file,
    };
    f->request = (ff_comparison_request){
        .size = sizeof f->request,
        .ctx = f,
        .fitter = fitter,
        .fit = &f->fit,
        .lines = f->columns.lines,
        .named = cli_option(f->options, "law") != NULL,
        .quantity = print_quantity,
        .refuse = refuse_law,
        .warn = warn,
        .facts = take_facts,
        .put = put,
        .wrap = wrap,
    };
    return fitter->fit(fitter->self, &f->fit);
}

static ff_status call_judge(const void *table, void *ctx)
{
    const ff_comparison *comparison = table;
    return comparison->judge(comparison->self, &((fitting *)ctx)->request);
}

static ff_status call_print(const void *table, void *ctx)
{
    const ff_comparison *comparison = table;
    return comparison->print(comparison->self, &((fitting *)ctx)->request);
}

static bool work(fitting *f)
{
    const cli_options *options = f->options;
    const cli_words settings = cli_option_words(options, "with");
    const fe_tool_choice choice = {
        .option = "fit",
        .interface = FF_FITTER_ID,
        .name = options->operand,
        .settings = settings.words,
        .setting_count = settings.count,
    };
    const fe_tool_choice comparer = {
        .option = "fit", .interface = FF_COMPARISON_ID, .name = CLI_COMPARISON_MODEL};
    if (!fe_tool_open(&f->tool, f->library, &choice, f->report) ||
        !fe_tool_open(&f->comparer, f->library, &comparer, f->report))
        return false;
    f->fitter = f->tool.table;
    f->comparison = f->comparer.table;
    bool good = fe_columns_read(&f->columns, options->second, f->fitter->columns,
                                f->fitter->column_count, f->fitter->column_stride, f->report);
    good = add_laws(f) && good;
    good = take_settings(f) && good;
    return good && take_ats(f) && fe_tool_call(&f->tool, "fit", call_fit, f, f->report) &&
           fe_tool_call(&f->comparer, "judge", call_judge, f, f->report);
}

static json_t *answer_of(const fitting *f)
{
    json_t *answer = results_json_answer("ok", FE_EXIT_OK, f->report);
    json_object_update(answer, f->facts);
    return answer;
}

static void write_text(results_folder *folder, const char *name, const char *text)
{
    const char *dot = strrchr(name, '.');
    char *stem = fe_print_text("%.*s", (int)(dot ? (size_t)(dot - name) : strlen(name)), name);
    FILE *stream = results_folder_begin(folder, stem, dot ? dot : "");
    if (stream)
        fputs(text, stream);
    free(stem);
}

static bool write_files(const fitting *f, const char *directory)
{
    results_folder *folder = results_folder_open(directory, f->report);
    if (!folder)
        return false;
    for (size_t i = 0; i < f->file_count; i++)
        write_text(folder, f->files[i].name, f->files[i].text);
    json_t *answer = answer_of(f);
    char *text = json_dumps(answer, JSON_INDENT(1) | JSON_REAL_PRECISION(RESULTS_JSON_DIGITS));
    write_text(folder, "fit.json", text ? text : "");
    free(text);
    json_decref(answer);
    bool good = results_folder_commit(folder);
    results_folder_free(folder);
    return good;
}

/* results/<name of the data without its ending>; NULL: nothing is written. */
static char *directory_of(const cli_options *options)
{
    const char *slash = strrchr(options->second, '/');
    const char *name = slash ? slash + 1 : options->second, *dot = strrchr(name, '.');
    if (options->directory || options->json)
        return options->directory ? fe_print_text("%s", options->directory) : NULL;
    return fe_print_text("results/%.*s", (int)(dot ? (size_t)(dot - name) : strlen(name)), name);
}

static void close_fitting(fitting *f)
{
    for (size_t i = 0; i < f->law_count; i++) {
        fit_law *law = &f->laws[i];
        fe_candidate_free(law->candidate);
        free(law->id);
        free(law->params);
        free(law->param_rows);
    }
    for (size_t i = 0; i < f->file_count; i++) {
        free(f->files[i].name);
        free(f->files[i].text);
    }
    free(f->laws);
    free(f->files);
    free(f->views);
    free(f->why);
    free(f->at);
    json_decref(f->facts);
    fe_columns_free(&f->columns);
    fe_tree_free(f->settings);
    fe_tool_close(&f->comparer);
    fe_tool_close(&f->tool);
    fe_report_free(f->report);
    fe_library_free(f->library);
}

int cli_fit_command(const cli_options *options)
{
    fitting f = {.options = options,
                 .report = fe_report_new(),
                 .library = fe_library_new(options->plugin_paths, options->plugin_path_count)};
    char *directory = directory_of(options);
    int code = FE_EXIT_OK;
    if (!work(&f) || (directory && !write_files(&f, directory))) {
        code = cli_refuse(f.report, options, "nothing was fitted");
    } else if (options->json) {
        results_json_print(answer_of(&f));
    } else {
        fe_report_print(f.report, stderr, false);
        fe_tool_call(&f.comparer, "print", call_print, &f, f.report);
        if (directory)
            printf("\nresults in %s\n", directory);
    }
    free(directory);
    close_fitting(&f);
    return code;
}
