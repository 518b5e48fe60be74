/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results for people and other programs. CSV and the page are the program's own; any other form is
   that of a model of the kind "writer". */
#include "command.h"
#include "service.h"

#include "../report/report.h"
#include "../results/export-csv.h"
#include "../results/json.h"
#include "../results/made.h"
#include "../results/target.h"
#include "../results/view.h"
#include "../study/study.h"
#include "../terminal/terminal.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char kind[] = "writer/";

typedef struct form {
    const char *name;
    const char *suffix; /* of one file: ".html"; "": it fills a directory */
    /* Of the program's own; NULL: a model does it. */
    bool (*write)(const ff_view *view, const results_target *target);
} form;

static bool write_csv(const ff_view *view, const results_target *target)
{
    return results_export_csv(view, target->folder);
}

static bool write_page(const ff_view *view, const results_target *target)
{
    return report_write(view, target->part, target->report);
}

static const form forms[] = {{"csv", "", write_csv}, {"html", ".html", write_page}};
enum { FORMS = sizeof forms / sizeof *forms };

/* "csv" of "writer/csv", which may be written out as of a model. */
static const char *name_of(const char *to)
{
    return strncmp(to, kind, sizeof kind - 1) ? to : to + sizeof kind - 1;
}

static const form *find_form(const char *name)
{
    for (size_t i = 0; i < FORMS; i++)
        if (!strcmp(forms[i].name, name))
            return &forms[i];
    return NULL;
}

/* False with an error when one of the program's own was meant, and there is no such model. */
static bool check_name(const char *name, ff_engine *engine, ff_report *report)
{
    const char *names[FORMS];
    size_t count;
    const char *const *ids = ff_engine_ids(engine, &count);
    char *id = memory_print_text("%s%s", kind, name);
    bool known = false;
    for (size_t i = 0; i < count; i++)
        known = known || !strcmp(ids[i], id);
    free(id);
    for (size_t i = 0; i < FORMS; i++)
        names[i] = forms[i].name;
    const char *near = known ? NULL : ff_nearest(name, names, FORMS);
    return !near || ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                             "there is no writer \"%s\"; did you mean \"%s\"?", name, near);
}

/* results.nc, or results-csv for a directory. */
static char *default_path(const char *directory, const char *stem, const form *to)
{
    size_t length = strlen(directory);
    const char *slash = length && directory[length - 1] == '/' ? "" : "/";
    return memory_print_text("%s%s%s%s%s", directory, slash, stem, *to->suffix ? to->suffix : "-",
                             *to->suffix ? "" : to->name);
}

typedef struct call {
    const void *table;
    const ff_view *view;
    results_target *target;
    bool no_memory; /* to give the writer what it asked for */

    const char *name; /* of the file that it asks for, or NULL */
    const char *path; /* where that is; NULL: nowhere */

    size_t variable, index; /* of the array that it asks for */
    ff_array *array;
    ff_status status;
} call;

/* The writer, which may have files open, is not left without memory: it is told. */
static bool find(call *c, void (*function)(void *ctx))
{
    bool found = ff_protected(function, c) == FF_OK;
    c->no_memory = c->no_memory || !found;
    return found;
}

static void find_path(void *ctx)
{
    call *c = ctx;
    results_target *to = c->target;
    c->path = to->folder ? c->name ? results_folder_path(to->folder, c->name) : NULL : to->part;
    if (!c->path)
        ff_error(to->report, FF_FAULT_PLUGIN, FF_NOWHERE, NULL,
                 "the writer asked for a file of the name \"%s\"", c->name ? c->name : "");
}

static const char *path_of(void *ctx, const char *name)
{
    call *c = ctx;
    c->name = name;
    return find(c, find_path) ? c->path : NULL;
}

static void load_array(void *ctx)
{
    call *c = ctx;
    c->status = c->view->load(c->view->ctx, c->variable, c->index, c->array);
}

static ff_status load(void *ctx, size_t variable, size_t index, ff_array *array)
{
    call *c = ctx;
    c->variable = variable;
    c->index = index;
    c->array = array;
    *array = (ff_array){.data = NULL};
    return find(c, load_array) ? c->status : FF_NOMEM;
}

static int32_t shape_of(void *ctx, size_t variable, size_t index, size_t shape[4])
{
    const call *c = ctx;
    return c->view->shape(c->view->ctx, variable, index, shape);
}

static void release(void *ctx, ff_array *array)
{
    const call *c = ctx;
    c->view->release(c->view->ctx, array);
}

static ff_status call_write(void *ctx)
{
    const call *c = ctx;
    const ff_writer *writer = c->table;
    const ff_target target = {.size = sizeof target, .ctx = ctx, .path = path_of};
    ff_view view = *c->view;
    view.ctx = ctx;
    view.shape = shape_of;
    view.load = load;
    view.release = release;
    return writer->write(writer->self, &view, &target);
}

/* What the view reported comes before what the writer made of it. */
static bool call_writer(ff_instance *writer, const ff_view *view, results_target *to)
{
    call c = {.view = view, .target = to};
    ff_status status = ff_instance_service(writer, FF_WRITER_ID, &c.table);
    if (status == FF_OK || status == FF_DOMAIN)
        status = ff_instance_call(writer, "write", call_write, &c);
    if (c.no_memory)
        memory_require(NULL);
    bool good = status == FF_OK || status == FF_DOMAIN;
    if (ff_report_errors(to->report) == 0)
        ff_report_append(to->report, ff_instance_report(writer));
    return good && ff_report_errors(to->report) == 0;
}

/* The form that a model writes; NULL after an error. */
static ff_instance *open_writer(ff_engine *engine, const cli_options *options, const char *name,
                                form *to, ff_report *report)
{
    const void *table;
    ff_instance *writer = cli_service_open(engine, options, "to", FF_WRITER_ID, &table, report);
    const char *slash = strchr(name, '/');
    if (!writer)
        return NULL;
    to->name = slash ? slash + 1 : name;
    to->suffix = ((const ff_writer *)table)->suffix;
    return writer;
}

/* A directory of results would lose them: its files are replaced together. */
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
                    "\"%s\" holds the results of a run or a study", path);
}

static bool write_to(const form *to, ff_instance *writer, const ff_view *view,
                     const cli_options *options, const char *stem, results_target *target)
{
    target->path = options->directory ? memory_print_text("%s", options->directory)
                                      : default_path(options->operand, stem, to);
    bool good = (*to->suffix || holds_no_run(target->path, target->report)) &&
                results_target_open(target, !*to->suffix) &&
                (to->write ? to->write(view, target) : call_writer(writer, view, target));
    if (good)
        results_made_note(options->operand, target->path,
                          target->part ? target->part : target->path);
    return good && results_target_commit(target);
}

static bool run(const cli_options *options, const char *name, const char *stem, ff_engine *engine,
                results_target *target)
{
    const ff_view *view = results_view_open(options->operand, target->report);
    const form *own = find_form(name);
    form to = own ? *own : (form){.name = name};
    ff_instance *writer = NULL;
    const cli_words settings = cli_option_words(options, "with");
    bool good = view != NULL;
    if (good && own && settings.count)
        good = ff_error(target->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "--with %s: %s takes no parameters", settings.words[0], name);
    else if (good && !own)
        good = check_name(name, engine, target->report) &&
               (writer = open_writer(engine, options, name, &to, target->report));
    good = good && write_to(&to, writer, view, options, stem, target);
    ff_instance_close(writer);
    results_view_close(view);
    return good;
}

static int write_with(const cli_options *options, const char *to, const char *stem)
{
    const char *name = name_of(to);
    ff_engine *engine = cli_engine_new(options);
    results_target target = {.report = ff_report_new()};
    bool good = run(options, name, stem, engine, &target);
    int code = EXIT_SUCCESS;
    if (!good) {
        code = cli_refuse(target.report, options, "nothing was written");
    } else if (options->json) {
        json_t *answer = results_json_answer("ok", code, target.report);
        json_object_set_new(answer, "path", results_json_text(target.path));
        results_json_print(answer);
    } else {
        terminal_print_messages(target.report, stderr, false);
        printf("%s\n", target.path);
    }
    results_target_close(&target);
    ff_report_free(target.report);
    ff_engine_close(engine);
    return code;
}

int cli_export(const cli_options *options)
{
    return write_with(options, cli_option(options, "to"), "results");
}

int cli_write_report(const cli_options *options)
{
    const char *to = cli_option(options, "to");
    if (!to && cli_names_figures(options->operand))
        return cli_report_figures(options);
    return write_with(options, to ? to : "html", "report");
}
